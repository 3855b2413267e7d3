#!/bin/sh
# SPDX-License-Identifier: MIT
# Writes the tables of speed into README.md, each between its two marks (<!-- NAME --> and
# <!-- end of NAME -->). Arguments: rounds (an odd number, 5), then the tables, all unless named:
# programs methods picture lattices threads.
# programs: beside POV-Ray, user seconds of whole runs at 800x600 on one thread, in turn, median; and
# the share of pixels of the two pictures that differ by more than one step of 8 bits.
set -eu
cd "$(dirname "$0")/.."
rounds=${1:-5}
[ $# -gt 0 ] && shift
[ $# -gt 0 ] || set -- programs methods picture lattices threads
folder=$(mktemp -d) examples=/usr/share/doc/povray/examples
trap 'rm -rf "$folder"' EXIT

# user_seconds COMMAND...: the processor time of the command in user mode.
user_seconds() {
    bash -c 'TIMEFORMAT=%U; { time "$@" >/dev/null 2>&1 </dev/null; } 2>&1' time "$@"
}
median() { sort -n "$1" | sed -n "$(((rounds + 1) / 2))p"; }

programs() {
    echo "| scene | POV-Ray, s | qirender, s | ratio | pixels that differ |"
    echo "|---|---|---|---|---|"
    for scene in $examples/objects/bezier.pov $examples/advanced/teapot/teapot.pov scenes/teapot-matte/teapot-matte.pov \
        scenes/teapot-chrome/teapot-chrome.pov scenes/folds/folds.pov scenes/shells/shells.pov \
        ../shared/corpus/fmunoz/fruit_only.pov; do
        [ -f "$scene" ] || continue
        rm -f "$folder"/*.txt
        for _ in $(seq "$rounds"); do
            user_seconds povray "+I$scene" "+O$folder/a.png" "+L$(dirname "$scene")" +Lscenes/teapot +W800 +H600 -A -D +WT1 >>"$folder/a.txt"
            user_seconds build/qirender "+I$scene" "+O$folder/b.png" "+L$(dirname "$scene")" +Lscenes/teapot +W800 +H600 -A -D +WT1 >>"$folder/b.txt"
        done
        differ=$(build/qicompare "$folder/a.png" "$folder/b.png" --fail 1 --warn 1 2>/dev/null | sed -n 's/.*(\(.*%\)) off by more than one step.*/\1/p')
        echo "$(basename "$scene") $(median "$folder/a.txt") $(median "$folder/b.txt") $differ" |
            awk '{printf "| %s | %s | %s | %.2f | %s |\n", $1, $2, $3, $2 / $3, $4}'
    done
}

for table in "$@"; do
    if [ "$table" = programs ]; then
        programs >"$folder/table"
    else
        build/qibench speed "$table" --rounds "$rounds" >"$folder/table"
    fi
    cat "$folder/table"
    tests/readme_table.sh "$table" "$folder/table"
done
