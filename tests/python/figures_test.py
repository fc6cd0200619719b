# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""Figures: against numpy's own sums, and against the report of the program."""
import json
import unittest

import hooke
import numpy as np

import scenes


class Figures(scenes.FolderTest):
    def test_measurements(self):
        sim = hooke.Simulation.from_scene(scenes.BALL_PIT, set={"precision": "double"}, threads=1)
        sim.step(100)
        now, m = sim.snapshot(), sim.measure()
        mass = sim.masses[now.material][:, None]
        self.assertEqual(m.particles, len(now))
        np.testing.assert_allclose(m.kinetic_energy, 0.5 * (mass * now.v**2).sum(), rtol=1e-12)
        np.testing.assert_allclose(m.potential_energy, 9.8 * (mass[:, 0] * now.x[:, 1]).sum(), rtol=1e-12)
        np.testing.assert_allclose(m.momentum, (mass * now.v).sum(axis=0), rtol=1e-9)
        np.testing.assert_allclose(m.centre_of_mass, (mass * now.x).sum(axis=0) / mass.sum(), rtol=1e-12)
        np.testing.assert_allclose(m.max_speed, np.linalg.norm(now.v, axis=1).max(), rtol=1e-12)
        np.testing.assert_array_equal([m.min, m.max], [now.x.min(axis=0), now.x.max(axis=0)])
        self.assertEqual(m.colliders, {})

    def test_contacts(self):
        sim = scenes.simulation()
        sim.step(60)
        c, m, now = sim.contacts(), sim.measure(), sim.snapshot()
        self.assertEqual((c.kind == 0).sum(), m.contacts)
        self.assertEqual((c.kind == 1).sum(), m.wall_contacts)
        self.assertGreater(m.contacts, 0)
        self.assertGreater(m.wall_contacts, 0)
        pairs = c.kind == 0
        between = now.x[now.rows(c.a[pairs])] - now.x[now.rows(c.b[pairs])]
        np.testing.assert_allclose(c.overlap[pairs], 0.1 - np.linalg.norm(between, axis=1), atol=1e-12)
        floor = c.partner[c.kind == 1] == 2
        np.testing.assert_array_equal(c.point[c.kind == 1][floor][:, 1], 0)
        self.assertEqual((c.force.shape, c.point.shape), ((len(c.a), 3), (len(c.a), 3)))

    def test_the_ledger_balances(self):
        sim = scenes.simulation(set={"precision": "double"})
        start = sim.measure().kinetic_energy
        sim.step(150)
        ledger = sim.ledger
        self.assertAlmostEqual(sum(ledger.work.values()), sim.measure().kinetic_energy - start, places=10)
        np.testing.assert_allclose(sum(ledger.impulse.values()), sim.measure().momentum, atol=1e-10)
        self.assertGreater(ledger.dissipated, 0)
        self.assertEqual((ledger.removed, ledger.born, ledger.broken_springs), (0, 0, 0))

    def test_they_are_those_of_the_report(self):
        (self.folder / "s.json").write_text(json.dumps(scenes.box()))
        scenes.program("run", "s.json", "-o", "out", "--quiet", cwd=self.folder)
        report = json.loads((self.folder / "out" / "report.json").read_text())
        sim = scenes.simulation()
        sim.step(sim.end_step)
        self.assertEqual(sim.state_hash, report["state_hash"])
        self.assertEqual(sim.measure().kinetic_energy, report["energy"]["kinetic"])
        self.assertEqual(sim.ledger.dissipated, report["energy"]["dissipated"])
        self.assertEqual(sim.measure()._asdict()["max_overlap_ratio"], report["max_overlap_ratio"])

    def test_scene_and_schema(self):
        sim = scenes.simulation()
        self.assertEqual(sim.scene["materials"]["rubber"]["drag"], 0)
        self.assertIn("materials", hooke.schema()["properties"])
        self.assertEqual(sim.materials, ["rubber"])
        self.assertIn("27 particles", repr(sim))
