#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Scenes of povray-examples as pictures: POV-Ray's against --method facets at 320x240, without
# anti-aliasing. Prints for each the share of pixels that differ by more than one step of 8 bits, and
# what is not modelled in it, if anything is.
#   tests/examples_pictures.sh                      the folders of textures
#   tests/examples_pictures.sh FOLDER|SCENE...      those below the examples: lights camera/lens.pov
# POV-Ray's pictures are kept in build/examples-pictures. Exit status 1 if a scene of which all is
# modelled differs in more than LIMIT percent (0.5).
set -u
cd "$(dirname "$0")/.." || exit 2
from=/usr/share/doc/povray/examples
includes=${POV_INCLUDE:-/usr/share/povray-3.7/include}
limit=${LIMIT:-0.5}
program=${QIRENDER:-$PWD/build/qirender}
kept=$PWD/build/examples-pictures
mkdir -p "$kept"
[ $# -gt 0 ] || set -- textures/patterns textures/pigments textures/normals textures

scenes() {
    for name in "$@"; do
        case $name in
        *.pov) echo "$name" ;;
        *) (cd "$from" && find "$name" -maxdepth 1 -name '*.pov' | sort) ;;
        esac
    done
}

# The share of pixels, or why there is none.
judge() {
    local scene=$1 stem=${1//\//__} folder
    folder=$from/$(dirname "$scene")
    local switches="+L$includes +W320 +H240 -A -D -P"
    if [ ! -f "$kept/$stem-povray.png" ]; then
        # shellcheck disable=SC2086
        (cd "$folder" && timeout 200 povray "+I$(basename "$scene")" "+O$kept/$stem-povray.png" $switches +WT1) \
            >"$kept/$stem-povray.log" 2>&1 </dev/null || { echo "- POV-Ray refuses it or takes too long"; return; }
    fi
    # shellcheck disable=SC2086
    (cd "$folder" && timeout 200 "$program" "+I$(basename "$scene")" "+O$kept/$stem.png" $switches --method facets) \
        >"$kept/$stem.log" 2>&1 </dev/null || { echo "- qirender: $(grep -m1 -o 'error: .*' "$kept/$stem.log")"; return; }
    local share
    share=$(idiff -fail 0.0041 -failpercent 0 "$kept/$stem-povray.png" "$kept/$stem.png" |
        awk '/pixels .*over 0.0041/ { gsub(/[(%)]/, " "); for (i = 1; i < NF; i++) if ($i == "pixels") print $(i + 1) }')
    echo "${share:-0} $(grep -o 'warning: .*' "$kept/$stem.log" | grep -m1 -E 'not modelled|left out|missing' | cut -c10-)"
}

bad=0 good=0 part=0
while read -r scene; do
    read -r share gap <<<"$(judge "$scene")"
    printf '%-44s %8s %s\n' "$scene" "$share" "$gap"
    if [ "$share" = - ] || [ -n "$gap" ]; then
        part=$((part + 1))
    elif awk -v share="$share" -v limit="$limit" 'BEGIN { exit !(share > limit) }'; then
        bad=$((bad + 1))
    else
        good=$((good + 1))
    fi
done < <(scenes "$@")
echo "$good within $limit %, $bad over it, $part not all modelled"
[ $bad -eq 0 ]
