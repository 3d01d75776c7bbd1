// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/hit_walk.h>

#include <algorithm>

#include <coxeter/base/run_watch.h>

namespace whitney::perturbation {
namespace {

/// The limits are looked at once in so many simplices.
constexpr std::size_t kAskEvery = 32;

}  // namespace

void canonical_order(const PerturbedTriangulation& near, std::vector<std::uint32_t>& simplices) {
  const int d = near.ambient_dim();
  std::sort(simplices.begin(), simplices.end(), [&](std::uint32_t s, std::uint32_t t) {
    if (s == t) return false;
    if (const std::uint32_t a = near.base(s), b = near.base(t); a != b) {
      const auto za = near.lattice_vertex(a), zb = near.lattice_vertex(b);
      return std::lexicographical_compare(za.begin(), za.end(), zb.begin(), zb.end());
    }
    for (int c = 0; c < d; ++c)
      if (const int a = near.part(s, c), b = near.part(t, c); a != b) return a < b;
    return false;
  });
}

HitWalk walk_hit_facets(PerturbedTriangulation& near, std::span<const std::uint32_t> starts,
                        const HitWalkOptions& options) {
  const int d = near.ambient_dim();
  HitWalk trace;
  trace.region = options.region;
  std::vector<char> seen;
  const auto reach = [&](std::uint32_t s) {
    if (seen.size() <= s) seen.resize(std::max<std::size_t>(near.num_simplices(), s + 1), 0);
    if (seen[s]) return;
    seen[s] = 1;
    trace.simplices.push_back(s);
  };
  for (const std::uint32_t s : starts) reach(s);
  RunWatch watch(options.run, "walk");
  for (std::size_t next = 0; next < trace.simplices.size(); ++next) {
    if (next >= options.run.max_simplices) watch.stop(StopReason::kMaxSimplices);
    if (next % kAskEvery == kAskEvery - 1) watch.stopped_now(next, near.oracle_calls());
    if (watch.reason() != StopReason::kNone) break;
    const std::uint32_t s = trace.simplices[next];
    const std::uint32_t hit = near.evaluate(s, options.enough, options.with_midpoints).hit_facets;
    for (int q = 0; q <= d; ++q)
      if (hit >> q & 1)
        if (const std::uint32_t other = near.neighbour(s, q); !options.region || options.region(near, other))
          reach(other);
  }
  trace.stop_reason = watch.reason();
  trace.complete = trace.stop_reason == StopReason::kNone;
  if (!trace.complete) trace.simplices.resize(std::min(trace.simplices.size(), options.run.max_simplices));
  canonical_order(near, trace.simplices);
  return trace;
}

std::uint32_t find_start(PerturbedTriangulation& near, std::span<const double> x, std::size_t max_simplices) {
  std::vector<std::uint32_t> queue{near.locate(x)};
  std::vector<char> seen;
  bool found = false;
  std::size_t next = 0;
  for (; next < queue.size() && next < max_simplices; ++next) {
    const std::uint32_t s = queue[next];
    found = near.evaluate(s, 1).is_hit();
    if (found) break;
    for (int q = 0; q <= near.ambient_dim(); ++q) {
      const std::uint32_t other = near.neighbour(s, q);
      if (seen.size() <= other) seen.resize(near.num_simplices() + 1, 0);
      if (seen[other]) continue;
      seen[other] = 1;
      queue.push_back(other);
    }
  }
  // A trace that follows is not to see what this search happened to try.
  near.forget();
  return found ? queue[next] : queue.front();
}

}  // namespace whitney::perturbation
