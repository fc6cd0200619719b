# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""Run folders: written, read, exported, resumed."""
import json
import unittest

import hooke
import numpy as np

import scenes


class Runs(scenes.FolderTest):
    def test_a_run_is_that_of_the_program(self):
        (self.folder / "s.json").write_text(json.dumps(scenes.box()))
        scenes.program("run", "s.json", "-o", "theirs", "--quiet", cwd=self.folder)
        run = hooke.run(self.folder / "s.json", self.folder / "ours", threads=1)
        theirs = hooke.Run(self.folder / "theirs")
        self.assertEqual(run.report["state_hash"], theirs.report["state_hash"])
        np.testing.assert_array_equal(run.times, theirs.times)
        np.testing.assert_array_equal(run.steps, [0, 50, 100, 150, 200])
        np.testing.assert_array_equal(run.particle_counts, [27] * 5)
        for ours, other in zip(run, theirs):
            np.testing.assert_array_equal(ours.x, other.x)
        self.assertEqual(run.series.dtype.names, theirs.series.dtype.names)
        for name in run.series.dtype.names:
            np.testing.assert_array_equal(run.series[name], theirs.series[name], name)
        self.assertEqual(run.scene, theirs.scene)

    def test_reading(self):
        run = hooke.run(scenes.box(), self.folder / "out", threads=1)
        sim = scenes.simulation()
        for snapshot in run:
            sim.step(snapshot.step - sim.step_count)
            np.testing.assert_array_equal(snapshot.x, sim.snapshot().x)
            np.testing.assert_array_equal(snapshot.v, sim.snapshot().v)
            np.testing.assert_array_equal(snapshot.id, sim.snapshot().id)
            self.assertIsNone(snapshot.a)
        self.assertEqual(len(run), 5)
        self.assertEqual(run.snapshot().step, 200)
        self.assertEqual(run.snapshot(time=0.11).step, 100)
        self.assertEqual(run.snapshot(step=150).time, 0.15)
        self.assertEqual([run[0].step, run[-2].step, run.snapshot(index=1).step], [0, 150, 50])
        self.assertEqual((run.materials, run.time_step), (["rubber"], 0.001))
        np.testing.assert_array_equal(run.radii, [0.05])
        np.testing.assert_array_equal(run.masses, [0.5])
        np.testing.assert_array_equal(run.series["step"], run.steps)
        self.assertIn("kinetic", run.series.dtype.names)
        for wrong in ({"time": 7}, {"time": float("nan")}, {"step": 3}, {"time": 0, "step": 0}):
            with self.assertRaises(hooke.InputError):
                run.snapshot(**wrong)
        self.assertEqual([snapshot.step for snapshot in iter(run)], list(run.steps))
        for index in (5, -6):
            with self.assertRaises(IndexError):
                run[index]
        snapshot = run[1]
        del run
        self.assertEqual(snapshot.x.shape, (27, 3))

    def test_a_folder_in_use_is_kept(self):
        hooke.run(scenes.box(), self.folder / "out", threads=1)
        with self.assertRaisesRegex(hooke.InputError, "overwrite=True"):
            hooke.run(scenes.box(), self.folder / "out", threads=1)
        hooke.run(scenes.box(time={"step": 0.001, "end": 0.1}), self.folder / "out", threads=1, overwrite=True)
        self.assertEqual(len(hooke.Run(self.folder / "out")), 3)

    def test_a_run_that_can_not_start_leaves_the_old_one(self):
        scene = scenes.box(colliders=[{"name": "rock", "shape": {"mesh": {
            "file": "meshes/rock.obj", "scale": 0.2, "translate": [1.5, 1.5, 1.5]}}}])
        mesh = self.folder / "meshes" / "rock.obj"
        mesh.parent.mkdir()
        text = (scenes.ROOT / "scenes" / "meshes" / "rock.obj").read_bytes()
        mesh.write_bytes(text)
        out = self.folder / "out"
        hooke.run(scenes.box(), out, threads=1)
        before = {file.name: file.read_bytes() for file in out.iterdir()}
        sim = scenes.simulation(scene, folder=self.folder)
        mesh.unlink()
        for folder in (out, self.folder / "new" / "out"):
            with self.assertRaisesRegex(hooke.FileError, "rock.obj"):
                sim.run(folder, overwrite=True)
        mesh.write_bytes(text)
        (out / "meshes").write_text("no folder")
        with self.assertRaisesRegex(hooke.FileError, "meshes"):
            sim.run(out, overwrite=True)
        (out / "meshes").unlink()
        self.assertEqual({file.name: file.read_bytes() for file in out.iterdir()}, before)
        self.assertFalse((self.folder / "new").exists())
        sim.run(out, overwrite=True)
        self.assertEqual((out / "meshes" / "rock.obj").read_bytes(), text)
        self.assertEqual([file.name for file in (out / "meshes").iterdir()], ["rock.obj"])

    def test_a_run_goes_on_in_its_folder(self):
        whole = hooke.run(scenes.box(), self.folder / "whole", threads=1)
        end = {"time.end": 0.1}
        hooke.run(scenes.box(), self.folder / "out", threads=1, set=end)
        run = hooke.run(scenes.box(), self.folder / "out", threads=1, resume=self.folder / "out")
        self.assertEqual(run.report["state_hash"], whole.report["state_hash"])
        np.testing.assert_array_equal(run.steps, whole.steps)

    def test_what_was_changed_is_no_longer_the_run_of_its_folder(self):
        hooke.run(scenes.box(), self.folder / "out", threads=1, set={"time.end": 0.1})
        kept = (self.folder / "out" / "series.csv").read_text()

        def back(sim):
            state = sim.state()
            sim.step()
            sim.restore(state)

        changes = (lambda sim: sim.step(20), lambda sim: sim.apply_impulse(1, [0, 1, 0]), back,
                   lambda sim: sim.set_material("rubber", mass=1), lambda sim: sim.remove(1),
                   lambda sim: sim.add([[1, 1, 1]]), lambda sim: sim.set_velocities(1, [0, 0, 1]),
                   lambda sim: sim.set_external_forces(1, [0, 0, 1]), lambda sim: sim.move_collider("ball"))
        for k, change in enumerate(changes):
            sim = scenes.simulation(resume=self.folder / "out")
            change(sim)
            with self.assertRaisesRegex(hooke.InputError, "holds a run already", msg=f"change {k}"):
                sim.run(self.folder / "out")
        self.assertEqual((self.folder / "out" / "series.csv").read_text(), kept)

    def test_a_run_that_was_ended_goes_on_in_its_folder(self):
        whole = hooke.run(scenes.box(), self.folder / "whole", threads=1)
        hooke.run(scenes.box(), self.folder / "out", threads=1, set={"time.end": 0.1})
        sim = scenes.simulation(resume=self.folder / "out")
        with self.assertRaises(hooke.InputError):
            sim.apply_impulse(99, [0, 1, 0])

        def stop(step, particles):
            if step > 100:
                raise StopIteration

        with self.assertRaises(StopIteration):
            sim.run(self.folder / "out", on_progress=stop)
        self.assertTrue(100 < sim.step_count < 200)
        sim.run(self.folder / "out")
        run = hooke.Run(self.folder / "out")
        self.assertEqual(run.report["state_hash"], whole.report["state_hash"])
        np.testing.assert_array_equal(run.steps[[0, 2, -1]], [0, 100, 200])

    def test_a_simulation_that_was_changed(self):
        sim = scenes.simulation()
        sim.step(10)
        sim.apply_impulse(1, [0, 1, 0])
        seen = []
        sim.run(self.folder / "out", on_progress=lambda step, particles: seen.append(sim.measure().particles))
        self.assertEqual(sim.step_count, 200)
        self.assertEqual(set(seen), {27})
        self.assertEqual(hooke.Run(self.folder / "out").steps[0], 10)
        sim.external_forces = lambda now: np.zeros(3)
        with self.assertRaisesRegex(hooke.InputError, "external_forces"):
            sim.run(self.folder / "other")

    def test_export(self):
        run = hooke.run(scenes.box(), self.folder / "out", threads=1)
        files = hooke.export(run, self.folder / "last.csv")
        self.assertEqual(files, [self.folder / "last.csv"])
        rows = np.genfromtxt(files[0], delimiter=",", names=True)
        np.testing.assert_array_equal(rows["x"].astype(np.float32), run[-1].x[:, 0])
        scenes.program("export", self.folder / "out", "-o", self.folder / "theirs.csv")
        self.assertEqual(files[0].read_text(), (self.folder / "theirs.csv").read_text())
        self.assertEqual(len(hooke.export(self.folder / "out", self.folder / "p.ply", all=True)), 5)
        self.assertEqual(len(hooke.export(run, self.folder / "c.csv", time=0.1, content="contacts")), 1)
        for wrong in ({"content": "taste"}, {"time": 9}, {"step": 3}, {"all": True, "step": 50},
                      {"surface_radius": 0}, {"surface_resolution": 3}):
            with self.assertRaises(hooke.InputError):
                hooke.export(run, self.folder / "w.csv", **wrong)
        for wrong in ("w.txt", "no/w.csv"):
            with self.assertRaises(hooke.Error):
                hooke.export(run, self.folder / wrong)
