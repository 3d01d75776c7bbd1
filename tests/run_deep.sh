#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Everything that is too long for .ci/run: the whole suite under the sanitizers, every bug of tests/bugs, fuzzing, coverage. Hours on
# two cores. Goes on after a failure; the figures stand at the end, for CONTRIBUTING.md.
#
#   tests/run_deep.sh [SECONDS]      for each fuzz target; default 300
set -u
cd "$(dirname "$0")/.."
sh cmake/bootstrap.sh || exit 1
seconds="${1:-300}"
mkdir -p build/deep
status=0
step() {
  name="$1"
  shift
  begin="$(date +%s)"
  if "$@" >"build/deep/$name.log" 2>&1; then verdict=passed; else verdict=FAILED; status=1; fi
  printf '%-12s %s after %s s; %s\n' "$name" "$verdict" "$(($(date +%s) - begin))" "build/deep/$name.log" | tee -a build/deep/summary.txt
}
coverage() {
  cmake --preset coverage && cmake --build --preset coverage && ctest --preset coverage -j "$(nproc)"
  tests_passed=$?
  gcovr --root . --filter coxeter/ --filter perturbation/ --filter whitney/ --exclude-throw-branches --print-summary \
    --html-details build/deep/coverage.html build/coverage && return $tests_passed
}
{ date; git log -1 --format='commit %h'; } >build/deep/summary.txt
step tests sh tests/run_all.sh
step asan-ubsan tests/sanitize asan-ubsan
step tsan tests/sanitize ci-tsan
step bugs tests/bugs/run
step fuzz tests/fuzz/run "$seconds"
step coverage coverage
grep -h 'bugs caught' build/deep/bugs.log >>build/deep/summary.txt 2>/dev/null
grep -h 'inputs a second' build/deep/fuzz.log >>build/deep/summary.txt 2>/dev/null
grep -hE '^(lines|branches):' build/deep/coverage.log >>build/deep/summary.txt 2>/dev/null
cat build/deep/summary.txt
exit $status
