"""The type stubs name what the module has, and nothing else, with the same parameters."""

import ast
import inspect
import re
import unittest
from pathlib import Path

import foretouch
from foretouch import _foretouch

STUB = Path(_foretouch.__file__).with_name("_foretouch.pyi")


def is_public(name):
    return not name.startswith("_") or name in ("__version__", "__init__", "__len__", "__getitem__")


def own_members(cls):
    return {name for name in vars(cls) if is_public(name)}


def stub_members(node):
    names = set()
    for item in node.body:
        if isinstance(item, ast.FunctionDef):
            names.add(item.name)
        elif isinstance(item, ast.AnnAssign):
            names.add(item.target.id)
        elif isinstance(item, ast.Assign):
            names.update(target.id for target in item.targets)
    return names


def stub_parameters(function):
    """Names in order, with a star where only keywords follow, two for any, and defaults as text."""
    arguments = function.args
    positional = [a.arg for a in arguments.args]
    defaults = [None] * (len(positional) - len(arguments.defaults)) + arguments.defaults
    found = list(zip(positional, map(value_of, defaults)))
    if arguments.kwonlyargs:
        found.append(("*", None))
        found += zip([a.arg for a in arguments.kwonlyargs], map(value_of, arguments.kw_defaults))
    if arguments.kwarg:
        found.append(("**", None))
    return [pair for pair in found if pair[0] != "self"]


def value_of(node):
    return None if node is None else (ast.literal_eval(node),)


def bound_parameters(function):
    """The same of a compiled function, from the first line of its docstring."""
    signature = function.__doc__.splitlines()[0]
    inside = re.match(r"\w+\((.*)\) -> ", signature).group(1)
    found = []
    for argument in ast.parse(f"f({bound_as_call(inside)})").body[0].value.args:
        name, default = ast.literal_eval(argument)
        found.append((name, default))
    return [pair for pair in found if pair[0] != "self"]


def bound_as_call(inside):
    parts, depth, current = [], 0, ""
    for character in inside:
        depth += character in "([{"
        depth -= character in ")]}"
        if character == "," and depth == 0:
            parts.append(current)
            current = ""
        else:
            current += character
    parts.append(current)
    pairs = []
    for part in filter(str.strip, parts):
        name = re.match(r"\s*(\*{1,2}|\w+)", part).group(1)
        default = re.search(r" = (.*)$", part)
        pairs.append(f"({name!r}, {f'({default.group(1)},)' if default else None})")
    return ", ".join(pairs)


class Stubs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.tree = ast.parse(STUB.read_text())
        cls.classes = {n.name: n for n in cls.tree.body if isinstance(n, ast.ClassDef)}
        cls.functions = {n.name: n for n in cls.tree.body if isinstance(n, ast.FunctionDef)}

    def test_name_what_the_module_has(self):
        stubbed = set(self.classes) | set(self.functions) | {
            node.target.id for node in self.tree.body if isinstance(node, ast.AnnAssign)}
        self.assertEqual(stubbed, {name for name in dir(_foretouch) if is_public(name)})

    def test_name_what_classes_have(self):
        inherited = {"InputError", "ResourceError"}
        for name, node in self.classes.items():
            with self.subTest(name):
                members = own_members(getattr(_foretouch, name))
                if node.name in inherited:
                    members = set()
                if not any(isinstance(n, ast.FunctionDef) and n.name == "__init__"
                           for n in node.body):
                    members.discard("__init__")  # pybind11 gives one to each class
                    with self.assertRaises((TypeError, ValueError)) if not issubclass(
                            getattr(_foretouch, name), Exception) else self.subTest():
                        getattr(_foretouch, name)()
                self.assertEqual(stub_members(node), members)

    def test_have_the_same_parameters_and_defaults(self):
        checked = 0
        for name, node in self.functions.items():
            self.assertEqual(stub_parameters(node), bound_parameters(getattr(_foretouch, name)))
        for name, node in self.classes.items():
            for item in node.body:
                if not isinstance(item, ast.FunctionDef) or item.name in ("__len__", "__getitem__"):
                    continue
                if any(getattr(d, "id", "") == "property" for d in item.decorator_list):
                    continue
                with self.subTest(f"{name}.{item.name}"):
                    bound = getattr(getattr(_foretouch, name), item.name)
                    self.assertEqual(stub_parameters(item), bound_parameters(bound))
                    checked += 1
        self.assertGreater(checked, 15)

    def test_functions_and_query_have_the_same_options(self):
        options = dict(stub_parameters(next(
            n for n in self.classes["Query"].body if getattr(n, "name", "") == "__init__")))
        for function in [foretouch.first_contacts, foretouch.first_contacts_many]:
            parameters = inspect.signature(function).parameters
            for name, default in options.items():
                if default is not None:
                    self.assertEqual((parameters[name].default,), default, name)


if __name__ == "__main__":
    unittest.main()
