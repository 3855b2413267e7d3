#!/bin/sh
# SPDX-License-Identifier: MIT
# Writes the accuracy study into README.md, between <!-- study --> and <!-- end of study -->. Arguments:
# rounds (an odd number, 1), seconds that a point may take (20). The scenes that are there are measured; the others are named.
set -eu
cd "$(dirname "$0")/.."
folder=$(mktemp -d) found=
trap 'rm -rf "$folder"' EXIT
for scene in /usr/share/doc/povray/examples/advanced/teapot/teapot.pov ../shared/corpus/fmunoz/fruit_only.pov; do
    if [ -f "$scene" ]; then
        found="$found $scene"
    else
        echo "left out, it is not here: $scene" >&2
    fi
done
# shellcheck disable=SC2086
build/qibench sweep --study --rounds "${1:-1}" --patience "${2:-20}" $found >"$folder/study"
cat "$folder/study"
tests/readme_table.sh study "$folder/study"
