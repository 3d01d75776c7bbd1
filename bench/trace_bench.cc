// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tracer beside GUDHI's Coxeter_triangulation, in one run: the same function, the same triangulation, one thread,
// runs interleaved, answers compared. CPU seconds; ratios are ratios of medians. Without libgudhi-dev only our side
// runs.
//
//   trace_bench [--runs R] [--peer-runs P] [case ...]
// P times: one run of the peer, then R of ours. Cases: s2r3 t2r4 s3r6 t2r8 t2r10 t2r10fine
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <malloc.h>
#include <memory>
#include <optional>
#include <string>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#include <vector>

#include <Eigen/Dense>

#include <coxeter/base/eigen_view.h>
#include <coxeter/triangulation.h>
#include <whitney/cells/cell_complex.h>
#include <whitney/cells/subdivide.h>
#include <whitney/functions/function.h>
#include <whitney/tracing/trace.h>

#if __has_include(<gudhi/Coxeter_triangulation.h>)
#define WHITNEY_HAS_PEER 1
#include <gudhi/Coxeter_triangulation.h>
#include <gudhi/Implicit_manifold_intersection_oracle.h>
#include <gudhi/Manifold_tracing.h>
#endif

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

double median(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  return (x[(x.size() - 1) / 2] + x[x.size() / 2]) / 2;
}

/// A sphere or flat torus in R^d, in the coordinates y = Q^T (x - b) of a fixed motion. Hand-written, for both sides.
class Manifold final : public whitney::Function::Model {
 public:
  Manifold(bool torus, int intrinsic_dim, int ambient_dim) : torus_(torus), n_(intrinsic_dim), d_(ambient_dim) {
    MatrixXd A(d_, d_);
    b_.resize(d_);
    for (int i = 0; i < d_; ++i) {
      for (int j = 0; j < d_; ++j) A(i, j) = std::sin(1.0 + 3.7 * i + 1.3 * j * j + (i == j ? 2.0 : 0.0));
      b_[i] = 0.41 * std::cos(0.7 + 2.1 * i);
    }
    Q_ = A.householderQr().householderQ();
  }
  int ambient_dim() const override { return d_; }
  int codim() const override { return d_ - n_; }
  void value(const double* x, double* f) const {
    double y[16];
    for (int c = 0; c < d_; ++c) {
      double sum = 0;
      const double* column = Q_.data() + std::size_t(c) * d_;
      for (int r = 0; r < d_; ++r) sum += column[r] * (x[r] - b_[r]);
      y[c] = sum;
    }
    if (torus_) {
      f[0] = y[0] * y[0] + y[1] * y[1] - 1;
      f[1] = y[2] * y[2] + y[3] * y[3] - 1;
      for (int c = 4; c < d_; ++c) f[c - 2] = y[c];
    } else {
      f[0] = -1;
      for (int c = 0; c <= n_; ++c) f[0] += y[c] * y[c];
      for (int c = n_ + 1; c < d_; ++c) f[c - n_] = y[c];
    }
  }
  void evaluate(std::span<const double> points, std::span<double> values) const override {
    for (std::size_t i = 0; i * d_ < points.size(); ++i) value(&points[i * d_], &values[i * codim()]);
  }
  VectorXd seed(int i) const {
    VectorXd y = VectorXd::Zero(d_);
    const double u = 0.3 + i, v = 0.7 + 1.3 * i;
    if (torus_)
      y.head(4) << std::cos(u), std::sin(u), std::cos(v), std::sin(v);
    else
      for (int c = 0; c <= n_; ++c) y[c] = std::cos((i + 1) * (c + 1.7));
    if (!torus_) y.normalize();
    return Q_ * y + b_;
  }

 private:
  bool torus_;
  int n_, d_;
  MatrixXd Q_;
  VectorXd b_;
};

#ifdef WHITNEY_HAS_PEER
namespace peer = Gudhi::coxeter_triangulation;
using PeerSimplex = peer::Permutahedral_representation<std::vector<int>, std::vector<std::vector<std::size_t>>>;
using PeerTriangulation = peer::Freudenthal_triangulation<PeerSimplex>;

struct PeerFunction {
  const Manifold* manifold;
  std::size_t* evaluations;
  VectorXd operator()(const VectorXd& x) const {
    ++*evaluations;
    VectorXd f(manifold->codim());
    manifold->value(x.data(), f.data());
    return f;
  }
  std::size_t amb_d() const { return manifold->ambient_dim(); }
  std::size_t cod_d() const { return manifold->codim(); }
  VectorXd seed() const { return manifold->seed(0); }
};

/// Simplices found by the peer from the first of its seed points that gives any.
std::size_t run_peer(const Manifold& manifold, const whitney::coxeter::Triangulation& triangulation, double& seconds,
                     std::size_t& evaluations) {
  PeerTriangulation theirs(manifold.ambient_dim());
  theirs.change_matrix(whitney::as_eigen(triangulation.linear()));
  const PeerFunction f{&manifold, &evaluations};
  const auto oracle = peer::make_oracle(f);
  for (int i = 0; i < 50; ++i) {
    peer::Manifold_tracing<PeerTriangulation>::Out_simplex_map map;
    evaluations = 0;
    const double start = cpu_seconds();
    peer::manifold_tracing_algorithm(std::vector<VectorXd>{manifold.seed(i)}, theirs, oracle, map);
    seconds = cpu_seconds() - start;
    if (!map.empty()) return map.size();
  }
  return 0;
}
#endif

/// A line of /proc/self/status, in bytes.
double status_bytes(const char* key) {
  std::FILE* file = std::fopen("/proc/self/status", "r");
  char line[256];
  double kilobytes = 0;
  while (file && std::fgets(line, sizeof line, file))
    if (std::strncmp(line, key, std::strlen(key)) == 0) kilobytes = std::atof(line + std::strlen(key));
  if (file) std::fclose(file);
  return kilobytes * 1024;
}

/// How far the peak of resident memory lies above what was resident before `work`, after `before`; in a child process
/// of its own.
double peak_growth(const std::function<void()>& before, const std::function<void()>& work) {
  int ends[2];
  if (pipe(ends) != 0) return 0;
  const pid_t child = fork();
  if (child == 0) {
    before();
    malloc_trim(0);
    if (std::FILE* file = std::fopen("/proc/self/clear_refs", "w")) {
      std::fputs("5", file);  // forget the peak so far
      std::fclose(file);
    }
    const double resident = status_bytes("VmRSS:");
    work();
    const double growth = status_bytes("VmHWM:") - resident;
    _exit(write(ends[1], &growth, sizeof growth) == sizeof growth ? 0 : 1);
  }
  double growth = 0;
  if (read(ends[0], &growth, sizeof growth) != sizeof growth) growth = -1;
  waitpid(child, nullptr, 0);
  close(ends[0]);
  close(ends[1]);
  return growth;
}

struct Case {
  const char* name;
  const char* title;
  bool torus;
  int n, d;
  double edge_length;
};

constexpr Case kCases[] = {
    {"s2r3", "S^2 in R^3, .02", false, 2, 3, 0.02},   {"t2r4", "T^2 in R^4, .15", true, 2, 4, 0.15},
    {"s3r6", "S^3 in R^6, .5", false, 3, 6, 0.5},     {"t2r8", "T^2 in R^8, .4", true, 2, 8, 0.4},
    {"t2r10", "T^2 in R^10, .46", true, 2, 10, 0.46}, {"t2r10fine", "T^2 in R^10, .23", true, 2, 10, 0.23}};

void run(const Case& c, int runs, int peer_runs) {
  const auto manifold = std::make_shared<Manifold>(c.torus, c.n, c.d);
  const whitney::Function f(manifold);
  const auto triangulation = whitney::coxeter::coxeter_a(c.d, c.edge_length);
  const VectorXd seed = manifold->seed(0);
  const std::span<const double> seed_span(seed.data(), c.d);

  std::vector<double> ours, theirs;
  std::size_t simplices = 0, evaluations = 0, vertices = 0, peer_simplices = 0, peer_evaluations = 0;
  for (int r = 0; r < std::max(1, peer_runs); ++r) {
#ifdef WHITNEY_HAS_PEER
    if (peer_runs > 0) {
      double seconds = 0;
      peer_simplices = run_peer(*manifold, triangulation, seconds, peer_evaluations);
      theirs.push_back(seconds);
    }
#endif
    for (int i = 0; i < runs; ++i) {
      const double start = cpu_seconds();
      const whitney::TraceResult traced = whitney::trace(f, triangulation, seed_span);
      ours.push_back(cpu_seconds() - start);
      simplices = traced.num_simplices();
      evaluations = traced.evaluations;
      vertices = traced.num_vertices();
    }
  }
  std::optional<whitney::TraceResult> traced_there;
  std::optional<whitney::CellComplex> complex_there;
  auto trace_it = [&] { traced_there = whitney::trace(f, triangulation, seed_span); };
  auto complex_it = [&] { complex_there = whitney::cell_complex(*traced_there); };
  auto trace_and_complex = [&] {
    trace_it();
    complex_it();
    traced_there.reset();
  };
  const double growth = peak_growth([] {}, trace_it);
  std::printf("%-18s %8zu %9.4f %7.3f %9zu %9zu %6.0f", c.title, simplices, median(ours),
              median(ours) / double(simplices) * 1e6, evaluations, vertices, growth / double(simplices));
  if (!theirs.empty())
    std::printf(" %9.2f %11zu %7.0fx  %s", median(theirs), peer_evaluations, median(theirs) / median(ours),
                peer_simplices == simplices ? "same count" : "COUNTS DIFFER");
  std::printf("\n");
  std::fflush(stdout);

  const whitney::TraceResult traced = whitney::trace(f, triangulation, seed_span);
  double start = cpu_seconds();
  const whitney::CellComplex complex = whitney::cell_complex(traced);
  const double complex_seconds = cpu_seconds() - start;
  std::size_t cells = 0;
  for (int j = 0; j <= c.n; ++j) cells += complex.num_cells(j);
  const double complex_growth = peak_growth(trace_it, complex_it);
  start = cpu_seconds();
  const std::size_t pulled = whitney::pulled_subdivision(complex).num_simplices();
  const double pulled_seconds = cpu_seconds() - start;
  const double pulled_growth =
      peak_growth(trace_and_complex, [&] { (void)whitney::pulled_subdivision(*complex_there); });
  start = cpu_seconds();
  const std::size_t barycentric = whitney::barycentric_subdivision(complex).num_simplices();
  const double barycentric_seconds = cpu_seconds() - start;
  const double barycentric_growth =
      peak_growth(trace_and_complex, [&] { (void)whitney::barycentric_subdivision(*complex_there); });
  std::printf(
      "    cells %zu: Hasse diagram %.3f us, %.0f bytes a cell; pulled %.3f us, %.0f bytes a simplex (%zu);"
      " barycentric %.3f us, %.0f bytes a simplex (%zu)\n",
      cells, complex_seconds / double(cells) * 1e6, complex_growth / double(cells),
      pulled_seconds / double(pulled) * 1e6, pulled_growth / double(pulled), pulled,
      barycentric_seconds / double(barycentric) * 1e6, barycentric_growth / double(barycentric), barycentric);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  int runs = 5, peer_runs = 3;
  std::vector<std::string> wanted;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--runs" && i + 1 < argc)
      runs = std::atoi(argv[++i]);
    else if (word == "--peer-runs" && i + 1 < argc)
      peer_runs = std::atoi(argv[++i]);
    else
      wanted.push_back(word);
  }
  std::printf("%-18s %8s %9s %7s %9s %9s %6s %9s %11s %8s\n", "case", "simplices", "seconds", "us/s.", "f evals",
              "vertices", "B/s.", "peer s", "peer evals", "ratio");
  for (const Case& c : kCases) {
    const bool fine = std::string(c.name) == "t2r10fine";
    const bool chosen = wanted.empty() ? !fine : std::find(wanted.begin(), wanted.end(), c.name) != wanted.end();
    if (chosen) run(c, runs, fine ? 0 : peer_runs);
  }
}
