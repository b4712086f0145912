#!/usr/bin/env python3
"""Traces the column between walls by AUTO and prints the CPU time of its solver alone; run it in a copy of this folder.

    python3 column.py

AUTO compiles the equations into column.exe and runs that once for each state of contact. The first pass compiles; in the
second a script in its place adds up what the program takes, without compiler and interpreter.
"""

import re
import subprocess
import sys
from pathlib import Path

TIMED = f"""#!{sys.executable}
import os, subprocess, sys
child = subprocess.Popen(["./column.solver", *sys.argv[1:]])
_, status, usage = os.wait4(child.pid, 0)
with open("cpu_times", "a") as file:
    print(usage.ru_utime + usage.ru_stime, file=file)
sys.exit(os.waitstatus_to_exitcode(status))
"""
STATES = 4


def trace() -> str:
    return subprocess.run(["auto-07p", "column.auto"], capture_output=True, text=True).stdout


trace()
solver, times = Path("column.exe"), Path("cpu_times")
solver.rename("column.solver")
solver.write_text(TIMED)
solver.chmod(0o755)
printed = trace()
taken = [float(line) for line in times.read_text().split()] if times.exists() else []
ends = re.findall(r"^\s*\d+\s+(\d+)\s+UZ\s+\d+\s+(\S+)", printed, flags=re.M)
if len(taken) != STATES or len(ends) < STATES:
    sys.exit("AUTO did not trace the four states of the column:\n" + printed[-2000:])
print(f"column between walls,0,path,s,{sum(taken):.6g}")
print(f"column between walls,0,points,,{sum(int(points) for points, _ in ends)}")
print(f"column between walls,0,load at which the flat part buckles,,{float(ends[-1][1]):.10g}")
