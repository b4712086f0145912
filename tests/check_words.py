#!/usr/bin/env python3
"""Checks the words of the pages by the rules of docs/contributing.md:

    python3 tests/check_words.py             # fails where a page has more findings than tests/check_words.json, or too many words
    python3 tests/check_words.py --show PAGE # prints the findings of a page
    python3 tests/check_words.py --table     # words, sentence lengths and findings of every page
    python3 tests/check_words.py --update    # writes lower counts into tests/check_words.json

A finding is a banned word, a sentence of more than 25 words, or a sentence that opens with "Where", "What" or "Of". Every event
kind, end reason, type of bifurcation, step outcome and monitor component of the sources needs a row in docs/reference. Links to
headlines of pages lead to one.
"""

import json
import re
import sys
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[1]
BASELINE = SOURCE / "tests/check_words.json"
LONG = 25

# Each with what to write instead.
BANNED = {
    r"\bways?\b(?! to\b)": "displacement, path, direction, method",
    r"\bbehind\b": "after, beyond",
    r"\b(?:a|the|first|each|this|every|no) touch(?:es)?\b": "contact",
    r"(?<!axial )\bstretch(?:es)?\b": "contact zone; span",
    r"(?<!degree of )(?<!degrees of )\bfreedoms?\b": "degree of freedom",
    r"\blands? on\b|\blanded\b|\blandings?\b": "is solved for; jump",
    r"\bfalls? to\b|\bfalls\b(?= away)": "jumps to",
    r"\bcomes? to lie\b|\blies? down\b": "comes into contact",
    r"(?<!there )\bis no [a-z]+": "is not a",
    r"\b(?:tells|told|says|said|knows|asks|sees|minds|wants)\b": "reports, returns, supports, detects",
    r"\bto the last (?:bit|digit)\b|\bbit by bit\b": "bit-identical; to machine precision",
    r"\bhardly\b|\bby a hair\b|\bfor good\b": "a number",
    r"\blets? go\b": "is released",
    r"\bgives? way\b": "buckles; deforms",
    r"\bheld\b": "fixed, constrained, constant, kept closed",
    r"\bgreatest\b|(?<!at )\bleast\b": "maximum, minimum",
    r"\brefused?\b": "rejected",
    r"\blikewise\b|\bbesides\b|\bbut for\b": "also, except",
    r"\bunsupported\b": "not modelled",
}
OPENING = re.compile(r"^(?:Where|What|Of) (?!.*\?$)")

# Words that a page may have, code and tables included.
BUDGETS = {
    "README.md": 1910, "CHANGELOG.md": 700, "docs/tutorial.md": 1500, "docs/gallery.md": 1540, "docs/contributing.md": 900,
    "docs/explanation/contact.md": 1590, "docs/explanation/loading.md": 900, "docs/explanation/trust.md": 1300,
    "docs/reference/deck.md": 5450, "docs/reference/outputs.md": 3000, "docs/reference/errors.md": 2000,
    "docs/reference/command-line.md": 700, "docs/reference/glossary.md": 1000, "docs/reference/python.md": 1900,
    "docs/reference/library.md": 940, "docs/reference/sweep.md": 1100, "docs/architecture.md": 1500, "docs/decisions.md": 2450,
    "docs/theory.md": 15860, "docs/validation.md": 4200, "docs/paper.md": 1400, "docs/performance.md": 1900,
}
HOW_TO = 500


def pages(root: Path) -> dict:
    files = [root / "README.md", root / "CHANGELOG.md", *sorted((root / "docs").rglob("*.md"))]
    return {str(file.relative_to(root)): file.read_text(encoding="utf-8") for file in files}


def sentences(page: str, cells: bool = True) -> list:
    """Of paragraphs, list items and, if wanted, cells of tables, without code; a name in `code` is a word."""
    text = re.sub(r"^ *```.*?^ *```$|<!--.*?-->|^    .*?$|^\|[ |:-]*$", "", page, flags=re.M | re.S)
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"`[^`]+`", "`x`", text)
    units, paragraph = [], []
    for line in [*text.split("\n"), ""]:
        starts = re.match(r"\s*(?:[-*] |\d+\. |#|\||$)", line)
        if starts and paragraph:
            units.append(" ".join(paragraph))
            paragraph = []
        if line.lstrip().startswith("|"):
            units += line.strip().strip("|").split(" | ") if cells else []
        elif line.strip() and not line.startswith("#"):
            paragraph.append(re.sub(r"^\s*(?:[-*]|\d+\.) ", "", line).strip())
    parts = [part.strip(" *_") for unit in units for part in re.split(r"(?<=[.!?:])[*_]* +(?=[^a-z])", unit)]
    return [part for part in parts if re.search(r"[A-Za-z]{2}", part)]


def length(sentence: str) -> int:
    return len([word for word in sentence.split() if re.search(r"\w", word)])


def findings(page: str) -> list:
    found = []
    for sentence in sentences(page):
        for banned, better in BANNED.items():
            for hit in re.findall(banned, sentence, flags=re.I):
                found.append(("banned", f"'{hit}' (better: {better}): {sentence}"))
        if length(sentence) > LONG:
            found.append(("long", f"{length(sentence)} words: {sentence}"))
        if OPENING.match(sentence):
            found.append(("opening", sentence))
    return found


def counts(page: str) -> dict:
    kinds = [kind for kind, _ in findings(page)]
    return {kind: kinds.count(kind) for kind in ("banned", "long", "opening")}


def names_without_entry() -> list:
    """Names that files have and that no row or headline of the reference begins with."""
    sources = {
        "event kind": ("model/event_names.cpp", r"to_text\(EventKind \w+\) \{(.*?)\n\}", r'return "([\w-]+)"', 12),
        "end reason": ("model/event_names.cpp", r"to_text\(EndReason \w+\) \{(.*?)\n\}", r'return "([\w-]+)"', 16),
        "type of bifurcation": ("model/event_names.cpp", r"to_text\(BranchType \w+\) \{(.*?)\n\}", r'return "([\w-]+)"', 4),
        "step outcome": ("model/step_ledger.cpp", r"to_text\(StepOutcome \w+\) \{(.*?)\n\}", r'return "([\w-]+)"', 14),
        "step strategy": ("model/step_ledger.cpp", r"to_text\(Strategy \w+\) \{(.*?)\n\}", r'return "([\w-]+)"', 9),
        "monitor component": ("model/deck/words.hpp", r"(.*)", r'\{"([\w-]+)", Component::', 16),
    }
    entries = set()
    for page in (SOURCE / "docs/reference").glob("*.md"):
        for row in re.findall(r"^(?:\| |#+ )(`.*?)(?: \||$)", page.read_text(encoding="utf-8"), flags=re.M):
            entries |= set(re.findall(r"`([\w-]+)`", row))
    missing = []
    for kind, (file, part, name, at_least) in sources.items():
        names = [n for text in re.findall(part, (SOURCE / file).read_text(encoding="utf-8"), flags=re.S) for n in re.findall(name, text)]
        if len(names) < at_least:
            missing.append(f"tests/check_words.py finds only {len(names)} names of the kind '{kind}' in {file}")
        missing += [f"{kind} `{n}` has no row in docs/reference" for n in names if n not in entries]
    return missing


def broken_anchors() -> list:
    """Links to headlines that pages do not have."""
    def anchors(page: str) -> set:
        text = re.sub(r"^```.*?^```$", "", page, flags=re.M | re.S)
        return {re.sub(r"[^\w\- ]", "", h.lower()).replace(" ", "-") for h in re.findall(r"^#+ (.*)$", text, flags=re.M)}
    links = [(name, file, anchor) for name, page in pages(SOURCE).items()
             for file, anchor in re.findall(r"\]\(([^)#:\s]*)#([^)]+)\)", page)]
    return [f"{name} links to {file}#{anchor}, which is not there" for name, file, anchor in links
            if anchor not in anchors((SOURCE / name).parent.joinpath(file or Path(name).name).read_text(encoding="utf-8"))]


def table(root: Path) -> None:
    print("| page | words | sentences of prose | mean length | above 30 words | banned words |\n| --- | --- | --- | --- | --- | --- |")
    sums = [0, 0, 0, 0, 0]
    for name, page in pages(root).items():
        lengths = [length(s) for s in sentences(page, cells=False)]
        row = [len(page.split()), len(lengths), sum(lengths), sum(n > 30 for n in lengths), counts(page)["banned"]]
        sums = [a + b for a, b in zip(sums, row)]
        print_row(name, row)
    print_row("all", sums)


def print_row(name: str, row: list) -> None:
    words, number, total, long, banned = row
    print(f"| {name} | {words} | {number} | {total / max(number, 1):.1f} | {100 * long / max(number, 1):.0f} % | {banned} |")


def main() -> None:
    arguments = sys.argv[1:]
    if arguments[:1] == ["--table"]:
        return table(Path(arguments[1]).resolve() if len(arguments) > 1 else SOURCE)
    if arguments[:1] == ["--show"]:
        for kind, what in findings(Path(arguments[1]).read_text(encoding="utf-8")):
            print(f"{kind}: {what}")
        return None
    allowed = json.loads(BASELINE.read_text()) if BASELINE.exists() else {}
    failures, now = names_without_entry() + broken_anchors(), {}
    for name, page in pages(SOURCE).items():
        budget = BUDGETS.get(name, HOW_TO if name.startswith("docs/how-to/") else None)
        if budget is not None and len(page.split()) > budget:
            failures.append(f"{name} has {len(page.split())} words; at most {budget}")
        now[name] = counts(page)
        for kind, count in now[name].items():
            if count > allowed.get(name, {}).get(kind, 0) and (BASELINE.exists() or arguments != ["--update"]):
                failures.append(f"{name}: {kind}: {count}: at most {allowed.get(name, {}).get(kind, 0)}; "
                                f"python3 tests/check_words.py --show {name}")
    if arguments == ["--update"] and not any(": at most" in failure for failure in failures):
        kept = {name: found for name, found in now.items() if any(found.values())}
        BASELINE.write_text(json.dumps(kept, indent=1) + "\n")
    if failures:
        sys.exit("\n".join(failures))
    print(f"{len(now)} pages keep to their words")
    return None


main()
