// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <set>
#include <vector>

#include <coxeter/faces/cofaces.h>
#include <coxeter/faces/faces.h>
#include <coxeter/simplex.h>
#include "bytes.h"

namespace whitney::fuzz {

/// Faces and cofaces of a simplex made of the bytes, d <= 15, where the short forms do the work; against the same in
/// one dimension more than the short forms can hold: a simplex of R^d beside extra coordinates that lie in the last
/// part has the faces of the first, extended.
inline void partition_body(Bytes bytes) {
  Choices choices(bytes);
  const int d = 1 + choices.below(9), long_dim = 33;
  const int m = choices.below(d + 1);
  std::vector<std::int32_t> base;
  std::vector<std::uint16_t> part;
  for (int c = 0; c < d; ++c) {
    base.push_back(choices.below(7) - 3);
    part.push_back(static_cast<std::uint16_t>(choices.below(m + 1)));
  }
  part.push_back(static_cast<std::uint16_t>(m));  // element d
  for (int q = 0; q <= m; ++q)
    if (std::find(part.begin(), part.end(), q) == part.end()) return;  // a part would be empty
  std::vector<std::int32_t> long_base = base;
  std::vector<std::uint16_t> long_part(part.begin(), part.end() - 1);
  long_base.resize(static_cast<std::size_t>(long_dim), 0);
  long_part.resize(static_cast<std::size_t>(long_dim) + 1, static_cast<std::uint16_t>(m));

  const auto simplex = [](const std::vector<std::int32_t>& z, const std::vector<std::uint16_t>& p) {
    return coxeter::Simplex(coxeter::LatticeVertex(std::span<const std::int32_t>(z)),
                            coxeter::OrderedPartition::from_part_indices(p));
  };
  const coxeter::Simplex small = simplex(base, part), large = simplex(long_base, long_part);
  // The vertices of a face of either, by the coordinates that both have.
  using Face = std::set<std::vector<std::int32_t>>;
  const auto face_of = [d](const coxeter::Simplex& face) {
    Face vertices;
    for (const coxeter::LatticeVertex& v : face.vertices())
      vertices.insert(std::vector<std::int32_t>(v.data(), v.data() + d));
    return vertices;
  };
  for (int dim = 0; dim <= m; ++dim) {
    std::multiset<Face> short_faces, long_faces;
    coxeter::for_each_face(small, dim, [&](const coxeter::Simplex& f) { short_faces.insert(face_of(f)); });
    coxeter::for_each_face(large, dim, [&](const coxeter::Simplex& f) { long_faces.insert(face_of(f)); });
    demand(short_faces == long_faces, "faces in the short form are those in the long form");
  }
  // Every coface has the simplex among its faces, each comes once, and has the dimension asked for.
  for (int dim = m; dim <= std::min(d, m + 2); ++dim) {
    std::set<coxeter::Simplex> seen;
    coxeter::for_each_coface(small, dim, [&](const coxeter::Simplex& coface) {
      demand(coface.dim() == dim && seen.insert(coface).second, "a coface comes once, in its dimension");
      bool found = false;
      coxeter::for_each_face(coface, m, [&](const coxeter::Simplex& face) { found = found || face == small; });
      demand(found, "a simplex is a face of its cofaces");
    });
  }
}

}  // namespace whitney::fuzz
