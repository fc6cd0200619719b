# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""The exceptions of hooke. All are hooke.Error and carry every finding."""
from __future__ import annotations

from typing import NamedTuple, Sequence


class Finding(NamedTuple):
    """One fault, and its place."""

    where: str  #: a JSON path ("materials.water.radius"), "file.csv:12", a file, an argument; may be empty
    message: str  #: what is wrong, the value, and what is allowed

    def __str__(self) -> str:
        return f"{self.where}: {self.message}" if self.where else self.message


class Error(Exception):
    """Why something failed; `findings` has all faults at once, at least one."""

    findings: list[Finding]

    def __init__(self, findings: Sequence[Finding]):
        self.findings = list(findings)
        super().__init__("\n".join(str(finding) for finding in self.findings))

    def __str__(self) -> str:
        return "\n".join(str(finding) for finding in self.findings)

    def __reduce__(self):
        return type(self), (self.findings,)


class InputError(Error, ValueError):
    """An argument can't be used."""


class SceneError(InputError):
    """A scene can't be used: `where` is the JSON path, or the file and its line."""


class RunFailed(Error, RuntimeError):
    """The simulation went bad: `where` is the step. It stays as it is and takes no more steps."""


class FileError(Error, OSError):
    """A file could not be read or written."""


class BusyError(Error, RuntimeError):
    """The simulation is at work: in another thread, or in a step that called this one."""


class ClosedError(Error, RuntimeError):
    """The simulation is closed."""
