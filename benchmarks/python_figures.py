#!/usr/bin/env python3
"""What the Python package costs: the figures of docs/reference/python.md.

    python3 benchmarks/python_figures.py BUILD [--rounds N] [DECK …]

BUILD has the module (ARCWALL_PYTHON) and the benchmarks. Prints for each deck the CPU time of a trace by the library and by
Python, each from the deck's text to the end of the path, and by how much Python's is greater; then where the time of a path of
one's own equations goes. The library and Python run in turn, each in a process of its own, and of each trace the least time of
all rounds counts: other work on the machine only adds.
"""

import argparse
import os
import subprocess
import sys
import time
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent
DECKS = ["channel", "lee", "truss", "portal", "cylinder"]
SECONDS = 1.0  # of one process, about


def times_of_library(build, deck, repetitions):
    command = [build / "benchmarks/library_trace", deck, str(repetitions)]
    return [float(line) for line in subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()]


# In this process: to load a deck, to trace it, and to read λ, the monitors and the events.
def times_here(file, repetitions):
    import arcwall

    for _ in range(repetitions):
        begin = time.process_time()
        deck = arcwall.Deck.load(file)
        loaded = time.process_time()
        path = deck.trace()
        traced = time.process_time()
        for name in ("lambda", *path.monitors):
            path[name]
        path.events
        print(f"{loaded - begin:.6f} {traced - loaded:.6f} {time.process_time() - traced:.6f}")
        del path  # what it takes to free one is timed neither here nor of the library


def times_of_python(deck, repetitions):
    command = [sys.executable, __file__, "--here", deck, str(repetitions)]
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    return [tuple(map(float, line.split())) for line in lines]


def compare(build, deck, rounds):
    repetitions = max(3, round(SECONDS / min(times_of_library(build, deck, 3))))
    library, python = [], []
    for _ in range(rounds):
        library += times_of_library(build, deck, repetitions)
        python += times_of_python(deck, repetitions)
    least = min(library)
    load, trace, read = (min(times) for times in zip(*python))
    print(
        f"{deck.stem:10} library {1e3 * least:7.3f} ms, Python {1e3 * trace:7.3f} ms, {100 * (trace / least - 1):+.1f} %;"
        f" to load the deck {1e3 * load:.3f} ms, to read columns and events {1e3 * read:.3f} ms"
    )


# Bratu's problem with 10 000 unknowns, through its fold: what its three functions take, and what scipy takes for a solution.
def split_of_bratu():
    import arcwall
    import numpy as np
    import scipy.sparse as sp
    from scipy.sparse.linalg import spsolve

    n = 10_000
    spent = {"residual": 0.0, "jacobian": 0.0, "dlam": 0.0}
    calls = dict.fromkeys(spent, 0)
    ones = np.ones(n)
    K = (n + 1) ** 2 * sp.diags([-ones[1:], 2 * ones, -ones[1:]], [-1, 0, 1], format="csc")

    def timed(name, function):
        def run(u, lam):
            begin = time.process_time()
            result = function(u, lam)
            spent[name] += time.process_time() - begin
            calls[name] += 1
            return result

        return run

    class Bratu:
        residual = staticmethod(timed("residual", lambda u, lam: K @ u - lam * np.exp(u)))
        jacobian = staticmethod(timed("jacobian", lambda u, lam: K - sp.diags(lam * np.exp(u), format="csc")))
        dlam = staticmethod(timed("dlam", lambda u, lam: -np.exp(u)))

    begin = time.process_time()
    path = arcwall.trace(Bratu(), np.zeros(n), stop={n // 2: (-1.0, 4.0)})
    whole = time.process_time() - begin
    J, F = Bratu.jacobian(path.x[-1], path["lambda"][-1]), np.ones(n)
    begin = time.process_time()
    for _ in range(5):
        spsolve(J, F)
    solve = (time.process_time() - begin) / 5
    print(f"Bratu, {n} unknowns, {len(path)} points: {whole:.2f} s, {calls['jacobian']} linearizations, of which")
    for name, seconds in spent.items():
        print(f"  {name:10} {seconds:.3f} s in {calls[name]} calls")
    of_one = whole / calls["jacobian"]
    callbacks = sum(spent.values()) / calls["jacobian"]
    print(f"  so {1e3 * of_one:.1f} ms each, {1e3 * callbacks:.1f} ms in callbacks; scipy's spsolve takes {1e3 * solve:.1f} ms")


def main():
    if sys.argv[1:2] == ["--here"]:
        return times_here(sys.argv[2], int(sys.argv[3]))
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("decks", nargs="*", type=Path, help="default: some of the examples")
    parser.add_argument("--rounds", type=int, default=5)
    given = parser.parse_args()
    os.environ.update(PYTHONPATH=str(given.build.resolve() / "python/package"), OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    sys.path.insert(0, os.environ["PYTHONPATH"])
    for deck in given.decks or [SOURCE / "examples" / f"{name}.toml" for name in DECKS]:
        compare(given.build.resolve(), deck, given.rounds)
    split_of_bratu()


if __name__ == "__main__":
    main()
