#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
#
# tools/test.sh            the format, and every test but the long ones, in one build with assertions
# tools/test.sh sanitize   what reads, lists and stores under the address sanitizer, what runs on several threads under
#                          the thread sanitizer
# tools/test.sh soak       the long tests, everything but those under the sanitizers, and the engine on another processor
set -euo pipefail
cd "$(dirname "$0")/.."
jobs=$(nproc)

build_and_test() {  # NAME OF THE TEST'S PRESET, NAMES OF THE CONFIGURATION'S AND THE BUILD'S WHERE THEY DIFFER
  echo "== $1"
  cmake --preset "${2:-$1}" >/dev/null
  cmake --build --preset "${3:-$1}" -j "$jobs"
  ctest --preset "$1" -j "$jobs"
}

case "${1:-}" in
  "")
    tools/lint.sh format-check
    build_and_test dev
    ;;
  sanitize)
    build_and_test asan
    build_and_test tsan
    ;;
  soak)
    build_and_test soak dev soak
    build_and_test asan-everything
    ctest --preset asan-soak
    build_and_test tsan-everything
    build_and_test aarch64
    ;;
  *)
    echo "usage: tools/test.sh [sanitize|soak]" >&2
    exit 2
    ;;
esac
