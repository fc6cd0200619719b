#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
#
# check_module.sh MODULE: in the device code of hooke-cuda.so, which a build with tests leaves readable, each operation is
# rounded once.
set -euo pipefail
module=$1
for operation in mul.rn.f32 sqrt.rn.f32 div.rn.f32 mul.rn.f64 sqrt.rn.f64 div.rn.f64; do
  grep -qaF "$operation" "$module" || { echo "there is no $operation in $module: is this its device code?"; exit 1; }
done
if grep -aoE '(fma|[a-z]+\.approx|[a-z.]+\.ftz)\.[a-z0-9.]+' "$module" | sort | uniq -c | grep .; then
  echo "these are not rounded as the processor rounds"
  exit 1
fi
