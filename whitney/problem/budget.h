// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <coxeter/base/run_control.h>
#include <whitney/problem/report.h>

namespace whitney {

/// The limits of one run of several phases: what has been used of them, which of them stopped it, and what was left out
/// for their sake.
class Budget {
 public:
  explicit Budget(RunControl run);

  double seconds() const;  ///< since the run began
  /// Adds the seconds since the last call to that phase.
  void lap(std::map<std::string, double>& seconds, const std::string& phase);

  /// Whether time is up, or the caller wants to stop; notes the reason.
  bool spent(const char* phase);
  /// Whether so many bytes more than are in use now keep within the limit. If not, notes the omission.
  bool fits(const std::string& what, std::uint64_t bytes);
  /// Whether a phase that takes so many bytes keeps within all limits: fits(), and time is not up. A run that was
  /// stopped by a number of simplices, or by its memory, may go on to such phases; one out of time or patience may not.
  bool allows(const std::string& what, std::uint64_t bytes);
  /// Notes that something was left out for the reason that stopped the run last.
  void leave_out(const std::string& what, StopReason reason, std::uint64_t bytes = 0);

  /// The limits for an algorithm that runs now, as what is left of this run's. found_before: simplices of earlier
  /// calls, which count for max_simplices. It is stopped for its memory when what is in use now and then, together with
  /// bytes_per_simplex for every simplex found, exceeds the limit: so that what it found can be worked on. Refers to
  /// this budget.
  RunControl rest(std::size_t found_before = 0, double bytes_per_simplex = 0);
  /// Notes why an algorithm run with rest() ended, and returns that: kMemoryLimit in place of kCancelled where it was
  /// the memory.
  StopReason ended(StopReason reason);

  /// Memory gave out: from now on half as many simplices as were found then. False when that leaves none.
  bool halve();

  bool stopped() const { return stop_reason_ != StopReason::kNone && stop_reason_ != StopReason::kBox; }
  StopReason stop_reason() const { return stop_reason_; }
  const std::vector<Omission>& left_out() const { return left_out_; }

 private:
  RunControl run_;
  std::chrono::steady_clock::time_point begin_, lap_;
  double memory_asked_ = -1;  ///< seconds; to ask is not free
  bool memory_is_up_ = false;
  std::size_t simplices_ = 0;  ///< found by the algorithm that runs
  StopReason stop_reason_ = StopReason::kNone;
  std::vector<Omission> left_out_;
};

}  // namespace whitney
