// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

#include <coxeter/base/run_control.h>

namespace whitney {

/// The clock of one run: asks its RunControl now and then whether it goes on. Time, memory and the caller's progress
/// function; max_simplices is the business of the algorithm that counts them.
class RunWatch {
 public:
  /// What leaves nested loops when a run must stop; caught by the algorithm that made the watch, never by its caller.
  struct Stopped {};

  /// The run begins now. phase: see Progress, a string literal.
  RunWatch(const RunControl& run, const char* phase);

  /// Whether the run must stop. To be called often: most calls only count. Once stopped, it stays so.
  bool stopped(std::size_t simplices = 0, std::size_t evaluations = 0) {
    if (reason_ != StopReason::kNone) return true;
    return is_watching_ && ++calls_ % kCallsPerLook == 0 && look(simplices, evaluations);
  }
  /// The same, asked of the clock and the caller at every call.
  bool stopped_now(std::size_t simplices = 0, std::size_t evaluations = 0) {
    if (reason_ != StopReason::kNone) return true;
    return is_watching_ && look(simplices, evaluations);
  }
  /// Throws Stopped if the run must stop.
  void check() {
    if (stopped()) throw Stopped{};
  }
  /// Whether so many bytes more than this process holds now keep within RunControl::memory_limit; if not, the run is
  /// stopped by it.
  bool fits(std::uint64_t bytes);

  /// Something else stopped the run: a part of it that had limits of its own.
  void stop(StopReason reason) { reason_ = reason; }

  StopReason reason() const { return reason_; }
  double seconds() const;  ///< since the run began

 private:
  static constexpr unsigned kCallsPerLook = 256;

  bool look(std::size_t simplices, std::size_t evaluations);

  RunControl run_;
  const char* phase_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  bool is_watching_;  ///< there is a limit or somebody to ask
  unsigned calls_ = 0;
  double memory_asked_ = 0;  ///< seconds
  StopReason reason_ = StopReason::kNone;
};

}  // namespace whitney
