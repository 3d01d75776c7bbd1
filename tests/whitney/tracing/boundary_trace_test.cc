// SPDX-License-Identifier: GPL-3.0-or-later
// Manifolds with boundary and corners: boundary_trace.h, strata.h, cut_regularity.h and cell_complex.h together.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include <coxeter/base/eigen_view.h>
#include <coxeter/base/error.h>
#include <coxeter/faces/faces.h>
#include <coxeter/placement.h>
#include <whitney/cells/cell_complex.h>
#include <whitney/cells/strata.h>
#include <whitney/cells/subdivide.h>
#include <whitney/functions/find_seeds.h>
#include <whitney/functions/zero_sets.h>
#include <whitney/io/read_problem.h>
#include <whitney/topology/topology.h>
#include <whitney/tracing/cut_regularity.h>
#include <whitney/tracing/exact_pivot.h>
#include <whitney/tracing/trace.h>

namespace whitney {
namespace {

using coxeter::Simplex;
using Values = std::span<double>;
using Point = std::span<const double>;

Function sphere_function(int d, double radius) {
  return make_function(d, 1, [=](Point x, Values v) {
    v[0] = -radius * radius;
    for (double c : x) v[0] += c * c;
  });
}

Function torus_function() {
  return make_function(4, 2, [](Point x, Values v) {
    v[0] = x[0] * x[0] + x[1] * x[1] - 1;
    v[1] = x[2] * x[2] + x[3] * x[3] - 1;
  });
}

Function torus_cut(double squared_radius) {
  return make_function(4, 1, [=](Point x, Values v) {
    v[0] = squared_radius - (x[0] - 1) * (x[0] - 1) - x[1] * x[1] - (x[2] - 1) * (x[2] - 1) - x[3] * x[3];
  });
}

/// x_0 >= 0, .., x_{m-1} >= 0.
Function coordinates(int d, int m) {
  return make_function(d, m, [=](Point x, Values v) { std::copy_n(x.begin(), m, v.begin()); });
}

/// The unit Freudenthal triangulation: lattice vertices are the integer points.
coxeter::Triangulation integer_lattice(int d) { return coxeter::freudenthal(d, std::sqrt(double(d))); }

std::map<int, int> count_by_dim(const Strata& strata) {
  std::map<int, int> count;
  for (const Stratum& stratum : strata.strata) ++count[stratum.dim];
  return count;
}

std::string bytes_of(const TraceResult& traced) {
  std::string bytes;
  auto append = [&](const auto& list) {
    bytes.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(list[0]));
  };
  append(traced.vertex_coordinates());
  append(traced.points());
  append(traced.parts<std::uint8_t>());
  for (const BoundarySimplices& stratum : traced.boundary) {
    append(stratum.inequalities);
    append(stratum.base);
    append(stratum.parts);
    append(stratum.points);
  }
  return bytes;
}

/// The double: two copies glued along the boundary.
SimplicialMesh doubled(const CellComplex& complex) {
  // In the barycentric subdivision a simplex is determined by its vertices even after gluing, and no simplex of the
  // interior has all its vertices on the boundary.
  const Strata strata = strata_of(complex);
  SimplicialMesh mesh = barycentric_subdivision(complex, &strata);
  const auto& labels = mesh.point_data.back().values;
  const std::uint32_t count = static_cast<std::uint32_t>(mesh.num_points());
  std::vector<std::uint32_t> copy(count);
  for (std::uint32_t v = 0; v < count; ++v) {
    copy[v] = v;
    if (strata.strata[static_cast<std::size_t>(labels[v])].dim < mesh.dim) continue;
    copy[v] = static_cast<std::uint32_t>(mesh.num_points());
    for (int c = 0; c < mesh.ambient_dim; ++c)
      mesh.points.push_back(mesh.points[std::size_t{v} * mesh.ambient_dim + c]);
  }
  mesh.point_data.clear();
  mesh.cell_data.clear();
  mesh.strata.clear();
  const std::vector<std::uint32_t> first = mesh.simplices;
  for (std::uint32_t v : first) mesh.simplices.push_back(copy[v]);
  return mesh;
}

/// What must hold for every manifold with boundary: manifold links, both subdivisions agree, the double is closed with
/// chi = 2 chi - chi(boundary), and no boundary without inequality.
Topology expect_manifold(const CellComplex& complex) {
  const Topology of_cells = topology_of(complex.facets);
  TopologyOptions links_only;
  links_only.homology = false;
  for (const SimplicialMesh& mesh : {pulled_subdivision(complex), barycentric_subdivision(complex)}) {
    const Topology t = topology_of(mesh, links_only);
    EXPECT_TRUE(t.is_manifold()) << (t.witness ? t.witness->reason : "");
    EXPECT_EQ(t.euler_characteristic, of_cells.euler_characteristic);
    EXPECT_EQ(t.components, of_cells.components);
    EXPECT_EQ(t.boundary_components, of_cells.boundary_components);
  }
  const Topology twice = topology_of(doubled(complex), links_only);
  EXPECT_TRUE(twice.is_closed_manifold()) << (twice.witness ? twice.witness->reason : "");
  std::int64_t boundary = 0;
  for (int j = 0; j <= complex.intrinsic_dim; ++j)
    boundary += (j % 2 ? -1 : 1) * std::int64_t(complex.num_cells(j) - complex.set_begin[j][1]);
  EXPECT_EQ(twice.euler_characteristic, 2 * of_cells.euler_characteristic - boundary);
  return of_cells;
}

struct Cut {
  TraceResult traced;
  CellComplex complex;
  Strata strata;
  Topology topology;
};

Cut cut(const Function& f, std::optional<Function> g, const coxeter::Triangulation& triangulation,
        const std::vector<double>& seeds, std::optional<Box> box = {}) {
  TraceOptions options;
  options.inequalities = std::move(g);
  options.box = std::move(box);
  Cut out{trace(f, triangulation, seeds, options), {}, {}, {}};
  EXPECT_GT(out.traced.num_points(), 0u) << out.traced.seeds[0].reason;
  EXPECT_EQ(out.traced.evaluations, out.traced.num_vertices());
  out.complex = cell_complex(out.traced);
  EXPECT_EQ(out.complex.num_dropped, 0u);
  out.strata = strata_of(out.complex);
  out.topology = expect_manifold(out.complex);
  return out;
}

TEST(Boundary, OctantOfTheSphereHasOneFaceThreeArcsThreeCorners) {
  const std::map<int, int> expected{{2, 1}, {1, 3}, {0, 3}};
  // Coarse: few or no vertices in the interior. Integer radius in the integer lattice: corners at lattice vertices.
  struct Position {
    double radius;
    coxeter::Triangulation triangulation;
  };
  for (const auto& [radius, triangulation] :
       {Position{1, coxeter::coxeter_a(3, 0.1)}, Position{1, coxeter::coxeter_a(3, 0.5)},
        Position{1, coxeter::coxeter_a(3, 1.3)}, Position{1, coxeter::freudenthal(3, 0.1)},
        Position{2, integer_lattice(3)}, Position{3, integer_lattice(3)}, Position{7, integer_lattice(3)}}) {
    SCOPED_TRACE(radius);
    const double c = radius / std::sqrt(3.0);
    const Cut octant = cut(sphere_function(3, radius), coordinates(3, 3), triangulation, {c, c, c});
    EXPECT_EQ(count_by_dim(octant.strata), expected);
    EXPECT_EQ(octant.topology.euler_characteristic, 1);
    EXPECT_EQ(octant.topology.boundary_components, 1u);
    EXPECT_EQ(octant.strata.boundary_components, 1u);
    EXPECT_EQ(octant.strata.cut_components, 0u);
    // The graph: the face has all arcs; each arc two corners, each corner two arcs.
    EXPECT_EQ(octant.strata.strata[0].faces, (std::vector<std::uint32_t>{1, 2, 3}));
    std::map<std::uint32_t, int> arcs_at;
    for (int arc : {1, 2, 3}) {
      EXPECT_EQ(octant.strata.strata[arc].faces.size(), 2u);
      for (std::uint32_t corner : octant.strata.strata[arc].faces) ++arcs_at[corner];
    }
    EXPECT_EQ(arcs_at, (std::map<std::uint32_t, int>{{4, 2}, {5, 2}, {6, 2}}));
    // Each stratum as a mesh: a disc, three arcs, three points.
    for (const SimplicialMesh& mesh :
         {pulled_subdivision(octant.complex, &octant.strata), barycentric_subdivision(octant.complex, &octant.strata)})
      for (int s = 0; s < 7; ++s) {
        const SimplicialMesh piece = stratum_mesh(mesh, s);
        EXPECT_EQ(piece.dim, s == 0 ? 2 : s < 4 ? 1 : 0);
        EXPECT_EQ(topology_of(piece).euler_characteristic, 1);
        EXPECT_EQ(topology_of(piece).components, 1u);
      }
    // Points lie where their inequalities vanish, within the error of the interpolation.
    for (const BoundarySimplices& stratum : octant.traced.boundary)
      for (std::size_t i = 0; i < stratum.size(); ++i)
        for (int j : stratum.inequalities) EXPECT_NEAR(stratum.points[3 * i + j], 0, 1e-12);
  }
}

TEST(Boundary, OrthantOfTheThreeSphere) {
  // A curved tetrahedron: its strata are those of a simplex.
  for (const auto& triangulation : {coxeter::coxeter_a(4, 0.4), coxeter::freudenthal(4, 0.5)}) {
    const Cut orthant = cut(sphere_function(4, 1), coordinates(4, 4), triangulation, {.5, .5, .5, .5});
    EXPECT_EQ(count_by_dim(orthant.strata), (std::map<int, int>{{3, 1}, {2, 4}, {1, 6}, {0, 4}}));
    EXPECT_EQ(orthant.topology.euler_characteristic, 1);
    EXPECT_EQ(to_string((*orthant.topology.homology_z)[1]), "0");
  }
}

TEST(Boundary, CurvesWithEnds) {
  const Cut arc = cut(sphere_function(2, 1), coordinates(2, 1), coxeter::coxeter_a(2, 0.1), {1, 0});
  EXPECT_EQ(count_by_dim(arc.strata), (std::map<int, int>{{1, 1}, {0, 2}}));
  EXPECT_EQ(arc.topology.euler_characteristic, 1);
  EXPECT_EQ(arc.strata.boundary_components, 2u);
  // In R^4: the quarter x_0, x_2 >= 0 of a circle.
  const Function circle = make_function(4, 3, [](Point x, Values v) {
    v[0] = x[0] * x[0] + x[2] * x[2] - 1;
    v[1] = x[1];
    v[2] = x[3];
  });
  const Function both = make_function(4, 2, [](Point x, Values v) { v[0] = x[0], v[1] = x[2]; });
  const Cut quarter = cut(circle, both, coxeter::freudenthal(4, 0.4), {1, 0, 0, 0});
  EXPECT_EQ(count_by_dim(quarter.strata), (std::map<int, int>{{1, 1}, {0, 2}}));
}

TEST(Boundary, CutTorus) {
  for (double edge_length : {0.2, 0.3}) {
    const Cut disc = cut(torus_function(), torus_cut(3), coxeter::coxeter_a(4, edge_length), {1, 0, 1, 0});
    EXPECT_EQ(disc.topology.euler_characteristic, 1);
    EXPECT_EQ(disc.topology.boundary_components, 1u);
    // Beyond the singular value 4 what is cut away is a disc.
    const Cut rest = cut(torus_function(), torus_cut(5), coxeter::coxeter_a(4, edge_length), {1, 0, 1, 0});
    EXPECT_EQ(rest.topology.euler_characteristic, -1);
    EXPECT_EQ(rest.topology.boundary_components, 1u);
    EXPECT_EQ(to_string((*rest.topology.homology_z)[1]), "Z^2");
  }
}

TEST(Boundary, SingularCutsAreFoundAndOthersAreNot) {
  for (double c : {3.0, 3.9, 3.99, 4.0, 4.01, 5.0}) {
    TraceOptions options;
    options.inequalities = torus_cut(c);
    const double edge_length = 0.3;
    const auto traced =
        trace(torus_function(), coxeter::coxeter_a(4, edge_length), std::vector<double>{1, 0, 1, 0}, options);
    const CutRegularity regularity = check_cuts(torus_function(), traced, edge_length);
    EXPECT_EQ(regularity.singular.size(), c == 4 ? 2u : 0u) << c;
    // cos a + cos b = 0 crosses itself at (0, pi) and (pi, 0).
    for (const SingularCut& singular : regularity.singular) {
      EXPECT_NEAR(std::abs(singular.point[0]), 1, 1e-6);
      EXPECT_NEAR(singular.point[0] + singular.point[2], 0, 1e-6);
      EXPECT_LT(singular.singular_value, 1e-6);
    }
    EXPECT_LE(regularity.smallest_singular_value, 1);
    if (c == 3) {
      EXPECT_GT(regularity.smallest_singular_value, 0.3);
    }
  }
  // Two inequalities that are tangent to each other on the sphere: z >= 0 and the plane through the same circle.
  TraceOptions options;
  options.inequalities = make_function(3, 2, [](Point x, Values v) { v[0] = x[2], v[1] = x[2] + x[0] * x[0] - 1; });
  const auto traced =
      trace(sphere_function(3, 1), coxeter::coxeter_a(3, 0.1), std::vector<double>{0.6, 0, 0.8}, options);
  EXPECT_FALSE(check_cuts(sphere_function(3, 1), traced, 0.1).singular.empty());
}

TEST(Boundary, ADomainThatMeetsNothing) {
  const auto triangulation = coxeter::coxeter_a(3, 0.2);
  const std::vector<double> seed{1, 0, 0};
  TraceOptions everywhere, nowhere;
  everywhere.inequalities = make_function(3, 1, [](Point x, Values v) { v[0] = 3 - x[2]; });
  nowhere.inequalities = make_function(3, 1, [](Point x, Values v) { v[0] = x[2] - 3; });
  EXPECT_EQ(bytes_of(trace(sphere_function(3, 1), triangulation, seed, everywhere)),
            bytes_of(trace(sphere_function(3, 1), triangulation, seed)));
  const TraceResult none = trace(sphere_function(3, 1), triangulation, seed, nowhere);
  EXPECT_EQ(none.num_points(), 0u);
  EXPECT_EQ(none.seeds[0].outcome, SeedReport::Outcome::kDropped);
  EXPECT_NE(none.seeds[0].reason.find("inside the domain"), std::string::npos) << none.seeds[0].reason;
  // Touching from inside, at a lattice vertex on the sphere: the closed domain holds all of it.
  TraceOptions touching;
  touching.inequalities = make_function(3, 1, [](Point x, Values v) { v[0] = 3 - x[2]; });
  const Topology t = topology_of(pulled_subdivision(
      cell_complex(trace(sphere_function(3, 3), integer_lattice(3), std::vector<double>{3, 0, 0}, touching))));
  EXPECT_TRUE(t.is_closed_manifold());
  EXPECT_EQ(t.euler_characteristic, 2);
}

TEST(Boundary, SeveralInequalitiesThroughTheSameLatticeVertex) {
  // Five planes through the point (0, 0, 5) of the sphere and the lattice; two of them redundant.
  const Function g = make_function(3, 5, [](Point x, Values v) {
    v[0] = x[0];
    v[1] = x[1];
    v[2] = x[0] + x[1];
    v[3] = 2 * x[0] + x[1];
    v[4] = x[2];
  });
  const Cut octant = cut(sphere_function(3, 5), g, integer_lattice(3), {3, 3, 3});
  EXPECT_EQ(octant.topology.euler_characteristic, 1);
  EXPECT_EQ(octant.strata.boundary_components, 1u);
}

TEST(Boundary, UnitsDoNotMatter) {
  const auto reference = cut(torus_function(), torus_cut(3), coxeter::freudenthal(4, 0.4), {1, 0, 1, 0});
  for (double of_f : {1e-12, 1e12})
    for (double of_g : {1e-12, 1e12}) {
      const Function f = torus_function(), g = torus_cut(3);
      auto times = [](const Function& function, double factor) {
        return make_function(function.ambient_dim(), function.codim(), [=](Point x, Values v) {
          function.evaluate(x, v);
          for (double& value : v) value *= factor;
        });
      };
      const auto scaled = cut(times(f, of_f), times(g, of_g), coxeter::freudenthal(4, 0.4), {1, 0, 1, 0});
      EXPECT_EQ(scaled.topology.f_vector, reference.topology.f_vector);
    }
  for (double unit : {1e-9, 1e9}) {
    const Function f = make_function(4, 2, [=](Point x, Values v) {
      v[0] = x[0] * x[0] + x[1] * x[1] - unit * unit;
      v[1] = x[2] * x[2] + x[3] * x[3] - unit * unit;
    });
    const Function g = make_function(4, 1, [=](Point x, Values v) {
      v[0] =
          3 * unit * unit - (x[0] - unit) * (x[0] - unit) - x[1] * x[1] - (x[2] - unit) * (x[2] - unit) - x[3] * x[3];
    });
    const auto scaled = cut(f, g, coxeter::freudenthal(4, 0.4 * unit), {unit, 0, unit, 0});
    EXPECT_EQ(scaled.topology.euler_characteristic, 1);
  }
}

/// f in the coordinates y = Q^T (x - b) of a random motion.
Function moved(const Function& f, const Eigen::MatrixXd& Q, const Eigen::VectorXd& b) {
  return make_function(f.ambient_dim(), f.codim(), [=](Point x, Values v) {
    const Eigen::VectorXd y = Q.transpose() * (Eigen::Map<const Eigen::VectorXd>(x.data(), b.size()) - b);
    f.evaluate({y.data(), std::size_t(y.size())}, v);
  });
}

TEST(Boundary, MovedCopiesHaveTheSameStrata) {
  struct Setting {
    Function f, g;
    std::vector<double> seed;
    double edge_length;
    std::map<int, int> strata;
  };
  for (const auto& [f, g, seed, edge_length, strata] :
       {Setting{sphere_function(3, 1), coordinates(3, 3), {.6, .6, .6}, 0.2, {{2, 1}, {1, 3}, {0, 3}}},
        Setting{torus_function(), coordinates(4, 4), {.7, .7, .7, .7}, 0.3, {{2, 1}, {1, 4}, {0, 4}}},
        Setting{torus_function(), torus_cut(3), {1, 0, 1, 0}, 0.3, {{2, 1}, {1, 1}}},
        Setting{sphere_function(4, 1), coordinates(4, 2), {.6, .6, .6, .6}, 0.5, {{3, 1}, {2, 2}, {1, 1}}}}) {
    const int d = f.ambient_dim();
    for (int run = 0; run < 4; ++run) {
      const Eigen::MatrixXd Q = as_eigen(coxeter::random_rotation(d, 7 + run));
      Eigen::VectorXd b(d);
      for (int c = 0; c < d; ++c) b[c] = std::cos(1.0 + c + 3 * run);
      const Eigen::VectorXd start = Q * Eigen::Map<const Eigen::VectorXd>(seed.data(), d) + b;
      const Cut copy =
          cut(moved(f, Q, b), moved(g, Q, b), coxeter::coxeter_a(d, edge_length), {start.begin(), start.end()});
      EXPECT_EQ(count_by_dim(copy.strata), strata);
      EXPECT_EQ(copy.topology.euler_characteristic, 1);
      // Variables in another order, and the inequalities too.
      const int m = g.codim();
      const Function reversed = make_function(d, m, [=, g = g](Point x, Values v) {
        std::vector<double> y(x.rbegin(), x.rend());
        g.evaluate(y, v);
        std::reverse(v.begin(), v.end());
      });
      const Function f_reversed = make_function(d, f.codim(), [=, f = f](Point x, Values v) {
        std::vector<double> y(x.rbegin(), x.rend());
        f.evaluate(y, v);
      });
      if (run == 0) {
        EXPECT_EQ(
            count_by_dim(
                cut(f_reversed, reversed, coxeter::freudenthal(d, edge_length), {seed.rbegin(), seed.rend()}).strata),
            strata);
      }
    }
  }
}

TEST(Boundary, ABoxIsASetOfInequalitiesMarkedAsACut) {
  const auto triangulation = coxeter::coxeter_a(3, 0.1);
  const Box box{{-2, -2, -2}, {0.3, 2, 2}};
  const Cut boxed = cut(sphere_function(3, 1), {}, triangulation, {-1, 0, 0}, box);
  const Cut given = cut(sphere_function(3, 1), make_function(3, 1, [](Point x, Values v) { v[0] = 0.3 - x[0]; }),
                        triangulation, {-1, 0, 0});
  EXPECT_EQ(boxed.traced.stop_reason, StopReason::kBox);
  EXPECT_EQ(given.traced.stop_reason, StopReason::kNone);
  EXPECT_EQ(boxed.complex.points, given.complex.points);
  EXPECT_EQ(boxed.strata.boundary_components, 0u);
  EXPECT_EQ(boxed.strata.cut_components, 1u);
  EXPECT_EQ(given.strata.boundary_components, 1u);
  EXPECT_EQ(given.strata.cut_components, 0u);
  for (const BoundarySimplices& stratum : boxed.traced.boundary) {
    EXPECT_TRUE(boxed.traced.domain.is_box_side(stratum.inequalities[0]));
    for (std::size_t i = 0; i < stratum.size(); ++i) EXPECT_NEAR(stratum.points[3 * i], 0.3, 1e-12);
  }

  // The hyperboloid x^2 + y^2 - z^2 = 1, unbounded: a cylinder, cut twice by the box and once by an inequality.
  const Function hyperboloid =
      make_function(3, 1, [](Point x, Values v) { v[0] = x[0] * x[0] + x[1] * x[1] - x[2] * x[2] - 1; });
  const Box cube{{-4, -4, -2}, {4, 4, 2}};
  const Cut tube = cut(hyperboloid, {}, coxeter::coxeter_a(3, 0.3), {1, 0, 0}, cube);
  EXPECT_EQ(tube.topology.euler_characteristic, 0);
  EXPECT_EQ(tube.strata.cut_components, 2u);
  const Cut half = cut(hyperboloid, coordinates(3, 1), coxeter::coxeter_a(3, 0.3), {1, 0, 0}, cube);
  EXPECT_EQ(half.topology.euler_characteristic, 1);
  EXPECT_EQ(half.strata.cut_components, 2u);
  EXPECT_EQ(half.strata.boundary_components, 2u);
  EXPECT_EQ(count_by_dim(half.strata), (std::map<int, int>{{2, 1}, {1, 4}, {0, 4}}));
  // A symmetric position: the cube's faces are lattice planes.
  const Cut exact = cut(make_function(3, 1, [](Point x, Values v) { v[0] = x[0] * x[0] + x[1] * x[1] - 9; }), {},
                        integer_lattice(3), {3, 0, 0}, Box{{-5, -5, -2}, {5, 5, 2}});
  EXPECT_EQ(exact.topology.euler_characteristic, 0);
  EXPECT_EQ(exact.strata.cut_components, 2u);
}

TEST(Boundary, WholeCellsAreLeftOutWhereFHasNoValueOutsideTheBox) {
  const Function f = make_function(2, 1, [](Point x, Values v) { v[0] = x[1] - std::sqrt(x[0]); });
  TraceOptions options;
  options.box = Box{{0, -1}, {1, 2}};
  const TraceResult traced = trace(f, coxeter::coxeter_a(2, 0.1), std::vector<double>{0.5, 0.7}, options);
  EXPECT_EQ(traced.stop_reason, StopReason::kBox);
  EXPECT_FALSE(traced.whole);
  const Topology t = topology_of(pulled_subdivision(cell_complex(traced)));
  EXPECT_TRUE(t.is_manifold());
  EXPECT_EQ(t.euler_characteristic, 1);
  EXPECT_THROW(trace(f, coxeter::coxeter_a(2, 0.1), std::vector<double>{0.5, 0.7}), OracleError);
}

TEST(Boundary, InHighDimensions) {
  // Beyond d = 15 parts are lists (see short_partition.h). A quarter of a circle, a quarter of a sphere.
  for (const auto& [d, n, edge_length] : {std::tuple{17, 1, 0.8}, {17, 2, 1.2}, {33, 1, 1.0}}) {
    auto y = [](Point x, int c) { return x[c] - 0.01 * std::cos(1.0 + c); };
    const Function f = make_function(d, d - n, [=, d = d, n = n](Point x, Values v) {
      v[0] = -1;
      for (int c = 0; c <= n; ++c) v[0] += y(x, c) * y(x, c);
      for (int c = n + 1; c < d; ++c) v[c - n] = y(x, c);
    });
    const Function g = make_function(d, 2, [](Point x, Values v) {
      v[0] = x[0] + 0.1 * x[1];
      v[1] = x[1] - 0.07 * x[0];
    });
    std::vector<double> seed(d, 0.0);
    seed[0] = seed[1] = std::sqrt(0.5);
    const Cut quarter = cut(f, g, coxeter::coxeter_a(d, edge_length), seed);
    EXPECT_EQ(count_by_dim(quarter.strata),
              n == 1 ? (std::map<int, int>{{1, 1}, {0, 2}}) : (std::map<int, int>{{2, 1}, {1, 2}, {0, 2}}));
    EXPECT_EQ(quarter.topology.euler_characteristic, 1);
  }
}

TEST(Boundary, TheResultDoesNotDependOnTheSeed) {
  TraceOptions options;
  options.inequalities = coordinates(4, 4);
  std::set<std::string> results;
  for (const std::vector<double>& seed : std::vector<std::vector<double>>{
           {.8, .6, .6, .8}, {.1, 1, 1, .1}, {0, 1, 0, 1}, {1, 0, 1, 0}, {1, 0, 1, 0, .7, .7, .7, .7}})
    results.insert(bytes_of(trace(torus_function(), coxeter::freudenthal(4, 0.3), seed, options)));
  EXPECT_EQ(results.size(), 1u);
}

TEST(Boundary, LimitsLeaveAPartOfIt) {
  TraceOptions options;
  options.inequalities = coordinates(3, 3);
  for (std::size_t limit : {1, 10, 100, 500, 900}) {
    options.run.max_simplices = limit;
    const TraceResult traced =
        trace(sphere_function(3, 1), coxeter::coxeter_a(3, 0.1), std::vector<double>{.6, .6, .6}, options);
    EXPECT_EQ(traced.stop_reason, StopReason::kMaxSimplices);
    EXPECT_FALSE(traced.whole);
    EXPECT_NO_THROW(topology_of(pulled_subdivision(cell_complex(traced))));
  }
}

TEST(Boundary, BadInputIsNamed) {
  const auto triangulation = coxeter::coxeter_a(3, 0.1);
  const std::vector<double> seed{1, 0, 0};
  TraceOptions options;
  options.inequalities = coordinates(4, 1);
  EXPECT_THROW(trace(sphere_function(3, 1), triangulation, seed, options), InvalidInput);
  options.inequalities = make_function(3, 2, [](Point x, Values v) {
    v[0] = 1;
    v[1] = x[2] > 0.3 ? std::numeric_limits<double>::quiet_NaN() : 1;
  });
  try {
    trace(sphere_function(3, 1), triangulation, seed, options);
    FAIL() << "a NaN must not pass";
  } catch (const OracleError& error) {
    EXPECT_NE(std::string(error.what()).find("inequality 1 is NaN at ("), std::string::npos) << error.what();
  }
}

TEST(Boundary, SeedsOnEveryComponentOfTheDomain) {
  // Six caps of the sphere: max |x_i| >= 0.8.
  const Function caps = make_function(3, 1, [](Point x, Values v) {
    v[0] = std::pow(x[0], 10) + std::pow(x[1], 10) + std::pow(x[2], 10) - std::pow(0.8, 10);
  });
  const Domain domain(3, caps, Box{{-2, -2, -2}, {2, 2, 2}});
  const FoundSeeds seeds = find_seeds(sphere_function(3, 1), domain);
  const Cut pieces = cut(sphere_function(3, 1), caps, coxeter::coxeter_a(3, 0.1), seeds.points);
  EXPECT_EQ(pieces.topology.components, 6u);
  EXPECT_EQ(pieces.strata.boundary_components, 6u);
  // Slivers that no start point falls into: found on the boundary.
  const Function slivers = make_function(3, 1, [](Point x, Values v) { v[0] = x[0] * x[0] - 0.9999 * 0.9999; });
  const FoundSeeds few = find_seeds(sphere_function(3, 1), Domain(3, slivers, Box{{-2, -2, -2}, {2, 2, 2}}));
  EXPECT_EQ(cut(sphere_function(3, 1), slivers, coxeter::coxeter_a(3, 0.005), few.points).topology.components, 2u);
}

// Against brute force: every simplex of a part of the lattice, every set of inequalities, for maps with small random
// integers as values, so that zeros are everywhere.

/// A fixed random integer at each point, in [-size, size].
int noise(Point x, int salt, int size) {
  std::uint64_t hash = 0x9e3779b97f4a7c15ull * static_cast<std::uint64_t>(salt + 1);
  for (double c : x) {
    hash ^= static_cast<std::uint64_t>(static_cast<std::int64_t>(std::llround(c)) + 1000);
    hash *= 0xff51afd7ed558ccdull;
    hash ^= hash >> 33;
  }
  return static_cast<int>(hash % (2 * size + 1)) - size;
}

using StratumPoint = std::pair<std::vector<int>, Simplex>;

std::set<StratumPoint> points_of(const CellComplex& complex, const std::vector<char>* wanted = nullptr) {
  std::set<StratumPoint> points;
  for (std::size_t i = 0; i < complex.num_cells(0); ++i)
    if (wanted == nullptr || (*wanted)[i])
      points.insert({complex.inequality_sets[complex.set_of(0, i)], complex.simplex(0, i)});
  return points;
}

/// All stratum points in the lattice box [-reach, reach]^d.
std::set<StratumPoint> brute_force(const Function& f, const Function& g, int reach) {
  const int d = f.ambient_dim(), k = f.codim(), m = g.codim(), n = d - k;
  std::vector<std::vector<int>> sets{{}};
  for (std::size_t i = 0; i < sets.size(); ++i)
    for (int j = sets[i].empty() ? 0 : sets[i].back() + 1; j < m && int(sets[i].size()) < n; ++j) {
      sets.push_back(sets[i]);
      sets.back().push_back(j);
    }
  std::set<StratumPoint> found;
  std::set<Simplex> seen;
  std::vector<std::uint16_t> order(d + 1);
  std::vector<int> permutation(d);
  std::iota(permutation.begin(), permutation.end(), 0);
  std::vector<std::int32_t> z(d, -reach);
  auto examine = [&](const Simplex& sigma) {
    if (!seen.insert(sigma).second) return;
    std::vector<std::vector<double>> f_at, h_at;
    for (const auto& v : sigma.vertices()) {
      std::vector<double> x(v.begin(), v.end());
      f_at.emplace_back(k);
      h_at.emplace_back(m);
      f.evaluate(x, f_at.back());
      g.evaluate(x, h_at.back());
      for (double& value : h_at.back()) value = -value;
    }
    for (const std::vector<int>& set : sets) {
      if (sigma.dim() != k + int(set.size())) continue;
      std::vector<std::vector<double>> columns;
      for (std::size_t q = 0; q < f_at.size(); ++q) {
        columns.emplace_back();
        for (int j : set) columns.back().push_back(h_at[q][j]);
        columns.back().insert(columns.back().end(), f_at[q].begin(), f_at[q].end());
      }
      std::vector<const double*> pointers;
      for (const auto& column : columns) pointers.push_back(column.data());
      if (!exactly_hit(pointers)) continue;
      bool inside = true;
      for (int j = 0; j < m && inside; ++j) {
        if (std::binary_search(set.begin(), set.end(), j)) continue;
        std::vector<double> component;
        for (const auto& h : h_at) component.push_back(h[j]);
        const auto position = std::lower_bound(set.begin(), set.end(), j) - set.begin();
        inside = exactly_below(pointers, component, static_cast<int>(position));
      }
      if (inside) found.insert({set, sigma});
    }
  };
  for (;;) {
    do {
      for (int q = 0; q < d; ++q) order[permutation[q]] = static_cast<std::uint16_t>(q);
      order[d] = static_cast<std::uint16_t>(d);
      const Simplex full(coxeter::LatticeVertex(std::span<const std::int32_t>(z)),
                         coxeter::OrderedPartition::from_part_indices(order));
      for (int dim = k; dim <= d; ++dim) coxeter::for_each_face(full, dim, examine);
    } while (std::next_permutation(permutation.begin(), permutation.end()));
    int c = 0;
    while (c < d && ++z[c] == reach) z[c++] = -reach;
    if (c == d) return found;
  }
}

/// The complex of a set of stratum points.
CellComplex complex_of(const std::set<StratumPoint>& points, int d, int k) {
  std::set<std::vector<std::int32_t>> vertices;
  std::vector<std::int32_t> coordinates;
  for (const auto& [set, sigma] : points)
    for (const auto& v : sigma.vertices()) {
      // A base vertex of a coface is at most one step below.
      for (std::uint32_t below = 0; below < (1u << d); ++below) {
        std::vector<std::int32_t> z(v.begin(), v.end());
        for (int c = 0; c < d; ++c) z[c] -= below >> c & 1;
        vertices.insert(z);
      }
    }
  for (const auto& z : vertices) coordinates.insert(coordinates.end(), z.begin(), z.end());
  std::map<std::vector<std::int32_t>, std::uint32_t> number;
  for (const auto& z : vertices) number.emplace(z, static_cast<std::uint32_t>(number.size()));
  std::map<std::vector<int>, BoundarySimplices> by_set;
  for (const auto& [set, sigma] : points) {
    BoundarySimplices& list = by_set[set];
    list.inequalities = set;
    list.base.push_back(number.at(std::vector<std::int32_t>(sigma.base().begin(), sigma.base().end())));
    const auto parts = sigma.partition().part_indices();
    list.parts.insert(list.parts.end(), parts.data(), parts.data() + d);
    list.points.resize(list.points.size() + d);
  }
  const BoundarySimplices interior = by_set[{}];
  std::vector<BoundarySimplices> boundary;
  for (const auto& [set, list] : by_set)
    if (!set.empty()) boundary.push_back(list);
  std::stable_sort(boundary.begin(), boundary.end(),
                   [](const auto& a, const auto& b) { return a.inequalities.size() < b.inequalities.size(); });
  CrossedSimplices crossed;
  crossed.ambient_dim = d;
  crossed.codim = k;
  crossed.vertex_coordinates = coordinates;
  crossed.base = interior.base;
  const std::vector<std::uint8_t> parts(interior.parts.begin(), interior.parts.end());
  crossed.parts = parts;
  crossed.points = interior.points;
  crossed.boundary = boundary;
  crossed.num_given = 100;
  return cell_complex(crossed);
}

TEST(Boundary, AgreesWithBruteForceOnRandomIntegers) {
  struct Setting {
    int d, k, m, runs;
  };
  for (const auto& [d, k, m, runs] :
       {Setting{2, 1, 1, 8}, Setting{2, 1, 3, 8}, Setting{3, 1, 1, 4}, Setting{3, 1, 3, 6}, Setting{3, 2, 2, 4},
        Setting{4, 2, 3, 1}, Setting{4, 1, 2, 1}}) {
    int with_corners = 0;
    for (int run = 0; run < runs; ++run) {
      SCOPED_TRACE("d " + std::to_string(d) + " k " + std::to_string(k) + " m " + std::to_string(m) + " run " +
                   std::to_string(run));
      const int salt = 100 * run, reach = 3;
      const int of_d = d, of_k = k, of_m = m;
      const Function f = make_function(d, k, [=](Point x, Values v) {
        v[0] = -4 + noise(x, salt, 1);
        for (double c : x) v[0] += c * c;
        for (int r = 1; r < of_k; ++r) v[r] = x[r] + noise(x, salt + r, 1);
      });
      const Function g = make_function(d, m, [=](Point x, Values v) {
        for (int j = 0; j < of_m; ++j) v[j] = x[j % of_d] - (j / of_d) + noise(x, salt + 10 + j, 1);
      });
      const std::set<StratumPoint> expected = brute_force(f, g, reach);
      const CellComplex all = complex_of(expected, d, k);
      EXPECT_EQ(all.num_cells(0), expected.size());

      // Seeds at all points of the interior.
      TraceOptions options;
      options.inequalities = g;
      std::vector<double> seeds;
      for (const auto& [set, sigma] : expected) {
        if (!set.empty()) continue;
        const auto centre = coxeter::barycentre(sigma, integer_lattice(d));
        seeds.insert(seeds.end(), centre.begin(), centre.end());
      }
      if (seeds.empty()) continue;
      const TraceResult traced = trace(f, integer_lattice(d), seeds, options);
      const CellComplex complex = cell_complex(traced);
      const std::set<StratumPoint> found = points_of(complex);
      EXPECT_TRUE(std::includes(expected.begin(), expected.end(), found.begin(), found.end()));

      // Components of the whole: each is found or not, and those with an interior point are.
      std::vector<std::uint32_t> component(all.num_cells(0));
      std::iota(component.begin(), component.end(), 0u);
      auto root = [&](std::uint32_t i) {
        while (component[i] != i) i = component[i];
        return i;
      };
      for (std::size_t e = 0; e < all.num_cells(1); ++e) {
        const auto ends = all.facets[1][e];
        ASSERT_EQ(ends.size(), 2u);
        component[root(ends[0])] = root(ends[1]);
      }
      std::vector<char> wanted(all.num_cells(0), 0);
      for (std::uint32_t i = 0; i < all.num_cells(0); ++i)
        if (all.set_of(0, i) == 0) wanted[root(i)] = 1;
      std::vector<char> in_wanted(all.num_cells(0));
      for (std::uint32_t i = 0; i < in_wanted.size(); ++i) in_wanted[i] = wanted[root(i)];
      EXPECT_EQ(found, points_of(all, &in_wanted));
      expect_manifold(complex);
      expect_manifold(all);
      for (const auto& [set, sigma] : found) with_corners += set.size() > 1;
    }
    if (m > 1 && d - k > 1) {
      EXPECT_GT(with_corners, 0);
    }
  }
}

}  // namespace
}  // namespace whitney
