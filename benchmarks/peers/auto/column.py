#!/usr/bin/env python3
"""Traces the column between walls by AUTO and prints the CPU time of its solver alone.

    python3 column.py

AUTO compiles the equations into column.exe and runs that once for each state of contact. The first pass compiles; in the
second a script in its place adds up what the program takes, without compiler and interpreter.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
STATES = 4
TIMED = """#!{python}
import os, subprocess, sys
child = subprocess.Popen(["{solver}", *sys.argv[1:]])
_, status, usage = os.wait4(child.pid, 0)
with open("{times}", "a") as file:
    print(usage.ru_utime + usage.ru_stime, file=file)
sys.exit(os.waitstatus_to_exitcode(status))
"""


def trace(folder: Path) -> str:
    return subprocess.run(["auto-07p", "column.auto"], cwd=folder, capture_output=True, text=True).stdout


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for file in ("column.f90", "c.column", "column.auto"):
            shutil.copy(HERE / file, folder)
        trace(folder)
        program, solver, times = folder / "column.exe", folder / "solver", folder / "times"
        if not program.exists():
            sys.exit("AUTO did not compile the equations")
        program.rename(solver)
        program.write_text(TIMED.format(python=sys.executable, solver=solver, times=times))
        program.chmod(0o755)
        printed = trace(folder)
        taken = [float(line) for line in times.read_text().split()] if times.exists() else []
    ends = re.findall(r"^\s*\d+\s+(\d+)\s+UZ\s+\d+\s+(\S+)", printed, flags=re.M)
    if len(taken) != STATES or len(ends) < STATES:
        sys.exit("AUTO did not trace the four states of the column:\n" + printed[-2000:])
    for figure, unit, value in (("path", "s", sum(taken)), ("points", "", sum(int(points) for points, _ in ends)),
                                ("load at which the flat part buckles", "", float(ends[-1][1]))):
        print(f"column between walls,0,{figure},{unit},{value:.10g}")


if __name__ == "__main__":
    main()
