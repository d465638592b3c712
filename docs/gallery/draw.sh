#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Draws the pictures of docs/gallery.md with `gmsim view` and a headless Chromium: draw.sh [GMSIM] [NAME…].
# Without names it draws all of them.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
scenes="$here/../../scenes"
gmsim="$(realpath "${1:-$here/../../build/release/gmsim}")"
shift || true
wanted=" $* "
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

# draw FOLDER SCENE ADDRESS: what ADDRESS says stands in docs/viewing.md.
draw() {
  [[ $wanted == "  " || $wanted == *" $2 "* ]] || return 0
  (cd "$work" && "$gmsim" "$scenes/$1/$2.yaml" --force >/dev/null && "$gmsim" view "$2.vtkhdf" >/dev/null)
  chromium --headless --no-sandbox --enable-unsafe-swiftshader --hide-scrollbars --window-size=640,480 \
    --virtual-time-budget=5000 --user-data-dir="$work/profile" --screenshot="$here/$2.png" \
    "file://$work/$2.html#$3" >/dev/null 2>&1
  echo "$2.png"
}

draw paper fig6_masses 'frame=-1&field=mass&fit=frame'
draw paper fig9b_spring_force 'frame=25&fit=frame'
draw paper fig9c_vertex_force 'frame=25&fit=frame'
draw paper fig9d_global_edge 'frame=25&fit=frame'
draw paper fig9e_atomic_edge 'frame=25&fit=frame'
draw paper fig11_rectangles 'frame=25&fit=frame'
draw paper fig12_atomic_face 'frame=28&fit=frame'
draw paper fig12_global_face 'frame=28&fit=frame'
draw paper fig12_spring_elongation 'frame=16&fit=frame'
draw paper fig14_cloth 'frame=25&fit=frame'
draw paper fig14_cloth_tears 'frame=28&fit=frame'
draw paper pairing_stretch_removes_elements 'frame=35&fit=frame'
draw paper pairing_shear_removes_element 'frame=30&fit=frame'
draw paper pairing_bending_separates 'frame=40&fit=frame'
draw paper table2_quads 'frame=30&fit=frame'
draw paper table2_tri4 'frame=30&fit=frame'
draw paper table2_mix4 'frame=30&fit=frame'
draw hard cascade 'frame=6&fit=frame'
draw hard rubble 'frame=20'
draw hard pinch_in_a_sheet 'frame=30&fit=frame'
draw hard pinch_in_a_block 'frame=20'
draw hard crossing_t 'frame=20'
draw hard crossing_x 'frame=20'
draw hard torn_at_a_nail 'frame=20&field=fixed'
draw hard moebius_in_halves 'frame=-1&fit=frame'
draw hard moebius_in_thirds 'frame=-1&fit=frame'
