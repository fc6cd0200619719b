# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""The examples run, and what they find is right."""
import contextlib
import importlib.util
import io
import os
import re

import hooke
import numpy as np

import scenes


def load(name):
    file = scenes.ROOT / "examples" / "python" / f"{name}.py"
    spec = importlib.util.spec_from_file_location(name, file)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class Guide(scenes.FolderTest):
    def test_what_it_shows_runs(self):
        (self.folder / "scenes").symlink_to(scenes.ROOT / "scenes")
        here = os.getcwd()
        os.chdir(self.folder)
        self.addCleanup(os.chdir, here)
        for page in ("README.md", "docs/python.md"):
            blocks = re.findall(r"```python\n(.*?)```", (scenes.ROOT / page).read_text(), re.S)
            self.assertTrue(blocks, page)
            for block in blocks:
                with self.subTest(page=page, block=block), contextlib.redirect_stdout(io.StringIO()):
                    exec(compile(block, page, "exec"), {})


class Examples(scenes.FolderTest):
    def run_example(self, name, *words):
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            result = load(name).main([str(word) for word in words])
        self.assertTrue(printed.getvalue())
        return result

    def plot(self):
        return "--plot", self.folder / "plot.png"

    def check_plot(self):
        self.assertGreater((self.folder / "plot.png").stat().st_size, 5000)

    def test_bouncing_balls(self):
        measured, predicted = self.run_example("bouncing_balls", *self.plot())
        np.testing.assert_allclose(measured, predicted, atol=0.02)
        self.check_plot()

    def test_angle_of_repose(self):
        angles = self.run_example("angle_of_repose", "--frictions", 0.1, 0.6, "--grains", 6, 10, *self.plot())
        self.assertGreater(angles[1], angles[0] + 3)
        self.assertTrue(all(-5 < angle < 50 for angle in angles), angles)
        self.check_plot()

    def test_paddle(self):
        tops = self.run_example("paddle", "--seconds", 6, *self.plot())
        self.assertGreater(len(tops), 4)
        np.testing.assert_allclose(tops[2:], 1.5, atol=0.25)
        self.check_plot()

    def test_n_body(self):
        energy, angular_momentum = self.run_example("n_body", "--stars", 60, "--orbits", 0.5, *self.plot())
        self.assertLess(energy, 1e-4)
        self.assertLess(angular_momentum, 1e-10)
        self.check_plot()

    def test_read_a_run(self):
        hooke.run(scenes.box(), self.folder / "out", threads=1)
        table = self.run_example("read_a_run", self.folder / "out")
        self.assertEqual(table.shape, (5, 1))
        self.assertLess(table[-1, 0], table[0, 0])
