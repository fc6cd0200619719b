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


def is_special(name):
    return re.search(r"(^|\.)__\w+__$", name) is not None


def parameters(function):
    """Parameters of a function of the syntax tree: [("count", 1), ...]; the value is a default, or ... where none is."""
    names = [a.arg for a in function.args.args]
    defaults = [...] * (len(names) - len(function.args.defaults)) + [ast.literal_eval(d) for d in function.args.defaults]
    found = list(zip(names, defaults))
    for argument, default in zip(function.args.kwonlyargs, function.args.kw_defaults):
        found.append(("*" + argument.arg, ... if default is None else ast.literal_eval(default)))
    return [each for each in found if each[0] != "self"]


def stub_names():
    """Names of the stub with their parameters, if any: {"Simulation.step": [("count", 1)], "Simulation.time": None}."""
    text = (pathlib.Path(hooke.__file__).parent / "_hooke.pyi").read_text()
    found = {}

    def add(body, prefix):
        for node in body:
            if isinstance(node, ast.FunctionDef):
                is_property = any(getattr(d, "id", "") == "property" for d in node.decorator_list)
                found[prefix + node.name] = None if is_property else parameters(node)
            elif isinstance(node, ast.ClassDef):
                add(node.body, node.name + ".")
            elif isinstance(node, ast.AnnAssign):
                found[prefix + node.target.id] = None

    add(ast.parse(text).body, "")
    return found


def module_names():
    """The same of the module, by the signatures at the front of the descriptions. Without names like __init__."""
    found = {}

    def signature(function):
        return parameters(ast.parse(f"def {function.__doc__.splitlines()[0]}: ...").body[0])

    for name, value in vars(_hooke).items():
        if inspect.isclass(value):
            for member, item in vars(value).items():
                if isinstance(item, property):
                    found[f"{name}.{member}"] = None
                elif not is_special(member) and callable(getattr(value, member)):
                    found[f"{name}.{member}"] = signature(getattr(value, member))
        elif callable(value) and not is_special(name):
            found[name] = signature(value)
    return found


class Stub(unittest.TestCase):
    def test_names_parameters_and_defaults(self):
        stub, module = stub_names(), module_names()
        self.assertEqual({name for name in stub if not is_special(name)}, set(module))
        for name, found in module.items():
            self.assertEqual(stub[name], found, name)

    def test_special_names(self):
        for name in filter(is_special, stub_names()):
            *classes, special = name.split(".")
            owner = getattr(_hooke, classes[0]) if classes else _hooke
            self.assertTrue(hasattr(owner, special), name)
            self.assertIsNot(getattr(owner, special), getattr(object, special, None), name)

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
