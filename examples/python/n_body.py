#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""A disc of stars around a heavy core, seen from above; its energy and angular momentum as they should be: constant.

    n_body.py [--stars 300] [--orbits 1] [--plot disc.png]
"""
import argparse

import numpy as np

import hooke


def disc(stars, seed=1):
    """Positions and velocities of a core of mass 1 and of light stars on circles around it; G = 1."""
    random = np.random.default_rng(seed)
    radius = np.sqrt(random.uniform(0.5**2, 2**2, stars))
    angle = random.uniform(0, 2 * np.pi, stars)
    around = np.stack([np.cos(angle), np.zeros(stars), np.sin(angle)], axis=1)
    along = np.stack([-np.sin(angle), np.zeros(stars), np.cos(angle)], axis=1)
    x = np.vstack([np.zeros(3), radius[:, None] * around])
    v = np.vstack([np.zeros(3), along / np.sqrt(radius)[:, None]])
    return x, v


def scene(stars, seconds):
    star = {"radius": 0.01, "stiffness": 0, "interacts": False}
    return {
        "hooke": 1,
        "name": "disc",
        "time": {"step": 0.005, "end": seconds, "integrator": "velocity-verlet"},
        "precision": "double",
        "gravity": [0, 0, 0],
        "domain": {"min": [-8, -8, -8], "max": [8, 8, 8], "walls": "open"},
        "attraction": {"G": 1, "softening": 0.05},
        "materials": {"core": {**star, "mass": 1, "color": "#ffd08a"},
                      "star": {**star, "mass": 0.05 / stars, "color": "#8db8ff"}},
    }


def main(argv=None):
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--stars", type=int, default=300)
    arguments.add_argument("--orbits", type=float, default=1, help="of stars at a distance of 1")
    arguments.add_argument("--plot", help="draw the disc into this file")
    options = arguments.parse_args(argv)
    seconds = 2 * np.pi * options.orbits
    x, v = disc(options.stars)
    sim = hooke.Simulation.from_arrays(scene(options.stars, seconds), x, v, material=["core"] + ["star"] * options.stars)

    def invariants():
        now, m = sim.snapshot(), sim.measure()
        mass = sim.masses[now.material][:, None]
        return m.kinetic_energy + m.attraction_energy, (mass * np.cross(now.x, now.v)).sum(axis=0)[1]

    start = invariants()
    frames = [sim.snapshot()]
    while sim.step_count < sim.end_step:
        sim.step(min(sim.end_step - sim.step_count, max(1, sim.end_step // 3)))
        frames.append(sim.snapshot())
    drifts = [abs(now / before - 1) for before, now in zip(start, invariants())]
    print(f"{len(sim)} bodies, {sim.step_count} steps: energy changed by {drifts[0]:.1e} of it, "
          f"angular momentum by {drifts[1]:.1e}")
    if options.plot:
        import matplotlib.pyplot as plt

        figure, axes = plt.subplots(1, len(frames), figsize=(4 * len(frames), 4), sharey=True)
        for axis, frame in zip(axes, frames):
            axis.scatter(frame.x[1:, 0], frame.x[1:, 2], s=2, c=np.linalg.norm(frame.v[1:], axis=1))
            axis.set(aspect="equal", xlim=(-3, 3), ylim=(-3, 3), title=f"t = {frame.time:.2f}")
        figure.tight_layout()
        figure.savefig(options.plot)
    return drifts


if __name__ == "__main__":
    main()
