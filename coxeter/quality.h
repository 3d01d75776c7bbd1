// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace whitney::coxeter {

/// Shape of the d-simplices of a triangulation in which all of them are congruent. Lengths in the unit of edge_length.
/// Rotated and translated copies have the same.
struct Quality {
  int ambient_dim;
  double longest_edge;
  /// Also the least distance of two vertices of the whole triangulation (its separation).
  double shortest_edge;
  /// Least distance of a vertex from the hyperplane of the opposite facet.
  double smallest_altitude;
  /// smallest_altitude / longest_edge, dimensionless, as in BKW20, (3). (Other papers divide by d as well.)
  double thickness;
  /// Least distance of two parallel hyperplanes that enclose the simplex: 1 / max over sets A of vertices of the length
  /// of the sum over A of grad lambda_i, where lambda_i are the barycentric coordinates.
  double width;
  double circumradius;
  double inradius;
  /// The largest delta such that every ball with the circumcentre of a d-simplex as centre and a radius below
  /// circumradius + delta holds no vertices but those of the simplex (a length). 0 when the Delaunay cells are larger
  /// than the simplices.
  double protection;
};

/// Of coxeter_a(ambient_dim, edge_length). With s = edge_length sqrt((d+1) / floor((d+1)^2 / 4)): edges
/// s sqrt(m (d+1-m) / (d+1)), all altitudes s / sqrt(2), width = altitude / sqrt(floor((d+1)/2)), circumradius
/// s sqrt(d (d+2) / (12 (d+1))), the next vertices at squared distance 2 s^2 / (d+1) more. BKW20 prints the thickness
/// sqrt(2/d) for odd d; it is sqrt(2/(d+1)). Source: Choudhary, Kachanovich, Wintraecken, Coxeter triangulations have
/// good quality; every value is checked by brute force in the tests.
/// Throws InvalidInput unless 1 <= ambient_dim <= 65534 and edge_length is finite and positive.
Quality coxeter_a_quality(int ambient_dim, double edge_length);

/// Of freudenthal(ambient_dim, edge_length). With a = edge_length / sqrt(d), the grid spacing: altitudes a (first and
/// last vertex) and a / sqrt(2) (the others), width a / sqrt(d), circumradius edge_length / 2, protection 0 for d > 1
/// (the ball through the vertices of the simplex passes through all vertices of the cube). Throws as above.
Quality freudenthal_quality(int ambient_dim, double edge_length);

class Triangulation;

/// A proven lower bound of the least width of the d-simplices of any triangulation: within a factor 1 - 1e-6 of it
/// where the linear part Lambda is not ill-conditioned, smaller where its inverse is known less well, 0 where it is not
/// known at all (a condition number near 1e15). The sums of gradients that Quality::width speaks of are, over all
/// d-simplices, Lambda^-T g for the vectors g of zeros, ones and minus ones whose entries sum to -1, 0 or 1. Where all
/// coordinates play the same role (a Gram matrix Lambda^T Lambda with equal diagonal and equal off-diagonal entries up
/// to 1e-12: the Coxeter and Freudenthal triangulations, moved and scaled) only the numbers of ones and minus ones
/// matter; otherwise all g are tried, and InvalidInput is thrown for d above 12.
double simplex_width(const Triangulation& triangulation);

}  // namespace whitney::coxeter
