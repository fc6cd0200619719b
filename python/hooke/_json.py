# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""JSON of scenes that are Python values."""
import json
import pathlib


def _plain(value):
    if hasattr(value, "tolist"):  # numpy's numbers and arrays
        return value.tolist()
    if isinstance(value, pathlib.PurePath):
        return str(value)
    raise TypeError(f"a scene holds numbers, texts, lists and dicts, not {type(value).__name__}: {value!r}")


def dumps(value):
    """JSON of a value. TypeError for what JSON does not have, ValueError for nan and inf."""
    return json.dumps(value, default=_plain, allow_nan=False)
