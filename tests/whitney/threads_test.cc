// SPDX-License-Identifier: GPL-3.0-or-later
//
// What promises to be safe from several threads is called from several threads, and gives the bits it gives one. Under
// ThreadSanitizer (.ci/run, the preset tsan) a race is an error.
#include <cmath>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <coxeter/triangulation.h>
#include <whitney/functions/expression.h>
#include <whitney/functions/function.h>
#include <whitney/manifolds/catalogue.h>
#include <whitney/manifolds/implicit_manifold.h>
#include <whitney/manifolds/parametric_manifold.h>
#include <whitney/tracing/trace.h>

namespace whitney {
namespace {

constexpr int kThreads = 4;

/// What `job` returns, from this thread first and then from several at once.
void expect_the_same(const std::function<std::vector<double>()>& job) {
  const std::vector<double> alone = job();
  std::vector<std::vector<double>> results(kThreads);
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) threads.emplace_back([&, t] { results[t] = job(); });
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<double>& result : results) EXPECT_EQ(result, alone);
}

std::vector<double> scattered(int dim, int count) {
  std::vector<double> points;
  for (int i = 0; i < dim * count; ++i) points.push_back(1.1 * std::sin(1.7 * i + 0.3));
  return points;
}

Function torus() {
  const std::vector<std::string> variables{"x", "y", "z"};
  return parse_equations(variables, std::vector<std::string>{"(x^2+y^2+z^2+3)^2-16*(x^2+y^2)"});
}

TEST(Threads, AFunctionIsEvaluatedByAll) {
  const Function f = torus();
  const std::vector<double> points = scattered(3, 200);
  expect_the_same([&] {
    std::vector<double> values(200), jacobian(3);
    f.evaluate(points, values);
    for (int i = 0; i < 200; ++i) {
      f.jacobian({&points[3 * i], 3}, jacobian);
      values.insert(values.end(), jacobian.begin(), jacobian.end());
    }
    return values;
  });
}

TEST(Threads, ExpressionsAreCompiledByAll) {
  expect_the_same([] {
    std::vector<double> values(20);
    torus().evaluate(scattered(3, 20), values);
    values.push_back(parse_constant("sin(1)^2 + 2*pi"));
    return values;
  });
}

std::vector<double> feet(const Submanifold& M, int count) {
  const int d = M.ambient_dim();
  const std::vector<double> points = scattered(d, count);
  std::vector<double> all, point(d), frame(d * d);
  for (int i = 0; i < count; ++i) {
    FootErrors errors;
    const bool found = M.project({&points[d * i], std::size_t(d)}, point, frame, errors);
    all.push_back(found);
    if (found) all.insert(all.end(), point.begin(), point.end());
    if (found) all.insert(all.end(), frame.begin(), frame.end());
  }
  return all;
}

TEST(Threads, FeetAreFoundByAll) {
  for (const Submanifold& M : {named_submanifold("flat_torus"), named_submanifold("so3_matrices"),
                               named_submanifold("klein_bottle"), implicit_manifold(torus(), {3, 0, 0})})
    expect_the_same([&] { return feet(M, 10); });
}

// Its bending is measured when first asked for: here, by all at once.
TEST(Threads, AnEstimateIsMadeOnce) {
  const auto ellipse = [](std::span<const double> u, std::span<double> x) {
    x[0] = 2 * std::cos(u[0]);
    x[1] = std::sin(u[0]);
  };
  const auto fresh = [&] { return parametric_manifold(2, {{0, 6.283185307179586}}, ellipse); };
  const double alone = fresh().bending()->reach;
  const Submanifold M = fresh();
  std::vector<double> reach(kThreads);
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) threads.emplace_back([&, t] { reach[t] = M.bending()->reach; });
  for (std::thread& thread : threads) thread.join();
  for (const double r : reach) EXPECT_EQ(r, alone);
}

TEST(Threads, TracesDoNotDisturbEachOther) {
  const Function f = torus();
  expect_the_same([&] {
    const TraceResult traced = trace(f, coxeter::coxeter_a(3, 0.4), std::vector{3.0, 0.0, 0.0});
    return std::vector<double>(traced.points().begin(), traced.points().end());
  });
}

}  // namespace
}  // namespace whitney
