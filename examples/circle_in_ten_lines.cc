// SPDX-License-Identifier: GPL-3.0-or-later
// The unit circle in R^3, traced as the zero set of two equations, as a mesh. Prints the number of its edges.
#include <cstdio>
#include <vector>

#include <whitney/cells/cell_complex.h>
#include <whitney/cells/subdivide.h>
#include <whitney/io/write_mesh.h>
#include <whitney/tracing/trace.h>

int main() {
  const auto f = whitney::make_function(3, 2, [](std::span<const double> x, std::span<double> value) {
    value[0] = x[0] * x[0] + x[1] * x[1] - 1;
    value[1] = x[2];
  });
  const auto traced = whitney::trace(f, whitney::coxeter::coxeter_a(3, 0.3), std::vector{1.0, 0.0, 0.0});
  const auto mesh = whitney::pulled_subdivision(whitney::cell_complex(traced));
  whitney::write_mesh("circle.noff", mesh);
  std::printf("%zu edges\n", mesh.num_simplices());
}
