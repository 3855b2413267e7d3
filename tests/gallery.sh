#!/bin/sh
# Renders README's pictures again: every scene of scenes/ with QI, into its own folder.
set -eu
cd "$(dirname "$0")/.."
for scene in scenes/*/*.pov; do
    picture=${scene%.pov}.png
    echo "$picture"
    build/qirender "+I$scene" "+O$picture" "+L$(dirname "$scene")" +Lscenes/teapot +W640 +H400 +A0.1 -V
done
