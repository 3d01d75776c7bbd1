#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# All tests, from a bare machine: installs what is missing, configures, builds, runs.
set -eu
root="$(cd "$(dirname "$0")/.." && pwd)"
sh "$root/cmake/bootstrap.sh"
cd "$root"
cmake --preset release
cmake --build --preset release
ctest --preset release -j "$(nproc)"
