#!/usr/bin/env python3
"""Reads the figures of benchmarks/suite.py and prints docs/performance.md.

    python3 docs/make_performance.py build/benchmarks/performance.csv > docs/performance.md

Sections whose figures are missing (sizes left out by --quick, peers that are not installed) are left out. Figures are the
least of all repetitions; a ratio takes both from one file.
"""

import csv
import sys
from collections.abc import Callable
from dataclasses import dataclass

# Peers that are hard to install, by their ratio to the yardstick: CPU time per Newton iteration and element on Lee's frame
# with 200 elements, 0.67 us and 0.92 us beside 0.12 us, once measured side by side on one machine.
BY_RATIO = {"OpenSees": 0.67 / 0.12, "LOCA": 0.92 / 0.12}

# The yardstick's work per element and iteration, counted in benchmarks/chain_yardstick.cpp.
YARDSTICK_FLOPS = 420  # assembly 160, factorization 115, two solutions 100, vectors 45
YARDSTICK_BYTES = 430  # 54 numbers of blocks, factors and vectors, each of which goes by once at least
YARDSTICK_DIVISIONS = 3  # pivots of a node, each of which waits for the one before


class Figures:
    def __init__(self, path: str):
        with open(path, newline="") as file:
            rows = list(csv.DictReader(file))
        try:
            self.least = {(r["program"], r["case"], int(r["size"]), r["figure"]): float(r["min"]) for r in rows}
        except (KeyError, ValueError) as problem:
            sys.exit(f"make_performance.py: {path} is no file of benchmarks/suite.py: {problem}")

    def of(self, program: str, case: str, size: int, figure: str) -> float | None:
        return self.least.get((program, case, size, figure))

    def sizes(self, program: str, case: str) -> list[int]:
        return sorted({key[2] for key in self.least if key[:2] == (program, case)})

    def cases(self, program: str) -> list[tuple[str, int]]:
        return list(dict.fromkeys(key[1:3] for key in self.least if key[0] == program))

    def smallest_and_largest(self, program: str) -> list[tuple[str, int]]:
        return [(case, size) for case, size in self.cases(program)
                if size in (min(self.sizes(program, case)), max(self.sizes(program, case)))]

    def ratio(self, one: tuple, other: tuple) -> float | None:
        a, b = self.of(*one), self.of(*other)
        return a / b if a is not None and b else None


def shown(value: float | None, digits: int = 3) -> str:
    if value is None:
        return "–"
    text = f"{value:.{digits}g}"
    return f"{value:.0f}" if "e" in text and abs(value) >= 1.0 else text


def table(head: list[str], rows: list[list]) -> str:
    lines = ["| " + " | ".join(head) + " |", "| --- " + "| ---: " * (len(head) - 1) + "|"]
    lines += ["| " + " | ".join(cell if isinstance(cell, str) else shown(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines)


# --- goals ----------------------------------------------------------------------------------------------------------


@dataclass
class Goal:
    what: str
    bound: float
    figure: Callable[[Figures], float | None]
    at_least: bool = False

    def row(self, figures: Figures) -> list | None:
        value = self.figure(figures)
        if value is None:
            return None
        met = value >= self.bound if self.at_least else value <= self.bound
        return [self.what, f"{'≥' if self.at_least else '≤'} {self.bound:g}", shown(value), "yes" if met else "**no**"]


CHOLMODS = [f"CHOLMOD {which}" for which in ("simplicial AMD", "simplicial METIS", "supernodal METIS")]
PER_ITERATION = "per iteration and element"


def against_yardstick(size: int) -> Callable[[Figures], float | None]:
    return lambda f: f.ratio(("time_split", "lee", size, PER_ITERATION), ("chain_yardstick again", "lee", size, PER_ITERATION))


def peer_against_arcwall(peer: str) -> Callable[[Figures], float | None]:
    return lambda f: f.ratio((peer, "lee", 200, PER_ITERATION), ("time_split", "lee", 200, PER_ITERATION))


def by_ratio_against_arcwall(peer: str) -> Callable[[Figures], float | None]:
    def figure(f: Figures) -> float | None:
        ours = against_yardstick(200)(f)
        return BY_RATIO[peer] / ours if ours else None
    return figure


def iterations_a_point(f: Figures) -> float | None:
    return f.ratio(("time_split", "lee", 200, "iterations"), ("time_split", "lee", 200, "points"))


def spread(f: Figures) -> float | None:
    each = [f.of("time_split", "lee", n, PER_ITERATION) for n in f.sizes("time_split", "lee") if n >= 100]
    return max(each) / min(each) if len(each) > 1 else None


def growth(f: Figures) -> float | None:
    return f.ratio(("time_split", "lee", 100000, PER_ITERATION), ("time_split", "lee", 100, PER_ITERATION))


def memory_a_node(f: Figures, program: str = "time_split", figure: str = "peak memory") -> float | None:
    """From the growth with the size, so that libraries and the program itself do not count."""
    sizes = f.sizes(program, "lee")
    if len(sizes) < 2:
        return None
    small, large = (f.of(program, "lee", n, figure) for n in (sizes[0], sizes[-1]))
    return (large - small) / (sizes[-1] - sizes[0]) if small and large else None


def contact_time(case: str, size: int) -> Callable[[Figures], float | None]:
    def figure(f: Figures) -> float | None:
        path, changes = f.of("time_split", case, size, "path"), f.of("time_split", case, size, "contact changes")
        return 1e6 * path / (changes * size) if path and changes else None
    return figure


def closed_against_open(case: str, size: int, per: str = "per linearization and unknown"
                        ) -> Callable[[Figures], float | None]:
    return lambda f: f.ratio(("time_split", case, size, f"{per} with closed contacts"),
                             ("time_split", case, size, f"{per} with open contacts"))


def solver_against_cholmod(size: int) -> Callable[[Figures], float | None]:
    """Over the best that CHOLMOD does of itself."""
    def figure(f: Figures) -> float | None:
        def of(which: str) -> float | None:
            return f.of("frame_solver", f"frame {which}", size, "factorization and two solutions")
        theirs = [time for which in CHOLMODS if (time := of(which))]
        return of("arcwall") / min(theirs) if of("arcwall") and theirs else None
    return figure


def beside_solver(size: int) -> Callable[[Figures], float | None]:
    """Everything that is neither factorization nor solution, as a share of these."""
    def figure(f: Figures) -> float | None:
        solver = [f.of("time_split", "frame", size, f"share {part}") for part in ("factorization", "solution")]
        return (1.0 - sum(solver)) / sum(solver) if None not in solver else None
    return figure


def foundation_against_getfem(f: Figures) -> float | None:
    return f.ratio(("GetFEM", "foundation", 40, "path"), ("time_split", "foundation", 40, "path"))


GOALS = [
    Goal("Lee's frame, 200 elements: time per iteration and element, × the yardstick's", 1.5, against_yardstick(200)),
    Goal("the same with 2000 elements", 1.5, against_yardstick(2000)),
    Goal("OpenSees, the same with 200, × arcwall's (by ratio)", 3.0,
         by_ratio_against_arcwall("OpenSees"), at_least=True),
    Goal("LOCA (by ratio)", 4.0, by_ratio_against_arcwall("LOCA"), at_least=True),
    Goal("Octave", 10.0, peer_against_arcwall("Octave"), at_least=True),
    Goal("SciPy", 10.0, peer_against_arcwall("SciPy"), at_least=True),
    Goal("Lee's frame to v = 90 cm: points at default settings", 130, lambda f: f.of("time_split", "lee", 200, "points")),
    Goal("iterations a point", 4.2, iterations_a_point),
    Goal("Lee's frame, 20 elements: process, × the yardstick's", 3.0,
         lambda f: f.ratio(("trace-path", "lee", 20, "process"), ("chain_yardstick", "lee", 20, "process"))),
    Goal("without report and shapes, which the yardstick does not write", 3.0,
         lambda f: f.ratio(("trace-path", "lee without pictures", 20, "process"),
                           ("chain_yardstick", "lee", 20, "process"))),
    Goal("channel, 80 elements: process [s]", 0.15,
         lambda f: f.of("trace-path", "channel", 80, "process")),
    Goal("foundation: GetFEM's path, × arcwall's", 50.0, foundation_against_getfem, at_least=True),
    Goal("time per iteration and element: 100000 elements, × 100 elements", 1.5, growth),
    Goal("maximum over minimum, 100 to 100000 elements", 1.5, spread),
    Goal("memory per node of Lee's frame [kB]", 1.2, memory_a_node),
    Goal("channel, 80 elements: matrix with closed contacts, × with open ones, by unknowns", 1.3,
         closed_against_open("channel", 80)),
    Goal("the same with 1280 elements", 1.3, closed_against_open("channel", 1280)),
    Goal("the same as a whole, with up to twice as many elements", 1.3,
         closed_against_open("channel", 1280, "per linearization")),
    Goal("channel at nodes, 80 elements: matrix with closed contacts, × with open ones", 1.3,
         closed_against_open("channel at nodes", 80)),
    Goal("the same with 1280 elements", 1.3, closed_against_open("channel at nodes", 1280)),
    Goal("time per contact change and element [µs]", 3.0, contact_time("channel at nodes", 1280)),
    Goal("the same with 80 elements", 3.0, contact_time("channel at nodes", 80)),
    *(Goal(f"square frame, {size} unknowns: factorization and two solutions, × CHOLMOD's best", 1.1,
           solver_against_cholmod(size)) for size in (10000, 100000, 1000000)),
    Goal("square frame, 100000 unknowns: everything else, × these", 0.3, beside_solver(100000)),
    Goal("square frame, 1000000 unknowns: everything else, × these", 0.1, beside_solver(1000000)),
]


def goals(f: Figures) -> str:
    rows = [row for row in (goal.row(f) for goal in GOALS) if row]
    text = "## Goals\n\n" + table(["what", "goal", "figure", "met"], rows)
    if closed_against_open("channel", 1280)(f):
        text += """

Moving contact adds a border to the matrix, and elements to the mesh ([decisions](decisions.md), "Parts beside a growing contact zone")."""
    return text


# --- sections -------------------------------------------------------------------------------------------------------


def lee(f: Figures) -> str:
    rows = []
    for n in f.sizes("time_split", "lee"):
        def of(figure: str, program: str = "time_split", n: int = n) -> float | None:
            return f.of(program, "lee", n, figure)
        yardstick = of(PER_ITERATION, "chain_yardstick again")
        process, path = of("process", "trace-path"), of("path", "chain_yardstick again")
        rows.append([str(n), yardstick, of(PER_ITERATION), of(PER_ITERATION) / yardstick if yardstick else None,
                     of("per iteration of accepted steps and element") / yardstick if yardstick else None,
                     of("per linearization and element") / yardstick if yardstick else None,
                     str(int(of("points"))), of("iterations") / of("points"),
                     of("linearizations") / of("iterations in all"),
                     of("path") / path if path else None, process / path if process and path else None])
    return """## Lee's frame

The yardstick (`benchmarks/chain_yardstick.cpp`) is written by hand for this frame and compiled for the machine it runs on. It
locates no events, counts no unstable directions and takes some 200 steps. From 50000 elements on it fails, by its rounded diagonal.
Time and Newton iterations of a path include events and failed attempts; the fifth column counts iterations of accepted steps only.
*Per matrix* counts all matrices: `arcwall` forms more for events.

""" + table(["elements", "yardstick, µs per iteration and element", "arcwall, the same", "× per iteration",
             "× per iteration of accepted steps", "× per matrix", "points",
             "iterations a point", "matrices an iteration", "path, × the yardstick's",
             "process of trace-path, × the yardstick's path"], rows)


def parts(f: Figures) -> str:
    names = {"linearize": "F, K, F_λ", "factorize": "LDLᵀ", "line_solve": "two solutions",
             "corrector": "corrector, per iteration"}
    rows = []
    for n in f.sizes("newton_iteration", "linearize"):
        seconds = [f.of("newton_iteration", name, n, "per iteration per element") for name in names]
        yardstick = f.of("chain_yardstick again", "lee", n, PER_ITERATION)
        rows.append([str(n), *(1e6 * one if one else None for one in seconds), yardstick])
    return """## The parts of an iteration alone

Lee's frame in the middle of its snap, repeated at one state [µs per element].

""" + table(["elements", *names.values(), "yardstick, whole iteration"], rows) if rows else ""


def peers(f: Figures) -> str:
    rows = []
    for peer, ratio in BY_RATIO.items():
        rows.append([f"{peer}, 200", ratio, by_ratio_against_arcwall(peer)(f)])
    for peer in ("Octave", "SciPy"):
        for n in f.sizes(peer, "lee"):
            theirs = (peer, "lee", n, PER_ITERATION)
            rows.append([f"{peer}, {n}", f.ratio(theirs, ("chain_yardstick again", *theirs[1:])),
                         f.ratio(theirs, ("time_split", *theirs[1:]))])
    text = table(["Lee's frame, elements: time per iteration and element", "× the yardstick", "× arcwall"], rows)
    other = []
    if value := f.ratio(("AUTO", "column between walls", 0, "path"), ("time_split", "channel", 20, "path")):
        other.append(["AUTO, column between walls, 20 intervals on half of it, contact states given by hand; "
                      "arcwall: 20 elements", value])
    if value := foundation_against_getfem(f):
        other.append(["GetFEM, beam on a foundation, 40 × 4 plane elements on half of it, small displacements", value])
    if other:
        text += "\n\n" + table(["peer, whole path", "× arcwall"], other)
    missing = [key[0] for key in f.least if key[1] == "not installed"]
    if missing:
        text += f"\n\nNot installed: {', '.join(missing)}."
    return """## Peers

OpenSees' and LOCA's ratios to the yardstick were measured elsewhere; all others ran beside arcwall.
SciPy and Octave repeat the yardstick's method.

""" + text


PARTS = {"assembly": "F, K, F_λ", "factorization": "LDLᵀ", "solution": "solutions", "side conditions": "contact"}


def split(f: Figures) -> str:
    rows = []
    for case, size in f.smallest_and_largest("time_split"):
        def of(figure: str, case: str = case, size: int = size) -> float:
            return f.of("time_split", case, size, figure)
        own = of("linearizations of steps") / of("linearizations")
        start = f.of("time_split", "lee", 20, "peak memory")
        large = of("nodes") >= 1000 and start is not None
        rows.append([case + (f", {size}" if size else ""), of("path"), *(f"{100 * of(f'share {part}'):.0f}" for part in PARTS),
                     f"{100 * max(0.0, 1 - own):.0f}", (of("peak memory") - start) / of("nodes") if large else None])
    return """## Where the time goes

Shares of tracing, outputs excluded, for the smallest and the largest size (elements; star and square frame: unknowns).
*K for events*: share of matrices for events, stability counts and active-set changes. *LDLᵀ* includes the two solves of each iteration;
*solutions* are all others. *kB a node*: memory above that of Lee's frame with 20 elements.

""" + table(["case", "path [s]", *(f"{part} [%]" for part in PARTS.values()), "K for events [%]", "kB a node"], rows)


def processes(f: Figures) -> str:
    rows = []
    for case, size in f.smallest_and_largest("trace-path"):
        whole = f.of("trace-path", case, size, "process")
        path = f.of("time_split", case, size, "path")
        rows.append([case + (f", {size}" if size else ""), whole, path / whole if path else None,
                     f.of("trace-path", case, size, "peak memory of the process") / 1024.0])
    per_node = memory_a_node(f), memory_a_node(f, "trace-path", "peak memory of the process")
    return """## Whole processes and memory

`trace-path run`, with all files, for the smallest and the largest size.

""" + table(["case", "process [s]", "of it tracing", "peak memory [MB]"], rows) + (
        f"\n\nLee's frame takes {shown(per_node[0])} kB a node while tracing. "
        f"The program takes {shown(per_node[1])} kB: it keeps all points." if None not in per_node else "")


def frames(f: Figures) -> str:
    rows = []
    by = ["arcwall", *CHOLMODS]
    for size in f.sizes("frame_solver", "frame arcwall"):
        base = f.of("frame_solver", "frame CHOLMOD simplicial AMD", size, "factorization and two solutions")
        each = [f.of("frame_solver", f"frame {one}", size, "factorization and two solutions") for one in by]
        rows.append([str(size), f.of("frame_solver", "frame", size, "assembly") / base,
                     *(value / base if value else None for value in each)])
    return """## Frames

Assembly, and one factorization with two solutions, of the square frame at rest, × CHOLMOD's simplicial LDLᵀ called directly.
The supernodal one is LLᵀ, for definite matrices alone.

""" + table(["unknowns", "assembly", *by], rows) if rows else ""


def machine(f: Figures) -> str:
    multiply_add = f.of("machine_limits", "multiply_add", 0, "flops")
    bandwidth = f.of("machine_limits", "triad", 1 << 25, "bytes")
    division = f.of("machine_limits", "dependent_division", 0, "time")
    least = f.of("chain_yardstick again", "lee", 2000, PER_ITERATION)
    ours = f.of("time_split", "lee", 2000, PER_ITERATION)
    if None in (multiply_add, bandwidth, division, least, ours):
        return ""
    limits = [("arithmetic: flops at the maximum rate of vectors", 1e6 * YARDSTICK_FLOPS / multiply_add),
              ("memory: bytes at the bandwidth of main memory", 1e6 * YARDSTICK_BYTES / bandwidth),
              ("waiting: divisions, one after the other", 1e6 * YARDSTICK_DIVISIONS * division)]
    rows = [[what, limit / least, limit / ours] for what, limit in limits]
    return f"""## Distance to the machine's limits

Lee's frame with 2000 elements. Per iteration and element the yardstick needs about
{YARDSTICK_FLOPS} operations, {YARDSTICK_BYTES} bytes if each number is read once, and {YARDSTICK_DIVISIONS} dependent divisions.
The shares are those of the time that these alone would take.

""" + table(["limit", "share of the yardstick's time", "share of arcwall's"], rows) + frame_rates(f, multiply_add)


def frame_rates(f: Figures, multiply_add: float) -> str:
    """How near the factorization of the square frame comes to the greatest rate."""
    rows = []
    for size in f.sizes("frame_solver", "frame arcwall"):
        operations = f.of("frame_solver", "frame CHOLMOD simplicial AMD", size, "operations")
        seconds = f.of("frame_solver", "frame arcwall", size, "factorization")
        if operations and seconds:
            rows.append([str(size), operations / seconds / multiply_add])
    return ("\n\nThe factorization of the square frame, by the operations that it needs in CHOLMOD's order:\n\n"
            + table(["unknowns", "share of the maximum rate of vectors"], rows)) if rows else ""


HEAD = """# Performance

*Reference.* `docs/make_performance.py` writes this page from one run of `bash benchmarks/run.sh --peers`. Times are the minimum CPU
times of several repetitions.
"""
QUICK = "This was a run with `--quick`: the large sizes are missing."
SKIPPED = "The greatest sizes, of 10⁶ unknowns, were left out of this run by `--skip`."


def main() -> None:
    if len(sys.argv) != 2:
        sys.exit("usage: python3 docs/make_performance.py PERFORMANCE_CSV")
    figures = Figures(sys.argv[1])
    sections = [section(figures) for section in (goals, lee, parts, peers, split, processes, frames, machine)]
    greatest = {case: max(figures.sizes("time_split", case), default=0) for case in ("lee", "star")}
    missing = [QUICK] if greatest["lee"] <= 2000 else [SKIPPED] if greatest["star"] < 1000000 else []
    print("\n\n".join([HEAD.rstrip(), *missing, *(section for section in sections if section)]))


if __name__ == "__main__":
    main()
