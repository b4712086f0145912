#!/usr/bin/env python3
"""The smallest benchmarks run, their figures can be read, and the page can be made of them.

    python3 suite_test.py BUILD_DIR
"""

import csv
import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent

# Lee's frame: shooting, as in docs/validation.md. With 20 elements the yardstick's are off by 3e-3, arcwall's, of order 4,
# by 2e-5.
FIRST_LIMIT = 1.855672754  # [kN]
ERRORS = {"chain_yardstick": 1e-2, "time_split": 1e-4}


def check(holds: bool, what: str) -> None:
    if not holds:
        sys.exit(f"suite_test.py: {what}")


def main() -> None:
    build = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        figures = Path(folder, "performance.csv")
        subprocess.run([sys.executable, SOURCE / "benchmarks/suite.py", build, "--smoke", "--out", figures], check=True)
        page = subprocess.run([sys.executable, SOURCE / "docs/make_performance.py", figures], check=True,
                              capture_output=True, text=True).stdout
        with open(figures, newline="") as file:
            rows = list(csv.DictReader(file))

    least = {(row["program"], row["case"], row["figure"]): float(row["min"]) for row in rows}
    for program, error in ERRORS.items():
        limit = least[program, "lee", "first limit"]
        check(abs(limit - FIRST_LIMIT) <= error * FIRST_LIMIT, f"{program}: first limit {limit}")
    for case in ("lee", "channel", "channel at nodes"):
        check(least["time_split", case, "factorizations"] > 0, f"{case}: no factorization was seen")
        check(least["time_split", case, "right-hand sides"] > 0, f"{case}: no solution was seen")
        parts = sum(value for (program, of, figure), value in least.items()
                    if (program, of) == ("time_split", case) and figure.startswith("share "))
        check(abs(parts - 1.0) < 1e-4, f"{case}: the shares of the time add up to {parts}")
    check(least["time_split", "channel at nodes", "contact changes"] > 0, "no contact changed")
    for row in rows:
        check(float(row["min"]) <= float(row["median"]) <= float(row["max"]), f"not in order: {row}")
    for words in ("## Goals", "| lee, 20 |", "| channel at nodes, 20 |"):
        check(words in page, f"the page does not have {words!r}")


if __name__ == "__main__":
    main()
