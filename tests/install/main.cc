// SPDX-License-Identifier: GPL-3.0-or-later
// A stranger's program, with the stranger's flags: traces and triangulates through the installed library, computes with
// the stranger's own Eigen in between (same classes as the library's, other flags), and checks the meshes named as
// FILE=EULER on the command line.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#ifdef CONSUMER_HAS_EIGEN
#include <Eigen/Dense>
#endif

#include <coxeter/base/error.h>
#include <coxeter/faces/cofaces.h>
#include <coxeter/faces/faces.h>
#include <coxeter/locate.h>
#include <whitney/cells/cell_complex.h>
#include <whitney/cells/subdivide.h>
#include <whitney/construction/triangulate.h>
#include <whitney/functions/combinators.h>
#include <whitney/functions/expression.h>
#include <whitney/functions/projection.h>
#include <whitney/io/read_mesh.h>
#include <whitney/io/write_mesh.h>
#include <whitney/manifolds/implicit_manifold.h>
#include <whitney/topology/topology.h>
#include <whitney/tracing/trace.h>

namespace {

int failures = 0;

void expect(bool condition, const std::string& what) {
  if (condition) return;
  std::printf("FAILED: %s\n", what.c_str());
  ++failures;
}

#ifdef CONSUMER_HAS_EIGEN
/// The decompositions that the library uses too.
void compute_with_eigen() {
  Eigen::MatrixXd A(5, 5);
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) A(i, j) = std::sin(1.0 + 3 * i + 7 * j + i * j) + (i == j ? 3 : 0);
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(5);
  const Eigen::VectorXd x = Eigen::PartialPivLU<Eigen::MatrixXd>(A).solve(b);
  const Eigen::VectorXd y = Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(A).solve(b);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::MatrixXd again = svd.matrixU() * svd.singularValues().asDiagonal() * svd.matrixV().transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A + A.transpose());
  expect((A * x - b).norm() < 1e-12 && (x - y).norm() < 1e-12, "Eigen solves");
  expect((A - again).norm() < 1e-12, "Eigen decomposes");
  expect(std::abs(solver.eigenvalues().sum() - 2 * A.trace()) < 1e-12, "Eigen finds eigenvalues");
  // Its matrices are welcome where the library takes one.
  const Eigen::MatrixXd Q = Eigen::HouseholderQR<Eigen::MatrixXd>(A.topLeftCorner(3, 3)).householderQ();
  const whitney::Function f = whitney::rotate(
      whitney::parse_equations(std::vector<std::string>{"x", "y", "z"}, std::vector<std::string>{"x^2+y^2+z^2-1"}), Q);
  expect(f.ambient_dim() == 3, "rotated by a matrix of Eigen's");
}
#else
void compute_with_eigen() {}
#endif

void count_faces() {
  const auto triangulation = whitney::coxeter::coxeter_a(4, 1);
  const std::vector<double> x{0.1, 0.2, 0.3, 0.45};
  const auto simplex = whitney::coxeter::locate_full(triangulation, x);
  int edges = 0, facets = 0, cofacets = 0;
  whitney::coxeter::for_each_face(simplex, 1, [&](const whitney::coxeter::Simplex&) { ++edges; });
  whitney::coxeter::for_each_facet(simplex, [&](const whitney::coxeter::Simplex& facet) {
    ++facets;
    whitney::coxeter::for_each_cofacet(facet, [&](const whitney::coxeter::Simplex&) { ++cofacets; });
  });
  expect(edges == 10 && facets == 5 && cofacets == 10, "faces of a 4-simplex");
}

void trace_and_triangulate() {
  const whitney::Function f = whitney::parse_equations(std::vector<std::string>{"x", "y", "z"},
                                                       std::vector<std::string>{"(x^2+y^2+z^2+3)^2-16*(x^2+y^2)"});
  const auto traced = whitney::trace(f, whitney::coxeter::coxeter_a(3, 0.4), std::vector{3.0, 0.0, 0.0});
  const auto mesh = whitney::pulled_subdivision(whitney::cell_complex(traced));
  const auto topology = whitney::topology_of(mesh);
  expect(topology.is_closed_manifold() && topology.components == 1 && topology.euler_characteristic == 0, "torus");
  compute_with_eigen();
  expect(whitney::principal_projection(mesh.points, 3).A.rows() == 4, "projection");

  const whitney::Function circle =
      whitney::parse_equations(std::vector<std::string>{"x", "y", "z"}, std::vector<std::string>{"x^2+y^2-1", "z"});
  const whitney::Submanifold M = whitney::implicit_manifold(circle, {1, 0, 0}, {});
  const auto result = whitney::triangulate(M, {1, 1, whitney::Bending::Source::kCaller},
                                           whitney::coxeter::coxeter_a(3, 0.3), M.seed_points());
  expect(result.certificate.verdict == whitney::perturbation::Verdict::kCertified, "circle certified");
  const auto whole = whitney::topology_of(whitney::barycentric_subdivision(result.complex));
  expect(whole.is_closed_manifold() && whole.components == 1, "circle closed");
}

void write_and_read() {
  const whitney::SimplicialMesh square{
      .ambient_dim = 3, .dim = 2, .points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, .simplices = {0, 1, 2, 0, 2, 3}};
  whitney::write_mesh("square.ply", square);
  const whitney::SimplicialMesh back = whitney::read_mesh("square.ply");
  expect(back.points == square.points && back.simplices == square.simplices, "a mesh comes back from its file");
  bool refused = false;
  try {
    whitney::read_mesh("there is no such file.off");
  } catch (const whitney::FileError&) {
    refused = true;
  }
  expect(refused, "an error of the library is caught outside");
}

void check_mesh(const std::string& argument) {
  const std::size_t equals = argument.find('=');
  const whitney::SimplicialMesh mesh = whitney::read_mesh(argument.substr(0, equals));
  const auto topology = whitney::topology_of(mesh);
  expect(topology.is_closed_manifold() && topology.components == 1 &&
             topology.euler_characteristic == std::atoi(argument.c_str() + equals + 1),
         argument);
}

}  // namespace

int main(int argc, char** argv) {
  count_faces();
  trace_and_triangulate();
  write_and_read();
  for (int i = 1; i < argc; ++i) check_mesh(argv[i]);
  std::puts(failures == 0 ? "the installed library works" : "the installed library does not work");
  return failures == 0 ? 0 : 1;
}
