#!/bin/sh
# SPDX-License-Identifier: MIT
# Judges a sweep.csv of qibench: errors fall as tolerances do, for every method, and no point of qi is
# farther off than its tolerance and the rounding of its hits allow. Noise: errors below 1e-9
# diameters are rounding; of the picture, a tenth or a thousandth of a step. Newton's method without bounds
# and triangles lose hits of their own, whose distance no tolerance limits: of them the picture counts.
# Of POV-Ray's triangles the pixels whose rays meet what they meet in truth must come nearer; where the
# whole picture does not, because finer triangles lose a ray that coarser ones kept, that is a finding,
# named with its worst pixel. So is what flatness does where it begins to cut neighbours differently: more
# rays slip through the cracks, and light does. And where all hits come nearer but flat triangles at the edge
# of a shadow, which hide the light from each other or not, change single pixels. POV-Ray itself must be as far off as our copy of its triangles.
# Last line: how many points were judged and how many are wrong; exit status 1 if any is.
set -eu
awk -F, '
    NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
    $at["failed"] != "" { given_up++; next }
    {
        method = $at["method"]
        kind = $at["scene"] " " method " " $at["prepare"] ($at["flatness"] > 0 ? " flatness" : "")
        name = kind " " $at["tolerance"] $at["u_steps"] ($at["flatness"] > 0 ? " " $at["flatness"] : "")
        rms = $at["picture_rms_steps"]; position = $at["position_max_diameters"]
        normal = $at["normal_rms_degrees"]; position_rms = $at["position_rms_diameters"]
        same = $at["picture_rms_same_hits_steps"]
        judged++
        if (method == "qi" && position > $at["tolerance"] + $at["rounding_diameters"]) {
            print name ": " position " diameters off, more than its tolerance"; wrong++
        }
        if (method == "qi" && $at["edge_leaks_share"] + $at["pin_hole_pixels"] > 0) {
            print name ": leaks"; wrong++
        }
        if (method == "facets" && !($at["flatness"] > 0))
            facets[$at["scene"] " " $at["u_steps"]] = rms
        if (method == "povray") {
            ours = facets[$at["scene"] " " $at["u_steps"]]
            if (ours != "" && (rms - ours > 0.01 || ours - rms > 0.01)) {
                print name ": RMS " rms ", our copy of its triangles " ours; wrong++
            }
        } else if (kind == last) {
            grows = rms > 1.1 * last_rms + 1e-3
            if (grows && method == "facets" && same <= 1.1 * last_same + 1e-3)
                print "finding: " name ": RMS grows from " last_rms " to " rms " by rays that these triangles lose (worst: pixel " \
                    $at["worst_x"] "," $at["worst_y"] ", " $at["worst_steps"] " steps); of the other pixels it goes from " last_same " to " same
            else if (grows && method == "facets" && $at["flatness"] > 0 && \
                     $at["pin_hole_pixels"] + $at["edge_leaks_share"] > last_cracks)
                print "finding: " name ": RMS grows from " last_rms " to " rms " by cracks between patches cut differently (" \
                    $at["pin_hole_pixels"] " pin-holes, " 100 * $at["edge_leaks_share"] " % of edge rays lost; worst: pixel " \
                    $at["worst_x"] "," $at["worst_y"] ", " $at["worst_steps"] " steps)"
            else if (grows && method == "facets" && normal < last_normal && position_rms < last_position_rms)
                print "finding: " name ": RMS grows from " last_rms " to " rms " by single pixels (" 100 * $at["pixels_off_share"] \
                    " % are off by more than a step; worst: " $at["worst_x"] "," $at["worst_y"] ", " $at["worst_steps"] \
                    " steps), while hits come nearer (" last_position_rms " to " position_rms " diameters) and so do normals (" \
                    last_normal " to " normal " degrees)"
            else if (grows) {
                print name ": RMS grows from " last_rms " to " rms; wrong++
            }
            if (method !~ /newton|facets/ && position > last_position && position > 1e-9) {
                print name ": position grows from " last_position " to " position; wrong++
            }
        }
        last = kind; last_rms = rms; last_position = position; last_same = same; last_normal = normal; last_position_rms = position_rms
        last_cracks = $at["pin_hole_pixels"] + $at["edge_leaks_share"]
    }
    END {
        print judged + 0 " points judged, " given_up + 0 " given up, " wrong + 0 " wrong"
        exit wrong > 0 || judged == 0
    }' "$1"
