// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <coxeter/simplex.h>

namespace whitney::coxeter::detail {

/// Raw access for enumerators, which rewrite one simplex in place. They must leave it canonical before a visitor sees
/// it.
struct SimplexWriter {
  std::int32_t* base;       // d
  std::uint16_t* elements;  // d + 1
  std::uint16_t* ends;      // number of parts

  explicit SimplexWriter(Simplex& simplex)
      : base(simplex.base_.data()),
        elements(simplex.partition_.data_.data()),
        ends(elements + simplex.partition_.num_elements_) {}

  static bool owns_memory(const Simplex& simplex) { return simplex.owns_memory(); }

  /// A copy of `original` with num_parts parts; what the ends hold is left open. At least `room` values may be written
  /// from `elements` on.
  static Simplex resized(const Simplex& original, int num_parts, std::size_t room = 0) {
    Simplex result;
    result.base_ = original.base_;
    const std::size_t n = original.partition_.num_elements_;
    auto& data = result.partition_.data_;
    data.resize_for_overwrite(room);
    data.resize_for_overwrite(n + static_cast<std::size_t>(num_parts));
    std::copy_n(original.partition_.data_.data(), n, data.data());
    result.partition_.num_elements_ = original.partition_.num_elements_;
    return result;
  }
};

/// Calls a visitor that returns void or, as bool, whether to go on.
template <class Visitor>
bool visit_continues(Visitor& visit, const Simplex& simplex) {
  if constexpr (std::is_void_v<std::invoke_result_t<Visitor&, const Simplex&>>) {
    visit(simplex);
    return true;
  } else {
    return static_cast<bool>(visit(simplex));
  }
}

}  // namespace whitney::coxeter::detail
