#!/usr/bin/env python3
"""Spoils folders of runs, curves and sweeps, and looks at what the program says to them:

    python3 bad_folders.py TRACE_PATH EXAMPLES [FOLDERS [SEED]]

Files are cut, garbled, edited, swapped, emptied, missing, or no files at all. Every command must end in time with one of
its own statuses: no signal, no internal error. The tests spoil a few folders; `200` is what a release is tried with.
"""
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

OWN_STATUSES = {0, 1, 2, 3, 4, 5, 6, 7, 8, 130}
SECONDS = 30

program, examples = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
count = int(sys.argv[3]) if len(sys.argv) > 3 else 20
seed = int(sys.argv[4]) if len(sys.argv) > 4 else 1
draw = random.Random(seed)


def run(arguments, folder):
    """The status and what was said; None if it did not end in time."""
    try:
        done = subprocess.run([program, *arguments], cwd=folder, capture_output=True, timeout=SECONDS, stdin=subprocess.DEVNULL)
    except subprocess.TimeoutExpired:
        return None, ""
    return done.returncode, (done.stdout[:4000] + done.stderr[:4000]).decode(errors="replace")


# --- what is spoiled ----------------------------------------------------------------------------------------------------

def make_whole_folders(scratch):
    """A run that slides, one that could go on, a run with stages, a curve, and two sweeps, in folders and in records."""
    channel = str(examples / "channel.toml")
    coarse = ["--set", "member.column.elements=10"]
    made = [
        ["run", channel, "--out", "run", "--quiet", *coarse],
        ["run", channel, "--out", "cut", "--quiet", "--max-points", "5", "--no-pictures", *coarse],
        ["run", str(examples / "harvester.toml"), "--out", "stages", "--quiet", "--no-pictures", "--max-points", "60"],
        ["curve", channel, "--out", "curve", "--quiet", *coarse],
    ]
    for study, more in (("study", []), ("records", ["--records"])):
        made.append(["sweep", "plan", "sweep.toml", "--out", study])
        made.append(["sweep", "run", study, "--quiet", *more])
        made.append(["sweep", "collect", study])
    (scratch / "sweep.toml").write_text(f'title = "two"\ndeck = "{examples}/truss.toml"\n[grid]\n"path.step" = [1.0, 2.0]\n')
    for arguments in made:
        status, said = run(arguments, scratch)
        if status not in (0, 3, 6):
            sys.exit(f"error: {arguments}: status {status}\n{said}")


def commands_for(folder):
    if folder in ("study", "records"):
        return [["sweep", "status", folder], ["sweep", "collect", folder], ["sweep", "run", folder, "--quiet"],
                ["sweep", "emit", folder, "--engine", "slurm"]]
    if folder == "curve":
        return [["curve", str(examples / "channel.toml"), "--out", "curve", "--quiet", "--set", "member.column.elements=10",
                 "--set", "curve.max_points=2"], ["report", folder]]
    # The last one writes the files anew.
    return [["verify", folder], ["verify", folder, "--again"], ["report", folder], ["resume", folder, "--quiet", "--max-points", "3"]]


# --- how ----------------------------------------------------------------------------------------------------------------

def cut(file):
    data = file.read_bytes()
    file.write_bytes(data[:draw.randrange(len(data) + 1)])


def garble(file):
    data = bytearray(file.read_bytes())
    for _ in range(draw.choice((1, 1, 3, 30))):
        if data:
            data[draw.randrange(len(data))] = draw.randrange(256)
    file.write_bytes(data)


def insert(file):
    data = file.read_bytes()
    at = draw.randrange(len(data) + 1)
    more = draw.choice((b"\0" * 100, b"\xff\xfe", b"}" * 50, b"[" * 5000, b"{\"a\":" * 3000, b"\n\n,,,,\n", b"1e999", b"-0", b"\"" * 3,
                        "λ\u202e".encode(), draw.randbytes(64)))
    file.write_bytes(data[:at] + more + data[at:])


def repeat(file):
    data = file.read_bytes()
    a, b = sorted((draw.randrange(len(data) + 1), draw.randrange(len(data) + 1)))
    file.write_bytes(data[:b] + data[a:b] + data[b:])


def drop_line(file):
    lines = file.read_bytes().split(b"\n")
    del lines[draw.randrange(len(lines))]
    file.write_bytes(b"\n".join(lines))


def odd_value(value):
    odd = [None, True, -1, 0, 10**18, 1e308, "", "x" * 5000, [], {}, [[[]]], "\u0000\u202e", 0.5]
    return draw.choice([one for one in odd if one != value])


def edit_json(file):
    """One value of a JSON text, or of a line of one, is another."""
    text = file.read_text(errors="replace")
    lines = text.split("\n") if file.suffix == ".jsonl" else [text]
    which = draw.randrange(len(lines))
    try:
        value = json.loads(lines[which])
    except ValueError:
        return garble(file)
    at = value
    while isinstance(at, (dict, list)) and at:
        key = draw.choice(list(at)) if isinstance(at, dict) else draw.randrange(len(at))
        if not isinstance(at[key], (dict, list)) or not at[key] or draw.random() < 0.2:
            if draw.random() < 0.2:
                del at[key]
            else:
                at[key] = odd_value(at[key])
            break
        at = at[key]
    lines[which] = json.dumps(value)
    file.write_text("\n".join(lines))


def edit_cells(file):
    lines = file.read_text(errors="replace").split("\n")
    which = draw.randrange(len(lines))
    cells = lines[which].split(",")
    cells[draw.randrange(len(cells))] = draw.choice(("", "nan", "inf", "-1", "1e400", "x", '"', "9" * 400, "0x1p3"))
    if draw.random() < 0.3:
        cells = cells[:draw.randrange(len(cells) + 1)]
    lines[which] = ",".join(cells)
    file.write_text("\n".join(lines))


def other_thing(file):
    """Something that is no file, or not this one, where a file is expected."""
    kind = draw.randrange(9)
    file.unlink()
    if kind == 0:
        os.mkfifo(file)
    elif kind == 1:
        file.mkdir()
    elif kind == 2:
        file.symlink_to("/dev/zero")
    elif kind == 3:
        file.symlink_to(file.name)
    elif kind == 4:
        file.symlink_to("/nowhere/at/all")
    elif kind == 5:
        file.touch()
        os.truncate(file, 1 << 40)
    elif kind == 6:
        file.write_bytes(b"")
    elif kind == 7:
        file.write_bytes(draw.randbytes(draw.randrange(1, 5000)))
    # else it is missing


def swap(file):
    others = [other for other in file.parent.iterdir() if other.is_file() and other != file]
    if others:
        shutil.copyfile(draw.choice(others), file)


def spoil(folder):
    """What was done, in words."""
    files = sorted(path for path in folder.rglob("*") if path.is_file() and "shapes" not in path.parts)
    important = [path for path in files if path.name in ("checkpoint", "result.json", "cases.jsonl", "events.json", "path.csv", "deck.toml")]
    done = []
    for _ in range(draw.choice((1, 1, 1, 2, 4))):
        file = draw.choice(important if important and draw.random() < 0.6 else files)
        if file.is_symlink() or not file.is_file() or file.stat().st_size > 1 << 24:
            continue  # that was spoiled before
        ways = [cut, garble, insert, repeat, drop_line, other_thing, swap]
        if file.suffix in (".json", ".jsonl"):
            ways += [edit_json] * 6
        if file.suffix == ".csv":
            ways += [edit_cells] * 4
        way = draw.choice(ways)
        way(file)
        done.append(f"{way.__name__} {file.relative_to(folder.parent)}")
    return ", ".join(done)


# --- all of them --------------------------------------------------------------------------------------------------------

def main():
    findings = calls = 0
    statuses = {}
    with tempfile.TemporaryDirectory() as scratch:
        scratch = Path(scratch)
        whole = scratch / "whole"
        whole.mkdir()
        make_whole_folders(whole)
        folders = sorted(path.name for path in whole.iterdir() if path.is_dir())
        for number in range(count):
            folder = folders[number % len(folders)]
            tried = scratch / "tried"
            shutil.copytree(whole, tried, symlinks=True)
            what = spoil(tried / folder)
            for arguments in commands_for(folder):
                status, said = run(arguments, tried)
                calls += 1
                statuses[status] = statuses.get(status, 0) + 1
                if status not in OWN_STATUSES or "internal error" in said:
                    findings += 1
                    print(f"{number}: {what}\n  {' '.join(arguments)}: "
                          f"{'no end in time' if status is None else f'status {status}'}\n  {said[:500]}")
            shutil.rmtree(tried)
    print(f"{count} spoiled folders, {calls} calls, {findings} findings; statuses "
          + ", ".join(f"{status}: {statuses[status]}" for status in sorted(statuses, key=str)))
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
