#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
#
# tools/fuzz.sh [NAME ...]    runs fuzzers, all of tests/fuzz or those named, FUZZ_SECONDS (60) each. What they learn is
#                             kept in build-fuzz/corpus; an input that makes one fail is left in build-fuzz/failures, and
#                             `build-fuzz/tests/fuzz/fuzz_NAME FILE` repeats it.
set -euo pipefail
cd "$(dirname "$0")/.."
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz -j "$(nproc)"
programs=build-fuzz/tests/fuzz

# Every key and every word of the schema, as scenes write them.
python3 - >build-fuzz/scene.dict <<'PYTHON'
import json
words = set()
def collect(node):
    if isinstance(node, dict):
        words.update(node.get("properties", {}) if isinstance(node.get("properties", {}), dict) else {})
        words.update(w for w in node.get("enum", []) if isinstance(w, str))
        for value in node.values():
            collect(value)
    elif isinstance(node, list):
        for value in node:
            collect(value)
collect(json.load(open("schema/scene.json")))
for word in sorted(words):
    print('"\\"%s\\""' % word)
PYTHON
"$programs"/write_fuzz_seeds build-fuzz/seeds

names=("$@")
if ((${#names[@]} == 0)); then
  for program in "$programs"/fuzz_*; do names+=("$(basename "$program" | sed s/fuzz_//)"); done
fi
export LSAN_OPTIONS=suppressions=tests/fuzz/leaks.supp:print_suppressions=0
failed=()
for name in "${names[@]}"; do
  corpus=build-fuzz/corpus/$name
  mkdir -p "$corpus" build-fuzz/failures
  seeds=()
  for folder in "tests/fuzz/seeds/$name" "build-fuzz/seeds/$name"; do [[ -d $folder ]] && seeds+=("$folder"); done
  [[ $name == scene ]] && seeds+=(scenes)
  dictionary=()
  case $name in
    scene | overrides) dictionary=(-dict=build-fuzz/scene.dict) ;;
    *) [[ -f tests/fuzz/dictionaries/$name.dict ]] && dictionary=("-dict=tests/fuzz/dictionaries/$name.dict") ;;
  esac
  echo "== $name"
  if ! "$programs/fuzz_$name" "$corpus" "${seeds[@]}" "${dictionary[@]}" -max_total_time="${FUZZ_SECONDS:-60}" \
    -timeout=20 -rss_limit_mb=2048 -malloc_limit_mb=512 -max_len=16384 -print_final_stats=1 \
    -artifact_prefix="build-fuzz/failures/$name-" >"build-fuzz/$name.log" 2>&1; then
    failed+=("$name")
    tail -40 "build-fuzz/$name.log"
  fi
  grep -E "stat::number_of_executed_units|stat::average_exec_per_sec|stat::peak_rss_mb" "build-fuzz/$name.log" || true
done
if ((${#failed[@]} > 0)); then
  echo "failed: ${failed[*]}; inputs are in build-fuzz/failures" >&2
  exit 1
fi
