// SPDX-License-Identifier: GPL-3.0-or-later
// Certified or not, and at what cost beside the trace (CPU time, one run):
//   certificate_bench                     the table
//   certificate_bench random COUNT SEED   random polynomial systems: every certificate against a trace at a quarter
//                                         of the edge length (components, Euler characteristic)
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <Eigen/QR>

#include <whitney/functions/expression.h>
#include <whitney/topology/topology.h>
#include <whitney/tracing/certificate.h>
#include <whitney/tracing/trace.h>

using namespace whitney;
using coxeter::Triangulation;

namespace {

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

struct Problem {
  std::string name;
  std::vector<std::string> variables, equations;
  std::vector<double> seed;
  std::vector<double> edge_lengths;
};

std::vector<std::string> coordinates(int d) {
  std::vector<std::string> names;
  for (int i = 1; i <= d; ++i) names.push_back("x" + std::to_string(i));
  return names;
}

Problem sphere(int n, int d, std::vector<double> edge_lengths) {
  Problem p{"S^" + std::to_string(n) + " R^" + std::to_string(d),
            coordinates(d),
            {"-1"},
            std::vector<double>(d, 0.0),
            std::move(edge_lengths)};
  for (int i = 1; i <= n + 1; ++i) p.equations[0] += "+x" + std::to_string(i) + "^2";
  for (int i = n + 2; i <= d; ++i) p.equations.push_back("x" + std::to_string(i));
  p.seed[0] = 1;
  return p;
}

Problem flat_torus(int d, std::vector<double> edge_lengths) {
  Problem p{"T^2 R^" + std::to_string(d),
            coordinates(d),
            {"x1^2+x2^2-1", "x3^2+x4^2-1"},
            std::vector<double>(d, 0.0),
            std::move(edge_lengths)};
  for (int i = 5; i <= d; ++i) p.equations.push_back("x" + std::to_string(i));
  p.seed[0] = p.seed[2] = 1;
  return p;
}

std::vector<Problem> table() {
  const std::vector<std::string> xyz{"x", "y", "z"};
  std::vector<Problem> all{
      sphere(1, 2, {0.7}),
      sphere(2, 3, {0.8, 0.7, 0.1}),
      {"torus of revolution", xyz, {"(x^2+y^2+z^2+3)^2-16*(x^2+y^2)"}, {3, 0, 0}, {0.4, 0.27, 0.25, 0.1}},
      {"chair",
       xyz,
       {"(x^2+y^2+z^2-0.8)^2-0.4*((z-1)^2-2*x^2)*((z+1)^2-2*y^2)"},
       {0, 0, std::sqrt((0.8 + std::sqrt(0.4)) / (1 + std::sqrt(0.4)))},
       {0.07, 0.04}},
      {"wavy sphere", xyz, {"x^2+y^2+z^2+0.1*(sin(5*x)+sin(5*y)+cos(5*z))-1"}, {1, 0, 0}, {0.17, 0.1}},
      flat_torus(4, {0.6, 0.55, 0.5, 0.3}),
      {"trefoil R^4",
       {"x1", "y1", "x2", "y2"},
       {"x1^2-y1^2+x2^3-3*x2*y2^2", "2*x1*y1+3*x2^2*y2-y2^3", "x1^2+y1^2+x2^2+y2^2-1"},
       {0, 0.6558, 0.7549, 0},
       {0.15, 0.13, 0.02}},
      sphere(2, 6, {0.7, 0.6, 0.3}),
      sphere(3, 6, {0.6, 0.5, 0.4}),
      {"SO(3) R^6",
       {"u1", "u2", "u3", "v1", "v2", "v3"},
       {"u1^2+u2^2+u3^2-1", "v1^2+v2^2+v3^2-1", "u1*v1+u2*v2+u3*v3"},
       {1, 0, 0, 0, 1, 0},
       {0.3}},
      flat_torus(8, {0.5, 0.4}),
      flat_torus(10, {0.46, 0.3}),
      {"dense R^8",
       coordinates(8),
       {"x1^2+x2^2+0.2*sin(x3*x5)-1", "x3^2+x4^2+0.2*cos(x1+x6)-1.1", "exp(0.5*x5)-1+0.2*sin(x1*x2)+x6*0.3",
        "x6+0.3*x6^3-0.2*cos(x3+x2*x7)", "x7+0.2*sin(x1*x4+x8)", "x8+0.1*exp(x2*x3)-0.3*x5"},
       {1, 0, 1, 0, 0, 0, 0, 0},
       {0.2}},
      sphere(1, 30, {0.3})};
  // The regular pentagon with the side (0,0) (1,0).
  std::vector<double> pentagon;
  for (double x = 1, y = 0, angle = 0.4 * std::numbers::pi; pentagon.size() < 6; angle += 0.4 * std::numbers::pi) {
    pentagon.insert(pentagon.end(), {x += std::cos(angle), y += std::sin(angle)});
  }
  all.push_back({"pentagon R^6",
                 {"x3", "y3", "x4", "y4", "x5", "y5"},
                 {"(x3-1)^2+y3^2-1", "(x4-x3)^2+(y4-y3)^2-1", "(x5-x4)^2+(y5-y4)^2-1", "x5^2+y5^2-1"},
                 pentagon,
                 {0.15, 0.08}});
  return all;
}

Triangulation random_triangulation(int d, double edge_length, std::mt19937_64& rng) {
  std::normal_distribution<double> normal;
  Eigen::MatrixXd matrix(d, d);
  for (int i = 0; i < d * d; ++i) matrix.data()[i] = normal(rng);
  const Eigen::MatrixXd rotation = Eigen::HouseholderQR<Eigen::MatrixXd>(matrix).householderQ();
  Eigen::VectorXd shift(d);
  for (int i = 0; i < d; ++i) shift[i] = edge_length * normal(rng);
  return coxeter::coxeter_a(d, edge_length).transformed(rotation, shift);
}

void print_table(const char* only) {
  std::printf("%-20s %6s %9s %9s %9s %8s %8s  %s\n", "case", "L", "simplices", "stars", "certified", "trace", "certify",
              "us/simplex of CPU time; worst radius and drop, distance bound, failing stars of the last lattice");
  for (const Problem& p : table()) {
    if (only != nullptr && p.name.find(only) == std::string::npos) continue;
    const Function f = parse_equations(p.variables, p.equations);
    const Enclosure enclosure = Enclosure::of_expressions(p.variables, p.equations);
    for (const double edge_length : p.edge_lengths) {
      int certified = 0, lattices = 0;
      std::size_t simplices = 0, stars = 0;
      double trace_time = 0, certify_time = 0;
      IsotopyCertificate c;
      for (int seed = 0; seed < 5; ++seed) {
        std::mt19937_64 rng(seed * 7919 + 13);
        const Triangulation triangulation = random_triangulation(int(p.variables.size()), edge_length, rng);
        const double begin = cpu_seconds();
        const TraceResult traced = trace(f, triangulation, p.seed, {.run = {.max_simplices = 3'000'000}});
        const double middle = cpu_seconds();
        c = certify_trace(enclosure, triangulation, traced);
        certify_time += cpu_seconds() - middle;
        trace_time += middle - begin;
        certified += c.is_certified();
        ++lattices;
        simplices += traced.num_simplices();
        stars += c.num_stars;
        if (traced.num_simplices() > 300'000) break;
      }
      std::printf("%-20s %6g %9zu %9zu %7d/%d %8.2f %8.2f  %.3f %.3f %.3g %zu %s\n", p.name.c_str(), edge_length,
                  simplices, stars, certified, lattices, 1e6 * trace_time / double(simplices),
                  1e6 * certify_time / double(simplices), c.worst_radius, c.worst_drop, c.distance_bound, c.num_failing,
                  c.reason.c_str());
      std::fflush(stdout);
    }
  }
}

std::string random_polynomial(int d, int degree, std::mt19937_64& rng) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::string text;
  char number[40];
  for (int term = 0; term < 4 + 2 * d; ++term) {
    std::snprintf(number, sizeof number, "%+.6f", normal(rng));
    text += number;
    const int total = 1 + int(rng() % degree);
    for (int i = 0; i < total; ++i) text += "*x" + std::to_string(1 + rng() % d);
  }
  std::snprintf(number, sizeof number, "%+.6f", 0.5 * normal(rng));
  return text + number;
}

struct Shape {
  std::int64_t euler_characteristic;
  std::size_t components;
  bool operator==(const Shape&) const = default;
};

Shape shape_of(const TraceResult& t) {
  TopologyOptions options;
  options.homology = false;
  options.links = false;
  const auto topology = topology_of(cell_complex(t).facets, options);
  return {topology.euler_characteristic, topology.components};
}

/// A polynomial system with a compact zero set: random terms, and |x|^4 or |x|^2 terms that win far out.
void try_random(int count, int seed) {
  std::size_t runs = 0, whole = 0, certified = 0, compared = 0, wrong = 0;
  for (int i = 0; i < count; ++i) {
    std::mt19937_64 rng(seed * 1'000'003ull + i);
    const int d = 2 + int(rng() % 3), k = 1 + int(rng() % (d - 1));
    std::vector<std::string> variables = coordinates(d), equations;
    for (int a = 0; a < k; ++a) equations.push_back(random_polynomial(d, 2 + int(rng() % 2), rng));
    std::string squares;
    for (int j = 1; j <= d; ++j) squares += "+x" + std::to_string(j) + "^2";
    const int kind = int(rng() % 3);
    if (kind == 0) equations[0] = "0.2*(" + squares + ")^2" + equations[0];
    if (kind == 1) equations[0] = "0.3*(" + squares + "-1)^2-0.1" + equations[0];
    if (kind == 2) equations[0] = squares + "-2";
    const Function f = parse_equations(variables, equations);
    const Enclosure enclosure = Enclosure::of_expressions(variables, equations);
    std::vector<double> seeds;
    std::normal_distribution<double> normal;
    for (int s = 0; s < 6 * d; ++s) seeds.push_back(normal(rng));
    double edge_length = std::pow(10.0, -0.1 - 1.1 * std::uniform_real_distribution<double>()(rng));
    const double largest = d == 4 && k == 1 ? 0.25 : 0.8;
    edge_length = std::max(edge_length, d == 4 && k == 1 ? largest : 0.05);
    try {
      ++runs;
      std::mt19937_64 lattice(rng());
      const Triangulation coarse = random_triangulation(d, edge_length, lattice);
      const TraceResult t = trace(f, coarse, seeds, {.run = {.max_simplices = 60'000}});
      if (!t.whole || t.num_simplices() == 0) continue;
      ++whole;
      const IsotopyCertificate c = certify_trace(enclosure, coarse, t);
      if (!c.is_certified()) continue;
      ++certified;
      // From where the coarse one is: one point of every simplex as a seed is too many, so of every 50th and more.
      std::vector<double> fine_seeds;
      const std::size_t step = 1 + t.num_simplices() / 2000;
      for (std::size_t s = 0; s < t.num_simplices(); s += step) {
        fine_seeds.insert(fine_seeds.end(), t.point(s).begin(), t.point(s).end());
      }
      const Triangulation fine = random_triangulation(d, edge_length / 4, lattice);
      const TraceResult u = trace(f, fine, fine_seeds, {.run = {.max_simplices = 3'000'000}});
      if (!u.whole) continue;
      ++compared;
      if (shape_of(t) != shape_of(u)) {
        ++wrong;
        const Shape a = shape_of(t), b = shape_of(u);
        std::printf("WRONG seed %d i %d d %d k %d L %g: chi %ld components %zu, fine chi %ld components %zu\n", seed, i,
                    d, k, edge_length, long(a.euler_characteristic), a.components, long(b.euler_characteristic),
                    b.components);
        for (const auto& e : equations) std::printf("  %s\n", e.c_str());
      }
    } catch (const std::exception& e) {
      std::printf("error i %d: %s\n", i, e.what());
    }
    if (i % 100 == 99) {
      std::printf("seed %d: %d systems, %zu traced, %zu whole, %zu certified, %zu compared, %zu wrong\n", seed, i + 1,
                  runs, whole, certified, compared, wrong);
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::strcmp(argv[1], "random") == 0) {
    try_random(argc > 2 ? std::atoi(argv[2]) : 1000, argc > 3 ? std::atoi(argv[3]) : 1);
  } else {
    print_table(argc > 1 ? argv[1] : nullptr);
  }
}
