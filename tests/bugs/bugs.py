# SPDX-License-Identifier: GPL-3.0-or-later
"""Bugs that a test must catch. Each breaks one promise of the library.

A bug is a list of edits (file, text, replacement), the executable of a test, its source and its filter. A text must be found exactly
once in its file, so that a bug that no longer applies says so: then find the place that keeps the promise today, and put
the bug there. The file may be a glob pattern, for code that moves: the text must be found once in all files together.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Bug:
    name: str
    promise: str
    edits: tuple  # of (file or pattern, text, replacement)
    test: str  # coxeter, perturbation or whitney: the executable
    source: str  # the file of the test is SOURCE_test.cc
    filter: str


BUGS = (
    Bug(
        "skip_set_flag",
        "a cofacet that was crossed is known on both its sides",
        (("whitney/tracing/*.cc", "  simplices_.set_flag(id, step.over.flag);\n", ""),),
        "whitney",
        "boundary_trace",
        "Boundary.OctantOfTheSphere*:Boundary.CurvesWithEnds",
    ),
    Bug(
        "less_for_less_equal_in_the_ratio_test",
        "a tie of two ratios is broken by the powers of eps, never by the order of the rows",
        (("whitney/tracing/exact_pivot.cc", "    if (order < 0) {\n", "    if (order <= 0) {\n"),),
        "whitney",
        "exact_pivot",
        "ExactPivot.*",
    ),
    Bug(
        "target_zero_instead_of_eps",
        "the complex is that of f = (eps, .., eps^k)",
        (
            (
                "whitney/tracing/exact_pivot.cc",
                "    while (system.inverse(r, l) == 0) ++l;  // a row of an inverse is not zero\n",
                "    if (system.inverse(r, l) == 0) continue;\n",
            ),
        ),
        "whitney",
        "exact_pivot",
        "ExactPivot.*",
    ),
    Bug(
        "height_without_eta",
        "(A+) counts the errors of the foot",
        (
            (
                "perturbation/certificate_proof.cc",
                "(R_c_ + sqrt(R_c_ * R_c_ - squared)) + Interval(eta_[i]));",
                "(R_c_ + sqrt(R_c_ * R_c_ - squared)));",
            ),
        ),
        "perturbation",
        "proof_ingredients",
        "Errors.*",
    ),
    Bug(
        "condition_C_dropped",
        "no second sheet of the manifold is in a certified simplex",
        (
            ("perturbation/certificate.cc", "    if (!(height < far * far)) return margins;\n", "    (void)far;\n"),
            (
                "perturbation/certificate_proof.cc",
                "    return std::all_of(height_.begin(), height_.end(), [&](const Interval& h) { return h.sup() < far.inf(); });\n",
                "    return far.inf() > 0;\n",
            ),
        ),
        "perturbation",
        "certificate",
        "Certificate.EachConditionCanFail",
    ),
    Bug(
        "rounding_guard_off",
        "the proof is in interval arithmetic, and hands the rounding mode back",
        (("perturbation/certificate_proof.cc", "  const Rounding rounding;\n  Attempt(", "  Attempt("),),
        "perturbation",
        "proof_ingredients",
        "RoundingGuard.*",
    ),
    Bug(
        "kernel_gamma_over_100",
        "the residual is bounded with what its own rounding may hide",
        (
            (
                "whitney/tracing/barycentric_kernel.cc",
                "    const double gamma = 4 * (n + 3) * kUnitRoundoff;\n    for (int l",
                "    const double gamma = 0.04 * (n + 3) * kUnitRoundoff;\n    for (int l",
            ),
            (
                "whitney/tracing/barycentric_kernel.cc",
                "    const double gamma = 4 * (n + 3) * kUnitRoundoff;\n    const Lanes rounding",
                "    const double gamma = 0.04 * (n + 3) * kUnitRoundoff;\n    const Lanes rounding",
            ),
        ),
        "whitney",
        "kernel_bounds",
        "KernelBounds.*",
    ),
    Bug(
        "is_complete_always_true",
        "a cell of a stopped trace is whole or not there",
        (("whitney/cells/*.cc", "  if (cell_dim == 1) return cell_facets.size() == 2;\n", "  if (cell_dim >= 1) return true;\n"),),
        "whitney",
        "cell_complex",
        "CellComplex.AStoppedTrace*",
    ),
    Bug(
        "strata_joined_across_sets",
        "a stratum holds the cells with one set of inequalities",
        (("whitney/cells/strata.cc", "    if (s == t) partition.join(", "    partition.join("),),
        "whitney",
        "boundary_trace",
        "Boundary.OctantOfTheSphere*",
    ),
    Bug(
        "second_sign_of_a_ridge",
        "the two facets around a ridge induce opposite signs on it",
        (
            (
                "whitney/topology/chain_complex.cc",
                "-sign[p] * signs[j - 1][e] * signs[j - 1][back];",
                "-sign[p] * signs[j - 1][e] * signs[j - 1][e];",
            ),
        ),
        "whitney",
        "chain_complex",
        "ChainComplex.*",
    ),
    Bug(
        "commit_without_rename",
        "a file that was committed is there under its name",
        (("whitney/io/atomic_file.cc", "  if (::rename(temporary_.c_str(), final_.c_str()) != 0) fail(errno);\n", ""),),
        "whitney",
        "atomic_file",
        "AtomicFileTest.AppearsOnCommitOnly",
    ),
    Bug(
        "region_ignored_in_certify",
        "a walk that keeps to a region is certified away from its boundary",
        (("perturbation/*.cc", "trace_.region && !trace_.region(near_, other)", "false"),),
        "whitney",
        "triangulate",
        "Triangulate.APartNearADomainIsCertifiedByItself",
    ),
)
