"""Compares the module's stub with the module, whose functions have their signatures in their docstrings; and checks documentation."""
import ast
import inspect
import pathlib
import re
import unittest

import candela
from candela import _candela

STUB = pathlib.Path(candela.__file__).with_name("_candela.pyi")


def names_of(arguments):
    return [argument.arg for argument in arguments.posonlyargs + arguments.args if argument.arg != "self"]


def stubbed():
    """The stub's declarations: "Scene.render" and the names of its arguments, or None for other than functions."""
    declared = {}

    def add(prefix, nodes):
        for node in nodes:
            if isinstance(node, ast.ClassDef):
                declared[prefix + node.name] = None
                add(prefix + node.name + ".", node.body)
            elif isinstance(node, ast.FunctionDef):
                is_property = any(isinstance(d, ast.Name) and d.id == "property" for d in node.decorator_list)
                declared[prefix + node.name] = None if is_property else names_of(node.args)
            elif isinstance(node, ast.AnnAssign):
                declared[prefix + node.target.id] = None

    add("", ast.parse(STUB.read_text(encoding="utf-8")).body)
    return declared


def bound():
    """The module's declarations."""
    found = {}

    def arguments_of(function):
        signature = function.__doc__.split("\n", 1)[0]
        return [name for name in re.findall(r"[(,] ?(\w+):", signature) if name != "self"]

    def add(prefix, owner):
        for name, value in vars(owner).items():
            if inspect.isclass(value):
                found[prefix + name] = None
                add(prefix + name + ".", value)
            elif name == "__version__" or isinstance(value, property):
                found[prefix + name] = None
            elif name == "__init__" and (value.__doc__ or "").startswith("__init__(self: "):
                found[prefix + name] = arguments_of(value)
            elif not name.startswith("_"):
                value = value.__func__ if isinstance(value, staticmethod) else value
                found[prefix + name] = arguments_of(value)

    add("", _candela)
    return found


class Stubs(unittest.TestCase):
    maxDiff = None

    def test_the_stub_declares_what_the_module_has_with_the_same_arguments(self):
        self.assertEqual(stubbed(), bound())


class Docstrings(unittest.TestCase):
    def test_everything_public_has_a_docstring_and_annotations(self):
        for name in candela.__all__:
            value = getattr(candela, name)
            if not (inspect.isclass(value) or inspect.isfunction(value)):
                continue
            self.assertTrue(inspect.getdoc(value), name)
            members = {name: value} if inspect.isfunction(value) else {
                f"{name}.{member}": getattr(attribute, "__func__", attribute)
                for member, attribute in vars(value).items()
                if not member.startswith("_") or member == "__init__"}
            for member, function in members.items():
                function = function.fget if isinstance(function, property) else function
                if not inspect.isfunction(function) or function.__module__.split(".")[0] != "candela":
                    continue
                if not member.endswith("__init__"):
                    self.assertTrue(function.__doc__, member)
                signature = inspect.signature(function)
                missing = [p.name for p in signature.parameters.values()
                           if p.annotation is p.empty and p.name not in ("self", "cls")]
                self.assertEqual(missing, [], member)
                self.assertIsNot(signature.return_annotation, signature.empty, member)


if __name__ == "__main__":
    unittest.main()
