// SPDX-License-Identifier: GPL-3.0-or-later
// The tracer against GUDHI's, an independent implementation: the same simplices in general position.
#include <gtest/gtest.h>

#if __has_include(<gudhi/Coxeter_triangulation.h>)

#include "trace_cases.h"

#include <coxeter/base/eigen_view.h>
#include <gudhi/Coxeter_triangulation.h>
#include <gudhi/Implicit_manifold_intersection_oracle.h>
#include <gudhi/Manifold_tracing.h>
#include <whitney/tracing/trace.h>

#include <set>
#include <utility>
#include <vector>

namespace whitney {
namespace {

namespace peer = Gudhi::coxeter_triangulation;
using PeerSimplex = peer::Permutahedral_representation<std::vector<int>, std::vector<std::vector<std::size_t>>>;
using PeerTriangulation = peer::Freudenthal_triangulation<PeerSimplex>;
/// Base vertex, then the part of each coordinate.
using Key = std::pair<std::vector<int>, std::vector<int>>;

struct PeerFunction {
  Function f;
  std::vector<double> point;
  Eigen::VectorXd operator()(const Eigen::VectorXd& x) const {
    Eigen::VectorXd value(f.codim());
    f.evaluate({x.data(), std::size_t(x.size())}, {value.data(), std::size_t(value.size())});
    return value;
  }
  std::size_t amb_d() const { return f.ambient_dim(); }
  std::size_t cod_d() const { return f.codim(); }
  Eigen::VectorXd seed() const { return Eigen::Map<const Eigen::VectorXd>(point.data(), point.size()); }
};

template <class Map>
std::set<Key> keys_of(const Map& map, int d) {
  std::set<Key> keys;
  for (const auto& [simplex, point] : map) {
    Key key{simplex.vertex(), std::vector<int>(d)};
    for (std::size_t p = 0; p < simplex.partition().size(); ++p)
      for (std::size_t c : simplex.partition()[p])
        if (int(c) < d) key.second[c] = int(p);
    keys.insert(key);
  }
  return keys;
}

std::set<Key> interior_of(const TraceResult& traced) {
  const int d = traced.ambient_dim();
  std::set<Key> keys;
  for (std::size_t i = 0; i < traced.num_simplices(); ++i) {
    const std::int32_t* z = traced.vertex_coordinates().data() + std::size_t{traced.base(i)} * d;
    Key key{std::vector<int>(z, z + d), std::vector<int>(d)};
    for (int c = 0; c < d; ++c) key.second[c] = traced.part(i, c);
    keys.insert(key);
  }
  return keys;
}

void expect_same_simplices(const Function& f, const std::vector<double>& seed, double edge_length) {
  const int d = f.ambient_dim();
  const auto ours = coxeter::coxeter_a(d, edge_length);
  PeerTriangulation theirs(d);
  theirs.change_matrix(as_eigen(ours.linear()));
  const PeerFunction function{f, seed};
  peer::Manifold_tracing<PeerTriangulation>::Out_simplex_map map;
  peer::manifold_tracing_algorithm(std::vector<Eigen::VectorXd>{function.seed()}, theirs, peer::make_oracle(function),
                                   map);
  const std::set<Key> expected = keys_of(map, d);
  ASSERT_GT(expected.size(), 0u) << "the peer found nothing from this seed";
  EXPECT_EQ(interior_of(trace(f, ours, seed)), expected);
}

TEST(Gudhi, FindsTheSameSimplices) {
  for (const auto& [manifold, edge] : {std::pair{sphere(1, 2), 0.2},
                                       {sphere(2, 3), 0.2},
                                       {sphere(1, 4), 0.2},
                                       {flat_torus(4), 0.3},
                                       {sphere(3, 5), 0.7},
                                       {flat_torus(7), 0.6},
                                       {torus_of_revolution(), 0.3}}) {
    const auto c = testing::rotated_and_shifted({"", manifold.function, manifold.point, edge, 0, 1, {}});
    SCOPED_TRACE(c.function.ambient_dim());
    expect_same_simplices(c.function, c.seeds, edge);
  }
}

/// The peer's domain is where its function is negative.
void expect_same_boundary(const Function& f, const Function& g, const std::vector<double>& seed, double edge_length) {
  const int d = f.ambient_dim();
  const auto ours = coxeter::coxeter_a(d, edge_length);
  PeerTriangulation theirs(d);
  theirs.change_matrix(as_eigen(ours.linear()));
  const PeerFunction function{f, seed};
  const PeerFunction domain{make_function(d, 1,
                                          [&](auto x, auto v) {
                                            g.evaluate(x, v);
                                            v[0] = -v[0];
                                          }),
                            seed};
  peer::Manifold_tracing<PeerTriangulation>::Out_simplex_map interior, boundary;
  peer::manifold_tracing_algorithm(std::vector<Eigen::VectorXd>{function.seed()}, theirs,
                                   peer::make_oracle(function, domain), interior, boundary);
  TraceOptions options;
  options.inequalities = g;
  const TraceResult traced = trace(f, ours, seed, options);
  ASSERT_GT(interior.size(), 0u) << "the peer found nothing from this seed";
  EXPECT_EQ(interior_of(traced), keys_of(interior, d));
  ASSERT_EQ(traced.boundary.size(), 1u);
  std::set<Key> found;
  for (std::size_t i = 0; i < traced.boundary[0].size(); ++i) {
    const std::int32_t* z = traced.vertex_coordinates().data() + std::size_t{traced.boundary[0].base[i]} * d;
    const std::uint16_t* parts = &traced.boundary[0].parts[i * d];
    found.insert({std::vector<int>(z, z + d), std::vector<int>(parts, parts + d)});
  }
  EXPECT_EQ(found, keys_of(boundary, d));
}

TEST(Gudhi, FindsTheSameBoundary) {
  for (const auto& [manifold, edge] : {std::pair{sphere(1, 2), 0.2},
                                       {sphere(2, 3), 0.2},
                                       {sphere(1, 4), 0.2},
                                       {flat_torus(4), 0.3},
                                       {sphere(3, 4), 0.5},
                                       {torus_of_revolution(), 0.3}}) {
    const auto c = testing::rotated_and_shifted({"", manifold.function, manifold.point, edge, 0, 1, {}});
    const int d = c.function.ambient_dim();
    SCOPED_TRACE(d);
    // A ball around the seed.
    const std::vector<double> seed(c.seeds.begin(), c.seeds.begin() + d);
    const Function ball = make_function(d, 1, [=](auto x, auto v) {
      v[0] = 1.71;
      for (int i = 0; i < d; ++i) v[0] -= (x[i] - seed[i]) * (x[i] - seed[i]);
    });
    expect_same_boundary(c.function, ball, seed, edge);
  }
}

}  // namespace
}  // namespace whitney

#else
TEST(Gudhi, FindsTheSameSimplices) { GTEST_SKIP() << "libgudhi-dev is not installed"; }
#endif
