#!/usr/bin/env bash
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
#
# Builds the documentation site into site/: pages by MkDocs, the API of the public headers by Doxygen. Fails on a warning.
set -euo pipefail
cd "$(dirname "$0")/.."

pages=build-docs/pages
rm -rf build-docs site
mkdir -p "$pages"
cp -r ./*.md LICENSE docs scenes schema "$pages"
cp apps/view/hooke.svg "$pages/hooke.svg"
# MkDocs wants the name of a block of code as an attribute: ```python speeds.py
sed -i -E 's/^```([a-z]+) (\S+\.\S+)$/``` { .\1 title="\2" }/; s/^```sh fails$/```sh/; s/^```jsonc/```js/' "$pages"/*.md "$pages"/docs/*.md

# The public headers: those that the lists of sources name so.
public_headers=$(for list in src/CMakeLists.txt src/*/CMakeLists.txt src/*/*/CMakeLists.txt; do
  awk -v folder="$(dirname "$list")" '/LINKS/ { on = 0 } /PUBLIC_HEADERS/ { on = 1 }
    on { for (i = 1; i <= NF; ++i) if ($i ~ /[.]h$/) print folder "/" $i }' "$list"
done)
{ cat tools/Doxyfile; echo "INPUT = tools/api_main_page.md " $public_headers; } | doxygen -
mv build-docs/api/html "$pages/api"
mkdocs build --quiet
echo "Made site/index.html"
