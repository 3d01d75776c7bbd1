// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <coxeter/base/run_control.h>
#include <coxeter/triangulation.h>
#include <whitney/functions/enclosure.h>
#include <whitney/tracing/trace_result.h>

namespace whitney {

struct CertifyOptions {
  /// The inequalities that the trace was given, in the same order; they must be seen to hold strictly wherever the
  /// manifold may be. Needed when the trace had any (the sides of a box are known without it).
  std::optional<Enclosure> inequalities{};
  /// How many of the places that fail are listed, the worst first.
  std::size_t max_places = 16;
  /// Time limit and cancellation; the verdict is then kStopped.
  RunControl run{};
};

/// Whether the complex that a trace found is, up to ambient isotopy, the zero set of f itself: Theorem B of
/// CERTIFICATE.md, which states what is proved and from what.
struct IsotopyCertificate {
  enum class Verdict {
    /// Every star test holds and the sum over the pieces of time of the largest drop near a simplex is below 1: there
    /// is
    /// a union of components of f = 0 on which Df has rank k, ambient isotopic to the traced complex.
    kCertified,
    kNotCertified,  ///< some star test or drop fails; `places` lists where. The complex may still be right
    kNotCovered,    ///< nothing was tested: `reason` says what the theorem does not cover
    kStopped        ///< a limit of the run
  };
  /// A lattice vertex whose star fails, or whose drop is too large.
  struct Place {
    std::vector<double> point;  ///< d, its position, rounded
    std::string failure;        ///< "irregular", "second derivatives unbounded", ...
    double radius = 0;          ///< estimate of the spectral radius of B there: below 1 is wanted
    double drop = 0;            ///< bound for the sum of the hat functions' changes there: below 1 is wanted
    double edge_length = 0;     ///< estimate: where this place would pass; half of today's where nothing is known
  };

  Verdict verdict = Verdict::kNotCovered;
  std::string reason;         ///< one sentence; empty when certified
  std::size_t num_stars = 0;  ///< stars tested: the vertices of the simplices crossed
  std::size_t num_failing = 0;
  std::vector<Place> places;
  double worst_radius = 0;         ///< estimate, over all stars
  double worst_drop = 0;           ///< largest local drop
  double advised_edge_length = 0;  ///< estimate: the edge length at which all places would pass; 0: none fails
  /// Proved when certified: the isotopy moves no point of the complex further, so both Hausdorff distances between
  /// complex and manifold are at most this (a length).
  double distance_bound = 0;
  /// k: largest proved |value that the tracer used - f|.
  std::vector<double> value_errors;
  /// Whether f is that of the text, not that of a program with rounded constants (Enclosure::has_exact_constants).
  bool has_exact_constants = false;
  double seconds = 0;

  bool is_certified() const { return verdict == Verdict::kCertified; }
};

/// Certifies a whole, closed trace of f = 0. f must enclose the function that was traced, and the triangulation be the
/// one of the trace; f's enclosures alone decide, the tracer's values being data. Time and memory are linear in the
/// number of simplices. Throws InvalidInput when dimensions do not fit.
IsotopyCertificate certify_trace(const Enclosure& f, const coxeter::Triangulation& triangulation,
                                 const TraceResult& trace, const CertifyOptions& options = {});

}  // namespace whitney
