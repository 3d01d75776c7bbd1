// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace whitney {

/// What all exceptions of the library are derived from. A mathematical outcome ("no point was found", "singular") is
/// never an exception: it is an enum in a result.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The caller's mistake: a wrong size, a value that is not finite where it must be, an unknown name.
/// The message names the argument (or the file and key) and what it should have been.
class InvalidInput : public Error {
 public:
  using Error::Error;
};

/// Lattice coordinates left the range of their type: the manifold is unbounded, or the edge length is absurdly small
/// for the size of the region.
class LatticeOverflow : public Error {
 public:
  using Error::Error;
};

/// A user's function failed: it returned NaN or an infinite value. The message names the point.
class OracleError : public Error {
 public:
  using Error::Error;
};

/// A file could not be read or written. The message names the file and the reason.
class FileError : public Error {
 public:
  using Error::Error;
};

}  // namespace whitney
