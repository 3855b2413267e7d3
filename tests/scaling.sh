#!/bin/bash
# SPDX-License-Identifier: MIT
# How the work grows with the number of solids: N spheres and N triangles in a cube, of which they
# fill the same share for all N, so that rays come as deep into it, counted in solids; and a field of
# copies of one bush of 100 parts.
# User seconds on one thread, the least of the rounds, in turn with POV-Ray's: what a picture of
# 16 pixels takes is reading and building, the rest of a large one goes to its rays. Writes README's
# table between <!-- scaling --> and <!-- end of scaling -->. Argument: rounds (3).
set -eu
cd "$(dirname "$0")/.."
rounds=${1:-3}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
program=$PWD/build/qirender
cd "$folder"

cat >cloud.pov <<'END'
#version 3.7; global_settings { assumed_gamma 1 }
camera { location <0, 0, -4> right x look_at 0 angle 28 }
#default { finish { ambient 1 diffuse 0 } pigment { rgb 0.7 } }
#declare S = seed(1);
#declare Size = 0.5/pow(N, 1/3);
#macro Spot() <2*rand(S) - 1, 2*rand(S) - 1, 2*rand(S) - 1> #end
#for (I, 1, N)
    sphere { Spot(), Size }
    #local P = Spot();
    triangle { P, P + 2*Size*Spot(), P + 2*Size*Spot() pigment { rgb x } }
#end
END
cat >field.pov <<'END'
#version 3.7; global_settings { assumed_gamma 1 }
camera { location <0, 14, -30> right x look_at <0, 0, 20> angle 50 }
light_source { <-200, 300, -150> 1 }
plane { y, 0 pigment { checker rgb 0.6 rgb 0.4 } }
#declare S = seed(1);
#declare Bush = union {
    #for (I, 1, 90)
        #local A = 2*pi*rand(S); #local R = 0.45*sqrt(rand(S));
        sphere { <R*cos(A), 0.3 + 0.7*rand(S), R*sin(A)>, 0.05 + 0.05*rand(S) pigment { rgb <0.2, 0.4 + 0.4*rand(S), 0.1> } }
    #end
    #for (I, 1, 10)
        cylinder { 0, <0.3*cos(I*0.63), 0.8, 0.3*sin(I*0.63)>, 0.02
            pigment { bozo color_map { [0 rgb <0.4, 0.2, 0.1>] [1 rgb <0.7, 0.5, 0.3>] } scale 0.1 } }
    #end
}
#for (J, 1, N)
    object { Bush rotate y*360*rand(S) scale 0.7 + 0.6*rand(S) translate <100*(rand(S) - 0.5), 0, 100*rand(S) - 10> }
#end
END

user_seconds() {
    bash -c 'TIMEFORMAT=%U; { time "$@" >/dev/null 2>&1 </dev/null; } 2>&1' time "$@"
}
least() { sort -n "$1" | head -1; }
megabytes() { /usr/bin/time -f %M "$@" 2>&1 >/dev/null </dev/null | tail -1 | awk '{printf "%.0f", $1 / 1000}'; }

# row WORDS SCENE N SIDE: a picture large enough that its rays take as long as building
row() {
    local words=$1 scene=$2 n=$3 side=$4
    rm -f ./*.txt
    for _ in $(seq "$rounds"); do
        for size in 4 $side; do
            user_seconds "$program" "+I$scene" "Declare=N=$n" +W$size +H$size -A -D +WT1 +Oours.png >>"ours$size.txt"
            user_seconds povray "+I$scene" "Declare=N=$n" +W$size +H$size -A -D +WT1 +Otheirs.png >>"theirs$size.txt"
        done
    done
    ours=$(megabytes "$program" "+I$scene" "Declare=N=$n" +W4 +H4 -A -D +WT1 +Oa.png)
    theirs=$(megabytes povray "+I$scene" "Declare=N=$n" +W4 +H4 -A -D +WT1 +Oa.png)
    differ=$(cd - >/dev/null && build/qicompare "$folder/ours.png" "$folder/theirs.png" --fail 1 --warn 1 2>/dev/null |
        sed -n 's/.*(\(.*%\)) off by more than one step.*/\1/p')
    echo "$(least ours4.txt) $(least ours$side.txt) $(least theirs4.txt) $(least theirs$side.txt) $side $ours $theirs ${differ:-0}" |
        awk -v words="$words" '{ pixels = $5 * $5
            printf "| %s | %.2f s, %s MB | %.0f ns | %.2f s, %s MB | %.0f ns | %s |\n",
                words, $1, $6, 1e9 * ($2 - $1) / pixels, $3, $7, 1e9 * ($4 - $3) / pixels, $8 }' | tee -a table
}

{
    echo "| scene | qirender: read and built | a pixel | POV-Ray: read and built | a pixel | pixels that differ |"
    echo "|---|---|---|---|---|---|"
} >table
row "1,000 spheres, 1,000 triangles" cloud.pov 1000 700
row "10,000 and 10,000" cloud.pov 10000 700
row "100,000 and 100,000" cloud.pov 100000 1800
row "100 copies of 100 parts" field.pov 100 700
row "1,000 copies" field.pov 1000 700
row "10,000 copies" field.pov 10000 700
cd - >/dev/null
tests/readme_table.sh scaling "$folder/table"
