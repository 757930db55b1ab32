#!/bin/sh
# Put "Pencil2D with Lampblack" and "Lampblack" among the user's programs, or take them away:
# desktop.sh install BUILD PYTHON, desktop.sh uninstall
set -eu
data=${XDG_DATA_HOME:-$HOME/.local/share}
home=$data/lampblack
launcher=$HOME/.local/bin/pencil2d-lampblack
entry=$data/applications/pencil2d-lampblack.desktop
window=$HOME/.local/bin/lampblack-window
window_entry=$data/applications/lampblack-window.desktop
icon=$data/icons/hicolor/scalable/apps/lampblack.svg

case "$1" in
    install)
        mkdir -p "$home/plugins/generic" "$(dirname "$launcher")" "$(dirname "$entry")" "$(dirname "$icon")"
        # A running Pencil2D has the old plugin mapped: put the new one in its place, not into it.
        cp "$2/plugins/generic/liblampblack.so" "$home/plugins/generic/liblampblack.so.new"
        mv "$home/plugins/generic/liblampblack.so.new" "$home/plugins/generic/liblampblack.so"
        cp "$2/lampblack-window" "$home/lampblack-window.new"
        mv "$home/lampblack-window.new" "$home/lampblack-window"
        cp scripts/launch.sh "$home/launch.sh"
        cp pencil2d_plugin/tool/icons/lamp.svg "$icon"
        cat >"$launcher" <<EOF
#!/bin/sh
exec "$home/launch.sh" "$home/plugins" "$3" "\$@"
EOF
        cat >"$window" <<EOF
#!/bin/sh
LAMPBLACK_PYTHON="\${LAMPBLACK_PYTHON:-$3}" exec "$home/lampblack-window" "\$@"
EOF
        chmod 755 "$launcher" "$home/launch.sh" "$window"
        sed "s|^Exec=lampblack-window|Exec=\"$window\"|" packaging/lampblack-window.desktop >"$window_entry"
        cat >"$entry" <<EOF
[Desktop Entry]
Type=Application
Name=Pencil2D with Lampblack
Comment=Draw animation and light it
Exec="$launcher" %f
Icon=lampblack
Categories=Graphics;2DGraphics;
MimeType=application/x-pencil2d-pclx;
EOF
        echo "Installed: \"Lampblack\" is the window for drawings of any program, $window"
        echo "Installed: start \"Pencil2D with Lampblack\" from the menu, or type $launcher"
        ;;
    uninstall)
        rm -rf "$home/plugins" "$home/launch.sh" "$home/lampblack-window"
        rm -f "$launcher" "$entry" "$icon" "$window" "$window_entry"
        rmdir "$home" 2>/dev/null || true
        echo "Removed. Projects and their lighting are left as they are."
        ;;
esac
