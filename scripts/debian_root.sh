#!/bin/sh
# Run a command in another Debian, where it finds the project: debian_root.sh bookworm|trixie|sid [COMMAND...]
#
# The root is made when it is missing (debootstrap, as root), and kept in DEBIAN_ROOTS, a folder under
# ~/.cache unless set. In it, the project is /lampblack, with a build/ of its own and a .venv that roots of
# the same Python share. Packages come from DEBIAN_MIRROR; unless set, from where this machine's apt takes
# Debian's.
set -eu
cd "$(dirname "$0")/.."

fail() {
    echo "error: $1" >&2
    echo "  $2" >&2
    exit 1
}

suite=${1:-}
case "$suite" in
    bookworm) python=python3.11 ;;
    trixie | sid) python=python3.13 ;;
    *) fail "\"$suite\" is not a Debian known here." "debian_root.sh bookworm|trixie|sid [COMMAND...]" ;;
esac
shift
[ "$(id -u)" = 0 ] || fail "Only root can make and enter a Debian root." "Run this as root."
command -v debootstrap >/dev/null || fail "debootstrap is missing." "apt-get install debootstrap"

# All that is mounted below is seen by this script and its children only, and goes with them.
if [ -z "${IN_DEBIAN_ROOT:-}" ]; then
    IN_DEBIAN_ROOT=1 exec unshare --mount --propagation private "$0" "$suite" "$@"
fi
unset IN_DEBIAN_ROOT

ROOTS=${DEBIAN_ROOTS:-${XDG_CACHE_HOME:-$HOME/.cache}/lampblack-debian}
root=$ROOTS/$suite
venv=$ROOTS/venv-$python
if [ -z "${DEBIAN_MIRROR:-}" ]; then
    DEBIAN_MIRROR=$(apt-get indextargets --format '$(LABEL) $(REPO_URI)' 'Created-By: Packages' 2>/dev/null |
        sed -n 's/^Debian //p' | head -n 1)
fi
DEBIAN_MIRROR=${DEBIAN_MIRROR:-http://deb.debian.org/debian}

in_root() {
    # The checkout may be another user's than root's.
    chroot "$root" /usr/bin/env HOME=/root TMPDIR=/tmp LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
        GIT_CONFIG_COUNT=1 GIT_CONFIG_KEY_0=safe.directory GIT_CONFIG_VALUE_0=/lampblack "$@"
}

mount_all() {
    for folder in dev proc sys; do
        mount --rbind "/$folder" "$root/$folder"
    done
    # Names and certificates of the network that this machine is in.
    [ ! -e "$root/etc/resolv.conf" ] || mount --bind /etc/resolv.conf "$root/etc/resolv.conf"
    [ ! -d /etc/ssl/certs ] || mount --bind -o ro /etc/ssl/certs "$root/etc/ssl/certs"
    mount --bind . "$root/lampblack"
    mount --bind "$venv" "$root/lampblack/.venv"
    mount --bind "$root/var/lib/lampblack-build" "$root/lampblack/build"
}

mkdir -p "$ROOTS" build .venv
exec 9>"$ROOTS/$suite.lock"
flock 9
if [ ! -e "$root.complete" ]; then
    rm -rf --one-file-system "$root"
    debootstrap --variant=minbase --include=ca-certificates "$suite" "$root" "$DEBIAN_MIRROR"
    # A mirror may lag behind, and the Release file of sid is valid for a week only.
    echo 'Acquire::Check-Valid-Until "false";' >"$root/etc/apt/apt.conf.d/80lampblack"
    # The root can be made again: its packages need not wait for the disk.
    echo force-unsafe-io >"$root/etc/dpkg/dpkg.cfg.d/lampblack"
    mkdir -p "$root/lampblack" "$root/var/lib/lampblack-build" "$root/etc/ssl/certs" "$venv"
    touch "$root/etc/resolv.conf"
    mount_all
    in_root apt-get update
    # By apt: debootstrap does not find what other packages provide, as Debian 12's venv needs.
    in_root apt-get install -y --no-install-recommends make "$python" "$python-venv"
    touch "$root.complete"
else
    mkdir -p "$venv"
    mount_all
fi
flock --unlock 9
[ $# -gt 0 ] || exit 0
in_root sh -c 'cd /lampblack && exec "$@"' sh "$@"
