"""What the tests of the Python package share. ctest says by TRACE_PATH and ARCWALL_SOURCE where program and sources are."""

import os
import pathlib
import subprocess

import pytest

import arcwall

SOURCE = pathlib.Path(os.environ.get("ARCWALL_SOURCE", pathlib.Path(__file__).parents[2]))
EXAMPLES = SOURCE / "examples"

# Under the address sanitizer, which is loaded before the interpreter. A program that is built with it must not be given it.
SANITIZED = "asan" in os.environ.get("LD_PRELOAD", "")


@pytest.fixture
def program():
    """The program, with arguments; gives what it prints. Status 3 and 6 are paths that ended early."""

    def run(*arguments):
        command = [os.environ.get("TRACE_PATH", SOURCE / "build/dev/apps/trace-path"), *map(str, arguments)]
        environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
        outcome = subprocess.run(command, capture_output=True, text=True, env=environment)
        assert outcome.returncode in (0, 3, 6), outcome.stderr
        return outcome.stdout

    return run


@pytest.fixture
def channel():
    return arcwall.Deck.load(EXAMPLES / "channel.toml")


@pytest.fixture
def truss():
    return arcwall.Deck.load(EXAMPLES / "truss.toml")
