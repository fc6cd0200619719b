#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""A controller plays keepie-uppie: it moves a paddle under a ball and strikes so that it always flies equally high.

    paddle.py [--seconds 10] [--plot ball.png]
"""
import argparse

import numpy as np

import hooke

STEP, GRAVITY, RADIUS, TOP = 5e-4, 9.8, 0.08, 1.5
PADDLE = np.array([0.0, 0.5, 0.0])  # its middle in the scene, m
HALF = np.array([0.25, 0.05, 0.25])  # half its size, m


def scene():
    return {
        "hooke": 1,
        "name": "paddle",
        "time": {"step": STEP, "end": 10},
        "gravity": [0, -GRAVITY, 0],
        "domain": {"min": [-2, 0, -2], "max": [2, 4, 2]},
        "materials": {"ball": {"radius": RADIUS, "mass": 0.2, "stiffness": 4000, "damping": 3, "color": "#e4453a"}},
        "colliders": [{"name": "paddle", "shape": {"box": {"min": (PADDLE - HALF).tolist(),
                                                           "max": (PADDLE + HALF).tolist()}}}],
    }


def command(x, v, middle):
    """The velocity that the paddle should have, m/s: stay under the ball, and rise where it comes down too slowly."""
    energy = GRAVITY * (TOP - x[1]) - 0.5 * v[1] ** 2  # what a flight to the top lacks, J/kg
    level = np.clip(12 * (x - middle) + v, -4, 4)
    strike = v[1] < 0 and x[1] - middle[1] < 0.25
    rise = np.clip(0.6 + 0.35 * energy, 0, 3) if strike else 6 * (PADDLE[1] - middle[1])
    return np.array([level[0], rise, level[2]])


def play(seconds):
    """Places of the ball over time, m: (n, 3), one a millisecond."""
    sim = hooke.Simulation.from_arrays(scene(), [[0.05, TOP, 0]], [0.1, 0, -0.05])
    middle, track = PADDLE.copy(), []
    while sim.time < seconds:
        now = sim.snapshot()
        velocity = command(now.x[0], now.v[0], middle)
        middle = middle + 2 * STEP * velocity
        # The paddle is led: it stands where it is put, and what touches it feels the velocity.
        for k in (1, 2):
            sim.move_collider("paddle", position=middle - PADDLE - (2 - k) * STEP * velocity, velocity=velocity)
            sim.step()
        track.append(now.x[0])
    return np.array(track)


def main(argv=None):
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--seconds", type=float, default=10)
    arguments.add_argument("--plot", help="draw the ball's height into this file")
    options = arguments.parse_args(argv)
    track = play(options.seconds)
    height = track[:, 1]
    tops = height[1:-1][(height[1:-1] > height[:-2]) & (height[1:-1] >= height[2:])]
    print(f"{len(tops)} flights in {options.seconds:g} s, their tops: "
          f"{tops.mean():.2f} m on average, {tops.min():.2f} to {tops.max():.2f} m")
    if options.plot:
        import matplotlib.pyplot as plt

        plt.plot(2 * STEP * np.arange(len(height)), height)
        plt.axhline(TOP, color="grey", linewidth=0.5)
        plt.xlabel("time (s)")
        plt.ylabel("height of the ball (m)")
        plt.savefig(options.plot)
    return tops


if __name__ == "__main__":
    main()
