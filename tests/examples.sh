#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Every scene of povray-examples, and every include of povray-includes by itself: pov2qi --check must
# accept exactly what POV-Ray accepts, and #debug must print the same lines. Differences that have a
# reason stand in tests/examples.txt: NAME<tab>REASON; they are named, and fail if they are gone.
set -u
cd "$(dirname "$0")/.." || exit 1
tests/examples_povray.sh || exit 1
tree=$PWD/build/examples/tree kept=$PWD/build/examples/povray ours=$PWD/build/examples/qipov
program=${POV2QI:-$PWD/build/pov2qi}
mkdir -p "$ours"
same=0 known=0 wrong=0

reason_of() { awk -F'\t' -v name="$1" '$1 == name { print $2 }' tests/examples.txt; }

# judge NAME "" or NAME "what differs"
judge() {
    local reason
    reason=$(reason_of "$1")
    if [ -z "$2" ] && [ -z "$reason" ]; then
        same=$((same + 1))
    elif [ -z "$2" ]; then
        wrong=$((wrong + 1))
        echo "$1: no longer differs; take it out of tests/examples.txt"
    elif [ -n "$reason" ]; then
        known=$((known + 1))
        echo "$1: $2 (known: $reason)"
    else
        wrong=$((wrong + 1))
        echo "$1: $2"
    fi
}

check() {
    local name=$1 folder=$2 file=$3 stem=$4 status povray difference=
    (cd "$folder" && timeout 100 "$program" --check "+I$file" +W4 +H3 -D -F +GDqdebug.txt \
        >/dev/null 2>"$ours/$stem.err" </dev/null)
    status=$?
    mv -f "$folder/qdebug.txt" "$ours/$stem.debug" 2>/dev/null || : >"$ours/$stem.debug"
    povray=$(cut -d' ' -f1 "$kept/$stem.status")
    if [ "$status" != "$povray" ]; then
        difference="POV-Ray ends with $povray, pov2qi with $status: $(grep -m1 error: "$ours/$stem.err")"
    elif ! cmp -s "$kept/$stem.debug" "$ours/$stem.debug"; then
        difference="#debug prints other lines: $(diff "$kept/$stem.debug" "$ours/$stem.debug" | sed -n 2p)"
    fi
    judge "$name" "$difference"
}

while read -r scene; do
    stem=${scene//\//__}
    [ -f "$kept/$stem.status" ] || continue
    check "$scene" "$tree/$(dirname "$scene")" "$(basename "$scene")" "$stem"
done < <(cd "$tree" && find . -name '*.pov' -printf '%P\n' | sort)

echo "examples: $same as POV-Ray, $known known differences, $wrong wrong"
[ "$wrong" -eq 0 ]
