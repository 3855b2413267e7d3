#!/bin/sh
# SPDX-License-Identifier: MIT
# Judges a sweep.csv of qibench: errors fall as tolerances do, for every method, and no point of qi is
# farther off than its tolerance and the rounding of its hits allow. Noise: errors below 1e-9
# diameters are rounding; of the picture, a tenth or a thousandth of a step. Newton's method without bounds
# and triangles lose hits of their own, whose distance no tolerance limits: of them the picture counts.
# Last line: how many points were judged and how many are wrong; exit status 1 if any is.
set -eu
awk -F, '
    NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
    $at["failed"] != "" { next }
    {
        kind = $at["scene"] " " $at["method"] " " $at["prepare"] ($at["flatness"] > 0 ? " flatness" : "")
        name = kind " " $at["tolerance"] $at["u_steps"] ($at["flatness"] > 0 ? " " $at["flatness"] : "")
        rms = $at["picture_rms_steps"]; position = $at["position_max_diameters"]
        judged++
        if ($at["method"] == "qi" && position > $at["tolerance"] + $at["rounding_diameters"]) {
            print name ": " position " diameters off, more than its tolerance"; wrong++
        }
        if ($at["method"] == "qi" && $at["edge_leaks_share"] + $at["pin_hole_pixels"] > 0) {
            print name ": leaks"; wrong++
        }
        if (kind == last) {
            if (rms > 1.1 * last_rms + 1e-3) { print name ": RMS grows from " last_rms " to " rms; wrong++ }
            if ($at["method"] !~ /newton|facets|povray/ && position > last_position && position > 1e-9) {
                print name ": position grows from " last_position " to " position; wrong++
            }
        }
        last = kind; last_rms = rms; last_position = position
    }
    END { print judged + 0 " points judged, " wrong + 0 " wrong"; exit wrong > 0 || judged == 0 }' "$1"
