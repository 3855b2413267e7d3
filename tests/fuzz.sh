#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# fuzz.sh scene|json [SECONDS]: runs a fuzzer that `make fuzz` has built, from the project's own
# programs and scenes. What it finds is left in build/fuzz/found; what it has learnt stays in
# build/fuzz/NAME and is where the next run begins.
set -eu
cd "$(dirname "$0")/.."
name=${1:-scene} seconds=${2:-3600}
corpus=build/fuzz/$name seeds=build/fuzz/$name.seeds dictionary=build/fuzz/$name.dict
mkdir -p "$corpus" "$seeds" build/fuzz/found
if [ "$name" = scene ]; then
    # The dictionary: the reserved words, and the signs that are more than one byte.
    sed -n 's/^X(/X(/p' converter/keywords.h | tr ' ' '\n' | sed -n 's/^X(\(.*\))$/"\1"/p' >"$dictionary"
    printf '"%s"\n' '#declare' '#local' '#macro' '#end' '#if (' '#while (' '#for (I,' '<0,0,0>' '>=' '!=' '/*' '*/' >>"$dictionary"
    for file in tests/sdl/*.pov tests/errors/*.pov scenes/*/*.pov; do
        cp "$file" "$seeds/$(basename "$(dirname "$file")")_$(basename "$file")"
    done
else
    for file in scenes/*/*.pov tests/sdl/*.pov; do
        build/pov2qi "$file" "+L$(dirname "$file")" +Lscenes/teapot -GA -GF -o "$seeds/$(basename "$file" .pov).qi.json" 2>/dev/null || true
    done
    find "$seeds" -size +40k -delete
    grep -oh '"[a-z_]*"' src/model/scene_fields.c src/model/scene.c | sort -u >"$dictionary"
fi
export ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1
exec nice "build/fuzz/fuzz_$name" -max_total_time="$seconds" -dict="$dictionary" -max_len=16384 -timeout=25 \
    -rss_limit_mb=3000 -artifact_prefix=build/fuzz/found/ -print_final_stats=1 "$corpus" "$seeds"
