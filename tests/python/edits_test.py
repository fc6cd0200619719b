# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""What a caller changes between steps."""
import unittest

import hooke
import numpy as np

import scenes


def balls(*x, material="light", **changes):
    return hooke.Simulation.from_arrays(scenes.rules(**changes), np.array(x, float).reshape(-1, 3), material=material,
                                        threads=1)


class Edits(unittest.TestCase):
    def test_impulses(self):
        sim = balls((0.5, 1, 1), (1, 1, 1), material=["light", "heavy"])
        sim.apply_impulse([1, 2], [[1, 0, 0], [0, 2, 0]])
        np.testing.assert_array_equal(sim.snapshot().v, [[1, 0, 0], [0, 0.5, 0]])
        sim.apply_impulse(2, [0, -2, 0])
        np.testing.assert_array_equal(sim.snapshot().v[1], [0, 0, 0])
        sim.apply_impulse(sim.snapshot().id, (0, 0, 4))
        np.testing.assert_array_equal(sim.snapshot().v, [[1, 0, 4], [0, 0, 1]])
        sim.step(10)
        np.testing.assert_allclose(sim.snapshot().x[1], [1, 1, 1.01])
        np.testing.assert_allclose(sim.measure().momentum, [1, 0, 8])

    def test_positions_and_velocities(self):
        sim = balls((0.5, 1, 1), (1, 1, 1), (1.5, 1, 1))
        sim.set_velocities([1, 3], [1, 2, 3])
        sim.set_positions(2, [0.2, 0.3, 0.4])
        sim.set_positions([1], [[0.1, 0.1, 0.1]], v=[0, 0, 7])
        now = sim.snapshot()
        np.testing.assert_array_equal(now.v, [[0, 0, 7], [0, 0, 0], [1, 2, 3]])
        np.testing.assert_array_equal(now.x, [[0.1, 0.1, 0.1], [0.2, 0.3, 0.4], [1.5, 1, 1]])

    def test_particles_come_and_go(self):
        sim = balls((0.5, 1, 1))
        ids = sim.add([[1, 1, 1], [1.5, 1, 1]], v=[0, 1, 0], material=["heavy", 0])
        np.testing.assert_array_equal(ids, [2, 3])
        self.assertEqual(ids.dtype, np.uint64)
        now = sim.snapshot()
        np.testing.assert_array_equal(now.material, [0, 1, 0])
        np.testing.assert_array_equal(now.v[1:], [[0, 1, 0]] * 2)
        sim.remove(ids[:1])
        np.testing.assert_array_equal(sim.snapshot().id, [1, 3])
        for material in (np.array([1, 0]), np.array([1, 0], np.uint16), np.array(["heavy", "light"]), ("heavy", 0),
                         [np.int64(1), np.str_("light")], [np.array(1), 0]):
            ids = sim.add([[1, 1, 1], [1.5, 1, 1]], material=material)
            np.testing.assert_array_equal(sim.snapshot().material[-2:], [1, 0], repr(material))
            sim.remove(ids)
        ids = sim.add([[1, 1, 1]] * 2, material=np.array(1))
        np.testing.assert_array_equal(sim.snapshot().material[-2:], [1, 1])
        sim.remove(ids)
        sim.remove(np.array([], dtype=int))
        np.testing.assert_array_equal(sim.add(np.zeros((0, 3)), material="light"), [])

    def test_colliders(self):
        sim = balls((1.5, 1.2, 1.5))
        self.assertEqual(sim.colliders, ["ball"])
        sim.step()
        self.assertEqual(sim.measure().colliders["ball"].contacts, 0)
        sim.move_collider("ball", position=[0, -0.1, 0], velocity=[0, -1, 0])
        np.testing.assert_allclose(sim.collider_poses["ball"].pivot, [1.5, 1.4, 1.5])
        load = sim.measure().colliders["ball"]
        self.assertEqual(load.contacts, 1)
        np.testing.assert_allclose(load.force, [0, 50, 0], rtol=1e-9)
        sim.step(20)
        self.assertLess(sim.snapshot().v[0, 1], -0.5)

    def test_materials(self):
        sim = balls((0.97, 1, 1), (1.03, 1, 1))
        force = sim.contacts().force[0]
        sim.set_material("light", stiffness=3000, drag=0.5)
        np.testing.assert_allclose(sim.contacts().force[0], 3 * force)
        np.testing.assert_array_equal(sim.radii, [0.05, 0.1])
        np.testing.assert_array_equal(sim.masses, [1, 4])


class Closers:
    """Values that close a simulation while they are converted."""

    def __init__(self, sim, value):
        self.sim, self.value = sim, value

    def __array__(self, *_, **__):
        self.sim.close()
        return np.array(self.value, float)

    def __float__(self):
        self.sim.close()
        return 1.0

    def __len__(self):
        return 1

    def __getitem__(self, index):
        self.sim.close()
        return ["light"][index]


class Closing(unittest.TestCase):
    def test_arguments_that_close_the_simulation(self):
        one = [0.5, 1, 1]
        calls = (lambda sim, it: sim.add(it), lambda sim, it: sim.add([one], v=it),
                 lambda sim, it: sim.add([one], material=it), lambda sim, it: sim.apply_impulse([1], it),
                 lambda sim, it: sim.set_positions([1], it), lambda sim, it: sim.set_positions([1], one, v=it),
                 lambda sim, it: sim.set_velocities([1], it), lambda sim, it: sim.set_external_forces([1], it),
                 lambda sim, it: sim.set_material("light", mass=it),
                 lambda sim, it: sim.move_collider("ball", position=it))
        for k, call in enumerate(calls):
            sim = balls(one)
            with self.assertRaises((hooke.ClosedError, hooke.InputError), msg=f"call {k}"):
                call(sim, Closers(sim, one if k == 9 else [one]))
            self.assertTrue(sim.closed, f"call {k}")

    def test_materials_are_looked_up_after_their_numbers(self):
        sim = balls((0.5, 1, 1))

        class Number:
            def __float__(self):
                sim.set_material("light", radius=0.07)
                return 3.0

        sim.set_material("light", mass=Number())
        np.testing.assert_array_equal([sim.radii[0], sim.masses[0]], [0.07, 3])


class ExternalForces(unittest.TestCase):
    def test_a_function_of_the_snapshot(self):
        sim = balls((0.5, 1, 1), (1, 1, 1), material=["light", "heavy"])
        sim.set_velocities([1, 2], [1, 0, 0])
        seen = []

        def drag(now):
            seen.append(now.step)
            return -0.5 * now.v

        sim.external_forces = drag
        self.assertIs(sim.external_forces, drag)
        sim.step(100)
        self.assertEqual(seen, list(range(100)))
        # Symplectic Euler: v shrinks by the same factor each step.
        np.testing.assert_allclose(sim.snapshot().v[:, 0], [(1 - 0.0005) ** 100, (1 - 0.000125) ** 100], rtol=1e-12)
        self.assertAlmostEqual(sim.ledger.work["external"], sim.measure().kinetic_energy - 2.5, places=12)
        sim.external_forces = None
        v = sim.snapshot().v
        sim.step(10)
        np.testing.assert_array_equal(sim.snapshot().v, v)

    def test_it_may_move_things_but_not_step(self):
        sim = balls((0.5, 1, 1))

        def lead(now):
            sim.move_collider("ball", position=[0.001 * now.step, 0, 0])
            return np.zeros(3)

        sim.external_forces = lead
        sim.step(11)
        np.testing.assert_allclose(sim.collider_poses["ball"].pivot, [1.51, 1.5, 1.5])

        def step(now):
            sim.step()

        sim.external_forces = step
        with self.assertRaises(hooke.BusyError):
            sim.step()

    def test_it_may_end_itself(self):
        sim = balls((0.5, 1, 1))

        def once(now):
            if now.step == 1:
                sim.external_forces = None
            return [1, 0, 0]

        sim.external_forces = once
        sim.step(5)
        self.assertIsNone(sim.external_forces)
        np.testing.assert_allclose(sim.snapshot().v, [[0.001, 0, 0]], rtol=1e-12)

        def first(now):
            sim.external_forces = lambda now: [0, 1, 0]

        sim.external_forces = first
        sim.step(3)
        np.testing.assert_allclose(sim.snapshot().v, [[0.001, 0.002, 0]], rtol=1e-12)

    def test_its_faults_end_the_step(self):
        sim = balls((0.5, 1, 1))

        def fail_at(now):
            if now.step == 3:
                raise ZeroDivisionError
            return [0, 0, 0]

        sim.external_forces = fail_at
        with self.assertRaises(ZeroDivisionError):
            sim.step(10)
        self.assertEqual(sim.step_count, 3)
        for wrong in (lambda s: None, lambda s: np.zeros((5, 3)), lambda s: [np.nan] * 3, lambda s: "force"):
            sim.external_forces = wrong
            with self.assertRaisesRegex(hooke.InputError, "external_forces"):
                sim.step()
        sim.external_forces = None
        sim.step(7)
        self.assertEqual(sim.step_count, 10)

    def test_constant_forces(self):
        sim = balls((0.5, 1, 1), (1, 1, 1))
        sim.set_external_forces([2], [0, 3, 0])
        sim.step(10)
        np.testing.assert_allclose(sim.snapshot().v, [[0, 0, 0], [0, 0.03, 0]], rtol=1e-12)
        sim.set_external_forces([], [])
        sim.step(10)
        np.testing.assert_allclose(sim.snapshot().v[1], [0, 0.03, 0], rtol=1e-12)
