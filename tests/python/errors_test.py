# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""Wrong arguments: exceptions that say what is expected, and a simulation that stays as it was."""
import unittest

import hooke
import numpy as np

import scenes


class Scenes(scenes.FolderTest):
    def test_every_finding_at_once(self):
        wrong = scenes.box(tiem={}, gravity=[0, "down", 0])
        wrong["materials"]["rubber"]["radius"] = -1
        with self.assertRaises(hooke.SceneError) as caught:
            hooke.Simulation.from_dict(wrong)
        findings = caught.exception.findings
        wheres = {finding.where for finding in findings}
        self.assertLessEqual({"materials.rubber.radius", "gravity[1]"}, wheres)
        self.assertIn("tiem", str(caught.exception))
        for finding in findings:
            self.assertIn(str(finding), str(caught.exception))

    def test_the_tree(self):
        for cls, base in ((hooke.SceneError, hooke.InputError), (hooke.InputError, ValueError),
                          (hooke.RunFailed, RuntimeError), (hooke.FileError, OSError), (hooke.BusyError, RuntimeError),
                          (hooke.ClosedError, RuntimeError)):
            self.assertTrue(issubclass(cls, hooke.Error) and issubclass(cls, base), cls)

    def test_files(self):
        with self.assertRaisesRegex(hooke.Error, "nowhere.json"):
            hooke.Simulation.from_scene("nowhere.json")
        (self.folder / "s.json").write_bytes(b"\xff\xfe{")
        with self.assertRaises(hooke.SceneError):
            hooke.Simulation.from_scene(self.folder / "s.json")
        with self.assertRaises(hooke.Error):
            scenes.simulation(resume=self.folder / "none.h5")
        (self.folder / "c.h5").write_text("no checkpoint")
        with self.assertRaises(hooke.Error):
            scenes.simulation(resume=self.folder / "c.h5")
        with self.assertRaises(hooke.FileError):
            scenes.simulation().checkpoint(self.folder / "no" / "c.h5")
        for wrong in (self.folder / "none", self.folder, self.folder / "s.json"):
            with self.assertRaises(hooke.InputError):
                hooke.Run(wrong)

    def test_values_that_json_has_not(self):
        for value in (float("nan"), object(), {1, 2}):
            with self.assertRaises((TypeError, ValueError)):
                scenes.simulation(set={"time.end": value})
        with self.assertRaises(hooke.InputError):
            scenes.simulation(set={1: 2})
        with self.assertRaises(hooke.SceneError):
            scenes.simulation(set={"time.sped": 2})

    def test_options(self):
        for options in ({"threads": -1}, {"threads": 100000}, {"device": "cuda"}):
            with self.assertRaises(hooke.InputError):
                hooke.Simulation.from_dict(scenes.box(), **options)
        for options in ({"threads": "two"}, {"device": 3}, {"colour": 1}, {"set": [1]}, {"resume": 5}):
            with self.assertRaises(TypeError):
                hooke.Simulation.from_dict(scenes.box(), **options)
        with self.assertRaises(TypeError):
            hooke.Simulation()

    def test_arrays(self):
        def make(*arrays, **options):
            hooke.Simulation.from_arrays(scenes.rules(), *arrays, **{"material": "light", **options})

        one = [[1, 1, 1]]
        for x in ([1, 1, 1], np.zeros((2, 2)), [["a", "b", "c"]], [[1, 2, 3], [1, 2]], None, 5, [[1, 1, np.inf]],
                  np.ones((1, 3), complex), np.ones((1, 3), object), [[5, 1, 1]]):
            with self.assertRaises(hooke.InputError, msg=repr(x)):
                make(x)
        for options in ({"v": np.zeros((2, 3))}, {"material": "wood"}, {"material": None}, {"material": 2},
                        {"material": -1}, {"material": ["light", "light"]}, {"material": [None]}, {"material": 1.5},
                        {"material": [True]}, {"material": np.array([0.0])},
                        {"material": np.array([7])}, {"material": np.array([[0]])}, {"material": np.array(2)}, {"id": [1, 2]}, {"id": [-1]}, {"id": [1.5]}, {"id": ["a"]}, {"id": [[1]]}):
            with self.assertRaises(hooke.InputError, msg=repr(options)):
                make(one, **options)
        with self.assertRaises(hooke.InputError):
            make([[1, 1, 1], [0.5, 1, 1]], id=[3, 3])
        with self.assertRaisesRegex(hooke.InputError, "wood.*light"):
            make(one, material="wood")


class Calls(unittest.TestCase):
    def setUp(self):
        self.sim = scenes.simulation()
        self.before = self.sim.state_hash

    def tearDown(self):
        self.assertEqual(self.sim.state_hash, self.before)
        self.sim.step(2)

    def refuses(self, *calls, error=hooke.InputError):
        for k, call in enumerate(calls):
            with self.assertRaises(error, msg=f"call {k}"):
                call()

    def test_ids(self):
        sim, zero = self.sim, np.zeros(3)
        for ids in (99, [1, 99], -1, [0], [1.0], ["1"], None, [[1]], np.array([True]), [2**63]):
            self.refuses(lambda: sim.remove(ids), lambda: sim.apply_impulse(ids, zero),
                         lambda: sim.set_positions(ids, zero), lambda: sim.set_velocities(ids, zero),
                         lambda: sim.set_external_forces(ids, zero))
        self.refuses(lambda: sim.remove(2**70), error=(hooke.InputError, OverflowError))
        self.refuses(lambda: sim.set_external_forces([1, 1], np.zeros(3)))
        with self.assertRaises(hooke.InputError) as caught:
            sim.remove([1, 98, 99])
        self.assertEqual([f.where for f in caught.exception.findings], ["particle 98", "particle 99"])

    def test_vectors(self):
        sim = self.sim
        for value in (None, 1, "x", [1, 2], np.zeros((3, 3)), np.zeros((2, 2)), [[np.nan, 0, 0]] * 2, [1e400, 0, 0]):
            self.refuses(lambda: sim.apply_impulse([1, 2], value), lambda: sim.set_positions([1, 2], value),
                         lambda: sim.set_velocities([1, 2], value), lambda: sim.set_external_forces([1, 2], value))
        self.refuses(lambda: sim.set_positions([1, 2], [[1, 1, 1], [1, 9, 1]]), lambda: sim.add([[3, 1, 1]]),
                     lambda: sim.add([1, 1, 1]), lambda: sim.add([[1, 1, 1]], material="wood"),
                     lambda: sim.add([[1, 1, 1]], v=[[1, 1, 1]] * 2))

    def test_others(self):
        sim = self.sim
        self.refuses(lambda: sim.step(-1), lambda: sim.move_collider("bell"),
                     lambda: sim.move_collider("ball", position=[1, 2]),
                     lambda: sim.move_collider("ball", velocity=[np.inf, 0, 0]),
                     lambda: sim.set_material("wood", radius=1), lambda: sim.set_material("rubber", radius=-1),
                     lambda: sim.set_material("rubber", colour=1), lambda: sim.set_material("rubber", mass="much"),
                     lambda: setattr(sim, "external_forces", 5))
        self.refuses(lambda: sim.step(1.5), lambda: sim.step("two"), lambda: sim.restore(None),
                     lambda: sim.checkpoint(5), lambda: sim.move_collider(1), error=TypeError)
        self.refuses(lambda: setattr(sim, "time", 5), lambda: setattr(sim.snapshot(), "x", 5), error=AttributeError)

    def test_out(self):
        sim = self.sim
        read_only = np.zeros((27, 3))
        read_only.flags.writeable = False
        unaligned = np.zeros(27 * 3 * 8 + 1, np.uint8)[1:].view(float).reshape(27, 3)
        for out in (unaligned, np.zeros((26, 3)), np.zeros((27, 3), int), np.zeros((3, 27)).T, np.zeros(81), [1], read_only,
                    np.zeros((27, 3), ">f8"), np.zeros((27, 3), np.float16)):
            self.refuses(lambda: sim.positions(out=out), lambda: sim.velocities(out=out))

    def test_pictures(self):
        sim = self.sim
        self.refuses(lambda: sim.render(size=(0, 10)), lambda: sim.render(size=(10**6, 10)),
                     lambda: sim.render(color_by="taste"), lambda: sim.render(samples=9),
                     lambda: sim.render(range=(2, 1)), lambda: sim.run("out", film="film.txt"),
                     lambda: sim.run("out", fps=0), lambda: sim.run("out", fps=1e308), lambda: sim.run("out", fps=1e-4),
                     lambda: sim.run("out", speed=1e7), lambda: sim.run("out", speed=float("nan")),
                     lambda: sim.run("out", checkpoint_every=-1), lambda: sim.run("out", on_progress=5))
        self.refuses(lambda: sim.render(size=5), lambda: sim.render(range=1), error=TypeError)


class Failures(unittest.TestCase):
    def test_a_run_that_blows_up(self):
        sim = scenes.simulation(set={"time.step": 0.2})
        self.assertTrue(any("stable step" in str(warning) for warning in sim.warnings))
        self.assertLess(sim.stable_step, 0.2)
        with self.assertRaises(hooke.RunFailed) as caught:
            sim.step(1000)
        self.assertRegex(str(caught.exception), "step .*stable step")
        with self.assertRaises(hooke.RunFailed):
            sim.step()
        self.assertEqual(len(sim.snapshot()), 27)

    def test_a_good_scene_has_no_warnings(self):
        self.assertEqual(scenes.simulation().warnings, [])
