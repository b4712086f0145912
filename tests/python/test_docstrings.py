"""Docstrings: each public name has one with an example, in numpydoc form, and the examples run."""

import ast
import dataclasses
import doctest
import inspect
import re
import shutil

import matplotlib
import pytest
from conftest import EXAMPLES

import arcwall

matplotlib.use("Agg")
NAMES = [name for name in arcwall.__all__ if name != "__version__"]
CLASSES = [name for name in NAMES if inspect.isclass(getattr(arcwall, name))]


def functions_of(name):
    """Return (label, function) of a public function, or of the public methods of a class, properties included."""
    thing = getattr(arcwall, name)
    if not inspect.isclass(thing):
        return [(name, thing)]
    found = []
    for method, of in vars(thing).items():
        of = of.fget if isinstance(of, property) else getattr(of, "__func__", of)
        if inspect.isfunction(of) and (not method.startswith("_") or method in ("__getitem__", "__setitem__") and of.__doc__):
            found.append((f"{name}.{method}", of))
    return found


def section(docstring, title):
    found = re.search(rf"^{title}\n-+\n(.*?)(?=^[A-Z]\w+\n-+\n|\Z)", docstring, re.M | re.S)
    return found.group(1) if found else ""


def test_names_are_in_order():
    assert sorted(arcwall.__all__) == arcwall.__all__


@pytest.mark.parametrize("name", NAMES)
def test_each_class_and_function_has_an_example(name):
    assert ">>> " in section(inspect.getdoc(vars(arcwall)[name]) or "", "Examples")


@pytest.mark.parametrize("name", NAMES)
def test_each_function_documents_its_arguments_and_its_result(name):
    for label, function in functions_of(name):
        docstring = inspect.cleandoc(function.__doc__ or "")
        summary = docstring.partition("\n\n")[0]
        assert summary.endswith(".") and "\n" not in summary, label
        signature = inspect.signature(function)
        is_property = isinstance(inspect.getattr_static(getattr(arcwall, name), label.partition(".")[2], None), property)
        documented = [
            one
            for names in re.findall(r"^(\w[\w, ]*) : ", section(docstring, "Parameters"), re.M)
            for one in names.split(", ")
        ]
        assert documented == [one for one in signature.parameters if one not in ("self", "cls")], label
        returns = signature.return_annotation not in (inspect.Signature.empty, None, "None")
        assert is_property or bool(section(docstring, "Returns")) == returns, label


@pytest.mark.parametrize("name", [name for name in CLASSES if dataclasses.is_dataclass(getattr(arcwall, name))])
def test_each_field_has_a_comment(name):
    thing = getattr(arcwall, name)
    lines = inspect.getsource(thing).splitlines()
    (definition,) = ast.parse("\n".join(lines)).body
    fields = [node for node in definition.body if isinstance(node, ast.AnnAssign)]
    assert [node.target.id for node in fields] == [field.name for field in dataclasses.fields(thing)]
    for node in fields:
        before, own = lines[node.lineno - 2].strip(), lines[node.end_lineno - 1]
        assert "  #: " in own or before.startswith("#: "), node.target.id


@pytest.fixture(scope="module")
def decks(tmp_path_factory):
    folder = tmp_path_factory.mktemp("decks")
    for name in ("channel", "truss"):
        shutil.copy(EXAMPLES / f"{name}.toml", folder)
    return folder


@pytest.mark.parametrize("name", ["arcwall", *NAMES])
def test_examples_print_what_they_show(name, decks, tmp_path, monkeypatch):
    shutil.copytree(decks, tmp_path, dirs_exist_ok=True)
    monkeypatch.chdir(tmp_path)
    thing = getattr(arcwall, name, arcwall)
    found = doctest.DocTestFinder(recurse=inspect.isclass(thing)).find(thing, name, globs={"arcwall": arcwall})
    shown = []
    runner = doctest.DocTestRunner(verbose=False)
    for one in found:
        runner.run(one, out=shown.append)
    assert runner.tries > 0 and runner.failures == 0, "".join(shown)
