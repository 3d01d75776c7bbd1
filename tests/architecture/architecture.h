// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace whitney::architecture {

/// A line that breaks a rule of the house, as "file:line: what is wrong".
using Violation = std::string;

/// Checks the sources (.h, .cc) under root/{coxeter,perturbation,whitney}, comments aside, against these rules:
///
/// 1. Includes point down: coxeter <- perturbation <- whitney <- whitney/io <- whitney/cli. Headers in
///    whitney/io/internal are for whitney/io alone.
/// 2. No header includes itself by way of others.
/// 3. Files and their formats are known to whitney/io and whitney/cli only: nowhere else OpenMesh, nlohmann, a file
///    stream, or a string that ends in the extension of a format.
/// 4. No header outside whitney/cli includes CGAL, GiNaC, OpenMesh or nlohmann: what a user includes brings in neither
///    their licences nor their build.
///
/// Sorted. Throws std::runtime_error if root has none of the three folders.
std::vector<Violation> check_architecture(const std::filesystem::path& root);

/// The text without its comments: blanks in their place, line breaks kept.
std::string without_comments(const std::string& text);

}  // namespace whitney::architecture
