#!/bin/bash
# SPDX-License-Identifier: MIT
# Every texture, pigment, normal, finish and material that POV-Ray's standard includes declare, each
# on a curved patch: POV-Ray's picture against --method facets at 320x240. Prints a line for each with
# the share of pixels that differ by more than one step of 8 bits. Those of which it is over LIMIT are
# compared once more with all crand of the includes set to 0 in both: its grain depends in POV-Ray on
# what the thread has drawn before.
#   tests/texture_sheet.sh             all of them
#   tests/texture_sheet.sh NAME...     only those
# Exit status 1 if any share is over LIMIT percent (0.1), without crand.
set -u
cd "$(dirname "$0")/.." || exit 2
includes=${POV_INCLUDE:-/usr/share/povray-3.7/include}
limit=${LIMIT:-0.1}
size=${SIZE:-+W320 +H240}
program=${QIRENDER:-$PWD/build/qirender}
folder=$PWD/build/texture-sheet
plain=$folder/plain
mkdir -p "$plain"
for include in "$includes"/*.inc; do
    sed -E 's/\bcrand[[:space:]]+[-+0-9.eE]+/crand 0/g' "$include" >"$plain/$(basename "$include")"
done

# FILE NAME KIND of each declaration. A name that stands for another has its kind.
declarations() {
    for file in textures metals golds woods stones1 stones2 stoneold glass glass_old skies stars finish; do
        tr -d '\r' <"$includes/$file.inc" | awk -v file="$file" '
            { gsub(/\/\/.*/, ""); gsub(/[={}]/, " & "); text = text " " $0 }
            END {
                gsub(/\/\*([^*]|\*+[^*\/])*\*+\//, " ", text)
                count = split(text, word, /[ \t]+/)
                for (i = 1; i < count - 2; i++) {
                    if (word[i] != "#declare" || word[i + 2] != "=")
                        continue
                    name = word[i + 1]; first = word[i + 3]
                    kind = first in known ? known[first] : first
                    known[name] = kind
                    if (kind == "colour" || kind == "rgb" || kind == "rgbf")
                        kind = "color"
                    if (kind == "color" && name !~ /^P_/)
                        continue
                    if (kind ~ /^(texture|pigment|normal|finish|material|color|sky_sphere)$/)
                        print file, name, kind
                }
            }'
    done
}

# The statement that shows NAME.
statement() {
    case $2 in
    texture) echo "object { Swatch_Patch() texture { $1 } }" ;;
    material) echo "object { Swatch_Patch() material { $1 } }" ;;
    pigment | color) echo "object { Swatch_Patch() pigment { $1 } }" ;;
    normal) echo "object { Swatch_Patch() pigment { rgb <0.9, 0.8, 0.6> } normal { $1 } }" ;;
    finish) echo "object { Swatch_Patch() pigment { rgb <0.8, 0.6, 0.3> } finish { $1 } }" ;;
    sky_sphere) echo "sky_sphere { $1 } object { Swatch_Patch() pigment { rgb 1 } finish { reflection 0.8 } }" ;;
    esac
}

over() { awk -v share="$1" -v limit="$limit" 'BEGIN { exit !(share + 0 > limit) }'; }

# share_of SCENE STEM INCLUDES: the share of pixels, or what went wrong. Both look into the folder that
# they are started in before all others.
share_of() {
    local switches="+I$1 +L$3 +L$PWD/scenes/texture-sheet $size -A +WT1" stem=$2 share
    # shellcheck disable=SC2086
    (cd "$3" && povray +O"$stem-povray.png" $switches -D) >"$stem.log" 2>&1 ||
        { echo "povray refuses it"; return; }
    # shellcheck disable=SC2086
    (cd "$3" && "$program" +O"$stem.png" $switches --method facets) >"$stem.log" 2>&1 ||
        { echo failed; return; }
    share=$(idiff -fail 0.0041 -failpercent 0 "$stem-povray.png" "$stem.png" |
        awk '/pixels .*over 0.0041/ { gsub(/[(%)]/, " "); for (i = 1; i < NF; i++) if ($i == "pixels") print $(i + 1) }')
    echo "${share:-0}"
}

compare() {
    local file=$1 name=$2 kind=$3 scene="$folder/$2.pov"
    {
        echo '#version 3.7; global_settings { assumed_gamma 1 max_trace_level 8 }'
        echo "#include \"colors.inc\""
        echo "#include \"$file.inc\""
        echo '#include "texture-sheet.inc"'
        echo 'Swatch_Stage()'
        statement "$name" "$kind"
    } >"$scene"
    local notes="" share
    share=$(share_of "$scene" "$folder/$name" "$includes")
    [ "$share" = "povray refuses it" ] && { echo "$file $name $kind $share"; return; }
    [ "$share" = failed ] && { echo "$file $name $kind failed"; return; }
    grep -q "warning:" "$folder/$name.log" && notes=" with a warning"
    over "$share" && notes="$notes, without crand $(share_of "$scene" "$folder/$name-plain" "$plain") %"
    printf '%-10s %-28s %-10s %8s %%%s\n' "$file" "$name" "$kind" "$share" "$notes"
}

list=$(declarations)
if [ $# -gt 0 ]; then
    list=$(for name in "$@"; do echo "$list" | awk -v name="$name" '$2 == name'; done)
fi
bad=0
while read -r file name kind; do
    line=$(compare "$file" "$name" "$kind")
    echo "$line"
    echo "$line" | awk -v limit="$limit" '
        { share = $4 + 0; if (sub(/.*without crand /, "")) share = $1 + 0 }
        { exit !(share > limit || $0 ~ /failed|refuses|warning/) }' && bad=$((bad + 1))
done <<<"$list"
echo "$(echo "$list" | wc -l) declarations, $bad of them over $limit % without crand"
[ $bad -eq 0 ]
