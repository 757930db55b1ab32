#!/bin/sh
# Build the site of the documentation into build/site/, in an environment of its own.
set -eu
cd "$(dirname "$0")/.."
venv=build/docs-venv
lock=requirements/docs.txt
if ! cmp -s "$lock" "$venv/installed"; then
    python3 -m venv "$venv"
    "$venv/bin/pip" install --disable-pip-version-check --require-hashes --no-deps -r "$lock"
    cp "$lock" "$venv/installed"
fi
# The pages lie as they do in the repository, so that each link leads to the same place here and there.
rm -rf build/docs
mkdir -p build/docs
git ls-files -co --exclude-standard ':(glob)*.md' LICENSE docs ':(glob)protocol/*' |
    tar -cf - -T - | tar -xf - -C build/docs
# Quiet it must not be: mkdocs counts warnings as it prints them.
NO_MKDOCS_2_WARNING=1 "$venv/bin/mkdocs" build
echo "Site: $PWD/build/site/index.html"
