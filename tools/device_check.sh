#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
#
# tools/device_check.sh build      builds what a machine with a GPU needs for the checks, into build-device: programs that
#                                  need no library that is not part of the system or of CUDA
# tools/device_check.sh run [OUT]  on that machine: the bits of all scenes of the tests, the checkers of memory, of
#                                  uninitialised memory and of warps on some of them, and the rates of the benchmark, as OUT/gpu.csv (build-device);
#                                  at most 8 minutes
set -euo pipefail
cd "$(dirname "$0")/.."

case "${1:-}" in
  build)
    cmake -B build-device -G Ninja -D CMAKE_BUILD_TYPE=Release -D HOOKE_COMPONENTS=core -D HOOKE_WITH_TBB=OFF -D HOOKE_CUDA=ON \
      -D HOOKE_INSTALL=OFF -D CMAKE_EXE_LINKER_FLAGS="-static-libstdc++ -static-libgcc" >/dev/null
    cmake --build build-device -j "$(nproc)" --target device_test device_bench
    ;;
  run)
    out=${2:-build-device}
    mkdir -p "$out"
    nvidia-smi --query-gpu=name,driver_version,memory.total --format=csv,noheader | tee "$out/device.txt"
    failed=0
    timeout 120 build-device/tests/device/device_test --gtest_brief=1 || failed=1
    if command -v compute-sanitizer >/dev/null; then
      some='*colliders_open:*surfaces_periodic:*boundaries_open_open_open'
      for tool in memcheck initcheck synccheck; do
        timeout 60 compute-sanitizer --tool "$tool" --error-exitcode 1 build-device/tests/device/device_test \
          --gtest_filter="$some" --gtest_brief=1 >"$out/$tool.txt" 2>&1 || { echo "$tool: see $out/$tool.txt"; failed=1; }
      done
    else
      echo "compute-sanitizer is not here: memory and warps are not checked"
    fi
    timeout 240 build-device/tests/device/device_bench "$out/gpu.csv" || failed=1
    exit "$failed"
    ;;
  *)
    echo "usage: tools/device_check.sh build | run [OUT]" >&2
    exit 2
    ;;
esac
