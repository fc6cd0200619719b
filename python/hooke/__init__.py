# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""Hooke, a real-time spring-mass particle engine.

    sim = hooke.Simulation.from_scene("scenes/ball-pit.json")
    sim.step(100)
    print(sim.snapshot().x.mean(axis=0))

A scene is a dict like its JSON file: docs/scene.md, hooke.schema(). SI units throughout. docs/python.md is the guide.
"""
from __future__ import annotations

import json
import os
import pathlib
from typing import Any, Callable, Optional, Union

import numpy as np

from ._errors import BusyError, ClosedError, Error, FileError, Finding, InputError, RunFailed, SceneError
from ._figures import ColliderLoad, ColliderPose, Contacts, Ledger, Measurements
from . import _hooke
from ._hooke import Simulation, Snapshot, State, __version__, schema

__all__ = [
    "BusyError", "ClosedError", "ColliderLoad", "ColliderPose", "Contacts", "Error", "FileError", "Finding",
    "InputError", "Ledger", "Measurements", "Run", "RunFailed", "SceneError", "Simulation", "Snapshot", "State",
    "export", "run", "schema",
]

Path = Union[str, "os.PathLike[str]"]


class Run(_hooke.Run):
    """The folder that a run has written, or is writing: what was there when it was opened.

    Run("out").snapshot(time=1).x; for snapshot in Run("out"): ...
    """

    @property
    def report(self) -> dict[str, Any]:
        """report.json as a dict. FileNotFoundError before the run's end."""
        return json.loads((self._home / "report.json").read_text(encoding="utf-8"))

    @property
    def scene(self) -> dict[str, Any]:
        """The scene as it was understood, with all defaults."""
        return json.loads((self._home / "scene.json").read_text(encoding="utf-8"))

    @property
    def series(self) -> np.ndarray:
        """series.csv as a structured array: run.series["time"], run.series["kinetic_energy"]; series.dtype.names."""
        with open(self._home / "series.csv", encoding="utf-8") as file:
            return np.atleast_1d(np.genfromtxt(file, delimiter=",", names=True, deletechars=""))

    @property
    def _home(self) -> pathlib.Path:
        folder = pathlib.Path(self.folder)
        return folder if folder.is_dir() else folder.parent


def run(scene: Union[Path, dict[str, Any]], folder: Path, film: Optional[Path] = None, *,
        set: dict[str, Any] = {}, threads: int = 0, device: str = "cpu", resume: Optional[Path] = None,
        overwrite: bool = False, checkpoint_every: Optional[float] = None, size: tuple[int, int] = (1280, 720),
        fps: float = 30.0, speed: float = 1.0, color_by: str = "material",
        on_progress: Optional[Callable[[int, int], Any]] = None) -> Run:
    """Runs a scene, a file or a dict, into a folder, as `hooke run` does, and returns the Run to read.

    The options are those of Simulation.from_scene() and Simulation.run(). A run that `resume`s its own folder goes on
    in it.
    """
    open_scene = Simulation.from_dict if isinstance(scene, dict) else Simulation.from_scene
    with open_scene(scene, set=set, threads=threads, device=device, resume=resume) as simulation:
        simulation.run(folder, overwrite=overwrite, checkpoint_every=checkpoint_every, film=film, size=size, fps=fps,
                       speed=speed, color_by=color_by, on_progress=on_progress)
    return Run(folder)


def export(run: Union[Path, Run], file: Path, *, time: Optional[float] = None, step: Optional[int] = None,
           all: bool = False, content: str = "particles", surface_radius: float = 1.0,
           surface_smoothing: float = 1.5, surface_resolution: float = 0.5) -> list[pathlib.Path]:
    """Writes snapshots of a run in the format that the extension of `file` names, as `hooke export` does.

    The last snapshot, the one nearest to `time` (s), the one of `step`, or `all`. `content`: "particles",
    "contacts", "surface", "volume", "cloths", "springs". Returns the files written, the one to open first at the front.
    """
    folder = run.folder if isinstance(run, Run) else run
    return _hooke.export(folder, file, time=time, step=step, all=all, content=content, surface_radius=surface_radius,
                         surface_smoothing=surface_smoothing, surface_resolution=surface_resolution)
