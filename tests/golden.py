#!/usr/bin/env python3
"""Compares runs of two builds of trace-path, for changes that must not change an answer:

    python3 tests/golden.py record PROGRAM FOLDER DECK_OR_FOLDER ...              # keeps the runs of the build before
    python3 tests/golden.py compare PROGRAM FOLDER [--class exact|mesh] [--only NAME]   # runs the same decks with another build

Both classes: the same exit status, the same branches and ends, the same events in the same order with the same counts and contacts.

    exact  λ and monitors at events and every number of path.csv agree within 1e-12 of the column's range.
    mesh   λ and monitors at events agree within 1e-6 of it. The points between events may differ.

Prints a line for each deck that differs, and the time of both builds. Exit status 1 if any deck differs. `-j N` runs N decks at once.
"""

import argparse
import csv
import json
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

TOLERANCE = {"exact": 1e-12, "mesh": 1e-6}
SECONDS = 600
ALIKE = ("kind", "branch", "stage", "unstable_before", "unstable_after", "type", "reason", "label")


def run(program, deck):
    """Returns exit status, events.json, rows of path.csv and seconds."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "run"
        command = [program, "run", str(deck), "--out", str(out), "--quiet", "--force", "--no-pictures"]
        try:
            status = subprocess.run(command, capture_output=True, timeout=SECONDS).returncode
        except subprocess.TimeoutExpired:
            return {"status": "timeout"}
        result = {"status": status}
        if (out / "events.json").exists():
            found = json.loads((out / "events.json").read_text())
            result |= {"branches": found["branches"], "events": found["events"]}
            with open(out / "path.csv") as file:
                result["path"] = list(csv.reader(file))
            result["seconds"] = json.loads((out / "result.json").read_text())["seconds"]["total"]
        return result


def contacts(event):
    return [(contact.get("wall"), contact.get("member")) for contact in event.get("contact", [])]


def columns(rows):
    """Returns the numbers of each column of path.csv; other cells stay text."""

    def number(cell):
        try:
            return float(cell)
        except ValueError:
            return cell

    return {name: [number(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0])}


def far_apart(before, now, scale, tolerance):
    if isinstance(before, float) and isinstance(now, float):
        return not abs(before - now) <= tolerance * scale and before != now and (before == before or now == now)
    return before != now


def scales(path):
    """Returns the largest absolute value of each column of path.csv."""
    return {
        name: max((abs(cell) for cell in cells if isinstance(cell, float)), default=0.0) for name, cells in path.items()
    }


def difference(before, now, kind):
    """Returns the first difference of two runs in words, or nothing."""
    if before["status"] != now["status"]:
        return f"exit status {before['status']} became {now['status']}"
    if ("events" in before) != ("events" in now):
        return "one of the runs has no events.json"
    if "events" not in before:
        return ""
    ends = [[(branch["origin"], branch["end"]["reason"]) for branch in one["branches"]] for one in (before, now)]
    if ends[0] != ends[1]:
        return f"ends {ends[0]} became {ends[1]}"
    kinds = [[event["kind"] for event in one["events"]] for one in (before, now)]
    if kinds[0] != kinds[1]:
        return f"events {kinds[0]} became {kinds[1]}"
    path, other = columns(before["path"]), columns(now["path"])
    scale, tolerance = scales(path), TOLERANCE[kind]
    for old, new in zip(before["events"], now["events"]):
        what = f"{old['kind']} {old['id']}"
        for key in ALIKE:
            if old.get(key) != new.get(key):
                return f"{what}: {key} {old.get(key)!r} became {new.get(key)!r}"
        if contacts(old) != contacts(new):
            return f"{what}: contacts {contacts(old)} became {contacts(new)}"
        values = {"lambda": (old["lambda"], new["lambda"])}
        values |= {name: (value, new["monitors"].get(name)) for name, value in old["monitors"].items()}
        for name, (value, changed) in values.items():
            if far_apart(value, changed, scale.get(name, 0.0), tolerance):
                return f"{what}: {name} {value!r} became {changed!r}"
    if kind == "mesh":
        return ""
    if before["path"][0] != now["path"][0] or len(before["path"]) != len(now["path"]):
        return f"path.csv: {len(before['path'])} rows became {len(now['path'])}"
    for name, cells in path.items():
        for i, (value, changed) in enumerate(zip(cells, other[name])):
            if far_apart(value, changed, scale[name], tolerance):
                return f"path.csv row {i}: {name} {value!r} became {changed!r}"
    return ""


def decks_of(names):
    for name in map(Path, names):
        yield from sorted(name.rglob("*.toml")) if name.is_dir() else [name]


def record(arguments):
    folder = Path(arguments.folder)
    folder.mkdir(parents=True, exist_ok=True)

    def keep(numbered):
        number, deck = numbered
        result = {"deck": str(deck.resolve())} | run(arguments.program, deck)
        (folder / f"{number:04d}-{deck.stem}.json").write_text(json.dumps(result))

    decks = list(enumerate(decks_of(arguments.decks), len(list(folder.glob("*.json")))))
    with ThreadPoolExecutor(arguments.jobs) as pool:
        list(pool.map(keep, decks))
    print(f"{len(decks)} runs are kept in {folder}")
    return 0


def compare(arguments):
    kept = [path for path in sorted(Path(arguments.folder).glob("*.json")) if arguments.only in path.stem]
    if not kept:
        sys.exit(f"error: {arguments.folder} has no kept runs; `golden.py record` writes them")

    def repeat(path):
        before = json.loads(path.read_text())
        now = run(arguments.program, before["deck"])
        return before, now, difference(before, now, arguments.kind)

    seconds, agree = [0.0, 0.0], 0
    with ThreadPoolExecutor(arguments.jobs) as pool:
        for before, now, why in pool.map(repeat, kept):
            agree += not why
            if why:
                print(f"{before['deck']}: {why[:400]}", flush=True)
            else:
                seconds[0] += before.get("seconds", 0.0)
                seconds[1] += now.get("seconds", 0.0)
    print(f"{agree} of {len(kept)} agree ({arguments.kind}); {seconds[0]:.1f} s became {seconds[1]:.1f} s")
    return 0 if agree == len(kept) else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    for name, action in (("record", record), ("compare", compare)):
        command = commands.add_parser(name)
        command.add_argument("program")
        command.add_argument("folder")
        command.add_argument("-j", dest="jobs", type=int, default=1)
        command.set_defaults(action=action)
        if action is record:
            command.add_argument("decks", nargs="+")
        else:
            command.add_argument("--class", dest="kind", choices=TOLERANCE, default="exact")
            command.add_argument("--only", default="", help="compare only decks whose name contains this")
    arguments = parser.parse_args()
    return arguments.action(arguments)


if __name__ == "__main__":
    sys.exit(main())
