# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""Opens hooke view on a display of its own and works it with real events of keyboard and mouse."""
import json
import os
import pathlib
import shutil
import subprocess
import time


class Skip(Exception):
    """What the test needs is not installed."""


class Display:
    """An X server without a screen, for the time of a with statement. scale: pixels a pixel of common monitors."""

    def __init__(self, width=1280, height=720, scale=1):
        for program in ("Xvfb", "xdotool", "xrdb"):
            if shutil.which(program) is None:
                raise Skip(f"{program} is not installed (tools/setup.sh test installs it)")
        self.size = f"{width}x{height}x24"
        self.scale = scale

    def __enter__(self):
        read, write = os.pipe()
        # Without a reset, what xrdb has set outlives its connection.
        command = ["Xvfb", "-displayfd", str(write), "-screen", "0", self.size, "-nolisten", "tcp", "-noreset"]
        self.server = subprocess.Popen(command, pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as pipe:
            number = pipe.readline().strip()
        if not number:
            raise Skip("Xvfb does not start")
        self.environment = dict(os.environ, DISPLAY=f":{number}", LIBGL_ALWAYS_SOFTWARE="1")
        self.environment.pop("WAYLAND_DISPLAY", None)
        subprocess.run(["xrdb", "-nocpp", "-merge"], input=f"Xft.dpi: {96 * self.scale}\n", env=self.environment, text=True,
                       check=True, timeout=30)
        return self

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait()


class Window:
    """A running hooke view. Places of the mouse are pixels of a window of 1280 x 720."""

    PATIENCE = 90  # s: other programs share the machine

    def __init__(self, display, program, folder, arguments):
        self.display = display
        self.folder = pathlib.Path(folder)
        self.status_file = self.folder / "status.json"
        self.status_file.unlink(missing_ok=True)
        self.errors = open(self.folder / "errors.txt", "w+", encoding="utf-8")
        self.output = open(self.folder / "output.txt", "w+", encoding="utf-8")
        self.process = subprocess.Popen([program, "view", *arguments, "--status", str(self.status_file)],
                                        cwd=folder, env=display.environment, stdout=self.output, stderr=self.errors)

    def __enter__(self):
        self.wait(lambda s: s["frame"] >= 3)
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        self.errors.close()
        self.output.close()

    def alive(self):
        if self.process.poll() is not None:
            self.errors.seek(0)
            raise AssertionError(f"the window has ended with {self.process.returncode}: {self.errors.read()[-2000:]}")

    def status(self):
        try:
            return json.loads(self.status_file.read_text(encoding="utf-8"))
        except FileNotFoundError:
            return {"frame": 0}

    def wait(self, holds, what="the expected state"):
        """Waits until the status is as it should be; returns it."""
        end = time.monotonic() + self.PATIENCE
        while True:
            status = self.status()
            if status["frame"] > 0 and holds(status):
                return status
            self.alive()
            if time.monotonic() > end:
                raise AssertionError(f"no {what}: {json.dumps(status)}")
            time.sleep(0.05)

    def frames(self, count=3):
        """Lets the window draw."""
        first = self.status()["frame"]
        return self.wait(lambda s: s["frame"] >= first + count, "new frames")

    def xdotool(self, *words):
        subprocess.run(["xdotool", *map(str, words)], env=self.display.environment, check=True, timeout=30)

    def key(self, name):
        self.xdotool("key", name)
        return self.frames()

    def drag(self, start, end, button=1, key=None):
        self.xdotool("mousemove", *start)
        self.frames(2)
        if key:
            self.xdotool("keydown", key)
        self.xdotool("mousedown", button)
        self.frames(2)
        for step in range(1, 5):
            self.xdotool("mousemove", *(round(a + (b - a) * step / 4) for a, b in zip(start, end)))
            self.frames(1)
        status = self.frames(2)
        self.xdotool("mouseup", button)
        if key:
            self.xdotool("keyup", key)
        self.frames(8)
        return status

    def ask_xdotool(self, *words):
        return subprocess.run(["xdotool", *map(str, words)], env=self.display.environment, check=True, timeout=30,
                              stdout=subprocess.PIPE, text=True).stdout.split()

    def id(self):
        return self.ask_xdotool("search", "--name", "Hooke")[-1]

    def focus(self):
        self.xdotool("windowfocus", "--sync", self.id())

    def lose_focus(self):
        """To the display's root window, as a click elsewhere does."""
        self.xdotool("windowfocus", self.ask_xdotool("search", "--maxdepth", 0, "--class", "")[0])

    def click(self, place, button=1):
        self.xdotool("mousemove", *place)
        self.frames(2)
        self.xdotool("click", button)
        return self.frames()

    def quit(self):
        """Quits by the key; returns what the program has printed."""
        self.xdotool("key", "q")
        self.process.wait(timeout=self.PATIENCE)
        assert self.process.returncode == 0, self.process.returncode
        self.output.seek(0)
        return self.output.read()
