#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# How fast scenes are read, beside POV-Ray: user time, medians of interleaved runs, as a table. A
# loop of arithmetic statements, a file of literal patches, and the scenes of povray-examples that
# take POV-Ray more than 0.1 s at one pixel. RUNS: how many runs each; EXAMPLES: where the scenes are.
set -u
cd "$(dirname "$0")/.." || exit 2
runs=${RUNS:-5}
examples=${EXAMPLES:-/usr/share/doc/povray/examples}
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
root=$PWD

head='#version 3.7; global_settings { assumed_gamma 1 }'
printf '%s\n#declare S = 0; #declare T = 1;\n#for (I, 1, 1000000)\n%s\n#end\nsphere { 0, 1 }\n' \
    "$head" '  #declare S = S + I * 0.5 - T / 3;' >"$work/loop.pov"
awk -v head="$head" 'BEGIN {
    srand(1); print head; print "union {"
    for (i = 0; i < 100000; i++) {
        print "bicubic_patch { type 1 flatness 0.01 u_steps 3 v_steps 3"
        for (k = 0; k < 16; k++)
            printf "<%.6f, %.6f, %.6f>%s\n", rand() * 20, rand() * 20, rand() * 20, k < 15 ? "," : ""
        print "}"
    }
    print "pigment { rgb 1 } }" }' >"$work/patches.pov"

seconds() { # program, arguments: user time
    TIMEFORMAT=%U
    { time "$@" >/dev/null 2>&1; } 2>&1
}
median() { sort -n | sed -n "$(((runs + 1) / 2))p"; }

compare() { # name, scene
    local name=$1 scene=$2 i
    : >"$work/a"
    : >"$work/b"
    cd "$(dirname "$scene")" || return
    for ((i = 0; i < runs; i++)); do
        seconds povray "+I$scene" +W1 +H1 -D -F "+O$work/x.png" >>"$work/a"
        seconds "$root/build/pov2qi" --check "$scene" >>"$work/b"
    done
    cd "$root" || exit 2
    awk -v name="$name" -v a="$(median <"$work/a")" -v b="$(median <"$work/b")" 'BEGIN {
        printf "| %s | %.2f | %.2f | %.1f |\n", name, a, b, a / (b > 0.001 ? b : 0.001) }'
}

echo '| scene | POV-Ray, s | pov2qi, s | ratio |'
echo '|---|---|---|---|'
compare '1,000,000 arithmetic statements' "$work/loop.pov"
compare '100,000 literal patches' "$work/patches.pov"
find "$examples" -name '*.pov' 2>/dev/null | sort | while read -r scene; do
    cd "$(dirname "$scene")" || continue
    slow=$(TIMEFORMAT=%U; { time timeout 20 povray "+I$scene" +W1 +H1 -D -F >/dev/null 2>&1; } 2>&1)
    cd "$root" || exit 2
    awk -v t="$slow" 'BEGIN { exit !(t > 0.1) }' && compare "$(basename "$scene")" "$scene"
done
