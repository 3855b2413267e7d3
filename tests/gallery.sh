#!/bin/sh
# SPDX-License-Identifier: MIT
# Renders README's pictures again: every scene of scenes/ with QI, into its own folder.
set -eu
cd "$(dirname "$0")/.."
for scene in scenes/*/*.pov; do
    picture=${scene%.pov}.png
    echo "$picture"
    case $scene in */pebble.pov) more=--patch-solids ;; *) more=-V ;; esac
    build/qirender "+I$scene" "+O$picture" "+L$(dirname "$scene")" +Lscenes/teapot +W640 +H400 +A0.1 -V $more
done

# The crops of other people's scenes in README, where those scenes are at hand.
corpus=../shared/corpus
[ -d "$corpus" ] || exit 0
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# crop SCENE NAME X Y: 100 x 75 pixels from there, four times as large, of POV-Ray's picture and ours.
crop() {
    (cd "$(dirname "$1")" && povray "+I$(basename "$1")" "+O$folder/pov.png" +W320 +H240 -A -D >/dev/null 2>&1)
    build/qirender "+I$1" "+O$folder/qi.png" +W320 +H240 -A -V
    for side in pov qi; do
        oiiotool "$folder/$side.png" --cut "100x75+$3+$4" --resize:filter=box 400x300 -o "scenes/gallery/$2-$side.png"
    done
}
crop "$corpus/postit/postit.pov" postit 150 140
crop "$corpus/eaglemode/Splitter.pov" eagle 40 5
crop "$corpus/easychair/easychair.pov" chair 155 60
