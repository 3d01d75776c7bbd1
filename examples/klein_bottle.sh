#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Whitney's construction on a surface that no tracer of equations can take: the Klein bottle in R^4, given by a
# parametrization. Installs what is missing, builds the program, triangulates with a certificate and draws the
# projection to the first three coordinates, coloured by the fourth: the projection crosses itself along a segment,
# where the colours differ; the surface does not.
#
#   sh examples/klein_bottle.sh [FOLDER]      FOLDER: where the results go, default out/
set -eu
root="$(cd "$(dirname "$0")/.." && pwd)"
out="${1:-$root/out}"
mkdir -p "$out"
sh "$root/cmake/build_program.sh" "$out/build.log"

"$root/build/release/bin/whitney" triangulate "$root/examples/problems/klein_bottle.json" --edge-length 0.2 \
  --mesh pulled --project 1,2,3 --color-by x4 -o "$out/klein_bottle.ply" -o "$out/klein_bottle.noff" \
  -o "$out/klein_bottle.pov" --stats "$out/klein_bottle.json"
povray -D -GA +I"$out/klein_bottle.pov" +O"$out/klein_bottle.png" +W1200 +H900 +A0.2 >>"$out/build.log" 2>&1 ||
  { echo "povray could not draw the picture; see $out/build.log" >&2; exit 1; }

echo
echo "mesh:       $out/klein_bottle.ply (projected; all four coordinates as properties), $out/klein_bottle.noff (in R^4)"
echo "statistics: $out/klein_bottle.json"
echo "picture:    $out/klein_bottle.png"
