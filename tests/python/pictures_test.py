# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""Pictures, from any thread, and films."""
import concurrent.futures
import subprocess
import threading
import unittest

import hooke
import numpy as np

import scenes


class Pictures(scenes.FolderTest):
    SIZE = (96, 54)

    def test_a_picture_shows_the_particles(self):
        sim = scenes.simulation()
        image = sim.render(size=self.SIZE)
        self.assertEqual((image.shape, image.dtype), ((54, 96, 3), np.uint8))
        self.assertGreater(image.std(), 5)
        sim.step(150)
        moved = sim.render(size=self.SIZE)
        self.assertFalse(np.array_equal(image, moved))
        np.testing.assert_array_equal(sim.render(size=self.SIZE), moved)
        self.assertEqual(sim.render(size=self.SIZE, color_by="speed", range=(0, 1), samples=1).shape, (54, 96, 3))
        clear = sim.render(size=self.SIZE, alpha=True)
        self.assertEqual(clear.shape, (54, 96, 4))
        self.assertEqual((clear[..., 3].min(), clear[..., 3].max()), (0, 255))

    def test_any_thread_may_draw(self):
        sims = [scenes.simulation() for _ in range(3)]
        expected = sims[0].render(size=self.SIZE)
        with concurrent.futures.ThreadPoolExecutor(3) as pool:
            for image in pool.map(lambda sim: sim.render(size=self.SIZE), sims):
                np.testing.assert_array_equal(image, expected)

    def test_notebooks_show_it(self):
        sim = scenes.simulation()
        self.assertTrue(sim._repr_png_().startswith(b"\x89PNG"))
        sim.close()
        self.assertIsNone(sim._repr_png_())

    def test_a_run_is_drawn_as_the_program_draws_it(self):
        run = hooke.run(scenes.box(), self.folder / "out", threads=1)
        ours = run.render(0.12, size=self.SIZE)
        scenes.program("render", self.folder / "out", "-o", self.folder / "p.png", "--time", 0.12, "--size", "96x54")
        import matplotlib.image
        theirs = (matplotlib.image.imread(self.folder / "p.png")[..., :3] * 255).round().astype(np.uint8)
        np.testing.assert_array_equal(ours, theirs)
        with self.assertRaises(hooke.InputError):
            run.render(7)

    def test_any_thread_may_draw_a_run(self):
        hooke.run(scenes.box(), self.folder / "out", threads=1)
        expected = hooke.Run(self.folder / "out").render(0.1, size=self.SIZE)
        run, together = hooke.Run(self.folder / "out"), threading.Barrier(6)

        def draw(_):
            together.wait()
            return run.render(0.1, size=self.SIZE)

        with concurrent.futures.ThreadPoolExecutor(6) as pool:
            for image in pool.map(draw, range(6)):
                np.testing.assert_array_equal(image, expected)

    def test_a_film(self):
        hooke.run(scenes.box(), self.folder / "out", film=self.folder / "f.mp4", size=self.SIZE, fps=20, threads=1)
        frames = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=nb_read_frames",
                                 "-of", "csv=p=0", self.folder / "f.mp4"], check=True, capture_output=True, text=True)
        self.assertEqual(frames.stdout.strip(), "5")
