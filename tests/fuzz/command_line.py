#!/usr/bin/env python3
"""Command lines at random, right and wrong: python3 command_line.py PROGRAM [--long] [--seed N]

Options of a command, values right and wrong, and `--set` are mixed. Whatever is asked, the program ends by itself, with a status
that the documentation has, and not as a defect (1), and says why where the status is that of an error. With --long there are
3000 instead of 60; a program that was built with sanitizers sees more.
"""
import argparse
import os
import random
import subprocess
import sys
import tempfile

NUMBERS = ["0", "1", "3", "-1", "1e400", "nan", "inf", "-0", "0x10", "1e-300", "99999999999999999999", "", " ", "1,5", "3.5"]
TEXTS = ["x", "=1", "-", "--", "\u202e", "a b", "/dev/null", "..", "results", "a" * 5000, "%s%n", "\x1b[2J", "[1", "{}", "'"]
SETS = ["path.step=1.0", "path.max_points=3", "path.step=x", "path.step=", "=1", "x", "a.b.c.d=1", "load.0.force=[0,-1]",
        "load.9.force=[0,-1]", "material.bar.E=0", "material.bar.E=[1]", "path.stop={}", "title='t'", "title=1", "path=3",
        "path.jumps=true", "path.search=true", "member={}", "point.a=[nan,0]", "load=[]", "wall=[]", "path.method='arc'"]
RUN = {"--out": TEXTS, "--set": SETS, "--max-points": NUMBERS, "--max-time": NUMBERS, "--checkpoint-pause": NUMBERS,
       "--scratch": None, "--json": None, "--no-pictures": None, "--quiet": None, "--force": None, "--verbose": None,
       "--dry-run": None, "--no-units": None}
COMMANDS = {
    "run": (["truss.toml"], RUN),
    "check": (["truss.toml"], {"--set": SETS}),
    "curve": (["truss.toml"], RUN),
    "converge": (["truss.toml"], {"--levels": NUMBERS, "--factor": NUMBERS, "--set": SETS, "--out": TEXTS, "--quiet": None}),
    "resume": (["done"], {key: RUN[key] for key in ("--max-points", "--max-time", "--checkpoint-pause", "--quiet", "--json")}),
    "verify": (["done"], {"--quiet": None, "--again": None}),
    "report": (["done"], {"--out": TEXTS, "--measured": ["measured.csv", "truss.toml", "x"]}),
    "sweep plan": (["sweep.toml"], {"--out": TEXTS}),
    "sweep run": (["study"], {"--case": NUMBERS, "--part": ["0/2", "2/2", "x", "1/0"] + NUMBERS, "--jobs": ["1", "0", "-1", "x"],
                              "--max-time": NUMBERS, "--failed": None, "--force": None, "--records": None, "--quiet": None}),
    "sweep collect": (["study"], {"--over": ["path.step", "x", ""]}),
    "sweep status": (["study"], {}),
    "sweep emit": (["study"], {"--engine": ["slurm", "parallel", "x"], "--jobs": NUMBERS, "--tasks": NUMBERS, "--time": TEXTS}),
}
WORDS = ["truss.toml", "done", "study", "sweep.toml", "missing", "", ".", "/dev/null", "measured.csv"]
DOCUMENTED = {0, 2, 3, 4, 5, 6, 7, 8, 130}


def command_line(draw):
    command = draw.choice(list(COMMANDS))
    words, options = COMMANDS[command]
    words = [draw.choice(WORDS) if draw.random() < 0.15 else word for word in words]
    line = command.split() + words * draw.choice([1] * 12 + [0, 2])
    for _ in range(draw.randrange(6)):
        if not options:
            break
        option = draw.choice(list(options))
        values = options[option]
        line.append(option)
        if values is not None and draw.random() < 0.95:
            line.append(draw.choice(values))
    if draw.random() < 0.05:
        line.append(draw.choice(["--unknown", "--", "-h", "--help", "--version", "--ou"]))
    return line


def prepare(program, folder):
    def call(*arguments):
        subprocess.run([program, *arguments], cwd=folder, check=True, capture_output=True)

    call("examples", "truss", "--out", "truss.toml")
    call("run", "truss.toml", "--out", "done", "--quiet", "--set", "path.max_points=1000")
    with open(os.path.join(folder, "sweep.toml"), "w", encoding="utf-8") as file:
        file.write('title = "t"\ndeck = "truss.toml"\n[grid]\n"path.step" = [1.0, 2.0]\n')
    with open(os.path.join(folder, "measured.csv"), "w", encoding="utf-8") as file:
        file.write('lambda,"mid [a,b]"\n0.1,"0.01"\n')
    call("sweep", "plan", "sweep.toml", "--out", "study")


def complaint(outcome):
    text = outcome.stderr.decode("utf-8", "replace")
    if outcome.returncode not in DOCUMENTED:
        return f"status {outcome.returncode}"
    if "Sanitizer" in text or "runtime error" in text:
        return "a sanitizer speaks"
    if outcome.returncode in (2, 4, 5) and not text.strip():
        return f"status {outcome.returncode} without a word"
    return None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--long", action="store_true")
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    program, draw, found = os.path.realpath(asked.program), random.Random(asked.seed), 0
    with tempfile.TemporaryDirectory() as outer:
        folder = os.path.join(outer, "work")  # `--out ..` stays inside
        os.mkdir(folder)
        prepare(program, folder)
        for _ in range(3000 if asked.long else 60):
            line = command_line(draw)
            try:  # in a session of its own: a program that ends its group ends no more than that
                outcome = subprocess.run([program, *line], cwd=folder, capture_output=True, stdin=subprocess.DEVNULL,
                                         timeout=120, start_new_session=True, check=False)
                wrong = complaint(outcome)
            except subprocess.TimeoutExpired:
                wrong = "it does not end"
            if wrong:
                found += 1
                print(f"error: {wrong}: {line}", file=sys.stderr)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
