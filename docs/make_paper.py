#!/usr/bin/env python3
"""Runs both examples of Selke and Kikuchi's paper, by their own incremental scheme and along the converged path, and
writes docs/paper.md with its pictures, docs/paper-*.svg.

    python3 docs/make_paper.py build/release/apps/trace-path
"""

import sys
import tempfile
from pathlib import Path

from make_validation import trace_into

HERE = Path(__file__).resolve().parent

# Their tables: load -> printed value, classic and Essenburg [kN cm or kN; cm].
TABLE_1 = {
    "0.4": (-0.0715, -0.0706), "0.4475": (-0.0799, -0.0790), "0.4485": (-0.0800, -0.0792), "0.4495": (-0.0800, -0.0800),
    "0.5": (-0.0800, -0.0800), "2.5": (-0.0800, -0.0800), "3": (-0.0800, -0.0800), "3.5": (-0.0800, -0.0798),
    "5": (-0.0800, -0.0771), "5.18": (-0.0800, -0.0769), "7.5": (-0.0800, -0.0735), "10": (-0.0800, -0.0703),
}
TABLE_2 = {
    "0.415": (0.0444, 0.0443), "0.427": (0.1479, 0.1472), "0.4275": (0.1500, 0.1489), "0.428": (0.1500, 0.1500),
    "0.5": (0.1500, 0.1500), "1.75": (0.1500, 0.1500), "5": (0.1500, 0.1500), "7": (0.1490, 0.1500),
    "7.1": (0.1374, 0.1500), "7.15": (0.1256, 0.1494), "7.5": (0.0420, 0.0680), "10": (-0.1500, -0.1500),
}

MATERIAL = """title = "An example of the paper"
[material.steel]
E = 2.1e4
nu = 0.29
[section.square]
shape = "rectangle"
width = {height}
height = {height}
[point]
A = [0.0, 0.0]
B = [2.0, 0.0]
[member.beam]
from = "A"
to = "B"
material = "steel"
section = "square"
"""

FOUNDATION = MATERIAL.format(height=0.2) + """{member}
[support]
A = ["x", "z"]
B = ["z"]
[[load]]
at = "A"
moment = -1.0
[[load]]
at = "B"
moment = 1.0
[[wall]]
name = "foundation"
side = "below"
profile = {{ type = "flat", z = -0.18 }}
{contact}
[path]
{path}
"""

CHANNEL = MATERIAL.format(height=0.1) + """imperfection = [
  {{ shape = "sine", amplitude = 0.00176, waves = 1 }},
  {{ shape = "sine", amplitude = 1e-4, waves = 3 }},
]
{member}
[support]
A = ["x", "z"]
B = ["z"]
[[load]]
at = "B"
force = [-1.0, 0.0]
[[wall]]
name = "upper"
side = "above"
profile = {{ type = "flat", z = 0.2 }}
[[wall]]
name = "lower"
side = "below"
profile = {{ type = "flat", z = -0.2 }}
{contact}
[path]
{path}
"""


def monitor(name, at, component):
    return f'[[monitor]]\nname = "{name}"\nat = "{at}"\ncomponent = "{component}"\n'


class Program:
    def __init__(self, path):
        self.path = path

    def run(self, deck):
        """Rows of path.csv of a deck."""
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "deck.toml"
            file.write_text(deck, encoding="utf-8")
            return trace_into(str(Path(folder) / "out"), self.path, file, []).points


def member(theory, elements, order=None):
    lines = [f'theory = "{theory}"', f"elements = {elements}"]
    if order:
        lines.append(f"order = {order}")
    return "\n".join(lines)


def converged(program, deck, theory, elements, loads, monitors, stop):
    """On the path of equilibria, contact exact."""
    landings = ", ".join(loads)
    path = f"step = 0.05\noutput_at = {{ lambda = [{landings}] }}\n[path.stop]\nlambda = [-1.0, {stop}]"
    return program.run(deck.format(member=member(theory, elements), contact="", path=path) + monitors)


def incremental(program, deck, theory, elements, loads, monitors, step, penalty, order=None):
    """By load increments of `step` with springs."""
    landings = ", ".join(loads)
    path = f'method = "incremental"\nstep = {step}\nmax_points = 100000\noutput_at = {{ lambda = [{landings}] }}'
    contact = f'[contact]\nmethod = "penalty"\npenalty = {penalty}'
    return program.run(deck.format(member=member(theory, elements, order), contact=contact, path=path) + monitors)


def stable_at(rows, load):
    """The first stable point at a load: what a beam under growing dead load has."""
    for row in rows:
        if abs(float(row["lambda"]) - float(load)) < 1e-9 and row["stability"] == "stable":
            return row
    return None


def at(rows, load):
    found = [row for row in rows if abs(float(row["lambda"]) - float(load)) < 1e-9]
    return found[0] if found else None


def number(row, column):
    return "–" if row is None else f"{float(row[column]):.5f}".replace("-", "−")


def table(head, loads, printed, columns):
    """One row a load: printed | incremental | converged for both theories."""
    text = [f"| {head} | classic: printed | incremental | converged | Essenburg: printed | incremental | converged |",
            "| --- | --- | --- | --- | --- | --- | --- |"]
    for load in loads:
        classic, essenburg = printed[load]
        shown = [f"{classic:.4f}".replace("-", "−"), columns["classic incremental"](load), columns["classic"](load),
                 f"{essenburg:.4f}".replace("-", "−"), columns["essenburg incremental"](load), columns["essenburg"](load)]
        text.append(f"| {load} | " + " | ".join(shown) + " |")
    return "\n".join(text)


# --- pictures: a sequence of deformed shapes ------------------------------------------------------------------------

PLACES = 41
STYLE = """
  .page { fill: #ffffff; }
  text { font: 13px sans-serif; fill: #222222; }
  .wall { fill: #bbbbbb; }
  .beam { fill: none; stroke: #0072b2; stroke-linejoin: round; }
  @media (prefers-color-scheme: dark) {
    .page { fill: #16181d; } text { fill: #dddddd; } .wall { fill: #4a4d55; } .beam { stroke: #56b4e9; }
  }
"""


def shape_monitors():
    text = ""
    for i in range(PLACES):
        fraction = i / (PLACES - 1)
        text += monitor(f"x{i}", f"beam:{fraction}", "x") + monitor(f"z{i}", f"beam:{fraction}", "z")
    return text


def sequence(name, title, unit, rows, height, walls, low, high):
    """docs/paper-NAME.svg: one panel a row of path.csv, the last row at the bottom."""
    width, left, scale = 720, 110, 290.0
    panel = (high - low) * scale + 14
    text = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {panel * len(rows) + 34:.0f}" role="img">',
            f"<title>{title}</title><style>{STYLE}</style>", f'<rect class="page" width="100%" height="100%"/>',
            f'<text x="12" y="20">{title}</text>']
    for i, row in enumerate(rows):
        top = 34 + i * panel

        def vertical(z, top=top):
            return top + (high - z) * scale

        for bottom, upper in walls:
            text.append(f'<rect class="wall" x="{left - 10}" y="{vertical(upper):.2f}" width="{2.0 * scale + 20:.0f}" '
                        f'height="{(upper - bottom) * scale:.2f}"/>')
        points = " ".join(f"{left + (2.0 * k / (PLACES - 1) + float(row[f'x{k}'])) * scale:.2f},"
                          f"{vertical(float(row[f'z{k}'])):.2f}" for k in range(PLACES))
        text.append(f'<polyline class="beam" stroke-width="{height * scale:.1f}" points="{points}"/>')
        text.append(f'<text x="12" y="{vertical(0.0) + 4:.1f}">{float(row["lambda"]):.4g} {unit}</text>')
    text.append("</svg>")
    (HERE / f"paper-{name}.svg").write_text("\n".join(text) + "\n", encoding="utf-8")


def pictures(program):
    shapes = shape_monitors()
    moments = ["0.2", "0.4", "1", "3", "5", "7"]
    for theory, figure in (("classic", 3), ("essenburg", 4)):
        rows = converged(program, FOUNDATION, theory, 80, moments, shapes, 7.0)
        found = [row for row in (stable_at(rows, moment) for moment in moments) if row]
        sequence(f"figure{figure}", f"Bending against a foundation, {theory} theory", "kN cm", found, 0.2,
                 [(-0.22, -0.18)], -0.22, 0.12)
    for theory, figure in (("classic", 6), ("essenburg", 7)):
        rows = converged(program, CHANNEL, theory, 80, ["0.4", "0.5", "2", "6"], shapes, 9.0)
        found = [stable_at(rows, load) for load in ("0.4", "0.5", "2", "6")]
        turn = max(range(len(rows)), key=lambda i: float(rows[i]["lambda"]) if float(rows[i]["z20"]) > 0.1 else -1.0)
        crossing = next(i for i in range(turn, len(rows)) if float(rows[i]["z20"]) < 0.0)
        sequence(f"figure{figure}", f"A column in a channel, {theory} theory", "kN",
                 found + [rows[turn], rows[crossing], rows[-1]], 0.1, [(0.2, 0.23), (-0.23, -0.2)], -0.23, 0.23)


# --- the text --------------------------------------------------------------------------------------------------------

TEXT = """# The paper and its numbers

*Explanation.* C. A. C. Selke and N. Kikuchi, *Local unilateral contact problems in beams using a higher order theory*,
beside the results of `trace-path`. `docs/make_paper.py` writes this page.

| columns | are |
| --- | --- |
| *printed* | the paper's tables |
| *incremental* | the paper's scheme: `path.method = "incremental"`, `contact.method = "penalty"` ([theory.md](theory.md), sections 7.4 and 10) |
| *converged* | stable points of equilibrium paths with exact contact, the first at a load |

*Classic* is the paper's name for Euler–Bernoulli beams: 80 elements with moving contact points.
Essenburg's theory has 160 quadratic elements.

## Where its equations are

| equation | here |
| --- | --- |
| (1), (2), (7), (8) no penetration, gap | `contact/profile.hpp`, `contact/candidate.hpp`; theory.md, 7.1 |
| (3) to (6) linearised conditions, normal | `Candidate::gap` with its gradient |
| (9), (10) Signorini's conditions | guards and multipliers, `contact/multiplier_contact.hpp`; theory.md, 4 |
| (11) penalty | `ContactLaw::Method::penalty`; theory.md, 7.4 |
| (12), (13) incremental virtual work, updated Lagrangian | `UpdatedClassicBeam`, `UpdatedEssenburgBeam`; theory.md, 10 |
| (14) increment | `continuation/load_increments.hpp` |
| (15) to (17) Essenburg's theory | `elements/essenburg_beam.hpp`; theory.md, 2.7 |
| (18) to (20) classic theory | `elements/classic_beam.hpp`; theory.md, 2.1 |

## Example 1: bending against a foundation

A beam of length 2 and section 0.2 × 0.2, 0.08 above the foundation, is bent by end moments M₀ [kN cm].
Displacement of its middle [cm]: of the axis (classic), of the lower face (Essenburg).
Incremental: increments of {step1}, springs of {penalty1} kN/cm²; 160 classic elements, 80 linear Essenburg elements with one
point along the axis.

{table1}

![Deformed shapes, classic theory](paper-figure3.svg)
![Deformed shapes, Essenburg's theory](paper-figure4.svg)

- *First contact* is printed as 0.4480 (classic) and 0.4493 (Essenburg), the values of the linear theories, 8 EI d/L² and
  8 EI d/(L² − ν h²). With large rotations they are 0.448961 and 0.450377.
- *Free rows, Essenburg* (0.4 to 0.4485): linear elements with full integration, 40 on the half, give the printed values,
  −0.07066, −0.07902, −0.07919. They lock, and would have first contact at 0.453; one point along the axis avoids that.
- *Separation* is printed at 3.4874. The five fields of (15), used consistently, give 3.9007 (linear theory) and 3.8275 (large
  rotations and a true end moment).
- *After separation* the printed lift (0.0002 to 0.0097) is 50 to 160 times the converged one.
  Only very coarse meshes give it (below); none gives both this and the free rows.
- *Above 7 kN cm* the Essenburg beam has no converged state: its outer fibre approaches 1/√3 of its length. There
  St Venant–Kirchhoff's law loses its stiffness; the incremental law continues.

The incremental scheme on coarse meshes, Essenburg's theory, linear elements, {coarse} elements on the whole beam:

{coarse_table}

## Example 2: a column in a channel

A column of length 2 and section 0.1 × 0.1, its faces 0.15 from both walls, is compressed by P [kN].
Displacement of its middle [cm]. Imperfection: a half sine of 0.00176 and a third harmonic of 0.0001, without which a classic
column does not snap. Incremental: increments of {step2}, springs of {penalty2} kN/cm², 80 elements (Essenburg: linear).

{table2}

![Deformed shapes, classic theory](paper-figure6.svg)
![Deformed shapes, Essenburg's theory](paper-figure7.svg)

- *Printed references:* Euler's load 0.4318 is π² EI/L²; it is 0.432687 if extensible, P (1 − P/EA) = π² EI/L².
  Link's snap load 6.9087 is 7.003081 for the perfect extensible column, and of order one in the mesh with contact at nodes.
- *Essenburg's theory* does not delay the snap. The middle separates near P = 2.44, and the column snaps at a smooth limit
  point, 6.2195 (6.2777 if perfect), before the classic one. Above 9.9955 kN it has no state on the lower wall.
- *The free rows* 0.415 and 0.427 belong to no common imperfection on an equilibrium path. Near the critical load, increments lag.
- *The rows 7.0 to 7.5* (classic) and P = 0 with 0.0302 lie on no equilibrium path.

### Does the incremental scheme explain the printed snap at 7.00 to 7.15?

{snap_text}

## Misprints

- (20): N₁³ = x − 2x²/L + x³/L², N₂³ = −x²/L + x³/L².
- (9), (10): the second lines should read t_N ≤ 0.
- (11): the solution converges to contact as μ → 0.
- (13): the initial stress term is σ_ji Δu_k,i δu_k,j, as in (12).
- Tables: the clearance d is from the beam's face to the wall, although (7), (8) read otherwise.
"""

SNAP_TEXT = """For Essenburg's theory it does. On meshes that resolve the contact (80, 160 elements) with springs of 1e6 and 1e7:

| theory | leaves the wall between [kN] | limit point of the path |
| --- | --- | --- |
| classic | {classic_least} and {classic_greatest} | 6.8632 |
| Essenburg | {essenburg_least} and {essenburg_greatest}, mostly near 7.15, as in Table 2 | 6.2195 |

The difference is the material. With C constant in each current configuration, outer fibres in compression stay stiffer than with
St Venant–Kirchhoff's law. So 7.10 to 7.15 belongs to the incremental law, not to the kinematics (15).
Iterated to equilibrium, that law has stable states on the wall up to 7.0 kN.
On coarser meshes or with softer springs the load is accidental."""


def snap_load(rows):
    """Where the middle has left the upper wall by 0.01; None if it never does; "ended" if the rows end before."""
    touched = False
    for row in rows:
        mid = float(row["mid"])
        touched = touched or mid > 0.1499
        if touched and mid < 0.14:
            return float(row["lambda"])
    return None if float(rows[-1]["lambda"]) > 7.4 else "ended"


def snap_study(program):
    """Loads of the snap on meshes that resolve the contact, by three sizes of the increments."""
    middle = monitor("mid", "beam:0.5", "z")
    loads = {"classic": [], "essenburg": []}
    for theory, order in (("classic", None), ("essenburg", 1)):
        for elements in (80, 160):
            for penalty in ("1e6", "1e7"):
                for step in (0.02, 0.01, 0.005):
                    load = snap_load(incremental(program, CHANNEL, theory, elements, ["7.5"], middle, step, penalty, order))
                    if isinstance(load, float):
                        loads[theory].append(load)
    return loads


def main():
    program = Program(sys.argv[1])
    step1, penalty1, step2, penalty2 = 0.0125, "1e9", 0.01, "1e5"
    middle = monitor("mid", "beam:0.5", "z")
    bottom = monitor("mid", "beam:0.5", "face-below-z")
    moments, loads = list(TABLE_1), list(TABLE_2)

    one = {"classic": converged(program, FOUNDATION, "classic", 80, moments, middle, 10.0),
           "essenburg": converged(program, FOUNDATION, "essenburg", 160, moments[:-2], bottom, 5.2),
           "classic incremental": incremental(program, FOUNDATION, "classic", 160, moments, middle, step1, penalty1),
           "essenburg incremental": incremental(program, FOUNDATION, "essenburg", 80, moments, bottom, step1, penalty1, 1)}
    two = {"classic": converged(program, CHANNEL, "classic", 80, loads, middle, 10.0),
           "essenburg": converged(program, CHANNEL, "essenburg", 160, loads[:-1], middle, 9.0),
           "classic incremental": incremental(program, CHANNEL, "classic", 80, loads, middle, step2, penalty2),
           "essenburg incremental": incremental(program, CHANNEL, "essenburg", 80, loads, middle, step2, penalty2, 1)}

    def columns(runs):
        return {name: (lambda load, name=name, rows=rows:
                       number(at(rows, load) if "incremental" in name else stable_at(rows, load), "mid"))
                for name, rows in runs.items()}

    coarse = (10, 20, 40)
    lifts = ["0.4", "3.5", "5", "7.5", "10"]
    coarse_lines = ["| elements | " + " | ".join(f"M₀ = {moment}" for moment in lifts) + " |", "| --- " * (len(lifts) + 1) + "|"]
    for elements in coarse:
        rows = incremental(program, FOUNDATION, "essenburg", elements, lifts, bottom, step1, penalty1, 1)
        coarse_lines.append(f"| {elements} | " + " | ".join(number(at(rows, moment), "mid") for moment in lifts) + " |")
    coarse_lines.append("| printed | " + " | ".join(f"{TABLE_1[moment][1]:.4f}".replace("-", "−") for moment in lifts) + " |")

    snaps = snap_study(program)
    pictures(program)
    (HERE / "paper.md").write_text(
        TEXT.format(table1=table("M₀", moments, TABLE_1, columns(one)), table2=table("P", loads, TABLE_2, columns(two)),
                    step1=step1, penalty1=penalty1, step2=step2, penalty2=penalty2,
                    coarse=", ".join(map(str, coarse)), coarse_table="\n".join(coarse_lines),
                    snap_text=SNAP_TEXT.format(**{f"{theory}_{name}": f"{of(snaps[theory]):.2f}" for theory in snaps
                                                  for name, of in (("least", min), ("greatest", max))})),
        encoding="utf-8")


if __name__ == "__main__":
    main()
