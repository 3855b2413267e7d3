#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Real scenes of solids as pictures: POV-Ray's against --method facets, 320x240 without
# anti-aliasing, one thread. Prints for each the percent of pixels that differ by more than one step
# of 8 bits, the user seconds of POV-Ray and of --method qi (least of RUNS runs in turn) with their
# ratio, and what is not modelled in it. The table is kept in tests/solids_pictures.txt (make solids-pictures).
#   tests/solids_pictures.sh [WORD...]   only scenes with one of these words in their line below
# Grain (crand) is drawn per ray here, per thread there: scenes that have it are compared without.
# POV-Ray's quick solver draws dotted lines across lemnisc2.pov, beyond the object too; it is
# compared with sturm, POV-Ray's other solver.
# Exit status 1 if a scene of which all is modelled differs in more than its limit.
set -u
cd "$(dirname "$0")/.." || exit 2
from=/usr/share/doc/povray/examples corpus=${CORPUS:-$PWD/../shared/corpus}
program=${QIRENDER:-$PWD/build/qirender} runs=${RUNS:-3}
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT

# LIMIT FOLDER SCENE [switches]
list() {
    (cd "$from" && for folder in objects objects/csg objects/quartic; do
        for scene in "$folder"/*.pov; do
            [ "$scene" = objects/primitiv.pov ] && limit=0.1 || limit=0.5
            echo "$limit $folder $(basename "$scene")"
        done
    done)
    echo "0.5 advanced/cliche cliche.pov"
    for frame in $(seq 27); do
        echo "0.5 portfolio allobjects.pov +KFI1 +KFF27 +SF$frame +EF$frame"
    done
    echo "0.5 corpus/fmunoz FMunoz_demo.pov"
    for name in Hills Floors Terrain; do
        echo "0.5 corpus/gamesprites GSprites_${name}_demo.pov"
    done
    echo "0.5 corpus/eaglemode Splitter.pov"
    echo "0.5 corpus/eaglemode SplitterPressed.pov"
    echo "0.5 corpus/easychair easychair.pov"
}

# A copy that may be written into, with what the scenes expect to find.
copy_folder() {
    local source=$from/$1 copy=$work/$1 file
    [ -f "$copy/.copied" ] && return
    case $1 in corpus/*) source=$corpus/${1#corpus/} ;; esac
    [ -d "$source" ] || return
    mkdir -p "$copy"
    cp -r "$source/." "$copy"
    chmod -R u+w "$copy"
    : >"$copy/.copied"
    for file in "$copy"/*; do # a symbolic link that was copied as the text of its name
        [ -f "$file" ] && [ "$(wc -l <"$file")" -le 1 ] && [ -f "$copy/$(cat "$file")" ] 2>/dev/null &&
            ln -sf "$(cat "$file")" "$file"
    done
    grep -lis 'crand *[0-9.]' "$copy"/*.inc | xargs -r sed -i 's/crand *[0-9.][0-9.]*//I'
    [ "$1" != objects/quartic ] || sed -i 's/bounded_by/sturm bounded_by/' "$copy/lemnisc2.pov"
    [ "$1" != advanced/cliche ] || (cd "$copy" && povray +Isign.pov +Osign.png -D -A +W320 +H240 >/dev/null 2>&1)
}

# run PROGRAM NAME ARGS...: user seconds on standard output
run() {
    local TIMEFORMAT=%3U name=$2 program=$1
    shift 2
    rm -f "$work/$name"*.png
    { time timeout 300 "$program" "$@" "+O$work/$name.png" >/dev/null 2>"$work/$name.log" </dev/null; } 2>"$work/time"
    local status=$?
    cat "$work/time"
    return $status
}

judge() {
    local limit=$1 folder=$2 scene=$3 theirs=999 ours=999 seconds share
    shift 3
    copy_folder "$folder"
    cd "$work/$folder" 2>/dev/null || { echo "- - - - it is not here"; return; }
    for _ in $(seq "$runs"); do
        seconds=$(run povray theirs "+I$scene" +W320 +H240 -A -D -P +WT1 "$@") || { echo "- - - - POV-Ray refuses it"; return; }
        theirs=$(printf '%s\n' "$theirs" "$seconds" | sort -g | head -1)
        seconds=$(run "$program" quick "+I$scene" +W320 +H240 -A -D -P +WT1 "$@")
        ours=$(printf '%s\n' "$ours" "$seconds" | sort -g | head -1)
    done
    run "$program" ours "+I$scene" +W320 +H240 -A -D -P --method facets "$@" >/dev/null ||
        { echo "- $theirs - - $(grep -m1 -o 'error: .*' "$work/ours.log")"; return; }
    share=$(idiff -fail 0.0041 -failpercent 0 "$work"/theirs*.png "$work"/ours*.png |
        awk '/pixels .*over 0.0041/ { gsub(/[(%)]/, " "); for (i = 1; i < NF; i++) if ($i == "pixels") print $(i + 1) }')
    echo "${share:-0} $theirs $ours $(awk -v a="$theirs" -v b="$ours" 'BEGIN { printf "%.2f", (b > 0 ? a / b : 99) }')" \
        "$(grep -o 'warning: .*' "$work/ours.log" | grep -m1 -E 'not modelled|left out|missing' | cut -c10-)"
}

bad=0 good=0 part=0
printf '%-44s %8s %8s %8s %6s\n' scene percent povray qirender ratio
while read -r limit folder scene switches; do
    line="$folder/$scene${switches:+ ${switches##*EF}}"
    if [ $# -gt 0 ]; then
        wanted=
        for word in "$@"; do case $line in *"$word"*) wanted=1 ;; esac; done
        [ "$wanted" ] || continue
    fi
    # shellcheck disable=SC2086
    read -r share theirs ours ratio gap <<<"$(judge "$limit" "$folder" "$scene" $switches)"
    printf '%-44s %8s %8s %8s %6s %s\n' "$line" "$share" "$theirs" "$ours" "$ratio" "$gap"
    if [ "$share" = - ] || [ -n "$gap" ]; then
        part=$((part + 1))
    elif awk -v share="$share" -v limit="$limit" 'BEGIN { exit !(share > limit) }'; then
        bad=$((bad + 1))
    else
        good=$((good + 1))
    fi
done < <(list)
echo "$good within the limit, $bad over it, $part not all modelled"
[ $bad -eq 0 ]
