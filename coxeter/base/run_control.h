// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>

namespace whitney {

/// How far a run has come.
struct Progress {
  const char* phase = "";       ///< what it is doing: "seeds", "trace", "perturb", "certify", ..
  std::size_t simplices = 0;    ///< simplices found (or looked at) so far in this phase
  std::size_t evaluations = 0;  ///< evaluations of the function or the oracle so far, where they are counted
  double seconds = 0;           ///< since the run began
};

/// The limits of a run, and a say in whether it goes on: the same for every algorithm that may take long. Reaching a
/// limit is no error: the result holds what was found and a StopReason.
struct RunControl {
  /// The run stops when it has found this many simplices of the triangulation.
  std::size_t max_simplices = std::numeric_limits<std::size_t>::max();
  /// The run stops after this many seconds.
  double time_limit = std::numeric_limits<double>::infinity();
  /// The run stops when this process would use more than this many bytes of memory.
  std::uint64_t memory_limit = std::numeric_limits<std::uint64_t>::max();
  /// Called now and then, from the thread that runs; returning false stops the run.
  std::function<bool(const Progress&)> progress{};
};

/// Why a run ended.
enum class StopReason {
  kNone,          ///< nothing was left to do
  kBox,           ///< likewise, but the manifold reached the box and was cut there
  kMaxSimplices,  ///< stopped by RunControl::max_simplices
  kTimeLimit,     ///< stopped by RunControl::time_limit
  kMemoryLimit,   ///< stopped by RunControl::memory_limit
  kCancelled      ///< stopped by RunControl::progress
};

/// "none", "box", "max_simplices", "time_limit", "memory_limit", "cancelled".
const char* to_string(StopReason reason);

}  // namespace whitney
