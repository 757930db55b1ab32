#!/bin/sh
# Open Pencil2D with Lampblack: launch.sh PLUGINS PYTHON [PROJECT]
#
# PLUGINS is the folder that holds generic/liblampblack.so, PYTHON the interpreter of the worker; empty is
# that which the panel installs.
set -eu
plugins=$1
python=$2
shift 2
[ -z "$python" ] || export LAMPBLACK_PYTHON="$python"
export QT_PLUGIN_PATH="$plugins${QT_PLUGIN_PATH:+:$QT_PLUGIN_PATH}"
export QT_QPA_GENERIC_PLUGINS="lampblack${QT_QPA_GENERIC_PLUGINS:+,$QT_QPA_GENERIC_PLUGINS}"
command -v pencil2d >/dev/null || {
    echo "error: Pencil2D is not installed." >&2
    echo "  On Debian: apt-get install pencil2d" >&2
    exit 1
}
exec pencil2d "$@"
