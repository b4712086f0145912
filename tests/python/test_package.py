"""The package as a whole: stubs, types, what its module calls."""

import ast
import graphlib
import os
import subprocess
import sys

from conftest import SOURCE

import arcwall
from arcwall import _engine


# The stub of the built module has its functions, its classes, and of these the methods. Of their arguments, which pybind11
# tells in docstrings alone, it has those names. Classes of pybind11 have a metaclass that no stub could name.
def test_the_stub_is_that_of_the_module(tmp_path):
    stub = ast.parse((SOURCE / "python" / "arcwall" / "_engine.pyi").read_text())
    classes = [node for node in stub.body if isinstance(node, ast.ClassDef)]
    allowed = tmp_path / "allowed"
    allowed.write_text("".join(f"arcwall._engine.{node.name}\n" for node in classes))
    checker = [sys.executable, "-m", "mypy.stubtest", "arcwall._engine", "--allowlist", allowed]
    outcome = subprocess.run(checker, capture_output=True, text=True, cwd=tmp_path)
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr
    for holder, nodes in [(_engine, stub.body), *((getattr(_engine, node.name), node.body) for node in classes)]:
        for node in nodes:
            if isinstance(node, ast.FunctionDef):
                check_arguments(node, getattr(holder, node.name).__doc__)


def check_arguments(node, signature):
    for argument in node.args.args:
        assert argument.arg == "self" or f"{argument.arg}:" in signature, (node.name, argument.arg)


# Annotations fit together inside the package, and are what a program that uses it relies on.
def test_the_types_hold_in_the_package_and_for_a_program():
    checker = [sys.executable, "-m", "mypy", "--cache-dir=/dev/null", "--ignore-missing-imports", "--disallow-untyped-defs"]
    program, environment = SOURCE / "tests/python/typed_program.py", os.environ | {"MYPYPATH": str(SOURCE / "python")}
    outcome = subprocess.run([*checker, program], capture_output=True, text=True, env=environment)
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr


# What sets malloc, locale, environment or numbers of threads for the whole process is not called. (sigaction() is there for
# the program's commands; that importing and tracing leave signals alone is seen in test_path.py.)
def test_the_module_calls_nothing_that_changes_the_process():
    listing = subprocess.run(["nm", "-D", "--undefined-only", _engine.__file__], capture_output=True, text=True, check=True)
    called = {line.split()[-1].split("@")[0] for line in listing.stdout.splitlines()}
    assert "malloc" in called or "_Znwm" in called
    settings = {"mallopt", "setlocale", "setenv", "putenv", "fesetround", "setrlimit", "_ZNSt6locale6globalERKS_"}
    assert not called & settings
    assert not [name for name in called if "num_threads" in name]


def test_the_version_is_that_of_the_program(program):
    assert program("--version").split() == ["trace-path", arcwall.__version__]


def test_the_modules_import_each_other_in_no_circle():
    imports = {}
    for file in (SOURCE / "python/arcwall").glob("*.py"):
        tree = ast.parse(file.read_text())
        for node in ast.walk(tree):  # annotations alone need what type checkers import
            if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
                node.body = [ast.Pass()]
        of_package = [node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.level == 1]
        imports[file.stem] = {name for node in of_package for name in ([node.module] if node.module else [a.name for a in node.names])}
    assert "pictures" in imports["curves"]
    graphlib.TopologicalSorter(imports).prepare()  # raises CycleError
