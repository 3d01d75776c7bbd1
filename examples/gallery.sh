#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Draws surfaces with boundary and surfaces glued from charts. Installs what is missing and builds the program.
#
#   sh examples/gallery.sh [FOLDER]      FOLDER: where the results go, default out/
set -eu
root="$(cd "$(dirname "$0")/.." && pwd)"
out="${1:-$root/out}"
mkdir -p "$out"
sh "$root/cmake/build_program.sh" "$out/build.log"

draw() { # name of the problem, options
  name="$1"
  shift
  echo "== $name"
  "$root/build/release/bin/whitney" trace "$root/examples/problems/$name.json" "$@" -o "$out/$name.vtu" \
    -o "$out/$name.pov" --stats "$out/$name.json"
  povray -D -GA +I"$out/$name.pov" +O"$out/$name.png" +W1000 +H850 +A0.2 >>"$out/build.log" 2>&1 ||
    { echo "povray could not draw the picture; see $out/build.log" >&2; exit 1; }
  echo "picture: $out/$name.png"
}

draw gyroid --color-by z
draw cut_torus
draw sphere_octant
draw klein_quartic
draw alvarez_deroin
draw clebsch_cubic
