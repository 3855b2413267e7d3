#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What POV-Ray says of each scene of povray-examples, kept in build/examples/povray: NAME.status (the
# exit status, then how it was found), NAME.debug (what #debug printed), NAME.err (its messages). Runs
# only those that are missing; minutes in all. The scenes lie in build/examples/tree, a copy in which
# they may write.
#
# A scene that takes longer than 20 s at +W4 +H3 (photons, radiosity, media) is run again at +Q0,
# which leaves the light out and reads the same text.
set -u
cd "$(dirname "$0")/.." || exit 1
from=/usr/share/doc/povray/examples
[ -d "$from" ] || { echo "examples: povray-examples is not installed" >&2; exit 1; }
tree=$PWD/build/examples/tree kept=$PWD/build/examples/povray
mkdir -p "$kept"
if [ ! -d "$tree" ]; then
    cp -rL "$from" "$tree.new"
    find "$tree.new" -name '*.gz' -exec gzip -d {} +
    mv "$tree.new" "$tree"
fi

# run SECONDS SCENE STEM [switch...]: one scene in its own folder.
run() {
    local limit=$1 scene=$2 stem=$3
    shift 3
    cd "$(dirname "$tree/$scene")" || return 1
    timeout "$limit" povray "+I$(basename "$scene")" +W4 +H3 -D -F +WT1 +GDqdebug.txt "$@" \
        >/dev/null 2>"$stem.err" </dev/null
    local status=$?
    mv -f qdebug.txt "$stem.debug" 2>/dev/null || : >"$stem.debug"
    return $status
}

# Each include by itself, as the only line of a scene.
mkdir -p "$tree/includes"
for include in /usr/share/povray-3.7/include/*.inc; do
    name=$(basename "$include" .inc)
    echo "#include \"$name.inc\"" >"$tree/includes/$name.pov"
done

(cd "$tree" && find . -name '*.pov' -printf '%P\n') | sort | while read -r scene; do
    stem=$kept/${scene//\//__}
    [ -f "$stem.status" ] && continue
    (run 20 "$scene" "$stem")
    status=$? how=
    if [ $status -eq 124 ]; then
        (run 240 "$scene" "$stem" +Q0)
        status=$? how=" +Q0"
    fi
    echo "$status$how" >"$stem.status"
done
