#!/bin/bash
# SPDX-License-Identifier: MIT
# Is --accuracy pixel what --accuracy exact is, to the eye? Renders all scenes in reach (ours, those of
# povray-examples with patches, and the corpus where it is there) with both, and counts pixels that
# are off by more than one step of 8 bits; prints a table with what each took, in turn, user seconds,
# median of the rounds. Also draft and fine. All scenes: the table goes into README.md as well, between
# <!-- accuracy --> and <!-- end of accuracy -->. Exit status 1 when pixel or fine is off anywhere.
# Arguments: rounds (an odd number, 3), then scenes instead of all.
set -eu
cd "$(dirname "$0")/.."
rounds=${1:-3}
[ $# -gt 0 ] && shift
examples=/usr/share/doc/povray/examples corpus=../shared/corpus
into_readme=
[ $# -gt 0 ] || into_readme=yes
[ $# -gt 0 ] || set -- scenes/*/*.pov "$examples"/objects/bezier.pov "$examples"/objects/primitiv.pov \
    "$examples"/advanced/teapot/teapot.pov "$corpus"/*/*.pov
folder=$(mktemp -d)
table=$(mktemp)
trap 'rm -rf "$folder" "$table"' EXIT
status=0

user_seconds() {
    bash -c 'TIMEFORMAT=%U; { time "$@" >"$0.log" 2>&1 </dev/null; } 2>&1' "$folder/run" "$@"
}
median() { sort -n "$1" | sed -n "$(((rounds + 1) / 2))p"; }
off() {
    build/qicompare "$folder/exact.png" "$folder/$1.png" --fail 1 --warn 1 2>/dev/null |
        sed -n 's/^ *\([0-9]*\) pixels.*off by more than one step.*/\1/p'
}

say() { echo "$1" | tee -a "$table"; }
say "| scene | exact, s | fine | pixel | draft | pixel / exact | pixels off: fine | pixel | draft |"
say "|---|---|---|---|---|---|---|---|---|"
for scene; do
    [ -f "$scene" ] || continue
    rm -f "$folder"/*
    for _ in $(seq "$rounds"); do
        for name in exact fine pixel draft; do
            user_seconds build/qirender "+I$scene" "+L$(dirname "$scene")" +Lscenes/teapot +W320 +H240 +A0.3 -V +WT1 \
                --accuracy $name "+O$folder/$name.png" >>"$folder/$name.txt"
            [ -f "$folder/$name.png" ] || { say "| $(basename "$scene") | not rendered: $(tail -1 "$folder/run.log") | | | | | | | |"; continue 3; }
        done
    done
    pixel=$(off pixel) fine=$(off fine) draft=$(off draft)
    [ "${pixel:-0}${fine:-0}" = 00 ] || status=1
    say "$(echo "$(basename "$scene") $(median "$folder/exact.txt") $(median "$folder/fine.txt") $(median "$folder/pixel.txt")" \
        "$(median "$folder/draft.txt") ${fine:-0} ${pixel:-0} ${draft:-0}" |
        awk '{printf "| %s | %s | %s | %s | %s | %.2f | %s | %s | %s |\n", $1, $2, $3, $4, $5, $4 / ($2 > 0 ? $2 : 1), $6, $7, $8}')"
done
if [ -n "$into_readme" ]; then
    tests/readme_table.sh accuracy "$table"
fi
exit $status
