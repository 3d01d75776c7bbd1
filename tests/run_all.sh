#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# All tests, from a bare machine: installs what is missing, configures, builds, runs.
# WHITNEY_CMAKE_OPTIONS: more arguments for cmake.
set -eu
root="$(cd "$(dirname "$0")/.." && pwd)"
sh "$root/cmake/bootstrap.sh"
cd "$root"
# shellcheck disable=SC2086
cmake --preset release ${WHITNEY_CMAKE_OPTIONS:-}
cmake --build --preset release
ctest --preset release -j "$(nproc)"
