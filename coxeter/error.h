// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace whitney {

/// The caller's mistake: a wrong size, a value that is not finite where it must be, an unknown name.
/// The message names the argument (or the file and key) and what it should have been.
class InvalidInput : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Lattice coordinates left the range of their type: the manifold is unbounded, or the edge length is absurdly small
/// for the size of the region.
class LatticeOverflow : public std::overflow_error {
 public:
  using std::overflow_error::overflow_error;
};

/// A user's function failed: it returned NaN or an infinite value. The message names the point.
class OracleError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file could not be read or written. The message names the file and the reason.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace whitney
