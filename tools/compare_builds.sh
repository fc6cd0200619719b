#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
#
# tools/compare_builds.sh PROGRAM OTHER [STEPS]    runs every scene of the gallery with two builds of hooke for so many
#                                                  steps (200), and says where their state hashes differ
set -euo pipefail
cd "$(dirname "$0")/.."
if (($# < 2)); then
  echo "usage: tools/compare_builds.sh PROGRAM OTHER [STEPS]" >&2
  exit 2
fi
steps=${3:-200}

hash_of() {  # PROGRAM SCENE
  "$1" bench "$2" --warmup 0 --steps "$steps" --json | python3 -c 'import json, sys; print(json.load(sys.stdin)["state_hash"])'
}

differ=0 scenes=0
for scene in scenes/*.json; do
  [[ $scene == *-big.json ]] && continue
  a=$(hash_of "$1" "$scene")
  b=$(hash_of "$2" "$scene")
  scenes=$((scenes + 1))
  if [[ $a != "$b" ]]; then
    echo "$scene: $a and $b after $steps steps"
    differ=1
  fi
done
((differ == 0)) && echo "$scenes scenes have the same state hash after $steps steps in both builds"
exit "$differ"
