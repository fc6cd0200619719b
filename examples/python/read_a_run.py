#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""Reads a run folder with numpy only: how the particles of each material mix, and where the energy went.

    read_a_run.py out/mixed          a folder that `hooke run` has written
"""
import argparse

import numpy as np

import hooke


def heights(run):
    """Mean height of each material over the snapshots, m: (snapshots, materials)."""
    rows = []
    for snapshot in run:
        count = np.bincount(snapshot.material, minlength=len(run.materials))
        total = np.bincount(snapshot.material, snapshot.x[:, 1], minlength=len(run.materials))
        rows.append(total / np.maximum(count, 1))
    return np.array(rows)


def main(argv=None):
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("run", help="a run folder")
    options = arguments.parse_args(argv)
    run = hooke.Run(options.run)
    print(f"{run!r}: {run.particle_counts[-1]} particles, {run.times[0]:g} to {run.times[-1]:g} s")
    table = heights(run)
    for name, start, end in zip(run.materials, table[0], table[-1]):
        print(f"  {name}: mean height {start:.3g} m at the start, {end:.3g} m at the end")
    last = run[-1]
    speed = np.linalg.norm(last.v, axis=1)
    print(f"  speeds at the end: half below {np.median(speed):.3g} m/s, the fastest {speed.max():.3g} m/s,"
          f" particle {last.id[speed.argmax()]}")
    kinetic = run.series["kinetic"]
    print(f"  kinetic energy: at most {kinetic.max():.3g} J, at {run.series['t'][kinetic.argmax()]:g} s")
    return table


if __name__ == "__main__":
    main()
