// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

#include <coxeter/base/run_control.h>

namespace whitney {

/// Watches over the limits of a run of several phases. The first limit that is reached is remembered and ends the run.
class PhaseWatch {
 public:
  explicit PhaseWatch(const RunControl& run) : run_(run), begin_(std::chrono::steady_clock::now()) {}

  double seconds() const;  ///< since the run began
  /// Whether no limit is reached: of time, of memory (what the process holds now and bytes_to_come), or of the caller's
  /// patience.
  bool keep_going(const char* phase, std::size_t simplices = 0, std::size_t evaluations = 0,
                  std::uint64_t bytes_to_come = 0);
  /// Whether so many bytes more than the process holds now keep within the memory limit. If not, the run is stopped.
  bool fits(std::uint64_t bytes);
  /// Ends the run for a reason that somebody else noticed, unless it has ended.
  void stop(StopReason reason);

  bool stopped() const { return reason_ != StopReason::kNone; }
  StopReason stop_reason() const { return reason_; }

 private:
  bool memory_is_short(std::uint64_t bytes) const;

  RunControl run_;
  std::chrono::steady_clock::time_point begin_;
  double memory_asked_ = -1;  ///< seconds; to ask is not free
  StopReason reason_ = StopReason::kNone;
};

}  // namespace whitney
