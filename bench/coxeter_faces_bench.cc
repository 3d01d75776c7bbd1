// SPDX-License-Identifier: GPL-3.0-or-later
//
// Faces, cofaces, facets and cofacets of random simplices: Tables 1 to 6 of the SoCG 2021 paper, beside GUDHI where it
// is installed. Both libraries enumerate the same simplices of the same run by turns, and hand a complete simplex
// (base vertex and sorted partition) to a consumer that sums one coordinate of the base vertex. In the rows marked
// "copy" the consumer first assigns every simplex to a variable of its own, whose memory both libraries reuse. Counts
// and sums must agree.
//
// Usage: coxeter_faces_bench [seconds per row and library, default 0.15] [only this d]
#include <coxeter/counts.h>
#include <coxeter/faces/cofaces.h>
#include <coxeter/faces/faces.h>

#if __has_include(<gudhi/Coxeter_triangulation.h>)
#define WHITNEY_HAS_GUDHI 1
#include <gudhi/Coxeter_triangulation.h>
#endif

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace {

using whitney::coxeter::LatticeVertex;
using whitney::coxeter::OrderedPartition;
using whitney::coxeter::Simplex;

/// Processor time of this process: other work on the machine counts less.
double now() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
}

/// A random l-simplex: a random d-simplex, a random set of l + 1 of its vertices.
Simplex random_simplex(int d, int l, std::mt19937& gen) {
  std::vector<int> order(static_cast<std::size_t>(d));
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), gen);
  std::vector<int> chosen(static_cast<std::size_t>(d) + 1);
  std::iota(chosen.begin(), chosen.end(), 0);
  std::shuffle(chosen.begin(), chosen.end(), gen);
  chosen.resize(static_cast<std::size_t>(l) + 1);
  std::ranges::sort(chosen);
  LatticeVertex v(d);
  for (int c = 0; c < d; ++c) v[c] = static_cast<std::int32_t>(gen() % 2001) - 1000;
  std::vector<LatticeVertex> vertices;
  for (int q = 0, next = 0; q <= l; ++q) {
    for (; next < chosen[static_cast<std::size_t>(q)]; ++next) ++v[order[static_cast<std::size_t>(next)]];
    vertices.push_back(v);
  }
  return Simplex::from_vertices(vertices);
}

struct Result {
  std::int64_t count = 0;
  std::int64_t sum = 0;  // of one coordinate of the base vertices
  friend bool operator==(const Result&, const Result&) = default;
};

template <bool kCopy>
Result enumerate_ours(const Simplex& simplex, int to) {
  Result result;
  static Simplex copy;
  auto consume = [&](const Simplex& s) {
    ++result.count;
    if constexpr (kCopy) {
      copy = s;
      result.sum += copy.base()[0];
    } else {
      result.sum += s.base()[0];
    }
  };
  if (to <= simplex.dim())
    for_each_face(simplex, to, consume);
  else
    for_each_coface(simplex, to, consume);
  return result;
}

#ifdef WHITNEY_HAS_GUDHI
using Peer =
    Gudhi::coxeter_triangulation::Permutahedral_representation<std::vector<int>, std::vector<std::vector<std::size_t>>>;

Peer to_peer(const Simplex& simplex) {
  Peer peer;
  peer.vertex().assign(simplex.base().begin(), simplex.base().end());
  for (int q = 0; q <= simplex.dim(); ++q) {
    const auto part = simplex.partition().part(q);
    peer.partition().emplace_back(part.begin(), part.end());
  }
  return peer;
}

template <bool kCopy>
Result enumerate_peer(const Peer& simplex, int to) {
  Result result;
  static Peer copy;
  auto consume = [&](const Peer& s) {
    ++result.count;
    if constexpr (kCopy) {
      copy = s;
      result.sum += copy.vertex()[0];
    } else {
      result.sum += s.vertex()[0];
    }
  };
  const auto dim = static_cast<std::size_t>(to);
  if (dim <= simplex.dimension())
    for (const Peer& s : simplex.face_range(dim)) consume(s);
  else
    for (const Peer& s : simplex.coface_range(dim)) consume(s);
  return result;
}
#endif

/// Nanoseconds per simplex produced of one pass over the first simplices of a list: as many as fill the time, at least
/// one. `done` is how many that were.
template <class Enumerate>
double pass(Enumerate enumerate, std::size_t num, double seconds, std::size_t& done, std::vector<Result>& results) {
  const double start = now();
  double elapsed = 0;
  std::int64_t count = 0;
  for (done = 0; done < num && (done == 0 || elapsed < seconds); ++done) {
    const Result r = enumerate(done);
    if (results.size() == done) results.push_back(r);
    count += r.count;
    elapsed = now() - start;
  }
  return elapsed / static_cast<double>(count) * 1e9;
}

struct Row {
  const char* name;
  int d, from, to;
};

bool g_agree = true;
int g_only_d = 0;

template <bool kCopy>
void run(const Row& row, double seconds) {
  constexpr int kRounds = 5;
  std::mt19937 gen(1);
  std::vector<Simplex> simplices;
  for (int i = 0; i < 50; ++i) simplices.push_back(random_simplex(row.d, row.from, gen));
  const double share = seconds / kRounds;
  std::vector<Result> ours, theirs;
  std::vector<double> our_ns, their_ns;
  std::size_t done = 0;
  volatile std::int64_t sink = 0;
#ifdef WHITNEY_HAS_GUDHI
  std::vector<Peer> peers;
  for (const Simplex& s : simplices) peers.push_back(to_peer(s));
#endif
  for (int round = 0; round < kRounds; ++round) {
    std::size_t num = simplices.size();
#ifdef WHITNEY_HAS_GUDHI
    // One pass of the longest tables takes GUDHI seconds: then once is enough.
    if (round == 0 || their_ns.back() * static_cast<double>(theirs[0].count) < 1e9) {
      their_ns.push_back(
          pass([&](std::size_t i) { return enumerate_peer<kCopy>(peers[i], row.to); }, num, share, done, theirs));
      num = done;
    }
#endif
    // The same simplices, repeated so that the clock is read rarely.
    double start = now(), elapsed = 0;
    std::int64_t count = 0;
    do {
      for (std::size_t i = 0; i < num; ++i) {
        const Result r = enumerate_ours<kCopy>(simplices[i], row.to);
        count += r.count;
        sink = sink + r.sum;
        if (ours.size() == i) ours.push_back(r);
      }
      elapsed = now() - start;
    } while (elapsed < share);
    our_ns.push_back(elapsed / static_cast<double>(count) * 1e9);
  }
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const double expected = row.to <= row.from ? whitney::coxeter::num_faces(row.from, row.to)
                                               : whitney::coxeter::num_cofaces(simplices[i], row.to);
    if (static_cast<double>(ours[i].count) != expected || (i < theirs.size() && !(ours[i] == theirs[i]))) {
      std::printf("DISAGREE: simplex %zu\n", i);
      g_agree = false;
    }
  }
  const double mine = median(our_ns);
  std::printf("%-9s %4d %4d %4d  %-5s %10lld %10.1f", row.name, row.d, row.from, row.to, kCopy ? "copy" : "visit",
              static_cast<long long>(ours[0].count), mine);
  if (!their_ns.empty()) std::printf(" %12.1f %9.0fx", median(their_ns), median(their_ns) / mine);
  std::printf("\n");
  std::fflush(stdout);
}

void run(const Row& row, double seconds, bool with_copy) {
  if (g_only_d != 0 && row.d != g_only_d) return;
  run<false>(row, seconds);
  if (with_copy) run<true>(row, seconds);
}

}  // namespace

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 0.15;
  g_only_d = argc > 2 ? std::atoi(argv[2]) : 0;
  std::printf("%-9s %4s %4s %4s  %-5s %10s %10s %12s %10s\n", "what", "d", "from", "to", "work", "first", "ns each",
              "GUDHI ns", "ratio");
  for (int to = 29; to >= 22; --to) run({"faces", 30, 30, to}, seconds, to == 26);    // Table 1
  for (int to = 23; to <= 30; ++to) run({"cofaces", 30, 22, to}, seconds, to == 26);  // Table 2
  for (const int d : {10, 30, 50, 100, 200, 400})                                     // Tables 3 to 6
    for (int codim = 1; codim <= 7; ++codim) {
      run({"facets", d, d - codim, d - codim - 1}, seconds, codim == 3);
      run({"cofacets", d, d - codim, d - codim + 1}, seconds, codim == 3);
    }
  for (const int to : {1, 5, 9}) run({"faces", 10, 10, to}, seconds, to == 5);
  for (const int to : {1, 2}) run({"faces", 30, 30, to}, seconds, false);
  run({"cofaces", 10, 5, 8}, seconds, true);
  run({"cofaces", 6, 0, 6}, seconds, true);
  std::printf(g_agree ? "counts and sums agree\n" : "DISAGREEMENT\n");
  return g_agree ? 0 : 1;
}
