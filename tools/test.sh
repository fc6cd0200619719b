#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
#
# tools/test.sh        everything but the long tests: with assertions, then the sanitizer builds
# tools/test.sh soak   the long tests
set -euo pipefail
cd "$(dirname "$0")/.."
jobs=$(nproc)

build_and_test() {  # PRESET OF THE BUILD, PRESET OF THE TESTS
  echo "== $2"
  cmake --preset "$1" >/dev/null
  cmake --build --preset "$1" -j "$jobs"
  ctest --preset "$2" -j "$jobs"
}

if [[ "${1:-}" == soak ]]; then
  build_and_test dev soak
  exit
fi

tools/lint.sh format-check
build_and_test dev dev
build_and_test asan asan
build_and_test tsan tsan
