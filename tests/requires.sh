#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The table tests/requires.txt: what each real scene with bicubic patches requires, and, behind '|',
# what of it is not modelled. Run it again when more is modelled: tests/requires.sh >tests/requires.txt
set -u
cd "$(dirname "$0")/.." || exit 1
program=${POV2QI:-build/pov2qi} examples=/usr/share/doc/povray/examples corpus=${CORPUS:-../shared/corpus}

# row NAME FILE [switch...]
row() {
    local name=$1 list
    shift
    [ -f "$1" ] || return 0
    list=$("$program" --requires +W320 +H240 -GA "$@" "+L$(dirname "$1")" 2>/dev/null) || list="refused"
    echo "$name: $(grep -v '[: ]' <<<"$list" | tr '\n' ' ')| $(sed -n 's/: not modelled$//p' <<<"$list" | tr '\n' ' ')" |
        sed 's/ *$//; s/ *|/ |/'
}

echo "# NAME: what it requires | what of that is not modelled (tests/requires.sh)"
row bezier $examples/objects/bezier.pov
row teapot $examples/advanced/teapot/teapot.pov
row primitiv $examples/objects/primitiv.pov
row allobjects $examples/portfolio/allobjects.pov +KFF2 +SF1 +EF1
for scene in cephalopov/bicubicpatch_basic dealii/cont243bic eaglemode/Splitter eaglemode/SplitterPressed \
    gamesprites/GSprites_Hills_demo gamesprites/GSprites_Terrain_demo gamesprites/GSprites_Floors_demo \
    fmunoz/FMunoz_demo fmunoz/fruit_only postit/postit easychair/easychair; do
    row "$(basename $scene)" $corpus/$scene.pov
done
