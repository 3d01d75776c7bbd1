// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/tracing/trace_result.h>

namespace whitney {

std::size_t TraceResult::num_points() const {
  std::size_t sum = num_simplices();
  for (const BoundarySimplices& stratum : boundary) sum += stratum.size();
  return sum;
}

CellComplex cell_complex(const TraceResult& trace) {
  CrossedSimplices crossed;
  crossed.ambient_dim = trace.ambient_dim();
  crossed.codim = trace.codim();
  crossed.vertex_coordinates = trace.vertex_coordinates();
  std::vector<std::uint32_t> base(trace.num_simplices());
  for (std::size_t i = 0; i < base.size(); ++i) base[i] = trace.base(i);
  crossed.base = base;
  if (trace.has_wide_parts())
    crossed.wide_parts = trace.parts<std::uint16_t>();
  else
    crossed.parts = trace.parts<std::uint8_t>();
  crossed.points = trace.points();
  crossed.boundary = trace.boundary;
  crossed.num_given = trace.domain.num_given();
  crossed.whole = trace.whole;
  return cell_complex(crossed);
}

}  // namespace whitney
