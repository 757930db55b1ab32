#!/bin/sh
# Build what users install into dist/: the worker's wheel and sdist, and the .deb of the plugin for the
# Debian that this runs on. It takes the last commit, so two builds of one commit are equal to the last byte.
#
# PYTHON names an interpreter with setuptools, .venv's unless set.
set -eu
cd "$(dirname "$0")/.."
umask 022
PYTHON=${PYTHON:-$PWD/.venv/bin/python}
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
dist=$PWD/dist
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

mkdir -p "$dist" "$work/source"
git archive HEAD | tar -x -C "$work/source"
cd "$work/source"
mkdir "$work/made"
for kind in wheel sdist; do
    "$PYTHON" -c "from setuptools.build_meta import *; build_$kind('$work/made')" >"$work/log" 2>&1 || {
        cat "$work/log" >&2
        exit 1
    }
done
wheel=$(basename "$work"/made/*.whl)
version=$(echo "$wheel" | cut -d- -f2)
cp "$work/made/$wheel" "$dist/"

# setuptools writes the time of the build into a sdist.
mkdir "$work/sdist"
tar -xf "$work"/made/*.tar.gz -C "$work/sdist"
tar --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner --format=ustar \
    -C "$work/sdist" -cf - "lampblack-$version" | gzip -9n >"$dist/lampblack-$version.tar.gz"

debian=$(. /etc/os-release && echo "${VERSION_ID:-$VERSION_CODENAME}")
architecture=$(dpkg --print-architecture)
libraries=usr/lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH)/lampblack
root=$work/root
plugin=$root/$libraries/plugins/generic/liblampblack.so
window=$root/$libraries/lampblack-window
# The linker's own digest is of paths that are stripped away.
cmake --preset dev -DLAMPBLACK_TESTS=OFF -DCMAKE_MODULE_LINKER_FLAGS=-Wl,--build-id=none \
    -DCMAKE_EXE_LINKER_FLAGS=-Wl,--build-id=none >/dev/null
cmake --build --preset dev --target lampblack lampblack-window
install -D -m 644 -s build/dev/plugins/generic/liblampblack.so "$plugin"
install -D -m 755 -s build/dev/lampblack-window "$window"
for binary in "$plugin" "$window"; do
    echo '{"installer": "/usr/share/lampblack"}' >"$(dirname "$binary")/lampblack.json"
done
install -D -m 755 packaging/pencil2d-lampblack "$root/usr/bin/pencil2d-lampblack"
sed -i "s|@PLUGINS@|/$libraries/plugins|" "$root/usr/bin/pencil2d-lampblack"
ln -s "/$libraries/lampblack-window" "$root/usr/bin/lampblack-window"
share=$root/usr/share
install -D -m 755 -t "$share/lampblack" scripts/launch.sh
install -D -m 644 -t "$share/lampblack" packaging/install_worker.py packaging/worker-python*.txt "$dist/$wheel"
install -D -m 644 -t "$share/applications" packaging/pencil2d-lampblack.desktop packaging/lampblack-window.desktop
install -D -m 644 -t "$share/metainfo" packaging/org.lampblack.Pencil2D.metainfo.xml
install -D -m 644 pencil2d_plugin/tool/icons/lamp.svg "$share/icons/hicolor/scalable/apps/lampblack.svg"
install -D -m 644 packaging/copyright "$share/doc/pencil2d-lampblack/copyright"

# dpkg-shlibdeps wants a debian/control beside it.
mkdir -p "$work/deps/debian" "$root/DEBIAN"
printf 'Source: lampblack\n\nPackage: pencil2d-lampblack\nArchitecture: any\n' >"$work/deps/debian/control"
depends=$(cd "$work/deps" && dpkg-shlibdeps -O "$plugin" "$window" 2>/dev/null |
    sed -n 's/^shlibs:Depends=//p')
sed -e "s#@VERSION@#$version~debian$debian#" -e "s#@ARCHITECTURE@#$architecture#" -e "s#@DEPENDS@#$depends#" \
    -e "s#@SIZE@#$(du -sk --apparent-size "$root/usr" | cut -f1)#" packaging/control >"$root/DEBIAN/control"
# Blocks of several threads are cut as the memory of the moment allows.
find "$root" -exec touch -h -d "@$SOURCE_DATE_EPOCH" {} +
dpkg-deb --root-owner-group -Zxz --threads-max=1 --build "$root" \
    "$dist/pencil2d-lampblack_$version~debian${debian}_$architecture.deb" >/dev/null
cd "$dist" && sha256sum "$wheel" "lampblack-$version.tar.gz" pencil2d-lampblack_"$version~debian$debian"_*.deb
