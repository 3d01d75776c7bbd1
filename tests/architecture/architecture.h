// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <compare>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace whitney::architecture {

/// A line that breaks a rule of the house.
struct Violation {
  std::string rule;  ///< one of the names below
  std::string path;  ///< relative to the root
  std::size_t line;
  std::string what;

  auto operator<=>(const Violation&) const = default;
};

/// "path:line: what [rule]"
std::string text(const Violation& violation);

/// Checks the sources (.h, .cc) under root/{coxeter,perturbation,whitney}, comments aside, against these rules:
///
/// room     a file lies in one of the rooms: coxeter/, coxeter/{base,faces,tables}/, perturbation/, whitney/WING/,
///          whitney/io/formats/.
/// arrow    an include goes only where the table of arrows (kArrows in architecture.cc) lets it go.
/// cycle    no header includes itself by way of others.
/// format   nlohmann, OpenMesh, file streams and strings that end in the extension of a format are in whitney/io only;
/// in
///          whitney/cli only such strings, for the texts of its help.
/// printing nothing below whitney/io prints, and nothing knows a stream that leads out of the program. (A string stream
///          that composes a text in memory is allowed.)
/// program  whitney/cli calls: it includes problem/, io/, itself, coxeter/base, the plain headers listed in
/// kPlainHeaders,
///          CLI11, and from C++ nothing that computes. An include rule is not enough to find every algorithm; it is
///          enough to leave one without tools.
/// public   no public header includes GiNaC, CGAL, GMP, Boost.Multiprecision, OpenMesh, nlohmann, TBB or Eigen
///          (whitney/io/openmesh.h, an adaptor, may include OpenMesh), nor a header that is not public.
/// flags    no public header asks which instructions it is compiled for, but coxeter/faces/nibbles.h, which names
///          everything in it after them.
/// threads  TBB in coxeter/base/parallel.{h,cc} only.
/// interval interval arithmetic in perturbation/interval.{h,cc} only.
///
/// Public are all headers but those of whitney/cli and whitney/io/formats and those that
/// root/cmake/internal_headers.txt lists; a line there whose header is gone is a violation of the rule "list".
///
/// Sorted. Throws std::runtime_error if root has none of the three folders.
std::vector<Violation> check_architecture(const std::filesystem::path& root);

/// Checks sizes and test files:
///
/// size     a .cc file of the project, its tests or its benchmarks has at most 500 lines; a function in coxeter,
///          perturbation or whitney at most 80, unless root/tests/architecture/long_ones.txt gives a reason.
/// test     a header has its test file, tests/PATH_test.cc, unless root/tests/architecture/untested_headers.txt gives a
///          reason.
/// list     the lists of exceptions hold nothing that is not needed.
std::vector<Violation> check_sizes(const std::filesystem::path& root);

/// A line "name | reason" of a list of exceptions.
struct Exception {
  std::string name;
  std::string reason;
  std::size_t line;
};

/// Blank lines and lines that begin with # are left out; a file that is not there is an empty list. Throws
/// std::runtime_error at a line without a reason.
std::vector<Exception> read_exceptions(const std::filesystem::path& path);

/// Takes the violations that root/tests/architecture/pending.txt names ("rule path | who mends it") out of the list,
/// and adds one, of the rule "list", for every line there that no violation needs any more.
std::vector<Violation> without_pending(const std::filesystem::path& root, std::vector<Violation> violations);

}  // namespace whitney::architecture
