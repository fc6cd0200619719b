#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""A controller plays keepie-uppie: it moves a paddle under a ball and strikes so that it always flies equally high.

    paddle.py [--seconds 10] [--plot ball.png]
"""
import argparse

import numpy as np

import hooke

STEP, GRAVITY, TOP = 5e-4, 9.8, 1.5
RADIUS, MASS, STIFFNESS, DAMPING = 0.08, 0.2, 4000, 3  # of the ball
PADDLE = np.array([0.0, 0.5, 0.0])  # its middle in the scene, m
HALF = np.array([0.25, 0.05, 0.25])  # half its size, m


def scene():
    return {
        "hooke": 1,
        "name": "paddle",
        "time": {"step": STEP, "end": 10},
        "gravity": [0, -GRAVITY, 0],
        "domain": {"min": [-2, 0, -2], "max": [2, 4, 2]},
        "materials": {"ball": {"radius": RADIUS, "mass": MASS, "stiffness": STIFFNESS, "damping": DAMPING,
                               "color": "#e4453a"}},
        "colliders": [{"name": "paddle", "shape": {"box": {"min": (PADDLE - HALF).tolist(),
                                                           "max": (PADDLE + HALF).tolist()}}}],
    }


class Controller:
    """Says how the paddle should move. It follows the ball, meets it with the speed that sends it to TOP, and pushes it
    back towards the middle, by what it knows of the contact law."""

    def __init__(self):
        zeta = DAMPING / (2 * np.sqrt(STIFFNESS * MASS))
        self.restitution = np.exp(-np.pi * zeta / np.sqrt(1 - zeta**2))
        self.grip = 1 - np.exp(-np.pi * DAMPING / np.sqrt(STIFFNESS * MASS))  # how far a ball takes on the level speed
        self.stroke = None  # the velocity of the stroke that is going on

    def velocity(self, x, v, middle):
        """The paddle's velocity, m/s, for a ball at x (m) that moves at v."""
        gap = x[1] - middle[1] - HALF[1] - RADIUS
        if self.stroke is not None and gap > 0 and v[1] > 0:
            self.stroke = None  # the ball has left
        meets = np.sqrt(max(v[1] ** 2 + 2 * GRAVITY * gap, 0))  # the speed at which it will arrive
        if self.stroke is None and v[1] < 0 and gap < 0.03 * meets:
            leaves = np.sqrt(2 * GRAVITY * (TOP - RADIUS - HALF[1] - middle[1]))
            rise = (leaves - self.restitution * meets) / (1 + self.restitution)
            wanted = -0.5 * x  # level: back to the middle within two seconds
            level = v + (wanted - v) / self.grip
            self.stroke = np.clip([level[0], rise, level[2]], -2, 2)
        if self.stroke is not None:
            return self.stroke
        follow = np.clip(12 * (x - middle) + v, -4, 4)
        return np.array([follow[0], 6 * (PADDLE[1] - middle[1]), follow[2]])


def play(seconds):
    """Places of the ball over time, m: (n, 3), one a millisecond."""
    sim = hooke.Simulation.from_arrays(scene(), [[0.05, TOP, 0]], [0.1, 0, -0.05])
    controller, middle, track = Controller(), PADDLE.copy(), []
    while sim.time < seconds:
        now = sim.snapshot()
        velocity = controller.velocity(now.x[0], now.v[0], middle)
        # The paddle is led: it stands where it is put, and what touches it feels the velocity.
        for _ in range(2):
            middle = middle + STEP * velocity
            sim.move_collider("paddle", position=middle - PADDLE, velocity=velocity)
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
