#!/bin/sh
# Install what Lampblack needs and this machine lacks: system libraries (Debian), and a virtual
# environment. Run again at will: what is there is left alone.
#
#   environment.sh            the worker and its command line
#   environment.sh plugin     also Pencil2D and what builds the plugin
#   environment.sh dist       also what makes packages
#   environment.sh test       also a virtual display and what drives it
#
# VENV names the environment, .venv unless set. Its packages have the versions of requirements/
# (scripts/lock.sh), or with NEWEST=1 the newest that pyproject.toml admits.
set -eu
cd "$(dirname "$0")/.."

PACKAGES="libgl1 libice6 libsm6 libx11-6 libxext6 libxfixes3 libxi6 libxkbcommon0 libxrender1 libxt6"
PLUGIN="pencil2d cmake ninja-build g++ pkg-config qtbase5-dev libqt5svg5 cppzmq-dev libzmq3-dev libsodium-dev"
DIST="git dpkg-dev"
TEST="ccache xvfb openbox xdotool imagemagick fonts-dejavu-core"
case "${1:-}" in
    plugin) PACKAGES="$PACKAGES $PLUGIN" ;;
    dist) PACKAGES="$PACKAGES $PLUGIN $DIST" ;;
    test) PACKAGES="$PACKAGES $PLUGIN $TEST" ;;
esac
VENV=${VENV:-.venv}
STAMP=$VENV/installed

fail() {
    echo "error: $1" >&2
    echo "  $2" >&2
    exit 1
}

# Blender's module is for some versions of Python only: those that have a file in requirements/.
lock_of() { "$1" -c 'import sys; print("requirements/python%d.%d" % sys.version_info[:2])' 2>/dev/null; }
if [ -z "${PYTHON:-}" ]; then
    for PYTHON in python3.11 python3.13; do
        LOCK=$(lock_of "$PYTHON") && [ -f "$LOCK.txt" ] && break
    done
fi
{ LOCK=$(lock_of "$PYTHON") && [ -f "$LOCK.txt" ]; } ||
    fail "There is no Python 3.11 or 3.13 here, one of which Blender's module needs." \
        "On Debian 12 and 13: apt-get install python3 python3-venv. Elsewhere: make PYTHON=/path/to/python3.13"

if command -v dpkg-query >/dev/null; then
    missing=""
    for package in $PACKAGES; do
        # Since Debian 13 some names end in t64, for their 64-bit times.
        dpkg-query -W -f '${Status}\n' "$package" "${package}t64" 2>/dev/null | grep -q 'ok installed' ||
            missing="$missing $package"
    done
    if [ -n "$missing" ]; then
        as_root=""
        if [ "$(id -u)" != 0 ]; then
            command -v sudo >/dev/null || fail "System packages are missing." "As root: apt-get install$missing"
            as_root=sudo
        fi
        # A list of packages may be old or not there yet: fetch it only when it is needed.
        $as_root apt-get install -y --no-install-recommends $missing ||
            { $as_root apt-get update && $as_root apt-get install -y --no-install-recommends $missing; }
    fi
fi

wanted=$(cat pyproject.toml scripts/environment.sh "$LOCK.txt" "$LOCK-torch.txt" | cksum)
[ -z "${NEWEST:-}" ] || wanted="newest of $(date +%F), $wanted"
[ -f "$STAMP" ] && [ "$(cat "$STAMP")" = "$wanted" ] && exit 0
"$PYTHON" -m venv "$VENV" ||
    fail "The virtual environment could not be made." "On Debian: apt-get install python3-venv"
install() { "$VENV/bin/pip" install --disable-pip-version-check "$@"; }
if [ -n "${NEWEST:-}" ]; then
    install --upgrade --upgrade-strategy eager -e '.[dev]'
else
    install --require-hashes --no-deps -r "$LOCK.txt"
    install -c "$LOCK-torch.txt" torch
    install --no-deps --no-build-isolation -e .
fi
echo "$wanted" >"$STAMP"
