# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""The types that editors see are those of the module."""
import ast
import inspect
import pathlib
import re
import unittest

import hooke
from hooke import _hooke


def stub_names():
    """Names of the stub, with the names of the parameters of functions: {"Simulation.step": ["self", "count"]}."""
    text = (pathlib.Path(hooke.__file__).parent / "_hooke.pyi").read_text()
    found = {}

    def add(body, prefix):
        for node in body:
            if isinstance(node, ast.FunctionDef):
                static = any(getattr(d, "id", "") == "staticmethod" for d in node.decorator_list)
                is_property = any(getattr(d, "id", "") == "property" for d in node.decorator_list)
                names = [a.arg for a in node.args.args + node.args.kwonlyargs]
                if prefix and not static:
                    names = names[1:]
                found[prefix + node.name] = None if is_property else names
            elif isinstance(node, ast.ClassDef):
                add(node.body, node.name + ".")
            elif isinstance(node, ast.AnnAssign):
                found[prefix + node.target.id] = None

    add(ast.parse(text).body, "")
    return found


def module_names():
    found = {}

    def parameters(function):
        signature = re.search(r"\((.*)\)( ->|$)", function.__doc__.splitlines()[0]).group(1)
        signature = re.sub(r"\[[^\[\]]*\]", "", re.sub(r"\[[^\[\]]*\]", "", signature))
        names = re.findall(r"(?:^|, )(\w+):", signature)
        return [name for name in names if name != "self"]

    for name, value in vars(_hooke).items():
        if inspect.isclass(value):
            for member, item in vars(value).items():
                if isinstance(item, property):
                    found[f"{name}.{member}"] = None
                elif (not member.startswith("__") or member in ("__len__", "__getitem__")) and callable(getattr(value, member)):
                    found[f"{name}.{member}"] = parameters(getattr(value, member))
        elif callable(value):
            found[name] = parameters(value)
    return found


class Stub(unittest.TestCase):
    def test_names_and_parameters(self):
        stub, module = stub_names(), module_names()
        special = {name for name in stub if re.search(r"(^|\.)__\w+__$", name)} - set(module)
        self.assertEqual(set(stub) - special, set(module))
        for name, names in module.items():
            self.assertEqual(stub[name], names, name)

    def test_everything_public_is_described(self):
        for name in hooke.__all__:
            item = getattr(hooke, name)
            self.assertTrue(item.__doc__, name)
            for member, value in vars(item).items() if inspect.isclass(item) else ():
                if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                    if issubclass(item, tuple):
                        continue
                    self.assertTrue(value.__doc__ and len(value.__doc__) > 2, f"{name}.{member}")
        self.assertTrue((pathlib.Path(hooke.__file__).parent / "py.typed").exists())
