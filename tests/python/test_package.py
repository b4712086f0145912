"""The package as a whole: stubs, docstrings, names."""

import ast
import inspect
import subprocess
import sys

from conftest import SOURCE

import arcwall
from arcwall import _engine


def public(names):
    return {name for name in names if not name.startswith("_")}


# The stub of the built module has its functions, its classes, and of these the methods with their arguments.
def test_the_stub_is_that_of_the_module():
    stub = ast.parse((SOURCE / "python" / "arcwall" / "_engine.pyi").read_text())
    functions = {node.name: node for node in stub.body if isinstance(node, ast.FunctionDef)}
    classes = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef)}
    assert public(dir(_engine)) == {*functions, *classes, "version"}
    for name, node in classes.items():
        methods = {one.name: one for one in node.body if isinstance(one, ast.FunctionDef)}
        members = {*methods, *(one.target.id for one in node.body if isinstance(one, ast.AnnAssign))}
        assert public(dir(getattr(_engine, name))) == public(members), name
        for method, of in methods.items():
            check_arguments(of, getattr(getattr(_engine, name), method).__doc__)
    for name, node in functions.items():
        check_arguments(node, getattr(_engine, name).__doc__)


def check_arguments(node, signature):
    for argument in node.args.args:
        assert argument.arg == "self" or f"{argument.arg}:" in signature, (node.name, argument.arg)


def test_each_name_of_the_package_is_there_and_says_what_it_is():
    assert sorted(arcwall.__all__) == arcwall.__all__
    for name in arcwall.__all__:
        thing = getattr(arcwall, name)
        assert name == "__version__" or inspect.getdoc(thing), name
        if not inspect.isclass(thing) or not thing.__module__.startswith("arcwall"):
            continue
        for method, of in vars(thing).items():
            if method.startswith("_") or not (inspect.isfunction(of) or isinstance(of, (property, classmethod))):
                continue
            if (name, method) in {("Curve", "title"), ("SystemPath", "monitors")} or hasattr(of, "_fields"):
                continue
            assert inspect.getdoc(getattr(thing, method)) or inspect.getdoc(of), (name, method)


# Annotations and the stub fit together, and so do their uses inside the package.
def test_the_types_hold():
    checker = [sys.executable, "-m", "mypy", "--cache-dir=/dev/null", "--ignore-missing-imports", "--follow-imports=skip"]
    outcome = subprocess.run([*checker, SOURCE / "python" / "arcwall"], capture_output=True, text=True)
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr


def test_the_version_is_that_of_the_program(program):
    assert program("--version").split() == ["trace-path", arcwall.__version__]
