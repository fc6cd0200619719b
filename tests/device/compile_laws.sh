#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
#
# compile_laws.sh NVCC HOST_COMPILER SOURCES OUTPUT: device code of every law; each operation is rounded once.
set -euo pipefail
nvcc=$1 compiler=$2 sources=$3 output=$4
"$nvcc" -ccbin "$compiler" -std=c++20 -arch=sm_90 --fmad=false -Werror all-warnings \
  -Xcompiler=-ffp-contract=off,-Wall,-Wextra,-Werror -I "$sources/include" -ptx "$sources/tests/device/laws.cu" -o "$output"
grep -q 'mul\.rn\.f32' "$output" && grep -q 'sqrt\.rn\.f64' "$output"
if grep -nE 'fma|approx|ftz' "$output"; then
  echo "these are not rounded as the processor rounds" >&2
  exit 1
fi
