#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what is missing, builds the program in build/release; the log goes to the file given.
#
#   sh cmake/build_program.sh LOG
set -eu
cd "$(dirname "$0")/.."
sh cmake/bootstrap.sh
{ cmake --preset release && cmake --build --preset release --target whitney_cli; } >"$1" 2>&1 ||
  { tail -n 30 "$1" >&2; echo "The build failed; the whole log is $1" >&2; exit 1; }
