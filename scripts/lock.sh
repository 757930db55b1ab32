#!/bin/sh
# Renew requirements/: the newest version that pyproject.toml admits of every package that Lampblack,
# its tests and its build need, for each Python that has a file there. For another Python, make an
# empty python3.N.txt first.
#
# Torch comes as several builds of one version, and a machine may have one of its own: these, and
# the CUDA packages that only some of them need, are listed apart, without hashes, as constraints.
set -eu
cd "$(dirname "$0")/.."
tools=$(mktemp -d)
trap 'rm -rf "$tools"' EXIT
"${PYTHON:-python3}" -m venv "$tools"
"$tools/bin/pip" install --quiet --disable-pip-version-check uv

for lock in requirements/python3.*.txt; do
    case "$lock" in *-torch.txt) continue ;; esac
    version=${lock#requirements/python}
    version=${version%.txt}
    sed -n 's/^requires = \["\(.*\)"\]$/\1/p' pyproject.toml |
        "$tools/bin/uv" --no-config pip compile --quiet pyproject.toml - --extra dev \
            --python-version "$version" --python-platform x86_64-unknown-linux-gnu \
            --generate-hashes --no-header --no-annotate --output-file "$tools/all"
    awk -v torch="$tools/torch" '
        /^[a-z]/ { apart = /^(torch|triton|nvidia-.*|cuda-.*)==/; if (apart) print $1 > torch }
        ! apart' "$tools/all" >"$tools/rest"
    cp "$tools/rest" "$lock"
    cp "$tools/torch" "${lock%.txt}-torch.txt"
done
