#!/bin/sh
# SPDX-License-Identifier: MIT
# Renders POV-Ray's own teapot with QI and with POV-Ray and compares them; says where the page is.
set -eu
cd "$(dirname "$0")/.."
scene=/usr/share/doc/povray/examples/advanced/teapot/teapot.pov
mkdir -p build/demo
build/qicompare -o build/demo --fail 1 --warn 1 "$scene" +W800 +H600 +A0.3
echo
echo "The page with both pictures: $PWD/build/demo/index.html"
