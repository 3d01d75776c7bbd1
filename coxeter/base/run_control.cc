// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/base/run_control.h>

namespace whitney {

const char* to_string(StopReason reason) {
  switch (reason) {
    case StopReason::kNone:
      return "none";
    case StopReason::kBox:
      return "box";
    case StopReason::kMaxSimplices:
      return "max_simplices";
    case StopReason::kTimeLimit:
      return "time_limit";
    case StopReason::kMemoryLimit:
      return "memory_limit";
    case StopReason::kCancelled:
      return "cancelled";
  }
  return "unknown";
}

}  // namespace whitney
