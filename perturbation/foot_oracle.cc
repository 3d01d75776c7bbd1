// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/foot_oracle.h>

#include <algorithm>

namespace whitney::perturbation {

FootPromise weaker(const FootPromise& a, const FootPromise& b) {
  return {std::min(a.place, b.place), std::min(a.errors, b.errors)};
}

const char* to_string(FootPromise::Place place) {
  switch (place) {
    case FootPromise::Place::kUnknown:
      return "unknown";
    case FootPromise::Place::kLocal:
      return "local";
    case FootPromise::Place::kGlobal:
      return "global";
  }
  return "unknown";
}

const char* to_string(FootPromise::Errors errors) {
  return errors == FootPromise::Errors::kProven ? "proven" : "modelled";
}

const char* to_string(ReachSource source) {
  switch (source) {
    case ReachSource::kProven:
      return "proven";
    case ReachSource::kCaller:
      return "caller";
    case ReachSource::kEstimated:
      return "estimated";
  }
  return "unknown";
}

}  // namespace whitney::perturbation
