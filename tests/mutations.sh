#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Small programs that are a little wrong (tests/programs/mutate.c): pov2qi --check must accept what
# POV-Ray accepts and refuse what it refuses. Prints each difference as a line for tests/grammar.txt
# (what POV-Ray says, then the program), and then what was said. What POV-Ray dies of, or does not
# answer in two seconds of work, is left out.
#   mutations.sh [FIRST [COUNT]]      or  mutations.sh --grammar  for the lines of tests/grammar.txt
set -u
cd "$(dirname "$0")/.." || exit 2
work=$PWD/build/mutations${1:-}
rm -rf "$work"
mkdir -p "$work" || exit 2
export program=${POV2QI:-$PWD/build/pov2qi}
if [ "${1:-}" = --grammar ]; then
    grep -v '^#' tests/grammar.txt | cut -c4- >"$work/lines"
else
    build/mutate "${1:-1}" "${2:-3000}" >"$work/lines" || exit 2
fi

judge() { # number, program
    local file=p$1.pov theirs ours head='#version 3.7; global_settings { assumed_gamma 1 }'
    printf '%s\n%s\n' "$head" "$2" >"$file"
    (ulimit -t 2; exec timeout -k 5 30 povray "+I$file" +W4 +H3 -D -F +WT1) >"$file.povray" 2>&1 </dev/null
    theirs=$?
    [ $theirs -gt 1 ] && { echo "left out ($theirs): $2" >"$file.left"; return; }
    timeout -k 5 20 "$program" --check "+I$file" +W4 +H3 -D -F >"$file.qipov" 2>&1 </dev/null
    ours=$?
    [ $theirs -eq $ours ] && { rm "$file"*; return; }
    if [ $theirs -eq 0 ]; then
        printf 'ok %s\n  # %s\n' "$2" "$(grep -m1 error: "$file.qipov" || tail -1 "$file.qipov")"
    else
        printf 'no %s\n  # %s\n' "$2" "$(tr '\n' ' ' <"$file.povray" | grep -o 'Parse Error.*\|Cannot.*' | cut -c-150)"
    fi >"$file.differs"
}
export -f judge
cd "$work" || exit 2
awk '{ printf "%d%c%s%c", NR, 0, $0, 0 }' lines |
    xargs -0 -n 2 -P "${JOBS:-$(nproc)}" bash -c 'judge "$1" "$2"' judge 2>/dev/null
count() { find . -name "$1" | wc -l; }
find . -name '*.differs' | sort -V | xargs -r cat
[ -n "${LEFT:-}" ] && find . -name '*.left' | sort -V | xargs -r cat
echo "mutations: $(wc -l <lines) programs, $(count '*.differs') differ, $(count '*.left') left out"
[ "$(count '*.differs')" -eq 0 ]
