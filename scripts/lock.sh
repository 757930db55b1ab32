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
    # What the panel's installer installs: the worker alone, in the same versions. The sizes are measured.
    worker=packaging/worker-python$version.txt
    sed -n 's/^\([a-z0-9][a-z0-9._-]*==[^ ;\\]*\).*/\1/p' "$lock" >"$tools/versions"
    "$tools/bin/uv" --no-config pip compile --quiet pyproject.toml --constraint "$tools/versions" \
        --python-version "$version" --python-platform x86_64-unknown-linux-gnu \
        --generate-hashes --no-header --no-annotate --output-file "$tools/worker"
    { grep '^# bytes' "$worker" || true; cat "$tools/worker"; } >"$tools/sized"
    cp "$tools/sized" "$worker"
    cp "$tools/torch" "${lock%.txt}-torch.txt"
done

# What builds the site of the documentation, for any Python.
"$tools/bin/uv" --no-config pip compile --quiet --group pyproject.toml:docs \
    --python-version 3.11 --python-platform x86_64-unknown-linux-gnu \
    --generate-hashes --no-header --no-annotate --output-file "$tools/docs"
cp "$tools/docs" requirements/docs.txt
