#!/bin/sh
# SPDX-License-Identifier: MIT
# readme_table.sh NAME FILE: puts what FILE holds into README.md, between <!-- NAME --> and
# <!-- end of NAME -->. Exit status 1 if README.md has no such place.
set -eu
cd "$(dirname "$0")/.."
grep -q "^<!-- $1 -->" README.md || { echo "README.md has no place for $1" >&2; exit 1; }
whole=$(mktemp)
trap 'rm -f "$whole"' EXIT
awk -v name="$1" -v file="$2" '
    $0 == "<!-- end of " name " -->" { inside = 0 }
    !inside { print }
    $0 == "<!-- " name " -->" {
        inside = 1
        print ""
        while ((getline line <file) > 0) print line
        print ""
    }' README.md >"$whole"
cp "$whole" README.md
