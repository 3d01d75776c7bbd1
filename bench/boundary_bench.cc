// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a boundary costs: the same manifold whole, cut in half by one inequality, to a quarter by two, and by a box;
// runs interleaved, CPU seconds, ratios of medians of the time per stratum point found.
//
//   boundary_bench [RUNS]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <time.h>
#include <vector>

#include <coxeter/triangulation.h>
#include <whitney/cells/cell_complex.h>
#include <whitney/functions/function.h>
#include <whitney/tracing/trace.h>

namespace {

using whitney::Function;
using Values = std::span<double>;
using Point = std::span<const double>;

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

double median(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  return (x[(x.size() - 1) / 2] + x[x.size() / 2]) / 2;
}

/// Sphere S^n or flat torus, off the lattice by a shift, in R^d.
Function manifold(bool torus, int n, int d) {
  return whitney::make_function(d, d - n, [=](Point x, Values v) {
    double y[16];
    for (int c = 0; c < d; ++c) y[c] = x[c] - 0.01 * std::cos(1.0 + c);
    if (torus) {
      v[0] = y[0] * y[0] + y[1] * y[1] - 1;
      v[1] = y[2] * y[2] + y[3] * y[3] - 1;
      for (int c = 4; c < d; ++c) v[c - 2] = y[c];
    } else {
      v[0] = -1;
      for (int c = 0; c <= n; ++c) v[0] += y[c] * y[c];
      for (int c = n + 1; c < d; ++c) v[c - n] = y[c];
    }
  });
}

struct Case {
  const char* title;
  bool torus;
  int n, d;
  double edge_length;
};

constexpr Case kCases[] = {{"S^2 in R^3, .02", false, 2, 3, 0.02},
                           {"T^2 in R^4, .1", true, 2, 4, 0.1},
                           {"S^3 in R^6, .4", false, 3, 6, 0.4},
                           {"T^2 in R^10, .4", true, 2, 10, 0.4}};

void run(const Case& c, int runs) {
  const Function f = manifold(c.torus, c.n, c.d);
  const auto triangulation = whitney::coxeter::coxeter_a(c.d, c.edge_length);
  std::vector<double> seed(c.d, 0.0);
  seed[0] = seed[2] = c.torus ? 1 : std::sqrt(0.5);
  whitney::TraceOptions whole, half, quarter, box;
  half.inequalities = whitney::make_function(c.d, 1, [](Point x, Values v) { v[0] = x[0] + 0.2 * x[1] - 0.013; });
  quarter.inequalities = whitney::make_function(c.d, 2, [](Point x, Values v) {
    v[0] = x[0] + 0.2 * x[1] - 0.013;
    v[1] = x[2] - 0.3 * x[1] - 0.017;
  });
  box.box = whitney::Box{std::vector<double>(c.d, -2.0), std::vector<double>(c.d, 2.0)};
  box.box->lower[0] = 0.013;
  const std::pair<const char*, const whitney::TraceOptions*> variants[] = {
      {"whole", &whole}, {"half", &half}, {"quarter, with corners", &quarter}, {"half, by a box", &box}};
  double reference = 0;
  std::vector<double> trace_seconds[4], complex_seconds[4];
  std::size_t points[4] = {}, boundary[4] = {}, exact[4] = {};
  for (int r = 0; r < runs; ++r)
    for (int v = 0; v < 4; ++v) {
      double start = cpu_seconds();
      const auto traced = whitney::trace(f, triangulation, seed, *variants[v].second);
      trace_seconds[v].push_back(cpu_seconds() - start);
      start = cpu_seconds();
      const auto complex = whitney::cell_complex(traced);
      complex_seconds[v].push_back(cpu_seconds() - start);
      points[v] = traced.num_points();
      boundary[v] = points[v] - traced.num_simplices();
      exact[v] = traced.exact_decisions;
    }
  for (int v = 0; v < 4; ++v) {
    const double per_point = 1e6 * median(trace_seconds[v]) / double(points[v]);
    if (v == 0) reference = per_point;
    std::printf("| %s, %s | %zu | %zu | %.3f | %.2f | %.2f | %zu | %.3f |\n", c.title, variants[v].first, points[v],
                boundary[v], median(trace_seconds[v]), per_point, per_point / reference, exact[v],
                median(complex_seconds[v]));
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::atoi(argv[1]) : 5;
  std::printf(
      "| case | simplices | of the boundary | trace, s | us / simplex | ratio to the whole | exact decisions | cell "
      "complex, s |\n"
      "|---|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const Case& c : kCases) run(c, runs);
}
