// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace whitney::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// What a body throws when the library breaks a promise. (whitney::Error is an answer, not a broken promise.)
class BrokenPromise : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

inline void demand(bool kept, const std::string& promise) {
  if (!kept) throw BrokenPromise(promise);
}

inline std::string_view text_of(Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

/// Decisions read off the bytes, one after the other; zeros when they are used up.
class Choices {
 public:
  explicit Choices(Bytes bytes) : rest_(bytes) {}
  bool empty() const { return rest_.empty(); }
  std::uint8_t byte() {
    if (rest_.empty()) return 0;
    const std::uint8_t first = rest_.front();
    rest_ = rest_.subspan(1);
    return first;
  }
  /// 0 .. count - 1.
  int below(int count) { return byte() % count; }

 private:
  Bytes rest_;
};

}  // namespace whitney::fuzz
