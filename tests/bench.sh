#!/bin/sh
# SPDX-License-Identifier: MIT
# Writes the tables of speed into README.md, each between its two marks (<!-- NAME --> and
# <!-- end of NAME -->), and as a page into build/bench. Arguments: rounds (an odd number, 5), then the tables, all unless named:
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

# page: the tables that README has between its marks, as one page.
page() {
    cat <<'HEAD'
<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>Speed</title><style>
:root{color-scheme:light dark}body{font:16px/1.5 system-ui,sans-serif;max-width:68rem;margin:2rem auto;padding:0 1rem}
div{overflow-x:auto;margin:1.5rem 0}table{border-collapse:collapse;font-variant-numeric:tabular-nums}
th,td{text-align:right;padding:.3rem .7rem;border-bottom:1px solid #8886;font-weight:400}
th:first-child,td:first-child{text-align:left}td{white-space:nowrap}thead th{font-size:.85rem}
@media print{body{max-width:none;margin:0}div{overflow:visible}table{font-size:8pt;break-inside:avoid}td,th{padding:.1rem .3rem}}
</style></head><body><h1>Speed</h1>
HEAD
    grep -m1 'model name' /proc/cpuinfo | sed 's/.*: \(.*\)/<p>\1, '"$(nproc) cores, $(date +%F)"'; median of '"$rounds"' rounds.<\/p>/'
    for name in programs methods picture lattices threads; do
        echo "<h2>$name</h2>"
        sed -n "/<!-- $name -->/,/<!-- end of $name -->/p" README.md | grep -v '^<!--' |
            sed 's/&/\&amp;/g; s/</\&lt;/g' | awk -F' *[|] *' '
            !/^[|]/ { if (open) { print "</tbody></table></div>"; open = 0 } if (NF) print "<p>" $0 "</p>"; next }
            /^[|][-|]*$/ { next }
            {
                cell = open ? "td" : "th"
                line = open ? "<tr>" : "<div><table><thead><tr>"
                for (i = 2; i < NF; i++) line = line "<" cell ">" $i "</" cell ">"
                print line "</tr>" (open ? "" : "</thead><tbody>")
                open = 1
            }
            END { if (open) print "</tbody></table></div>" }'
    done
    echo "</body></html>"
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
mkdir -p build/bench
page >"$folder/page" && mv "$folder/page" build/bench/index.html
echo build/bench/index.html
