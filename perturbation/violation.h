// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <perturbation/perturbed_triangulation.h>

namespace whitney::perturbation {

/// A proof that a d-simplex of T~ does not see M the way the certificate needs.
struct Violation {
  enum class Kind {
    kTwoPointsOnFace,  ///< M crosses one k-face transversally in two points at least
    kMissesAllFaces    ///< M meets the simplex, and every one of its k-faces is empty
  };
  Kind kind;
  coxeter::Simplex simplex;
  std::vector<int> face;       ///< kTwoPointsOnFace: the vertices of the k-face (positions in the simplex)
  std::vector<double> points;  ///< 2 x d, points near the two; or d, a point of M in the simplex, up to its error
};

/// One sentence.
std::string describe(const Violation& violation);

struct ViolationOptions {
  std::size_t max_simplices = 30;       ///< how many simplices are examined
  std::size_t max_pieces = 400;         ///< pieces per face, and oracle calls
  std::size_t max_all_pieces = 20'000;  ///< of all faces together
};

/// Looks for a violation among the given simplices, in their order.
///
/// Two points: a k-face is bisected at its longest edge again and again; a piece whose own (k-1)-faces satisfy (A+) and
/// that is hit and satisfies (B) holds exactly one point of M (the sheet of its foot), in its interior. Two pieces are
/// two points; this rests on the reach and on the errors of the feet. No point: dist(x, M) is 1-Lipschitz, so a piece
/// about x with radius below dist(x, M) is empty; this is claimed only of oracles that promise feet proved to be the
/// closest points, with proven errors (see FootPromise): a local foot says nothing of the rest of M.
std::optional<Violation> find_violation(PerturbedTriangulation& near, std::span<const std::uint32_t> simplices,
                                        const ViolationOptions& options = {});

}  // namespace whitney::perturbation
