// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Complexes with known topology, for the tests.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include <Eigen/Dense>

#include <whitney/cells/cell_complex.h>
#include <whitney/topology/face_lattice.h>
#include <whitney/topology/mesh.h>

namespace whitney::testing {

using Simplices = std::vector<std::vector<std::uint32_t>>;
using Complex = std::vector<Incidence>;  // facets per dimension

inline void push(Incidence& lists, const std::vector<std::uint32_t>& list) {
  lists.index.insert(lists.index.end(), list.begin(), list.end());
  lists.offset.push_back(lists.index.size());
}

/// A mesh of abstract simplices; its points have one coordinate, zero.
inline SimplicialMesh mesh_of(int dim, const Simplices& simplices) {
  SimplicialMesh mesh{.ambient_dim = 1, .dim = dim, .points = {}, .simplices = {}};
  std::uint32_t num_points = 0;
  for (const auto& simplex : simplices) {
    for (std::uint32_t v : simplex) {
      mesh.simplices.push_back(v);
      num_points = std::max(num_points, v + 1);
    }
  }
  mesh.points.assign(num_points, 0.0);
  return mesh;
}

inline Simplices simplices_of(const SimplicialMesh& mesh) {
  Simplices result(mesh.num_simplices());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const auto begin = mesh.simplices.begin() + i * (mesh.dim + 1);
    result[i].assign(begin, begin + mesh.dim + 1);
  }
  return result;
}

/// Boundary of the (n+1)-simplex.
inline SimplicialMesh simplex_sphere(int n) {
  Simplices simplices;
  for (int omit = 0; omit < n + 2; ++omit) {
    simplices.emplace_back();
    for (int v = 0; v < n + 2; ++v) {
      if (v != omit) simplices.back().push_back(v);
    }
  }
  return mesh_of(n, simplices);
}

/// Boundary of the (n+1)-dimensional cross-polytope; vertices 2i and 2i+1 are opposite.
inline SimplicialMesh cross_polytope(int n) {
  Simplices simplices;
  for (int bits = 0; bits < 1 << (n + 1); ++bits) {
    simplices.emplace_back();
    for (int i = 0; i <= n; ++i) simplices.back().push_back(2 * i + (bits >> i & 1));
  }
  return mesh_of(n, simplices);
}

/// Moebius and Csaszar's torus with 7 vertices.
inline SimplicialMesh torus7() {
  Simplices simplices;
  for (std::uint32_t i = 0; i < 7; ++i) {
    simplices.push_back({i, (i + 1) % 7, (i + 3) % 7});
    simplices.push_back({i, (i + 2) % 7, (i + 3) % 7});
  }
  return mesh_of(2, simplices);
}

inline SimplicialMesh projective_plane6() {
  return mesh_of(
      2,
      {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 1, 5}, {1, 2, 4}, {2, 4, 5}, {2, 3, 5}, {1, 3, 5}, {1, 3, 4}});
}

/// A grid of a x b squares, each cut in two; its sides left open, glued, or glued with a flip (the first pair only).
enum class Side { kOpen, kGlued, kFlipped };
inline SimplicialMesh grid_surface(int a, int b, Side first, Side second) {
  const int columns = first == Side::kOpen ? a + 1 : a;
  const int rows = second == Side::kOpen ? b + 1 : b;
  const auto vertex = [&](int i, int j) -> std::uint32_t {
    if (first != Side::kOpen && i == a) {
      i = 0;
      if (first == Side::kFlipped) j = second == Side::kOpen ? b - j : (2 * b - j) % b;
    }
    return std::uint32_t(i % columns * rows + j % rows);
  };
  Simplices simplices;
  for (int i = 0; i < a; ++i) {
    for (int j = 0; j < b; ++j) {
      simplices.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      simplices.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  return mesh_of(2, simplices);
}

inline SimplicialMesh shifted(SimplicialMesh mesh, std::uint32_t by) {
  for (std::uint32_t& v : mesh.simplices) v += by;
  mesh.points.resize(mesh.points.size() + by);
  return mesh;
}

inline SimplicialMesh disjoint_union(const SimplicialMesh& a, const SimplicialMesh& b) {
  SimplicialMesh result = shifted(b, a.num_points());
  result.simplices.insert(result.simplices.begin(), a.simplices.begin(), a.simplices.end());
  return result;
}

/// The union with only vertex 0 in common.
inline SimplicialMesh wedge(const SimplicialMesh& a, const SimplicialMesh& b) {
  SimplicialMesh result = disjoint_union(a, b);
  for (std::uint32_t& v : result.simplices) {
    if (v == a.num_points()) v = 0;
    if (v > a.num_points()) --v;
  }
  result.points.pop_back();
  return result;
}

/// The mesh with every vertex replaced.
inline SimplicialMesh relabelled(const SimplicialMesh& mesh, const std::vector<std::uint32_t>& label) {
  Simplices simplices = simplices_of(mesh);
  for (auto& simplex : simplices) {
    for (std::uint32_t& v : simplex) v = label[v];
  }
  return mesh_of(mesh.dim, simplices);
}

/// The connected sum of surfaces, along the first triangle of b and the last of a.
inline SimplicialMesh connected_sum(const SimplicialMesh& a, const SimplicialMesh& b) {
  Simplices first = simplices_of(a);
  Simplices second = simplices_of(b);
  std::vector<std::uint32_t> label(b.num_points());
  std::iota(label.begin(), label.end(), a.num_points());
  for (int k = 0; k < 3; ++k) label[second.front()[k]] = first.back()[k];
  first.pop_back();
  for (std::size_t i = 1; i < second.size(); ++i) {
    for (std::uint32_t& v : second[i]) v = label[v];
    first.push_back(second[i]);
  }
  // Without gaps in the numbering.
  std::map<std::uint32_t, std::uint32_t> compact;
  for (auto& simplex : first) {
    for (std::uint32_t& v : simplex) v = compact.try_emplace(v, compact.size()).first->second;
  }
  return mesh_of(2, first);
}

inline SimplicialMesh genus_surface(int genus) {
  SimplicialMesh surface = simplex_sphere(2);
  for (int g = 0; g < genus; ++g) surface = connected_sum(surface, grid_surface(4, 4, Side::kGlued, Side::kGlued));
  return surface;
}

inline SimplicialMesh cone(const SimplicialMesh& mesh) {
  Simplices simplices = simplices_of(mesh);
  for (auto& simplex : simplices) simplex.push_back(mesh.num_points());
  return mesh_of(mesh.dim + 1, simplices);
}

inline SimplicialMesh suspension(const SimplicialMesh& mesh) {
  Simplices simplices;
  for (std::uint32_t apex : {0u, 1u}) {
    for (auto simplex : simplices_of(mesh)) {
      simplex.push_back(mesh.num_points() + apex);
      simplices.push_back(simplex);
    }
  }
  return mesh_of(mesh.dim + 1, simplices);
}

/// Circles C_0 .. C_m of three vertices; C_s is wrapped degrees[s] times around C_(s+1), and C_0 bounds a disc: H_1 is
/// Z modulo the product of the degrees.
inline SimplicialMesh telescope(const std::vector<int>& degrees) {
  Simplices simplices{{0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  std::uint32_t inner = 0, next = 4;
  for (int degree : degrees) {
    const std::uint32_t ring = next, outer = next + 3 * degree;
    next = outer + 3;
    const auto r = [&](int i) { return ring + i % (3 * degree); };
    const auto a = [&](int i) { return inner + i % 3; };
    const auto b = [&](int i) { return outer + i % 3; };
    for (int i = 0; i < 3 * degree; ++i) {
      simplices.push_back({b(i), b(i + 1), r(i)});
      simplices.push_back({b(i + 1), r(i), r(i + 1)});
    }
    for (int i = 0; i < 3; ++i) {
      for (int t = 0; t + 1 < degree; ++t) simplices.push_back({r(degree * i + t), r(degree * i + t + 1), a(i)});
      simplices.push_back({r(degree * i + degree - 1), a(i), a(i + 1)});
      simplices.push_back({r(degree * i + degree - 1), r(degree * (i + 1)), a(i + 1)});
    }
    inner = outer;
  }
  return mesh_of(2, simplices);
}

/// A circle of `length` >= 2 edges, as a complex.
inline Complex circle(std::uint32_t length) {
  Complex facets(2);
  for (std::uint32_t i = 0; i < length; ++i) {
    push(facets[0], {});
    push(facets[1], {i, (i + 1) % length});
  }
  return facets;
}

/// An interval of `length` edges, as a complex.
inline Complex interval(std::uint32_t length) {
  Complex facets(2);
  for (std::uint32_t i = 0; i <= length; ++i) push(facets[0], {});
  for (std::uint32_t i = 0; i < length; ++i) push(facets[1], {i, i + 1});
  return facets;
}

/// The product of two complexes: cells are pairs of cells.
inline Complex product(const Complex& a, const Complex& b) {
  // The cell (i-cell x, j-cell y) is number start(i, j) + x * |b_j| + y of dimension i + j.
  const auto start = [&](std::size_t i, std::size_t j) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < i; ++k) {
      if (i + j - k < b.size()) count += a[k].size() * b[i + j - k].size();
    }
    return count;
  };
  Complex facets(a.size() + b.size() - 1);
  for (std::size_t dim = 0; dim < facets.size(); ++dim) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (dim < i || dim - i >= b.size()) continue;
      const std::size_t j = dim - i;
      for (std::uint32_t x = 0; x < a[i].size(); ++x) {
        for (std::uint32_t y = 0; y < b[j].size(); ++y) {
          std::vector<std::uint32_t> list;
          for (std::uint32_t f : a[i][x]) list.push_back(start(i - 1, j) + f * b[j].size() + y);
          for (std::uint32_t f : b[j][y]) list.push_back(start(i, j - 1) + x * b[j - 1].size() + f);
          push(facets[dim], list);
        }
      }
    }
  }
  return facets;
}

/// The barycentric subdivision of a complex of regular cells: vertex number (all cells of lower dimension) + i is the
/// j-cell i.
inline SimplicialMesh flags(const Complex& facets) {
  std::vector<std::uint32_t> base{0};
  for (const Incidence& lists : facets) base.push_back(base.back() + lists.size());
  Simplices partial, simplices;
  const int n = int(facets.size()) - 1;
  std::vector<std::uint32_t> flag(n + 1);
  const auto descend = [&](auto& self, int j, std::uint32_t cell) -> void {
    flag[j] = base[j] + cell;
    if (j == 0) simplices.push_back(flag);
    for (std::uint32_t f : facets[j][cell]) self(self, j - 1, f);
  };
  for (std::uint32_t cell = 0; cell < facets[n].size(); ++cell) descend(descend, n, cell);
  return mesh_of(n, simplices);
}

/// The orbits of the faces of a mesh under the cyclic group generated by a permutation of the vertices. The caller
/// chooses a free action with no two vertices of an orbit in a simplex, so that the orbits are regular cells.
inline Complex quotient(const SimplicialMesh& mesh, const std::vector<std::uint32_t>& generator) {
  const FaceLattice lattice = face_lattice(mesh);
  Complex facets(mesh.dim + 1);
  std::vector<std::uint32_t> orbit_below;
  for (int j = 0; j <= mesh.dim; ++j) {
    std::map<std::vector<std::uint32_t>, std::uint32_t> number;
    std::vector<std::uint32_t> orbit(lattice.num_faces(j));
    for (std::uint32_t i = 0; i < orbit.size(); ++i) {
      const auto begin = lattice.vertices[j].begin() + i * (j + 1);
      std::vector<std::uint32_t> face(begin, begin + j + 1), least = face;
      const std::vector<std::uint32_t> first = face;
      do {
        for (std::uint32_t& v : face) v = generator[v];
        std::sort(face.begin(), face.end());
        least = std::min(least, face);
      } while (face != first);
      const auto [at, is_new] = number.try_emplace(least, number.size());
      orbit[i] = at->second;
      if (!is_new) continue;
      std::vector<std::uint32_t> list;
      for (std::uint32_t f : lattice.facets[j][i]) list.push_back(orbit_below[f]);
      push(facets[j], list);
    }
    orbit_below = orbit;
  }
  return facets;
}

/// RP^n, from the cross-polytope.
inline Complex projective_space(int n) {
  const SimplicialMesh sphere = cross_polytope(n);
  std::vector<std::uint32_t> antipode(2 * n + 2);
  for (std::uint32_t v = 0; v < antipode.size(); ++v) antipode[v] = v ^ 1;
  return quotient(sphere, antipode);
}

/// The lens space L(p, q), from the join of two circles of 3p edges.
inline Complex lens_space(std::uint32_t p, std::uint32_t q) {
  const std::uint32_t length = 3 * p;
  Simplices simplices;
  for (std::uint32_t i = 0; i < length; ++i) {
    for (std::uint32_t j = 0; j < length; ++j) {
      simplices.push_back({i, (i + 1) % length, length + j, length + (j + 1) % length});
    }
  }
  std::vector<std::uint32_t> generator(2 * length);
  for (std::uint32_t i = 0; i < length; ++i) {
    generator[i] = (i + 3) % length;
    generator[length + i] = length + (i + 3 * q) % length;
  }
  return quotient(mesh_of(3, simplices), generator);
}

/// Poincare's homology sphere: the dodecahedron, twice subdivided, opposite faces glued after a turn of 36 degrees.
inline SimplicialMesh poincare_sphere() {
  using Point = Eigen::Vector3d;
  const double phi = (1 + std::sqrt(5.0)) / 2;
  std::vector<Point> normals, corners;
  for (int s = 0; s < 4; ++s) {
    const double a = s & 1 ? 1 : -1, b = s & 2 ? phi : -phi;
    for (const Point& normal : {Point(0, a, b), Point(a, b, 0), Point(b, 0, a)}) normals.push_back(normal.normalized());
    for (const Point& corner : {Point(0, b, a / phi), Point(b, a / phi, 0), Point(a / phi, 0, b)}) {
      corners.push_back(corner);
    }
    for (const double c : {-1.0, 1.0}) corners.push_back(Point(a, b / phi, c));
  }
  double height = 0;
  for (const Point& corner : corners) height = std::max(height, corner.dot(normals[0]));
  const auto on_face = [&](const Point& x, const Point& normal) { return std::abs(x.dot(normal) - height) < 1e-9; };

  Complex facets(4);
  std::vector<std::vector<Point>> centres{corners, {}, {}, {Point::Zero()}};
  for (std::size_t v = 0; v < 20; ++v) push(facets[0], {});
  std::vector<std::vector<std::uint32_t>> edges_of_face(12);
  for (std::uint32_t v = 0; v < 20; ++v) {
    for (std::uint32_t w = v + 1; w < 20; ++w) {
      if ((corners[v] - corners[w]).norm() > 2 / phi + 1e-9) continue;
      for (int f = 0; f < 12; ++f) {
        if (on_face(corners[v], normals[f]) && on_face(corners[w], normals[f])) {
          edges_of_face[f].push_back(facets[1].size());
        }
      }
      push(facets[1], {v, w});
      centres[1].push_back((corners[v] + corners[w]) / 2);
    }
  }
  std::vector<std::uint32_t> all(12);
  std::iota(all.begin(), all.end(), 0);
  for (int f = 0; f < 12; ++f) {
    push(facets[2], edges_of_face[f]);
    centres[2].push_back(height * normals[f]);
  }
  push(facets[3], all);

  SimplicialMesh mesh = flags(facets);
  std::vector<Point> points;
  for (const auto& list : centres) points.insert(points.end(), list.begin(), list.end());
  const FaceLattice lattice = face_lattice(mesh);
  std::vector<Point> finer;
  for (int j = 0; j <= 3; ++j) {
    for (std::size_t i = 0; i < lattice.num_faces(j); ++i) {
      Point centre = Point::Zero();
      for (int k = 0; k <= j; ++k) centre += points[lattice.vertices[j][i * (j + 1) + k]] / (j + 1);
      finer.push_back(centre);
    }
  }
  mesh = flags(lattice.facets);

  std::vector<std::uint32_t> label(finer.size());
  std::iota(label.begin(), label.end(), 0);
  const auto find = [&](std::uint32_t v) {
    while (label[v] != v) v = label[v];
    return v;
  };
  for (const Point& normal : normals) {
    if (normal.sum() + 1e-3 * normal[0] < 0) continue;  // one of two opposite faces
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(std::acos(-1.0) / 5, normal).toRotationMatrix();
    for (std::uint32_t v = 0; v < finer.size(); ++v) {
      if (!on_face(finer[v], normal)) continue;
      const Point image = turn * finer[v] - 2 * height * normal;
      for (std::uint32_t w = 0; w < finer.size(); ++w) {
        if ((finer[w] - image).norm() < 1e-9) label[std::max(find(v), find(w))] = std::min(find(v), find(w));
      }
    }
  }
  std::map<std::uint32_t, std::uint32_t> compact;
  std::vector<std::uint32_t> final_label(finer.size());
  for (std::uint32_t v = 0; v < finer.size(); ++v) {
    final_label[v] = compact.try_emplace(find(v), compact.size()).first->second;
  }
  return relabelled(mesh, final_label);
}

/// Splits random edges at new vertices, then renames the vertices and shuffles everything.
inline SimplicialMesh randomly_subdivided(const SimplicialMesh& mesh, int splits, std::uint64_t rng_seed) {
  std::mt19937_64 random(rng_seed);
  Simplices simplices = simplices_of(mesh);
  std::uint32_t num_points = mesh.num_points();
  for (int s = 0; s < splits; ++s) {
    auto edge = simplices[random() % simplices.size()];
    std::shuffle(edge.begin(), edge.end(), random);
    const std::uint32_t a = edge[0], b = edge[1], middle = num_points++;
    const std::size_t count = simplices.size();
    for (std::size_t i = 0; i < count; ++i) {
      const auto at_a = std::find(simplices[i].begin(), simplices[i].end(), a);
      const auto at_b = std::find(simplices[i].begin(), simplices[i].end(), b);
      if (at_a == simplices[i].end() || at_b == simplices[i].end()) continue;
      auto half = simplices[i];
      half[at_a - simplices[i].begin()] = middle;
      *at_b = middle;
      simplices.push_back(half);
    }
  }
  std::vector<std::uint32_t> label(num_points);
  std::iota(label.begin(), label.end(), 0);
  std::shuffle(label.begin(), label.end(), random);
  std::shuffle(simplices.begin(), simplices.end(), random);
  for (auto& simplex : simplices) {
    std::shuffle(simplex.begin(), simplex.end(), random);
    for (std::uint32_t& v : simplex) v = label[v];
  }
  return mesh_of(mesh.dim, simplices);
}

}  // namespace whitney::testing
