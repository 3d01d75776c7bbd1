// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <coxeter/base/error.h>
#include <coxeter/base/growing_array.h>
#include <coxeter/tables/vertex_table.h>
#include <coxeter/triangulation.h>
#include <whitney/functions/domain.h>
#include <whitney/functions/function.h>

namespace whitney {

/// "what is NaN at (x_1, .., x_d)", or "infinite".
OracleError not_finite(const std::string& what, double value, std::span<const double> x);

/// f and the inequalities at the vertices of a triangulation, each evaluated once; vertices are numbered in the order
/// in which they were asked for.
///
/// A record of the table holds, beside the coordinates: the k values of f, those of the given inequalities, the mask of
/// the inequalities that are violated. Pointers into it are invalidated by new vertices.
class LatticeValues {
 public:
  static constexpr std::uint32_t kUnreachable = 0xffffffff;

  /// All three must outlive this.
  LatticeValues(const Function& f, const coxeter::Triangulation& triangulation, const Domain& domain);

  /// The number of vertex z; what is not known there yet is evaluated. kUnreachable where f has no value.
  /// Throws OracleError where f or an inequality is not finite inside the box.
  std::uint32_t vertex(std::span<const std::int32_t> z);
  /// -g_j for every inequality of the domain, then the k values of f.
  void values(std::uint32_t vertex, double* out);
  /// f, k values, whatever they are where it has none; BarycentricKernel::kSlack more may be read.
  double* value(std::uint32_t vertex) { return table_.values(vertex); }
  /// Domain::set_mask at the vertex.
  const std::uint64_t* mask(std::uint32_t vertex) {
    return reinterpret_cast<std::uint64_t*>(value(vertex) + codim_ + num_given_);
  }
  std::size_t mask_words() const { return mask_of_all_.size(); }
  /// The union of all masks so far.
  const std::uint64_t* mask_of_all() const { return mask_of_all_.data(); }

  /// The vertices; one who enters some calls evaluate_new() before he asks for values.
  coxeter::VertexTable& table() { return table_; }
  void evaluate_new();
  /// Whether there are vertices without a value at all; then unreachable() may be asked.
  bool boxed() const { return !unreachable_.empty(); }
  bool unreachable(std::uint32_t vertex) const { return unreachable_[vertex]; }

  std::size_t evaluations() const { return evaluated_; }

 private:
  void enter(std::uint32_t vertex, std::span<const double> x, const double* f, const double* g);
  bool box_holds(std::span<const double> x) const;

  const Function& f_;
  const coxeter::Triangulation& triangulation_;
  const Domain& domain_;
  int dim_, codim_;
  std::size_t num_given_;
  std::vector<std::uint64_t> mask_of_all_;
  coxeter::VertexTable table_;
  std::size_t evaluated_ = 0;
  coxeter::GrowingArray<char> unreachable_;  // filled only when there is a box
  std::vector<double> x_, f_values_, g_values_, point_;
};

}  // namespace whitney
