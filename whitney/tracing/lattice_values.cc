// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/tracing/lattice_values.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <whitney/tracing/barycentric_kernel.h>

namespace whitney {

static_assert(BarycentricKernel::kSlack <= coxeter::VertexTable::kSlackWords);

OracleError not_finite(const std::string& what, double value, std::span<const double> x) {
  std::string at;
  char number[32];
  for (std::size_t c = 0; c < x.size(); ++c) {
    std::snprintf(number, sizeof number, "%s%.17g", c ? ", " : "", x[c]);
    at += number;
  }
  return OracleError(what + " is " + (std::isnan(value) ? "NaN" : "infinite") + " at (" + at + ")");
}

LatticeValues::LatticeValues(const Function& f, const coxeter::Triangulation& triangulation, const Domain& domain)
    : f_(f),
      triangulation_(triangulation),
      domain_(domain),
      dim_(f.ambient_dim()),
      codim_(f.codim()),
      num_given_(domain.num_given()),
      mask_of_all_(domain.num_words(), 0),
      table_(dim_, static_cast<int>(codim_ + num_given_ + domain.num_words())),
      point_(dim_) {}

bool LatticeValues::box_holds(std::span<const double> x) const {
  for (std::size_t c = 0; c < x.size(); ++c)
    if (!(x[c] >= domain_.box()->lower[c] && x[c] <= domain_.box()->upper[c])) return false;
  return true;
}

std::uint32_t LatticeValues::vertex(std::span<const std::int32_t> z) {
  const std::uint32_t vertex = table_.intern(z.data(), table_.form_of(z.data()));
  evaluate_new();
  return boxed() && unreachable(vertex) ? kUnreachable : vertex;
}

void LatticeValues::values(std::uint32_t vertex, double* out) {
  const double* known = value(vertex);
  for (std::size_t j = 0; j < num_given_; ++j) out[j] = -known[codim_ + j];
  if (domain_.box()) {
    triangulation_.cartesian({table_.coordinates(vertex), std::size_t(dim_)}, point_);
    for (int j = domain_.num_given(); j < domain_.num_inequalities(); ++j)
      out[j] = -domain_.box_value(j, point_.data());
  }
  std::copy_n(known, codim_, out + domain_.num_inequalities());
}

// All vertices that wait for their values, as one batch.
void LatticeValues::evaluate_new() {
  const std::size_t known = evaluated_, size = table_.size();
  if (known == size) return;
  const std::size_t count = size - known, d = dim_;
  x_.resize(count * d);
  for (std::size_t i = 0; i < count; ++i)
    triangulation_.cartesian({table_.coordinates(static_cast<std::uint32_t>(known + i)), d}, {&x_[i * d], d});
  f_values_.resize(count * codim_);
  f_.evaluate(x_, f_values_);
  g_values_.resize(count * num_given_);
  if (num_given_ > 0) domain_.given()->evaluate(x_, g_values_);
  evaluated_ = size;
  for (std::size_t i = 0; i < count; ++i)
    enter(static_cast<std::uint32_t>(known + i), {&x_[i * d], d}, &f_values_[i * codim_],
          g_values_.data() + i * num_given_);
}

void LatticeValues::enter(std::uint32_t vertex, std::span<const double> x, const double* f, const double* g) {
  double* values = value(vertex);
  if (!domain_.empty()) {
    for (std::size_t j = 0; j < num_given_; ++j) {
      if (!std::isfinite(g[j])) throw not_finite("inequality " + std::to_string(j), g[j], x);
      values[codim_ + j] = g[j];
    }
    auto* mask = reinterpret_cast<std::uint64_t*>(values + codim_ + num_given_);
    domain_.set_mask(x.data(), g, mask);
    for (std::size_t word = 0; word < mask_of_all_.size(); ++word) mask_of_all_[word] |= mask[word];
  }
  const bool boxed = domain_.box().has_value();
  if (boxed) unreachable_.push_back(false);
  for (int r = 0; r < codim_; ++r) {
    values[r] = f[r];
    if (std::isfinite(f[r])) continue;
    if (!boxed || box_holds(x)) throw not_finite("component " + std::to_string(r + 1) + " of f", f[r], x);
    unreachable_[vertex] = true;
  }
}

}  // namespace whitney
