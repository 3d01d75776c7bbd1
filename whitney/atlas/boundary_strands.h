// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <whitney/atlas/glue_charts.h>
#include <whitney/atlas/quilt.h>

namespace whitney::internal {

/// How messages name charts, their boundary parts and seams.
class SeamNames {
 public:
  SeamNames(std::span<const ChartPiece> pieces, std::span<const Seam> seams) : pieces_(pieces), seams_(seams) {}

  std::string chart(int c) const;                     ///< "chart 2", or with its name
  std::string side(int chart, int inequality) const;  ///< a boundary part
  std::string seam(std::size_t s) const;

 private:
  std::span<const ChartPiece> pieces_;
  std::span<const Seam> seams_;
};

/// A boundary part of a patch of the quilt, taken apart. An arc goes from corner to corner, and these two differ: a
/// boundary vertex has two boundary edges, and is a corner only where they belong to different parts.
struct BoundaryStrands {
  std::vector<Quilt::Vertex> corners;             ///< ends of arcs; of a curve: its end points
  std::vector<std::vector<Quilt::Vertex>> arcs;   ///< vertices in order
  std::vector<std::vector<Quilt::Vertex>> loops;  ///< vertices in cyclic order, each once
};

/// By chart and inequality.
using StrandsBySide = std::map<std::pair<int, int>, BoundaryStrands>;

/// Adds the pieces to the quilt as its patches; returns the first vertex of each. Throws InvalidInput where a piece is
/// no simplicial curve or surface.
std::vector<Quilt::Vertex> add_patches(std::span<const ChartPiece> pieces, const SeamNames& names, Quilt& quilt);

/// The boundary parts of the pieces, taken apart. Throws InvalidInput where a part is not on the boundary, is there
/// twice, or meets another, and where the boundary of a surface is no curve. dim: n, 1 or 2.
StrandsBySide boundary_strands(std::span<const ChartPiece> pieces, const SeamNames& names, int dim, const Quilt& quilt,
                               std::span<const Quilt::Vertex> first_vertex);

}  // namespace whitney::internal
