#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
#
# Runs every scene of scenes/ into out/gallery, draws one picture of each into docs/images, and writes docs/gallery.md.
#   tools/gallery.sh [NAME ...]   only these scenes; a run that is there already is not run again
set -euo pipefail
cd "$(dirname "$0")/.."
hooke=build/hooke

# What a picture shows best: the time of its moment (s), and more options of hooke render.
declare -A picture=(
  [avalanche]="--time 2.6"
  [ball-pit]="--time 0.95"
  [crowd]="--time 11"
  [drum]="--time 9"
  [fireworks]="--time 6.7"
  [flag]="--time 2"
  [fountain]="--time 6"
  [fracture]="--time 0.2"
  [galaxy]="--time 5.2"
  [glass]="--time 5 --size 854x480"
  [hourglass]="--time 7"
  [jelly]="--time 0.8"
  [mixed]="--time 2.4"
  [pillars]="--time 0.62 --size 960x540"
  [table-6.1]="--color-by height"
  [trampoline]="--time 0.6"
  [water]="--time 5.3"
  [wave-tank]="--time 2.6"
)
# How a scene is run where its own length would take long: the giant, with the longest step that is stable, and the
# galaxies, until the picture's moment.
declare -A run_options=(
  [galaxy]="--end 5.2"
  [table-6.1]="--set time.step=0.05 --end 160 --set output.every=20"
)

names=("$@")
if ((${#names[@]} == 0)); then
  for scene in scenes/*.json; do
    [[ $scene == *-big.json ]] || names+=("$(basename "$scene" .json)")
  done
fi
mkdir -p out/gallery docs/images
for name in "${names[@]}"; do
  run=out/gallery/$name
  # shellcheck disable=SC2086  # options, word by word
  [[ -e $run/report.json ]] || $hooke run "scenes/$name.json" -o "$run" --overwrite ${run_options[$name]:-}
  size="--size 1280x720"
  [[ ${picture[$name]:-} == *--size* ]] && size=
  # shellcheck disable=SC2086
  $hooke render "$run" -o "docs/images/$name.png" $size ${picture[$name]:-}
done

python3 - <<'PAGE'
import pathlib, re
page = ["# Gallery", "",
        "The scenes that come with Hooke, each with the picture that `make gallery` draws of it. `hooke run scenes/NAME.json "
        "--film NAME.mp4` makes the film.", ""]
for image in sorted(pathlib.Path("docs/images").glob("*.png"), key=lambda p: (p.stem != "water", p.stem)):
    file = pathlib.Path("scenes", image.stem + ".json")
    if not file.exists():
        continue  # a picture of something else
    text = file.read_text(encoding="utf-8")
    scene = {key: re.search(rf'^  "{key}": "([^"]*)"', text, re.M).group(1) for key in ("name", "description")}
    page += [f"## {scene['name']}", "", f"{scene['description']}. [scenes/{image.stem}.json](../scenes/{image.stem}.json)",
             "", f"![{scene['name']}](images/{image.name})", ""]
pathlib.Path("docs/gallery.md").write_text("\n".join(page), encoding="utf-8")
PAGE
