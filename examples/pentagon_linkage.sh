#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The tracer on a real problem, from a bare machine: installs what is missing, builds the program, traces the
# configuration space of a pentagon linkage (equations in R^6, a surface of genus 4) and draws it.
#
#   sh examples/pentagon_linkage.sh [FOLDER]      FOLDER: where the results go, default out/
set -eu
root="$(cd "$(dirname "$0")/.." && pwd)"
out="${1:-$root/out}"
mkdir -p "$out"
sh "$root/cmake/build_program.sh" "$out/build.log"

"$root/build/release/bin/whitney" trace "$root/examples/problems/pentagon_linkage.json" \
  -o "$out/pentagon.ply" -o "$out/pentagon.pov" --stats "$out/pentagon.json"
povray -D -GA +I"$out/pentagon.pov" +O"$out/pentagon.png" +W1200 +H900 +A0.2 >>"$out/build.log" 2>&1 ||
  { echo "povray could not draw the picture; see $out/build.log" >&2; exit 1; }

echo
echo "mesh:       $out/pentagon.ply"
echo "statistics: $out/pentagon.json"
echo "picture:    $out/pentagon.png"
