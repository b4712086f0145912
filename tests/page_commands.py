#!/usr/bin/env python3
"""Runs the commands of a page and compares what they print with what it says:

    python3 tests/page_commands.py TRACE_PATH PAGE

A comment before a block says what it is: `<!-- file NAME -->` a file that the commands read, `<!-- runs -->` commands,
`<!-- prints -->` what those before it print, `<!-- prints COMMAND -->` what that command prints. A
block may be indented, as in a list. With ARCWALL_WRITE_PAGES=1 the page is given what they print instead.
"""

import os
import re
import subprocess
import sys
import tempfile
import textwrap
from pathlib import Path

BLOCK = re.compile(r"^( *)<!-- (file|runs|prints) ?(.*?) ?-->\n+ *```\w*\n(.*?)^ *```$", re.MULTILINE | re.DOTALL)


def run(commands, folder, program):
    (folder / "bin").mkdir(exist_ok=True)
    link = folder / "bin" / "trace-path"
    if not link.exists():
        link.symlink_to(program)
    work = folder / "work"
    work.mkdir(exist_ok=True)
    paths = f"{folder / 'bin'}:{os.environ['PATH']}"
    done = subprocess.run(["bash", "-ec", commands], cwd=work, capture_output=True, text=True,
                          env=os.environ | {"PATH": paths})
    if done.returncode != 0:
        sys.exit(f"{commands}\nended with status {done.returncode}:\n{done.stderr}")
    return done.stdout


def main():
    program, page = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    write = os.environ.get("ARCWALL_WRITE_PAGES") == "1"
    text = page.read_text(encoding="utf-8")
    result, end, printed, compared = "", 0, "", 0
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        for block in BLOCK.finditer(text):
            indent, kind, more, content = block.groups()
            content = re.sub(f"^{indent}", "", content, flags=re.MULTILINE)
            result += text[end:block.start(4)]
            end = block.end(4)
            if kind == "file":
                (folder / "work").mkdir(exist_ok=True)
                (folder / "work" / more).write_text(content, encoding="utf-8")
            elif kind == "runs":
                printed = run(content, folder, program)
            else:
                expected = run(more, folder, program) if more else printed
                compared += 1
                if expected != content and not write:
                    sys.exit(f"{page.name} does not say what is printed\n--- the page\n{content}--- printed\n{expected}")
                content = expected
            result += textwrap.indent(content, indent)
    if compared == 0:
        sys.exit(f"{page.name} shows nothing that is printed")
    if write:
        page.write_text(result + text[end:], encoding="utf-8")
    print(f"{page.name} shows {compared} times what the program prints")


main()
