#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""Balls of different damping fall on a floor: the restitution of the contact law, measured and predicted.

    bouncing_balls.py [--plot heights.png]
"""
import argparse

import numpy as np

import hooke

STIFFNESS, MASS, RADIUS, STEP = 4000.0, 0.1, 0.05, 1e-4


def restitution(damping):
    """Speed after an impact over the speed before, of a spring and a dashpot that may pull (docs/theory.md)."""
    zeta = damping / (2 * np.sqrt(STIFFNESS * MASS))
    return np.exp(-np.pi * zeta / np.sqrt(1 - zeta**2))


def bounce(dampings, seconds):
    """Heights of the balls over time, m: (steps, balls)."""
    material = {"radius": RADIUS, "mass": MASS, "stiffness": STIFFNESS, "color": "#e4453a"}
    scene = {
        "hooke": 1,
        "name": "bouncing balls",
        "time": {"step": STEP, "end": seconds},
        "precision": "double",
        "domain": {"min": [0, 0, 0], "max": [0.3 * len(dampings), 2, 0.3]},
        "materials": {f"damping {d:g}": {**material, "damping": d} for d in dampings},
    }
    x = [[0.15 + 0.3 * k, 1, 0.15] for k in range(len(dampings))]
    sim = hooke.Simulation.from_arrays(scene, x, material=list(scene["materials"]))
    heights = []
    while sim.time < seconds:
        sim.step(10)
        heights.append(sim.snapshot().x[:, 1] - RADIUS)
    return np.array(heights)


def main(argv=None):
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--plot", help="draw the heights into this file")
    options = arguments.parse_args(argv)
    dampings = np.array([0.5, 2, 4, 8])
    heights = bounce(dampings, 1.2)
    # The highest point between the first impact and the second: e^2 times the height of the fall.
    fall = 1 - RADIUS
    first = (heights < 0).argmax(axis=0)
    rebound = np.array([heights[k:, ball].max() for ball, k in enumerate(first)])
    measured, predicted = np.sqrt(rebound / fall), restitution(dampings)
    for line in zip(dampings, measured, predicted):
        print("damping {:4.1f} N s/m: restitution {:.3f}, predicted {:.3f}".format(*line))
    if options.plot:
        import matplotlib.pyplot as plt

        plt.plot(1e-3 * np.arange(1, len(heights) + 1), heights, label=[f"{d:g} N s/m" for d in dampings])
        plt.xlabel("time (s)")
        plt.ylabel("height above the floor (m)")
        plt.legend()
        plt.savefig(options.plot)
    return measured, predicted


if __name__ == "__main__":
    main()
