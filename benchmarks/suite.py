#!/usr/bin/env python3
"""Runs the benchmarks of a build and writes their figures into one CSV file; benchmarks/run.sh calls this.

    python3 benchmarks/suite.py build/benchmarks [--quick | --smoke] [--peers] [--skip REGEX] [--out performance.csv]

All times are CPU times of whole processes or of parts that the programs measure themselves, so that other work on the
machine hardly counts. Each round runs everything once: what is compared is measured side by side.
"""

import argparse
import csv
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent
PEERS = SOURCE / "benchmarks/peers"
COLUMNS = ["program", "case", "size", "figure", "unit", "repetitions", "min", "median", "max"]
RUN_IS_USABLE = (0, 3)  # 3: a branch ended early, what was traced is written
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
DEBIAN_PYTHON = "/usr/bin/python3"  # the one that Debian's packages are for


@dataclass(frozen=True)
class Figure:
    program: str
    case: str
    size: int
    figure: str
    unit: str


@dataclass
class Sheet:
    """Every figure with its values from all rounds."""

    values: dict = field(default_factory=dict)

    def add(self, figure: Figure, value: float) -> None:
        self.values.setdefault(figure, []).append(value)

    def write(self, path: Path) -> None:
        with open(path, "w", newline="") as file:
            rows = csv.writer(file)
            rows.writerow(COLUMNS)
            for f, values in self.values.items():
                summary = (min(values), statistics.median(values), max(values))
                rows.writerow([f.program, f.case, f.size, f.figure, f.unit, len(values), *(f"{v:.6g}" for v in summary)])


@dataclass
class Process:
    """A command whose CPU time, memory and printed figures are wanted."""

    program: str
    case: str
    size: int
    command: list
    rounds: int | None = None  # fewer than the others': for what takes long

    def run(self, launcher: str, sheet: Sheet) -> None:
        done = subprocess.run([launcher, *self.command], capture_output=True, text=True,
                              env={**os.environ, **ONE_THREAD})
        if done.returncode not in RUN_IS_USABLE:
            raise RuntimeError(f"{' '.join(self.command)} failed: {done.stderr.strip()[-500:]}")
        printed, _, last = done.stdout.strip().rpartition("whole process,")
        cpu, _, kilobytes = map(float, last.split(","))
        self.add(sheet, "process", "s", cpu)
        self.add(sheet, "peak memory of the process", "kB", kilobytes)
        self.read(printed, sheet)

    def read(self, printed: str, sheet: Sheet) -> None:
        """Lines case,size,figure,unit,value that the program prints; the case may have a part of its own behind."""
        for row in csv.reader(printed.splitlines()):
            if len(row) == 5:
                sheet.add(Figure(self.program, row[0], int(row[1]), row[2], row[3]), float(row[4]))

    def add(self, sheet: Sheet, figure: str, unit: str, value: float) -> None:
        sheet.add(Figure(self.program, self.case, self.size, figure, unit), value)


@dataclass
class TracePath(Process):
    """A run of trace-path, whose result.json says what it did."""

    out: Path = Path()  # a folder for the folders of all rounds
    number: int = 0

    def run(self, launcher: str, sheet: Sheet) -> None:
        # Nothing is removed meanwhile: ext4 looks longer for room where files were removed a moment ago.
        self.number += 1
        self.command = [*self.command[:-1], str(self.out / str(self.number))]
        super().run(launcher, sheet)

    def read(self, printed: str, sheet: Sheet) -> None:
        result = json.loads((self.out / str(self.number) / "result.json").read_text())
        for name, value in result["counts"].items():
            self.add(sheet, name, "", value)
        part = result["seconds"]["tracing"] / max(result["seconds"]["total"], 1e-9)
        self.add(sheet, "share tracing", "", part)


@dataclass
class GoogleBenchmark(Process):
    """A program that uses Google Benchmark: CPU times and rates of its cases."""

    def read(self, printed: str, sheet: Sheet) -> None:
        report = json.loads(printed)
        known = {"name", "real_time", "cpu_time", "iterations", "repetitions", "repetition_index", "threads",
                 "family_index", "per_family_instance_index"}
        seconds = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}
        for one in report["benchmarks"]:
            case, *rest = one["name"].split("/")
            size = int(rest[0]) if rest and rest[0].isdigit() else 0
            sheet.add(Figure(self.program, case, size, "time", "s"), one["cpu_time"] * seconds[one["time_unit"]])
            for name, value in one.items():
                if isinstance(value, (int, float)) and name not in known:
                    sheet.add(Figure(self.program, case, size, name.replace("_", " "), ""), value)


@dataclass
class Suite:
    build: Path
    scratch: Path
    size: str  # smoke, quick or full

    def wanted(self, smoke: list, quick: list, full: list) -> list:
        return {"smoke": smoke, "quick": smoke + quick, "full": smoke + quick + full}[self.size]

    def program(self, name: str) -> str:
        return str(self.build / ("apps" if name == "trace-path" else "benchmarks") / name)

    def traced(self, case: str, size: int, deck: str, values: list, options: tuple = (), **more) -> TracePath:
        out = self.scratch / f"{case}-{size}"
        command = [self.program("trace-path"), "run", str(SOURCE / deck), "--quiet", "--set", "path.jumps=false", *options]
        for value in values:
            command += ["--set", value]
        command += ["--out", str(out)]  # last: see TracePath
        return TracePath("trace-path", case, size, command, out=out, **more)

    def split(self, case: str, size: int, **more) -> Process:
        return Process("time_split", case, size, [self.program("time_split"), case, str(size)], **more)

    def split_deck(self, case: str, size: int, deck: str, values: list, **more) -> Process:
        command = [self.program("time_split"), "deck", case, str(SOURCE / deck), str(size), *values]
        return Process("time_split", case, size, command, **more)

    def lee(self) -> Iterator[Process]:
        for n in self.wanted([20], [100, 200, 2000], [20000, 100000]):
            yield self.split("lee", n)
            if n > 20000:  # where the yardstick's rounded matrix is no longer the frame's
                continue
            few = 2 if n > 2000 else None
            values = [f"member.column.elements={n // 2}", f"member.short.elements={n // 10}",
                      f"member.long.elements={n - n // 2 - n // 10}"]
            yardstick = [self.program("chain_yardstick"), str(n)]
            yield Process("chain_yardstick", "lee", n, yardstick, rounds=few)
            yield Process("chain_yardstick again", "lee", n, [*yardstick, "5" if n <= 5000 else "1"], rounds=few)
            yield self.traced("lee", n, "examples/lee.toml", [*values, "path.watch=[]"], rounds=few)
            if n == 20:
                yield self.traced("lee without pictures", n, "examples/lee.toml", [*values, "path.watch=[]"],
                                  options=("--no-pictures",))

    def decks(self) -> Iterator[Process]:
        for case, deck in self.wanted([], [("semicircle with all branches", "docs/validation/semicircle.toml"),
                                           ("shallow arch", "docs/validation/shallow_arch.toml"),
                                           ("arch", "examples/arch.toml")], []):
            values = ["path.branches='all'"] if case == "shallow arch" else []
            yield self.split_deck(case, 0, deck, values)
            yield self.traced(case, 0, deck, values)
        for n in self.wanted([20], [80], [320, 1280]):
            few = 1 if n > 80 else None
            values = [f"member.column.elements={n}"]
            yield self.split_deck("channel", n, "examples/channel.toml", values, rounds=few)
            yield self.traced("channel", n, "examples/channel.toml", values, rounds=few)
            at_nodes = [*values, "contact.points='nodes'", "path.max_points=100000"]
            yield self.split_deck("channel at nodes", n, "examples/channel.toml", at_nodes, rounds=few)
        for case, deck in self.wanted([], [("foundation", "examples/foundation.toml"),
                                           ("thick foundation", "examples/thick.toml")], []):
            yield self.split_deck(case, 40, deck, [])
            yield self.traced(case, 40, deck, [])

    def large(self) -> Iterator[Process]:
        for unknowns in self.wanted([], [10000], [100000, 1000000]):
            few = {10000: 2}.get(unknowns, 1)
            yield self.split("star", unknowns, rounds=few)
            yield self.split("frame", unknowns, rounds=few)
            yield Process("frame_solver", "frame", unknowns, [self.program("frame_solver"), str(unknowns)], rounds=few)

    def machine(self) -> Iterator[Process]:
        elements = "|".join(map(str, self.wanted([20], [200, 2000], [20000, 100000])))
        parts = rf"--benchmark_filter=(corrector|linearize|factorize|line_solve)/({elements})$"
        for name, options in self.wanted([], [("machine_limits", []), ("newton_iteration", [parts])], []):
            yield GoogleBenchmark(name, "all", 0, [self.program(name), "--benchmark_format=json", *options], rounds=1)

    def processes(self) -> list:
        return [*self.lee(), *self.decks(), *self.large(), *self.machine()]


def peers(suite: Suite) -> Iterator[Process | str]:
    """The peers that are installed; of the others, a name."""
    def has_module(name: str) -> bool:
        return Path(DEBIAN_PYTHON).exists() and subprocess.run([DEBIAN_PYTHON, "-c", f"import {name}"],
                                                               capture_output=True).returncode == 0

    if has_module("scipy"):
        for n in suite.wanted([20], [200, 2000], []):
            yield Process("SciPy", "lee", n, [DEBIAN_PYTHON, str(PEERS / "lee_scipy.py"), str(n)], rounds=2)
    else:
        yield "SciPy"
    if shutil.which("octave-cli"):
        for n in suite.wanted([20], [200, 2000], []):
            yield Process("Octave", "lee", n, ["octave-cli", "--no-gui", str(PEERS / "lee_octave.m"), str(n)], rounds=2)
    else:
        yield "Octave"
    if shutil.which("auto-07p"):
        yield Process("AUTO", "column between walls", 0, [sys.executable, str(PEERS / "auto/column.py")], rounds=2)
    else:
        yield "AUTO"
    if has_module("getfem"):
        yield Process("GetFEM", "foundation", 40, [DEBIAN_PYTHON, str(PEERS / "foundation_getfem.py"), "40"], rounds=1)
    else:
        yield "GetFEM"


def run(processes: list, rounds: int, launcher: str, sheet: Sheet, out: Path) -> list:
    """Writes the figures after each round. Whatever fails is left out of later rounds; returns why."""
    failures = {}
    for number in range(rounds):
        for process in processes:
            if id(process) in failures or number >= (process.rounds or rounds):
                continue
            print(f"round {number + 1} of {rounds}: {process.program}, {process.case}, {process.size}", file=sys.stderr)
            try:
                process.run(launcher, sheet)
            except (OSError, RuntimeError, ValueError) as problem:
                failures[id(process)] = f"{process.program}, {process.case}, {process.size}: {problem}"
        sheet.write(out)
    return list(failures.values())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path, help="folder of the build")
    parser.add_argument("--quick", action="store_true", help="small sizes alone: some minutes")
    parser.add_argument("--smoke", action="store_true", help="the smallest sizes alone, once: seconds")
    parser.add_argument("--peers", action="store_true", help="also the other programs that are installed")
    parser.add_argument("--skip", metavar="REGEX", help="leave out what this matches in `case size`")
    parser.add_argument("--out", type=Path, help="where to write the figures (default: performance.csv of the build)")
    given = parser.parse_args()
    size = "smoke" if given.smoke else "quick" if given.quick else "full"
    sheet = Sheet()
    with tempfile.TemporaryDirectory() as scratch:
        suite = Suite(given.build.resolve(), Path(scratch), size)
        found = list(peers(suite)) if given.peers else []
        for name in (one for one in found if isinstance(one, str)):
            sheet.add(Figure(name, "not installed", 0, "skipped", ""), 1.0)
        processes = suite.processes() + [one for one in found if isinstance(one, Process)]
        if given.skip:
            processes = [one for one in processes if not re.search(given.skip, f"{one.case} {one.size}")]
        failures = run(processes, 1 if size == "smoke" else 5, suite.program("whole_process"), sheet,
                       given.out or given.build / "performance.csv")
    if failures:
        sys.exit("suite.py: these failed, and are left out of the figures:\n" + "\n".join(failures))


if __name__ == "__main__":
    main()
