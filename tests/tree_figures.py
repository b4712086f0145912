#!/usr/bin/env python3
"""Counts what makes moving contact hard to follow, for the working tree or for revisions:

    python3 tests/tree_figures.py [REVISION ...]

Code lines have no blanks and no comments. Constants are numbers in function bodies other than 0, 1, 2 and 0.5. A ladder is a list of
factors that are tried in turn. Prints a Markdown table with one column for each revision.
"""

import re
import subprocess
import sys
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[1]
ROOMS = ("core", "continuation", "elements", "contact", "contact/sliding")
NUMBER = re.compile(r"(?<![\w.])(\d+\.\d*(?:e[-+]?\d+)?|\d+e[-+]?\d+)(?![\w.])")
PLAIN = {0.0, 0.5, 1.0, 2.0}


def tree(revision):
    """Returns the text of each C++ source by its path."""
    if revision is None:
        names = [path for room in ROOMS[:4] for path in sorted((SOURCE / room).rglob("*.[ch]pp"))]
        return {str(path.relative_to(SOURCE)): path.read_text() for path in names}

    def git(*words):
        return subprocess.run(["git", "-C", str(SOURCE), *words], check=True, capture_output=True, text=True).stdout

    names = git("ls-tree", "-r", "--name-only", revision, *ROOMS[:4]).split()
    return {name: git("show", f"{revision}:{name}") for name in names if name.endswith((".cpp", ".hpp"))}


def code(text):
    """Returns the lines that have code, without comments and texts."""
    lines = (re.sub(r'"(?:[^"\\]|\\.)*"', '""', line).split("//")[0].rstrip() for line in text.split("\n"))
    return [line for line in lines if line.strip()]


def virtual_functions(text, name):
    body = re.search(rf"^class {name}\b.*?^}};", text, re.S | re.M)
    return len(re.findall(r"^\s+(?:\[\[nodiscard\]\] )?virtual (?!~)", body.group(0), re.M)) if body else 0


def figures(sources):
    lines = {name: code(text) for name, text in sources.items()}

    def of(room, suffix=""):
        return [line for name in lines if name.startswith(room + "/") and name.endswith(suffix) for line in lines[name]]

    def constants(room):
        numbers = [float(number) for line in of(room, ".cpp") for number in NUMBER.findall(line)]
        return sum(number not in PLAIN for number in numbers)

    def ladders(room):
        lists = re.findall(r"for \(const \w+ \w+ : \{([^}]*)\}|constexpr std::array \w+\{([\d., ]*)\}", "\n".join(of(room)))
        numbers = [NUMBER.findall(first or second) for first, second in lists]
        return sum(len(found) > 1 and len({float(number) for number in found}) == len(found) for found in numbers)

    moving = of("contact/sliding")
    result = {f"code lines of {room}": len(of(room)) for room in ROOMS}
    result |= {f"constants in {room}": constants(room) for room in ROOMS[1:3] + ROOMS[4:]}
    result["ladders of trial lengths in contact/sliding"] = ladders("contact/sliding")
    result["ladders of trials in continuation/corners"] = ladders("continuation/corners")
    result["virtual functions of System and its bases"] = sum(
        virtual_functions(text, name) for text in sources.values() for name in ("System", "UnilateralSystem", "Equations")
    )
    result["guard kinds"] = sum(bool(re.search(r"class \w+ final : public (BoundOf\w+|ValidityBound)\b", line)) for line in moving)
    result["dynamic_cast in contact/sliding"] = sum(line.count("dynamic_cast") for line in moving)
    strategies = re.search(r"enum class Strategy \{(.*?)\};", "\n".join("\n".join(text) for text in lines.values()), re.S)
    result["strategies in the step log"] = len(re.findall(r"\w+", strategies.group(1))) if strategies else 0
    return result


def main():
    names = sys.argv[1:] or [None]
    found = [figures(tree(name)) for name in names]
    print("| figure | " + " | ".join(name or "working tree" for name in names) + " |")
    print("| --- |" + " ---: |" * len(names))
    for figure in found[0]:
        print(f"| {figure} | " + " | ".join(str(one[figure]) for one in found) + " |")


if __name__ == "__main__":
    main()
