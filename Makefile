# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
#
# Short names for CMake's presets; each target first installs the Debian packages that it needs.

PREFIX ?= /usr/local
JOBS ?= $(shell nproc)
# How make run and make bench call the program, e.g. make run RUN_ARGS="--steps 200"
RUN_ARGS ?=
BENCH_ARGS ?=

.DEFAULT_GOAL := help
.PHONY: help python run gallery docs test sanitize soak fuzz package build build-all bench format lint install clean setup setup-docs setup-test setup-python setup-lint setup-soak setup-bench setup-fuzz setup-package

help:  ## this list
	@grep -hE '^[a-z]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:[^#]*##/\t/' | expand -t 12

run: build  ## build, run the dam break of 512,000 particles into out/water, and film it
	@echo "Running scenes/water.json: a dam break of 512,000 particles, and filming it (Ctrl-C stops it cleanly)."
	@mkdir -p out
	build/hooke run scenes/water.json -o out/water --overwrite --film out/water.mp4 $(RUN_ARGS)
	@build/hooke info out/water
	@echo "Made:"
	@echo "  out/water.mp4                   the film; one second of it is one second of the scene"
	@echo "  out/water/particles.vtkhdf      every snapshot; open it in ParaView 5.12 or later, or hooke export it"
	@echo "  out/water/series.csv            energy, momentum, overlap over time"
	@echo "  out/water/report.json, log.txt  what happened, and how; checkpoint.h5: its end, to go on from"
	@echo "Another view of it: build/hooke render out/water -o out/speed.mp4 --color-by speed"

gallery: build  ## run every scene and draw a picture of each into docs/gallery.md
	tools/gallery.sh

docs: setup-docs  ## make the documentation site: site/index.html
	@tools/make_docs.sh

test: setup-test  ## build with assertions, run every test but the long ones
	tools/test.sh

sanitize: setup-test  ## the tests again that address and thread sanitizers can make fail
	tools/test.sh sanitize

soak: setup-soak  ## hours: the long tests, lint, and everything under sanitizers
	tools/lint.sh
	tools/test.sh soak
	tools/compare_builds.sh build-dev/hooke build-clang/hooke
	tools/package.sh
	tools/package.sh test

fuzz: setup-fuzz  ## feed readers with changed inputs, FUZZ_SECONDS (60) each
	tools/fuzz.sh

package: setup-package  ## make Debian packages: build/packages
	tools/package.sh

build: setup  ## release build: build/hooke
	@cmake --preset release >/dev/null
	@cmake --build --preset run -j $(JOBS)

build-all: setup  ## release build of the program, the libraries and the benchmarks
	@cmake --preset release >/dev/null
	@cmake --build --preset release -j $(JOBS)

python: setup-python  ## release build of the Python module: PYTHONPATH=build/python
	@cmake --preset release >/dev/null
	@cmake --build --preset python -j $(JOBS)

bench: build-all setup-bench  ## measure this machine, a quarter of an hour, for docs/performance.md; or BENCH_ARGS=--quick
	bench/run_benchmarks $(BENCH_ARGS)

format: setup-lint  ## format all sources
	tools/lint.sh format

lint: setup-lint  ## check the format, clang-tidy, and a build with Clang 19
	tools/lint.sh

install: build-all  ## install program, library, headers and scenes below PREFIX
	cmake --install build --prefix $(PREFIX)

clean:  ## remove every build folder and the site
	rm -rf build build-docs site build-dev build-clang build-asan build-asan-everything build-tsan build-tsan-everything build-aarch64 build-fuzz

setup:
	@tools/setup.sh

setup-docs:
	@tools/setup.sh docs

setup-test:
	@tools/setup.sh test

setup-package:
	@tools/setup.sh package

setup-python:
	@tools/setup.sh python

setup-lint:
	@tools/setup.sh lint

setup-soak:
	@tools/setup.sh soak

setup-bench:
	@tools/setup.sh bench

setup-fuzz:
	@tools/setup.sh fuzz
