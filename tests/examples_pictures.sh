#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Scenes as pictures: POV-Ray's against --method facets at 320x240, without anti-aliasing. Prints for
# each the share of pixels that differ by more than one step of 8 bits; of scenes with crand or the
# jitter of area lights and rainbows, whose grain POV-Ray draws from what its threads have done before, also the
# share without them; and what is not modelled in it, if anything is.
#   tests/examples_pictures.sh                      the scenes of tests/examples_pictures.txt
#   tests/examples_pictures.sh FOLDER|SCENE...      those below the examples: lights camera/lens.pov;
#                                                   corpus/... lies in ../shared and may be missing
#   PAGES=FOLDER tests/examples_pictures.sh patches  those with patches, with a page of qicompare each,
#                                                   --method qi beside POV-Ray, and an index of them
# POV-Ray's pictures are kept in build/examples-pictures. Exit status 1 if a scene of which all is
# modelled differs in more than LIMIT percent (0.5), without grain.
set -u
cd "$(dirname "$0")/.." || exit 2
examples=/usr/share/doc/povray/examples
corpus=$(cd ../shared/corpus 2>/dev/null && pwd)
includes=${POV_INCLUDE:-/usr/share/povray-3.7/include}
limit=${LIMIT:-0.5}
program=${QIRENDER:-$PWD/build/qirender}
kept=$PWD/build/examples-pictures
mkdir -p "$kept"
if [ $# -eq 0 ]; then
    set -- textures/patterns textures/pigments textures/normals textures/finishes textures lights camera interior patches
fi
if [ "${*: -1}" = patches ]; then
    set -- "${@:1:$#-1}" advanced/cliche/cliche.pov
    for name in gamesprites/GSprites_{Hills,Floors,Terrain}_demo easychair/easychair \
        postit/postit eaglemode/Splitter eaglemode/SplitterPressed fmunoz/FMunoz_demo \
        fmunoz/fruit_only; do
        [ -f "$corpus/$name.pov" ] && set -- "$@" "corpus/$name.pov"
    done
fi

# Where the scene of that name lies. Of the corpus a copy, since a link in it was copied as the name of
# the file that it leads to.
folder_of() {
    case $1 in
    corpus/*)
        local from to
        from=$corpus/$(dirname "${1#corpus/}") to=$kept/$(dirname "$1")
        if [ ! -d "$to" ]; then
            mkdir -p "$to" && cp -L "$from"/* "$to"
            for link in "$to"/*.inc; do
                local name
                [ -f "$link" ] || continue
                name=$(head -c 200 "$link" | tr -d '\0')
                [ "$name" != "" ] && [ -f "$to/$name" ] && cp "$to/$name" "$link"
            done
        fi
        echo "$to"
        ;;
    *) dirname "$examples/$1" ;;
    esac
}

scenes() {
    for name in "$@"; do
        case $name in
        *.pov) echo "$name" ;;
        *) (cd "$examples" && find "$name" -maxdepth 1 -name '*.pov' | sort) ;;
        esac
    done
}

# without_grain FOLDER FILE STEM: a copy of both without grain; where it is.
without_grain() {
    local to=$kept/plain/$3
    mkdir -p "$to"
    cp -Lu "$1"/* "$to" 2>/dev/null
    for source in "$1"/*.inc "$1/$2"; do
        [ -f "$source" ] &&
            sed -E 's/\bcrand[[:space:]]+[-+0-9.eE]+/crand 0/g; s/\bjitter\b([[:space:]]+[-+0-9.]+)?//g' "$source" >"$to/${source##*/}"
    done
    echo "$to"
}

# compare FOLDER FILE STEM [FOLDER]: the share of pixels, or why there is none. The second folder holds
# what is not in the first.
compare() {
    local folder=$1 file=$2 stem=$3
    local switches="+L$folder ${4:++L$4} +L$includes +L$kept +W320 +H240 -A -D -P"
    if [ ! -f "$kept/$stem-povray.png" ]; then
        # shellcheck disable=SC2086
        (cd "$folder" && timeout 200 povray "+I$file" "+O$kept/$stem-povray.png" $switches +WT1) \
            >"$kept/$stem-povray.log" 2>&1 </dev/null || { echo "- POV-Ray refuses it or takes too long"; return; }
    fi
    # shellcheck disable=SC2086
    (cd "$folder" && timeout 200 "$program" "+I$file" "+O$kept/$stem.png" $switches --method facets) \
        >"$kept/$stem.log" 2>&1 </dev/null || { echo "- qirender: $(grep -m1 -o 'error: .*' "$kept/$stem.log")"; return; }
    local share
    share=$(idiff -fail 0.0041 -failpercent 0 "$kept/$stem-povray.png" "$kept/$stem.png" |
        awk '/pixels .*over 0.0041/ { gsub(/[(%)]/, " "); for (i = 1; i < NF; i++) if ($i == "pixels") print $(i + 1) }')
    echo "${share:-0} $(grep -o 'warning: .*' "$kept/$stem.log" | grep -m1 -E 'not modelled|left out|missing' | cut -c10-)"
}

# The picture that a picture shows.
[ -f "$kept/sign.png" ] || povray "+I$examples/advanced/cliche/sign.pov" "+O$kept/sign.png" "+L$includes" \
    +W800 +H800 -A -D >"$kept/sign.log" 2>&1 </dev/null

bad=0 good=0 part=0 pages=()
while read -r scene; do
    folder=$(folder_of "$scene") file=$(basename "$scene") stem=${scene//\//__}
    read -r share gap <<<"$(compare "$folder" "$file" "$stem")"
    judged=$share plain=
    if [ -z "$gap" ] && awk -v share="$share" -v limit="$limit" 'BEGIN { exit !(share > limit) }' &&
        cat "$folder/$file" "$folder"/*.inc 2>/dev/null | grep -qE '\b(jitter|crand)\b'; then
        plain=$(without_grain "$folder" "$file" "$stem")
        read -r judged _ <<<"$(compare "$plain" "$file" "$stem-plain" "$folder")"
        printf '%-44s %8s, without grain %s %s\n' "$scene" "$share" "$judged" "$gap"
    else
        printf '%-44s %8s %s\n' "$scene" "$share" "$gap"
    fi
    # Grain differs everywhere, and by chance: its page is about the scene without it.
    pages+=("${plain:-$folder}/$file")
    if [ "$judged" = - ] || [ -n "$gap" ]; then
        part=$((part + 1))
    elif awk -v share="$judged" -v limit="$limit" 'BEGIN { exit !(share > limit) }'; then
        bad=$((bad + 1))
    else
        good=$((good + 1))
    fi
done < <(scenes "$@")
# Pages that show where --method qi and POV-Ray differ, and why.
if [ -n "${PAGES:-}" ]; then
    build/qicompare "${pages[@]}" +W320 +H240 -A "+L$includes" "+L$kept" -o "$PAGES" --fail 1 2>&1 |
        grep -E 'off by more|worst places|not compared|index.html'
fi
echo "$good within $limit %, $bad over it, $part not all modelled"
[ $bad -eq 0 ]
