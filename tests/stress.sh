#!/bin/sh
# SPDX-License-Identifier: MIT
# make stress: runs build/stress with the arguments given, keeps all it says in build/stress.txt, and
# when it was asked for all cases and methods writes its last table into README.md.
set -u
cd "$(dirname "$0")/.." || exit 2
nice build/stress "$@" >build/stress.txt
status=$?
cat build/stress.txt
table=$(sed -n '/^failures in a million rays/,/^seed/p' build/stress.txt | grep '^|')
case " $* " in
*" --case "* | *" --method "* | *" --scene "*) exit $status ;;
esac
[ -n "$table" ] || exit $status
{
    tail -1 build/stress.txt | sed 's/$/:/'
    echo
    echo "$table"
} >build/stress.md
tests/readme_table.sh stress build/stress.md
exit $status
