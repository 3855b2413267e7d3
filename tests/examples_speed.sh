#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# User seconds of POV-Ray and of qirender --method qi for scenes of povray-examples, one thread,
# 320x240, without anti-aliasing; medians of RUNS (3) runs in turn, so that read the ratios.
#   tests/examples_speed.sh                      textures, lights and cameras
#   tests/examples_speed.sh FOLDER|SCENE...      those below the examples, or scenes by their own path
# Scenes that POV-Ray refuses, or of which something is not modelled, are left out.
set -u
cd "$(dirname "$0")/.." || exit 2
from=/usr/share/doc/povray/examples
home=$PWD
program=${QIRENDER:-$PWD/build/qirender}
runs=${RUNS:-3} size=${SIZE:-+W320 +H240}
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
[ $# -gt 0 ] || set -- textures/patterns textures/pigments textures/normals textures/finishes textures \
    lights camera

scenes() {
    for name in "$@"; do
        case $name in
        /*.pov) echo "$name" ;;
        *.pov) echo "$from/$name" ;;
        *) find "$from/$name" -maxdepth 1 -name '*.pov' | sort ;;
        esac
    done
}

# seconds SCENE PROGRAM: of one run in the scene's folder
seconds() {
    local TIMEFORMAT=%3U folder
    folder=$(dirname "$1")
    cd "$folder" || return 1
    # shellcheck disable=SC2086
    { time timeout 300 "$2" "+I$(basename "$1")" "+L$folder" "+O$work/picture.png" $size -A -D -P +WT1 \
        >/dev/null 2>"$work/log" </dev/null; } 2>"$work/time"
    local status=$?
    cd "$home" || exit 2
    cat "$work/time"
    return $status
}

median() { sort -n | sed -n "$(((runs + 1) / 2))p"; }

printf '%-40s %8s %8s %6s\n' scene povray qirender ratio
while read -r scene; do
    seconds "$scene" "$program" >/dev/null && ! grep -q 'modelled' "$work/log" || continue
    seconds "$scene" povray >/dev/null || continue
    : >"$work/povray"
    : >"$work/ours"
    for _ in $(seq "$runs"); do
        seconds "$scene" povray >>"$work/povray"
        seconds "$scene" "$program" >>"$work/ours"
    done
    name=${scene#"$from"/}
    awk -v scene="${name##*/corpus/}" -v p="$(median <"$work/povray")" -v q="$(median <"$work/ours")" \
        'BEGIN { printf "%-40s %8.3f %8.3f %6.2f\n", scene, p, q, (q > 0 ? p / q : 0) }'
done < <(scenes "$@") | tee "$work/table"
sort -k4 -n "$work/table" | awk '{ r[NR] = $4 } END { if (NR) printf "median ratio %.2f, least %.2f, most %.2f, %d scenes\n",
    r[int((NR + 1) / 2)], r[1], r[NR], NR }'
