// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a square of two triangles through the installed library and reads it back.
#include <cstdio>

#include <coxeter/base/error.h>
#include <whitney/io/read_mesh.h>
#include <whitney/io/write_mesh.h>
#include <whitney/topology/mesh.h>

int main() {
  const whitney::SimplicialMesh square{
      .ambient_dim = 3, .dim = 2, .points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, .simplices = {0, 1, 2, 0, 2, 3}};
  whitney::write_mesh("square.ply", square);
  const whitney::SimplicialMesh back = whitney::read_mesh("square.ply");
  bool refused = false;
  try {
    whitney::read_mesh("there is no such file.off");
  } catch (const whitney::FileError&) {
    refused = true;
  }
  const bool good = refused && back.points == square.points && back.simplices == square.simplices;
  std::puts(good ? "the installed library works" : "the installed library gave back something else");
  return good ? 0 : 1;
}
