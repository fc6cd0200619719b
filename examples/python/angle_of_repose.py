#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""A column of grains collapses into a heap, for several coefficients of friction: how steep it stays.

    angle_of_repose.py [--frictions 0.1 0.3 0.6] [--grains 8 16] [--plot heaps.png]

Grains don't rotate in Hooke, so they slide where real ones roll: heaps are steeper than of real grains of that friction.
"""
import argparse

import numpy as np

import hooke

RADIUS = 0.05


def scene(friction, wide, high):
    """A column `wide` by `high` grains in the middle of a floor, four grains thick, periodic across."""
    thick, spacing = 4, 2.05 * RADIUS
    length = spacing * wide * 6
    return {
        "hooke": 1,
        "name": f"heap, friction {friction:g}",
        "time": {"step": 2e-4, "end": 3},
        "domain": {"min": [0, 0, 0], "max": [length, spacing * (high + 2), spacing * thick],
                   "walls": ["spring", "spring", "periodic"]},
        "materials": {"grain": {"radius": RADIUS, "mass": 0.1, "stiffness": 20000, "shear": 8, "damping": 4,
                                "friction": friction, "tension": False, "color": "#d8b06a"}},
        "particles": [{"material": "grain",
                       "block": {"min": [(length - spacing * wide) / 2, RADIUS, RADIUS],
                                 "max": [(length + spacing * wide) / 2 - RADIUS, spacing * high, spacing * thick - RADIUS],
                                 "spacing": spacing, "jitter": 0.1 * RADIUS, "seed": 1}}],
    }


def slope(x, middle):
    """The angle of the heap's flanks, degrees: a line through the highest grains of each strip."""
    away, height = np.abs(x[:, 0] - middle), x[:, 1]
    strips = np.floor(away / (2 * RADIUS)).astype(int)
    top = np.array([height[strips == k].max() if (strips == k).any() else 0 for k in range(strips.max() + 1)])
    flank = np.flatnonzero(top > 1.5 * RADIUS)
    if len(flank) < 2:
        return 0.0
    fall = np.polyfit((flank + 0.5) * 2 * RADIUS, top[flank], 1)[0]
    return float(np.degrees(np.arctan(-fall)))


def heap(friction, wide, high):
    """Positions of the grains at rest, and the angle."""
    sim = hooke.Simulation.from_dict(scene(friction, wide, high))
    sim.step(sim.end_step)
    x = sim.snapshot().x
    return x, slope(x, 0.5 * sim.scene["domain"]["max"][0])


def main(argv=None):
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--frictions", type=float, nargs="+", default=[0.1, 0.3, 0.6])
    arguments.add_argument("--grains", type=int, nargs=2, default=[8, 16], metavar=("WIDE", "HIGH"))
    arguments.add_argument("--plot", help="draw the heaps into this file")
    options = arguments.parse_args(argv)
    heaps = [heap(friction, *options.grains) for friction in options.frictions]
    for friction, (x, angle) in zip(options.frictions, heaps):
        print(f"friction {friction:g}: {len(x)} grains, {angle:.1f} degrees")
    if options.plot:
        import matplotlib.pyplot as plt

        _, axes = plt.subplots(len(heaps), sharex=True, squeeze=False)
        for axis, friction, (x, angle) in zip(axes[:, 0], options.frictions, heaps):
            axis.scatter(x[:, 0], x[:, 1], s=4)
            axis.set_aspect("equal")
            axis.set_title(f"friction {friction:g}: {angle:.1f} degrees")
        plt.tight_layout()
        plt.savefig(options.plot)
    return [angle for _, angle in heaps]


if __name__ == "__main__":
    main()
