# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""Small scenes, and what tests of the Python module have in common."""
import os
import pathlib
import subprocess
import tempfile
import unittest

import hooke

ROOT = pathlib.Path(__file__).resolve().parents[2]
BALL_PIT = ROOT / "scenes" / "ball-pit.json"
PROGRAM = os.environ.get("HOOKE", str(ROOT / "build" / "hooke"))


def box(**changes):
    """27 balls above the floor of a box, and a collider."""
    scene = {
        "hooke": 1,
        "name": "box",
        "time": {"step": 0.001, "end": 0.2},
        "domain": {"min": [0, 0, 0], "max": [2, 2, 2]},
        "materials": {"rubber": {"radius": 0.05, "mass": 0.5, "stiffness": 5000, "shear": 1, "damping": 5}},
        "particles": [{"material": "rubber",
                       "block": {"min": [0.5, 0.06, 0.5], "max": [0.7, 0.26, 0.7], "spacing": 0.1}}],
        "colliders": [{"name": "ball", "shape": {"sphere": {"center": [1.5, 1.5, 1.5], "radius": 0.2}}}],
        "output": {"every": 0.05},
    }
    scene.update(changes)
    return scene


def rules(**changes):
    """Two materials in a box without gravity and without particles."""
    materials = {"light": {"radius": 0.05, "mass": 1, "stiffness": 1000},
                 "heavy": {"radius": 0.1, "mass": 4, "stiffness": 1000}}
    return box(gravity=[0, 0, 0], materials=materials, particles=[], precision="double", **changes)


def simulation(scene=None, **options):
    return hooke.Simulation.from_dict(scene or box(), threads=1, **options)


def program(*words, **options):
    """What the program prints; fails where it fails."""
    done = subprocess.run([PROGRAM, *map(str, words)], check=True, capture_output=True, text=True, **options)
    return done.stdout


class FolderTest(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="hooke_python_")
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
