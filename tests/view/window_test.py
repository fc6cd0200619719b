#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""Tests hooke view with real events of keyboard and mouse, under Xvfb and the software driver.

window_test.py HOOKE COMPARE [--random SECONDS] [--update]
COMPARE is the program compare_pictures. --random: only random input, for so long. --update: stores the pictures that are
drawn now as the right ones. Exit status 77 where Xvfb or xdotool is not installed.
"""
import argparse
import math
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import time

from window_driver import Display, Skip, Window

HERE = pathlib.Path(__file__).resolve().parent
ALIKE = 0.97  # structural similarity of a picture and the stored one, at least: drivers round differently

SCENE = """{
  "hooke": 1, "name": "window test",
  "time": { "step": 0.001, "end": 1 },
  "domain": { "min": [0, 0, 0], "max": [2, 2, 2] },
  "materials": {
    "red":  { "radius": 0.06, "mass": 0.1, "stiffness": 500, "shear": 0.3, "damping": 1, "color": "#e4453a" },
    "linen": { "radius": 0.03, "mass": 0.01, "stiffness": 300, "damping": 0.1, "color": "#4cb35a" } },
  "particles": [ { "material": "red",
    "block": { "min": [0.1, 0.06, 0.1], "max": [1.9, 0.7, 1.9], "spacing": 0.125, "lattice": "hcp" } } ],
  "cloths": [ { "material": "linen", "corner": [0.2, 1.7, 0.2], "edges": [[0.6, 0, 0], [0, 0, 0.6]], "cells": [10, 10],
    "stretch": 40, "shear": 10, "bend": 2, "damping": 0.02, "pins": ["edge:0", "edge:2"] } ],
  "colliders": [ { "name": "ball", "shape": { "sphere": { "center": [1, 1.1, 1.2], "radius": 0.25 } } } ],
  "output": { "every": 0.1 },
  "camera": { "eye": [3.4, 2.8, 5.2], "target": [1, 0.8, 1], "field_of_view": 35 }
}"""
EXPLODES = SCENE.replace('"step": 0.001', '"step": 0.05')
EMPTY = """{"hooke": 1, "time": {"step": 0.01, "end": 1}, "domain": {"min": [0, 0, 0], "max": [1, 1, 1]},
  "materials": {"sand": {"radius": 0.02, "mass": 1, "stiffness": 100}}, "particles": []}"""


class Tests:
    def __init__(self, display, arguments, folder):
        self.display, self.arguments, self.folder = display, arguments, pathlib.Path(folder)
        for name, text in (("scene", SCENE), ("explodes", EXPLODES), ("empty", EMPTY)):
            (self.folder / f"{name}.json").write_text(text, encoding="utf-8")

    def window(self, *words):
        return Window(self.display, self.arguments.hooke, self.folder, words)

    # Keys -----------------------------------------------------------------------------------------------------------

    def test_time(self):
        with self.window("scene.json", "--paused") as w:
            assert w.status()["step_count"] == 0
            for expected in (1, 2, 3):
                w.key("Return")
                w.wait(lambda s: s["step_count"] == expected, "step")
            w.key("BackSpace")
            w.wait(lambda s: s["step_count"] == 2, "step back")
            w.key("space")
            w.wait(lambda s: s["runs"] and s["step_count"] > 50, "run")
            w.key("space")
            assert not w.status()["runs"]
            for key, expected in (("minus", 0.5), ("minus", 0.25), ("equal", 0.5), ("0", "fastest"), ("minus", 5)):
                w.key(key)
                w.wait(lambda s: s["speed"] == expected, f"speed after {key}")
            w.key("1")
            w.wait(lambda s: s["step_count"] == 0, "reset")
            w.quit()

    def test_switches(self):
        with self.window("scene.json", "--paused") as w:
            for key, name, values in (
                    ("m", "mode", ["move"]), ("k", "mode", ["cut"]), ("v", "mode", ["view"]),
                    ("h", "panel", [False, True]), ("t", "plots", [True, False]), ("n", "numbers", [False, True]),
                    ("p", "spheres", [False, True]), ("r", "rendering", [False, True]), ("x", "clip", [True, False]),
                    ("g", "ground", [False, True]), ("b", "dark", [False, True]), ("f", "flies", [True, False]),
                    ("F1", "help", [True, False]), ("question", "help", [True, False]),
                    ("c", "coloring", ["speed", "height", "pressure", "contacts", "age", "id", "material"]),
                    ("shift+c", "coloring", ["id", "age"])):
                for value in values:
                    w.key(key)
                    w.wait(lambda s: s[name] == value, f"{name} {value} after {key}")
            w.quit()

    def test_particles(self):
        with self.window("scene.json", "--paused") as w:
            at_first = w.status()["particles"]
            w.key("3")
            dropped = w.wait(lambda s: s["particles"] > at_first, "dropped ball")["particles"]
            w.xdotool("mousemove", 480, 430)
            w.key("4")
            shot = w.wait(lambda s: s["particles"] > dropped, "shot ball")["particles"]
            w.xdotool("keydown", "o")
            w.frames(6)
            w.xdotool("keyup", "o")
            w.wait(lambda s: s["particles"] > shot, "poured particles")
            w.key("2")
            w.key("1")
            w.wait(lambda s: s["particles"] == at_first, "reset")
            assert w.status()["message"] == "", w.status()["message"]
            w.quit()

    def test_files(self):
        with self.window("scene.json", "--paused") as w:
            w.key("s")
            w.wait(lambda s: "saved scene-001.png" in s["message"], "still")
            w.key("ctrl+s")
            w.wait(lambda s: "saved scene-scene-001.json" in s["message"], "scene")
            w.key("ctrl+e")
            w.wait(lambda s: "saved scene-002.h5" in s["message"] or "saved scene-001.h5" in s["message"], "checkpoint")
            for name in ("scene-001.json", "scene-scene-001.json"):
                subprocess.run([self.arguments.hooke, "check", name], cwd=self.folder, check=True, stdout=subprocess.DEVNULL)
            w.key("space")
            w.key("shift+S")
            w.wait(lambda s: s["step_count"] > 200, "steps of the film")
            w.key("shift+S")
            w.wait(lambda s: re.search(r"saved scene-\d+.mp4 with \d+ frames", s["message"]), "film")
            w.quit()
        film = next(self.folder.glob("scene-*.mp4"))
        assert film.stat().st_size > 1000 and film.with_suffix(".json").exists()

    # The mouse ------------------------------------------------------------------------------------------------------

    def test_camera(self):
        def eye(s):
            return s["eye"]

        def distance(s):
            return math.dist(s["eye"], s["target"])

        with self.window("scene.json", "--paused") as w:
            w.key("h")
            start = w.status()
            w.drag((500, 300), (640, 340))
            turned = w.status()
            assert math.dist(eye(turned), eye(start)) > 0.5 and math.dist(turned["target"], start["target"]) < 1e-3
            w.drag((500, 300), (600, 300), key="shift")
            panned = w.status()
            assert math.dist(panned["target"], turned["target"]) > 0.1
            w.drag((500, 300), (560, 300), button=2)
            assert math.dist(w.status()["target"], panned["target"]) > 0.05
            near = w.status()
            w.drag((500, 300), (500, 420), key="ctrl")
            assert distance(w.status()) > 1.2 * distance(near)
            far = w.status()
            w.click((500, 300), button=4)
            w.frames(8)
            assert distance(w.status()) < 0.95 * distance(far)
            w.key("Home")
            w.wait(lambda s: math.dist(eye(s), eye(start)) < 1e-2, "the first camera")
            w.xdotool("keydown", "Up")
            w.frames(4)
            w.xdotool("keyup", "Up")
            w.wait(lambda s: math.dist(s["target"], start["target"]) > 0.1, "flight")
            w.quit()

    def test_touch(self):
        with self.window("scene.json", "--paused") as w:
            w.key("h")
            w.click((640, 500))
            w.wait(lambda s: s["picked"] is not None, "picked particle")
            w.key("Delete")
            w.wait(lambda s: s["picked"] is None, "nothing picked")
            w.key("m")
            w.key("space")
            ball = self.find(w, (610, 250), "held_collider", "ball")
            held = w.drag(ball, (ball[0] + 60, ball[1] - 30))
            assert held["held_collider"] == "ball", held
            w.wait(lambda s: s["held_collider"] == "", "let go")
            held = w.drag((700, 520), (700, 420))
            assert held["held_particles"] > 0, held
            w.wait(lambda s: s["held_particles"] == 0, "let go")
            w.quit()

    def find(self, w, near, name, value):
        """A place near which a press takes hold of what it should."""
        for dx, dy in ((0, 0), (0, 30), (30, 0), (-30, 0), (0, -30), (40, 40), (-40, 40)):
            place = (near[0] + dx, near[1] + dy)
            w.xdotool("mousemove", *place)
            w.frames(2)
            w.xdotool("mousedown", 1)
            w.frames(4)
            found = w.status()[name] == value
            w.xdotool("mouseup", 1)
            w.frames(3)
            if found:
                return place
        raise AssertionError(f"no {value} near {near}")

    def test_knife(self):
        with self.window("scene.json") as w:
            w.key("h")
            w.key("k")
            assert w.status()["broken_springs"] == 0
            w.drag((480, 130), (700, 180))  # across the cloth
            cut = w.wait(lambda s: s["broken_springs"] > 0, "cut springs")
            assert cut["message"] == "" and cut["mode"] == "cut", cut
            w.key("v")
            w.drag((480, 130), (700, 180))
            assert w.status()["broken_springs"] == cut["broken_springs"], "only the knife cuts"
            w.quit()

    def test_lost_focus(self):
        """What is held when the window loses the keyboard, or is unmapped, is let go; the window goes on."""
        with self.window("scene.json", "--paused") as w:
            w.key("h")
            for lose, regain in ((w.lose_focus, w.focus),
                                 (lambda: w.xdotool("windowunmap", w.id()), lambda: w.xdotool("windowmap", w.id()))):
                w.focus()
                w.frames()
                try:
                    self.lose_a_drag(w, lose, regain)
                    self.lose_a_hand(w, lose, regain)
                    self.lose_keys(w, lose, regain)
                finally:  # the display is the next test's, too
                    w.xdotool("mouseup", 1, "keyup", "o", "keyup", "Up")
                    subprocess.run(["xset", "r", "on"], env=w.display.environment, check=True, timeout=30)
            w.quit()

    def rest(self, w):
        """The state in which the camera has come to rest."""
        before = w.status()
        for _ in range(200):
            now = w.frames(3)
            if math.dist(now["eye"], before["eye"]) < 1e-9:
                return now
            before = now
        raise AssertionError(f"the camera does not come to rest: {before}")

    def press(self, w, place):
        w.xdotool("mousemove", *place)
        w.frames(2)
        w.xdotool("mousedown", 1)
        return w.wait(lambda s: s["drags"], "drag")

    def regain(self, w, regain):
        w.xdotool("mouseup", 1)
        regain()
        time.sleep(0.2)
        w.focus()
        return w.wait(lambda s: not s["drags"], "rest")

    def lose_a_drag(self, w, lose, regain):
        w.key("v")
        self.press(w, (500, 300))
        w.xdotool("mousemove", 560, 320)
        w.frames(8)
        lose()
        w.wait(lambda s: not s["drags"], "end of a drag")
        still = self.rest(w)
        w.xdotool("mousemove", 300, 200)  # with the button still down
        time.sleep(0.5)
        now = w.status()
        assert math.dist(now["eye"], still["eye"]) < 1e-6, f"the camera moved from {still} to {now}"
        self.regain(w, regain)
        w.key("Home")

    def lose_a_hand(self, w, lose, regain):
        w.key("m")
        place = self.find(w, (610, 250), "held_collider", "ball")
        self.press(w, place)
        w.wait(lambda s: s["held_collider"] == "ball", "hold")
        lose()
        w.wait(lambda s: s["held_collider"] == "" and not s["drags"], "let go")
        self.regain(w, regain)

    def lose_keys(self, w, lose, regain):
        # A root window that has the keyboard passes on to what lies below the mouse, repeated keys too.
        subprocess.run(["xset", "r", "off"], env=w.display.environment, check=True, timeout=30)
        w.xdotool("keydown", "o", "keydown", "Up")
        w.wait(lambda s: s["pours"], "pouring")
        w.frames(4)
        lose()
        w.wait(lambda s: not s["pours"], "end of pouring")
        still = self.rest(w)
        later = w.frames(8)
        assert later["particles"] == still["particles"], f"poured on: from {still} to {later}"
        w.xdotool("keyup", "o", "keyup", "Up")
        self.regain(w, regain)
        w.key("Home")

    def test_tune(self):
        with self.window("scene.json", "--paused") as w:
            step = w.status()["time_step"]
            dragged = w.drag((1005, 290), (1045, 290))
            w.wait(lambda s: s["gravity"][1] != -9.8, "another gravity")
            w.key("ctrl+z")
            w.wait(lambda s: s["gravity"] == [0, -9.8, 0], "the gravity of the start")
            w.key("ctrl+y")
            w.wait(lambda s: s["gravity"][1] != -9.8, "the other gravity again")
            w.click((1215, 94))  # the safe step
            w.wait(lambda s: s["time_step"] != step, "another time step")
            assert dragged["failure"] == ""
            w.click((640, 650), button=3)
            w.key("Escape")  # closes the menu alone
            w.quit()

    # The window -----------------------------------------------------------------------------------------------------

    def test_sizes(self):
        with self.window("scene.json") as w:
            for width, height in ((640, 480), (200, 100), (1100, 700)):
                w.xdotool("search", "--name", "Hooke", "windowsize", width, height)
                w.wait(lambda s: (s["width"], s["height"]) == (width, height), f"size {width}x{height}")
            w.quit()

    def test_pictures(self):
        with self.window("scene.json", "--paused", "--size", "640x360") as w:
            for number, (name, keys) in enumerate((("material", []), ("height", ["c", "c"]), ("clipped", ["x", "b"]),
                                                   ("points", ["p"])), 1):
                for key in keys:
                    w.key(key)
                w.frames(6)
                w.key("s")
                file = self.folder / f"scene-{number:03}.png"
                w.wait(lambda s: f"saved {file.name}" in s["message"], "still")
                self.compare(file, HERE / "images" / f"window-{name}.png")
            w.quit()

    def compare(self, drawn, stored):
        if self.arguments.update and stored.parent != self.folder:
            stored.parent.mkdir(exist_ok=True)
            stored.write_bytes(drawn.read_bytes())
            return
        alike = float(subprocess.run([self.arguments.compare, drawn, stored], check=True, text=True,
                                     stdout=subprocess.PIPE).stdout)
        assert alike >= ALIKE, f"{stored.name}: similarity {alike}"

    def test_film_still(self):
        """The panel's still with the look of films is the picture that hooke render draws."""
        hooke = self.arguments.hooke
        subprocess.run([hooke, "run", "scene.json", "-o", "out", "--steps", "1", "--quiet"], cwd=self.folder, check=True)
        subprocess.run([hooke, "render", "out", "-o", "rendered.png", "--time", "0", "--no-legend"], cwd=self.folder,
                       env=self.display.environment, check=True, stdout=subprocess.DEVNULL)
        with self.window("scene.json", "--paused") as w:
            w.click((1068, 72))  # the tab Save
            w.click((1000, 202))
            w.wait(lambda s: "saved scene-001.png" in s["message"], "still")
            w.quit()
        self.compare(self.folder / "scene-001.png", self.folder / "rendered.png")

    def test_failures(self):
        with self.window("explodes.json") as w:
            w.wait(lambda s: "time.step" in s["failure"], "failure")
            w.frames(3)
            assert not w.status()["runs"]
            w.key("BackSpace")
            w.wait(lambda s: s["failure"] == "", "the state before it")
            w.quit()
        with self.window("empty.json") as w:
            w.key("3")
            w.wait(lambda s: s["particles"] > 0, "ball")
            w.quit()

    def test_no_display(self):
        for words, changes, expected in (
                (["scene.json"], {"DISPLAY": None}, r"error: window: there is no display.*hooke render"),
                (["scene.json"], {"MESA_GL_VERSION_OVERRIDE": "3.3"}, r"error: window: there is no OpenGL 4\.3.*render"),
                (["missing.json"], {}, r"error: .*missing\.json"),
                ([], {}, r"SCENE is required")):
            environment = dict(self.display.environment)
            for name, value in changes.items():
                environment.pop(name, None)
                if value is not None:
                    environment[name] = value
            done = subprocess.run([self.arguments.hooke, "view", *words], cwd=self.folder, env=environment, text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=120, check=False)
            assert done.returncode == 2, (words, changes, done)
            assert re.search(expected, done.stderr), (expected, done.stderr)

    def test_scale(self):
        """A monitor of twice the common resolution: letters and panels are twice as large, and the mouse meets them."""
        with Display(1600, 900, scale=2) as display:
            with Window(display, self.arguments.hooke, self.folder, ["scene.json", "--paused", "--size", "800x450"]) as w:
                status = w.status()
                assert (status["scale"], status["width"], status["height"]) == (2, 1600, 900), status
                w.key("h")
                w.click((800, 625))
                w.wait(lambda s: s["picked"] is not None, "picked particle")
                w.key("m")
                self.find(w, (762, 312), "held_collider", "ball")
                w.key("h")
                step = w.status()["time_step"]
                w.click((1470, 188))  # the safe step
                w.wait(lambda s: s["time_step"] != step, "another time step")
                w.key("s")
                w.wait(lambda s: "saved scene-001.png" in s["message"], "still")
                w.quit()

    def test_record(self):
        with self.window("scene.json", "--record", "a.record", "--threads", "2") as w:
            w.key("3")
            w.key("m")
            w.drag((640, 500), (640, 380))
            w.key("4")
            w.key("BackSpace")
            w.key("space")
            w.frames(4)
            printed = w.quit()
        hash_of = re.search(r"state hash ([0-9a-f]{16})", printed).group(1)
        for threads in (1, 2):
            done = subprocess.run([self.arguments.hooke, "view", "--replay", "a.record", "--headless", "--threads",
                                   str(threads)], cwd=self.folder, text=True, stdout=subprocess.PIPE, check=False)
            assert done.returncode == 0 and hash_of in done.stdout, (threads, hash_of, done.stdout)
        text = (self.folder / "a.record").read_text(encoding="utf-8")
        (self.folder / "b.record").write_text(re.sub(r'"radius":[0-9.e-]+', '"radius":0.123', text, count=1),
                                              encoding="utf-8")
        done = subprocess.run([self.arguments.hooke, "view", "--replay", "b.record", "--headless"], cwd=self.folder,
                              text=True, stdout=subprocess.PIPE, check=False)
        assert done.returncode == 3 and re.match(r"DIVERGED at step \d+", done.stdout), done

    # Random input ---------------------------------------------------------------------------------------------------

    def random_input(self, seconds, seed):
        """Presses, drags and resizes at random; the window must live and still quit."""
        print(f"random input for {seconds} s, seed {seed}", flush=True)
        chance = random.Random(seed)
        keys = [*"1234vmkfhtnprcxgbso", "space", "Return", "BackSpace", "shift+BackSpace", "equal", "minus", "0", "F1",
                "Home", "Delete", "ctrl+z", "ctrl+y", "ctrl+s", "Up", "Down", "Page_Up", "shift+c", "Tab"]
        with self.window("scene.json") as w:
            end = time.monotonic() + seconds
            while time.monotonic() < end:
                what = chance.random()
                place = (chance.randrange(1280), chance.randrange(720))
                if what < 0.45:
                    w.xdotool("key", chance.choice(keys))
                elif what < 0.65:
                    w.xdotool("mousemove", *place, "click", chance.choice((1, 1, 2, 3, 4, 5)))
                elif what < 0.95:
                    other = (chance.randrange(1280), chance.randrange(720))
                    w.xdotool("mousemove", *place, "mousedown", 1, "mousemove", *other)
                    time.sleep(0.1)
                    w.xdotool("mouseup", 1)
                else:
                    w.xdotool("search", "--name", "Hooke", "windowsize", chance.randrange(80, 1280),
                              chance.randrange(80, 720))
                time.sleep(0.02)
                w.alive()
            w.xdotool("keyup", "o", "mouseup", 1)
            w.xdotool("key", "Escape")
            time.sleep(2)
            if w.process.poll() is None:  # the help was open
                w.xdotool("key", "Escape")
            w.process.wait(timeout=w.PATIENCE)
            assert w.process.returncode == 0, w.process.returncode


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("hooke")
    parser.add_argument("compare")
    parser.add_argument("--random", type=float)
    parser.add_argument("--seed", type=int, default=int(time.time()))
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--only")
    arguments = parser.parse_args()
    arguments.hooke = os.path.abspath(arguments.hooke)
    arguments.compare = os.path.abspath(arguments.compare)
    failed = []
    try:
        with Display() as display:
            if arguments.random:
                with tempfile.TemporaryDirectory() as folder:
                    Tests(display, arguments, folder).random_input(arguments.random, arguments.seed)
                return 0
            for name in [n for n in dir(Tests) if n.startswith("test_") and (arguments.only or "") in n]:
                with tempfile.TemporaryDirectory() as folder:
                    begin = time.monotonic()
                    try:
                        getattr(Tests(display, arguments, folder), name)()
                        print(f"{name}: passed, {time.monotonic() - begin:.0f} s", flush=True)
                    except AssertionError as error:
                        print(f"{name}: FAILED: {error}", flush=True)
                        failed.append(name)
    except Skip as reason:
        print(f"skipped: {reason}")
        return 77
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
