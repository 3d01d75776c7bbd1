// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <set>
#include <vector>

#include <coxeter/faces/cofaces.h>
#include <coxeter/faces/faces.h>
#include <coxeter/triangulation.h>
#include <whitney/functions/function.h>
#include <whitney/tracing/exact_pivot.h>
#include <whitney/tracing/trace.h>
#include "bytes.h"

namespace whitney::fuzz {

/// f: Z^d -> small integers read off the bytes inside a cube, constant outside, so that zeros are everywhere and the
/// zero set is compact. What is traced from any seed is hit by exact arithmetic, and closed: of a cofacet of what was
/// found, every face that is hit was found.
inline void trace_body(Bytes bytes) {
  Choices choices(bytes);
  const int d = 2 + choices.below(2), k = 1 + choices.below(d - 1), radius = 2, side = 2 * radius + 1;
  std::vector<double> table(static_cast<std::size_t>(k) * static_cast<std::size_t>(std::pow(side, d)));
  for (double& value : table) value = choices.below(5) - 2;
  const Function f = make_function(d, k, [=](std::span<const double> x, std::span<double> value) {
    std::size_t at = 0;
    bool outside = false;
    for (int c = 0; c < d; ++c) {
      const long z = std::lround(x[static_cast<std::size_t>(c)]) + radius;
      outside = outside || z < 0 || z >= side;
      at = at * static_cast<std::size_t>(side) + static_cast<std::size_t>(outside ? 0 : z);
    }
    for (std::size_t r = 0; r < value.size(); ++r) value[r] = outside ? 7 : table[at * value.size() + r];
  });
  const auto triangulation = coxeter::freudenthal(d, std::sqrt(static_cast<double>(d)));
  const auto is_hit = [&](const coxeter::Simplex& sigma) {
    std::vector<double> values(static_cast<std::size_t>(k * (k + 1)));
    std::vector<const double*> columns;
    std::size_t q = 0;
    for (const coxeter::LatticeVertex& v : sigma.vertices()) {
      const std::vector<double> x(v.data(), v.data() + d);
      const std::span<double> value =
          std::span(values).subspan(q++ * static_cast<std::size_t>(k), static_cast<std::size_t>(k));
      f.evaluate(x, value);
      columns.push_back(value.data());
    }
    return exactly_hit(columns);
  };

  std::vector<double> seeds;
  for (int s = 0; s < 6; ++s)
    for (int c = 0; c < d; ++c) seeds.push_back((choices.below(32) - 16) / 8.0);
  const TraceResult traced = trace(f, triangulation, seeds);
  demand(traced.whole, "a compact zero set is traced to its end");
  std::set<coxeter::Simplex> found;
  for (std::size_t i = 0; i < traced.num_simplices(); ++i) {
    const std::span<const std::int32_t> z = traced.vertex_coordinates().subspan(
        std::size_t{traced.base(i)} * static_cast<std::size_t>(d), static_cast<std::size_t>(d));
    std::vector<std::uint16_t> part;
    for (int c = 0; c < d; ++c) part.push_back(static_cast<std::uint16_t>(traced.part(i, c)));
    part.push_back(static_cast<std::uint16_t>(k));
    const coxeter::Simplex sigma{coxeter::LatticeVertex(z), coxeter::OrderedPartition::from_part_indices(part)};
    demand(found.insert(sigma).second, "a simplex is found once");
    demand(is_hit(sigma), "what is found is hit");
  }
  for (const coxeter::Simplex& sigma : found)
    coxeter::for_each_coface(sigma, k + 1, [&](const coxeter::Simplex& cofacet) {
      int hit = 0;
      coxeter::for_each_face(cofacet, k, [&](const coxeter::Simplex& face) {
        if (!is_hit(face)) return;
        ++hit;
        demand(found.count(face) > 0, "what is found is closed");
      });
      demand(hit == 2, "a cofacet has two faces that are hit");
    });
}

}  // namespace whitney::fuzz
