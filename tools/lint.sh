#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
#
# tools/lint.sh                format, clang-tidy of libraries and program, and a build with Clang 19 of everything
# tools/lint.sh format         rewrite the sources in the format of .clang-format
# tools/lint.sh format-check   say which sources are not in it
set -euo pipefail
cd "$(dirname "$0")/.."
mapfile -t sources < <(git ls-files --cached --others --exclude-standard -- '*.h' '*.cpp' '*.inl')

case "${1:-all}" in
  format) clang-format-19 -i "${sources[@]}" ;;
  format-check) clang-format-19 --dry-run -Werror "${sources[@]}" ;;
  all)
    clang-format-19 --dry-run -Werror "${sources[@]}"
    cmake --preset clang >/dev/null
    cmake --build --preset clang -j "$(nproc)"
    run-clang-tidy-19 -quiet -p build-clang -j "$(nproc)" "^$PWD/(src|apps)/" 2>/dev/null
    ;;
  *)
    echo "usage: tools/lint.sh [format|format-check]" >&2
    exit 2
    ;;
esac
