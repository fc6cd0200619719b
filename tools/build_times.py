#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""Says where a build's time went, from Ninja's log: seconds of compiler and linker by folder, and the slowest files.

build_times.py BUILD [BUILD ...]     e.g. build-dev build-asan; of builds in new folders with CCACHE_DISABLE=1

Times are how long each job ran, so jobs that share a core count double: build with as many jobs as there are cores.
"""
import collections
import pathlib
import sys

SLOWEST = 12


def jobs_of(build):
    """{output: (start s, end s)} of each output's last job."""
    jobs = {}
    for line in (build / ".ninja_log").read_text(encoding="utf-8").splitlines()[1:]:
        start, end, _, output, _ = line.split("\t")
        jobs[output] = (int(start) / 1000, int(end) / 1000)
    return jobs


def folder_of(output):
    parts = output.split("/CMakeFiles/")[0].split("/")
    if parts[0] in ("src", "tests", "apps", "bench") and len(parts) > 1:
        depth = 3 if parts[:2] in (["src", "backends"], ["src", "render"]) and not parts[-1].endswith((".a", ".so")) else 2
        return "/".join(parts[:depth])
    return "programs" if "CMakeFiles" not in output else parts[0]


def report(build):
    jobs = jobs_of(build)
    seconds, count = collections.Counter(), collections.Counter()
    for output, (start, end) in jobs.items():
        seconds[folder_of(output)] += end - start
        count[folder_of(output)] += 1
    clock = max(end for _, end in jobs.values())
    print(f"{build}: {len(jobs)} jobs, {sum(seconds.values()):.0f} s of jobs; the last ended {clock:.0f} s after its ninja began")
    for folder, total in seconds.most_common():
        print(f"  {total:7.1f} s  {count[folder]:4}  {folder}")
    print("  slowest:")
    for output, (start, end) in sorted(jobs.items(), key=lambda job: job[1][0] - job[1][1])[:SLOWEST]:
        print(f"  {end - start:7.1f} s        {output}")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    for folder in sys.argv[1:]:
        report(pathlib.Path(folder))
