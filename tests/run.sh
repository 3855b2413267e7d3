#!/bin/sh
# SPDX-License-Identifier: MIT
# Runs the named test programs from build/test/, shows cmocka's closing lines, and ends with one line
# "N passed, N failed". Exit status 1 if a test failed or a program died before it could say so.
export ASAN_OPTIONS="${ASAN_OPTIONS:-detect_leaks=0}" UBSAN_OPTIONS="${UBSAN_OPTIONS:-print_stacktrace=1}"
passed=0 failed=0
mkdir -p build/test/log
for test in "$@"; do
    log=build/test/log/$test.txt
    start=$(date +%s)
    build/test/"$test" >"$log" 2>&1
    status=$?
    ok=$(sed -n 's/^\[  PASSED  \] \(.*: \)*\([0-9]*\) test(s)\..*/\2/p' "$log" | tail -1)
    bad=$(sed -n 's/^\[  FAILED  \] \(.*: \)*\([0-9]*\) test(s), listed below:.*/\2/p' "$log" | tail -1)
    ok=${ok:-0} bad=${bad:-0}
    if [ "$status" -ne 0 ] && [ "$bad" -eq 0 ]; then bad=1; fi
    passed=$((passed + ok)) failed=$((failed + bad))
    echo "== $test: $ok passed, $bad failed, $(($(date +%s) - start)) s"
    grep -E '^\[  (PASSED|FAILED|SKIPPED)  \]|^skipped:' "$log"
    if [ "$bad" -ne 0 ]; then
        grep -vE '^\[ (RUN|      OK) ' "$log" | tail -60
    fi
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
