# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""Steps, snapshots, checkpoints, threads, signals."""
import gc
import json
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import weakref

import hooke
import numpy as np

import scenes


class Steps(scenes.FolderTest):
    def test_the_bits_are_the_program_s(self):
        scenes.program("run", scenes.BALL_PIT, "-o", self.folder / "out", "--steps", 150, "--quiet")
        report = json.loads((self.folder / "out" / "report.json").read_text())
        for threads in (1, 2):
            sim = hooke.Simulation.from_scene(scenes.BALL_PIT, threads=threads)
            sim.step(149)
            sim.step()
            self.assertEqual(sim.state_hash, report["state_hash"])
            self.assertEqual(sim.threads, threads)
        self.assertEqual(sim.step_count, 150)
        self.assertEqual(sim.time, 150 * sim.time_step)
        self.assertEqual(len(sim), report["particles"])

    def test_a_dict_is_the_file_it_stands_for(self):
        text = json.dumps(scenes.box())
        (self.folder / "s.json").write_text(text)
        a = hooke.Simulation.from_scene(self.folder / "s.json", set={"time.step": 0.002, "materials.rubber.radius": 0.04})
        b = scenes.simulation(set={"time": {"step": np.float64(0.002), "end": 0.2}, "materials.rubber.radius": 0.04})
        a.step(50)
        b.step(50)
        self.assertEqual(a.state_hash, b.state_hash)
        self.assertEqual(a.scene["time"]["step"], 0.002)

    def test_arrays_are_particles(self):
        x = np.random.default_rng(1).uniform(0.2, 1, (50, 3)).astype(np.float32)
        v = np.tile([0, 1, 0], (50, 1))
        names = ["light", "heavy"] * 25
        sim = hooke.Simulation.from_arrays(scenes.rules(), x, v, material=names, id=np.arange(50, 0, -1), threads=1)
        now = sim.snapshot()
        np.testing.assert_array_equal(now.id, np.arange(1, 51))
        np.testing.assert_array_equal(now.x, x[::-1])
        np.testing.assert_array_equal(now.v, v)
        np.testing.assert_array_equal(np.array(sim.materials)[now.material], names[::-1])
        self.assertEqual(len(hooke.Simulation.from_arrays(scenes.rules(), np.zeros((0, 3)), material="light")), 0)

    def test_the_reference_is_in_double(self):
        sim = scenes.simulation(device="reference")
        sim.step(3)
        self.assertEqual((sim.device, sim.precision), ("reference", "double"))
        self.assertEqual(sim.positions().dtype, np.float64)

    def test_a_checkpoint_goes_on_with_the_same_bits(self):
        sim = scenes.simulation()
        sim.step(20)
        sim.checkpoint(self.folder / "c.h5")
        state = sim.state()
        sim.step(30)
        end = sim.state_hash
        again = scenes.simulation(resume=self.folder / "c.h5")
        self.assertEqual(again.step_count, 20)
        again.step(30)
        self.assertEqual(again.state_hash, end)
        sim.restore(state)
        self.assertEqual((sim.step_count, state.step, len(state)), (20, 20, 27))
        sim.step(30)
        self.assertEqual(sim.state_hash, end)


class Snapshots(unittest.TestCase):
    def test_columns_are_views_that_never_change(self):
        sim = scenes.simulation()
        before = sim.snapshot()
        x = before.x
        kept = x.copy()
        sim.step(50)
        after = sim.snapshot()
        np.testing.assert_array_equal(x, kept)
        self.assertFalse(np.array_equal(after.x, x))
        self.assertEqual((before.step, after.step, after.time), (0, 50, sim.time))
        self.assertEqual((x.shape, x.dtype), ((27, 3), np.float64))
        self.assertEqual((before.id.dtype, before.material.dtype), (np.uint64, np.uint16))
        self.assertTrue(np.shares_memory(x, before.x), "no copy")
        for array in (x, before.v, before.id, before.material):
            self.assertFalse(array.flags.writeable or array.flags.owndata)
        with self.assertRaises(ValueError):
            x[0] = 1

    def test_arrays_outlive_snapshot_and_simulation(self):
        sim = scenes.simulation()
        sim.step(5)
        x, ids = sim.snapshot().x, sim.snapshot().id
        kept = x.copy()
        sim.close()
        del sim
        gc.collect()
        others = [scenes.simulation() for _ in range(3)]
        for other in others:
            other.step(5)
        np.testing.assert_array_equal(x, kept)
        self.assertEqual(ids[-1], 27)

    def test_positions_are_in_the_engine_s_precision(self):
        sim = scenes.simulation()
        sim.step(10)
        now = sim.snapshot()
        self.assertEqual(sim.positions().dtype, np.float32)
        np.testing.assert_array_equal(sim.positions(), now.x)
        np.testing.assert_array_equal(sim.velocities(), now.v)
        out = np.empty((27, 3))
        self.assertIs(sim.velocities(out=out), out)
        np.testing.assert_array_equal(out, now.v)

    def test_velocity_verlet_has_accelerations(self):
        self.assertIsNone(scenes.simulation().snapshot().a)
        scene = scenes.rules(time={"step": 0.001, "end": 1, "integrator": "velocity-verlet"})
        scene["gravity"] = [0, -2, 0]
        sim = hooke.Simulation.from_arrays(scene, [[1, 1, 1]], material="light")
        sim.step()
        np.testing.assert_allclose(sim.snapshot().a, [[0, -2, 0]])

    def test_rows_of_ids(self):
        now = scenes.simulation().snapshot()
        np.testing.assert_array_equal(now.rows([27, 1]), [26, 0])
        with self.assertRaisesRegex(hooke.InputError, "particle 99"):
            now.rows(99)


class Threads(unittest.TestCase):
    def test_other_threads_run_while_it_steps(self):
        sim = hooke.Simulation.from_scene(scenes.BALL_PIT, threads=1)
        worker = threading.Thread(target=sim.step, args=(200,))
        counted = 0
        worker.start()
        while worker.is_alive():
            counted += 1
            time.sleep(0.001)
        worker.join()
        self.assertGreater(counted, 5)
        self.assertEqual(sim.step_count, 200)

    def test_a_second_thread_is_refused(self):
        sim = hooke.Simulation.from_scene(scenes.BALL_PIT, threads=1)
        worker = threading.Thread(target=sim.step, args=(300,))
        worker.start()
        refused = False
        while worker.is_alive() and not refused:
            try:
                sim.measure()
            except hooke.BusyError:
                refused = True
        worker.join()
        self.assertTrue(refused)
        sim.measure()

    def test_python_code_of_a_step_lets_no_other_thread_in(self):
        """Not even while on_progress or external_forces waits, and lets other threads of Python run."""
        sim = hooke.Simulation.from_scene(scenes.BALL_PIT, threads=1, set={"time.end": 0.02})
        outcomes, inside, tried = [], threading.Event(), threading.Event()

        def intrude():
            inside.wait()
            for call in (sim.measure, sim.snapshot, lambda: sim.add([[1, 1, 1]]), sim.close, lambda: len(sim)):
                try:
                    call()
                    outcomes.append("let in")
                except hooke.BusyError:
                    outcomes.append("refused")
            outcomes.append("refused" if sim._repr_png_() is None else "let in")
            tried.set()

        def wait(*_):
            inside.set()
            tried.wait()
            return [0, 0, 0] if sim.measure().particles else None  # the thread itself may look

        def step(count=3):
            sim.external_forces = wait
            sim.step(count)
            sim.external_forces = None

        with tempfile.TemporaryDirectory() as folder:
            for call in (step, lambda: sim.run(folder + "/out", on_progress=wait)):
                for event in (inside, tried):
                    event.clear()
                outcomes.clear()
                thread = threading.Thread(target=intrude)
                thread.start()
                call()
                thread.join()
                self.assertEqual(outcomes, ["refused"] * 6)

    def test_a_forked_process_is_told(self):
        sim = scenes.simulation()
        sim.step()
        sim.render(size=(32, 18))
        with tempfile.TemporaryDirectory() as folder:
            run = hooke.run(scenes.box(), folder + "/out", threads=1)
            run.render(size=(32, 18))
            calls = (sim.step, sim.measure, lambda: scenes.simulation(), lambda: scenes.simulation({"hooke": 2}),
                     lambda: hooke.Simulation.from_scene("nowhere.json"),
                     lambda: hooke.Simulation.from_arrays({}, None), lambda: hooke.Run(folder + "/out"),
                     lambda: run[0], run.render)
            child = os.fork()
            if child == 0:
                told = 0
                for call in calls:
                    try:
                        call()
                    except hooke.BusyError as error:
                        told += "spawn" in str(error)
                del sim, run, calls, call
                gc.collect()
                os._exit(0 if told == 9 else 1)
            self.assertEqual(os.waitpid(child, 0)[1], 0)


class Signals(scenes.FolderTest):
    CODE = """
import hooke, sys, scenes
sim = hooke.Simulation.from_scene(scenes.BALL_PIT, threads=1)
print("ready", flush=True)
try:
    sim.step(10**9)
except KeyboardInterrupt:
    steps = sim.step_count
    sim.step(3)
    other = hooke.Simulation.from_scene(scenes.BALL_PIT, threads=1)
    other.step(steps + 3)
    print(steps, sim.state_hash == other.state_hash, flush=True)
"""

    def test_ctrl_c_ends_a_long_step_between_two_steps(self):
        child = subprocess.Popen([sys.executable, "-c", self.CODE], stdout=subprocess.PIPE, text=True)
        self.assertEqual(child.stdout.readline(), "ready\n")
        time.sleep(0.5)
        child.send_signal(signal.SIGINT)
        steps, same = child.communicate(timeout=120)[0].split()
        self.assertGreater(int(steps), 0)
        self.assertEqual(same, "True")
        self.assertEqual(child.returncode, 0)

    def test_ctrl_c_works_soon_after_fast_steps(self):
        """Steps of an empty box are so fast that very many are taken at once; those of a full one are not."""
        sim = scenes.simulation()
        sim.remove(sim.snapshot().id)
        sim.step(10**5)
        sim.add(np.stack(np.meshgrid(*[np.arange(0.1, 1.95, 0.12)] * 3), axis=-1).reshape(-1, 3))

        def ring(*_):
            raise TimeoutError

        self.addCleanup(signal.signal, signal.SIGALRM, signal.signal(signal.SIGALRM, ring))
        start = time.monotonic()
        signal.setitimer(signal.ITIMER_REAL, 0.2)
        with self.assertRaises(TimeoutError):
            sim.step(10**9)
        self.assertLess(time.monotonic() - start, 3)

    def test_a_run_that_is_ended_can_be_resumed(self):
        scene = scenes.box(time={"step": 0.001, "end": 500})
        calls = []

        def stop(step, particles):
            calls.append((step, particles))
            if len(calls) == 3:
                raise StopIteration("enough")

        with self.assertRaises(StopIteration):
            hooke.run(scene, self.folder / "out", threads=1, on_progress=stop)
        self.assertEqual(calls[0], (0, 27))
        run = hooke.Run(self.folder / "out")
        reached = run.snapshot().step
        self.assertGreater(reached, 0)
        resumed = scenes.simulation(scene, resume=self.folder / "out")
        self.assertEqual(resumed.step_count, reached)
        straight = scenes.simulation(scene)
        straight.step(reached)
        self.assertEqual(resumed.state_hash, straight.state_hash)


class Objects(unittest.TestCase):
    def test_close(self):
        with scenes.simulation() as sim:
            now = sim.snapshot()
            sim.external_forces = lambda now: [0, 0, 0]
            function = weakref.ref(sim.external_forces)
            self.assertTrue(sim)
        self.assertTrue(sim.closed)
        self.assertEqual(len(now), 27)
        self.assertIn("closed", repr(sim))
        sim.close()
        self.assertIsNone(sim.external_forces)
        self.assertIsNone(function())
        for use in (sim.step, sim.snapshot, sim.measure, sim.contacts, sim.render, sim.positions, sim.state,
                    lambda: sim.ledger, lambda: len(sim), lambda: sim.time, lambda: sim.scene,
                    lambda: sim.checkpoint("c.h5"), lambda: sim.run("out"), lambda: sim.add([[1, 1, 1]])):
            with self.assertRaises(hooke.ClosedError):
                use()

    def test_cycles_are_collected(self):
        sim = scenes.simulation()
        sim.external_forces = lambda now: [0, sim.time, 0]
        sim.step(3)
        gone = weakref.ref(sim)
        del sim
        gc.collect()
        self.assertIsNone(gone())
        raw = hooke.Simulation.__new__(hooke.Simulation)
        gc.collect()
        with self.assertRaises(hooke.ClosedError):
            raw.step()

    def test_many_simulations(self):
        many = [scenes.simulation() for _ in range(100)]
        for sim in many:
            sim.step(5)
        self.assertEqual(len({sim.state_hash for sim in many}), 1)

    def test_errors_can_be_pickled(self):
        try:
            scenes.simulation(set={"time.step": -1})
        except hooke.SceneError as error:
            again = pickle.loads(pickle.dumps(error))
            self.assertEqual((type(again), again.findings, str(again)), (hooke.SceneError, error.findings, str(error)))
