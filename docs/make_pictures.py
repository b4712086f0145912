#!/usr/bin/env python3
"""Traces the channel example with node contact and with moving contact points, and draws docs/teeth.svg.

    python3 docs/make_pictures.py build/release/apps/trace-path
"""

import csv
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent
STEP = 0.002  # path.max_step, so that lines between points look like curves

# What is shown: shortening [cm] and load [kN], while contact grows along the upper wall, and behind the snap.
SHORTENING = (0.08, 0.20)
LOAD = (3.0, 7.1)

# The drawing, in pixels: the axes' box inside the whole.
WIDTH, HEIGHT = 720, 440
LEFT, TOP, RIGHT, BOTTOM = 62, 18, 704, 390


@dataclass
class Curve:
    name: str  # in STYLE
    label: str
    points: str  # contact.points
    elements: int


CURVES = [
    Curve("nodes20", "node contact, 20 elements", "nodes", 20),
    Curve("nodes40", "node contact, 40 elements", "nodes", 40),
    Curve("sliding", "moving contact points, 20 elements", "moving", 20),
]

# Colours of Okabe and Ito, which the colour-blind can tell apart; brighter ones where the page is dark.
STYLE = """
  .page { fill: #ffffff; }
  text { font: 14px sans-serif; fill: #222222; }
  .axis { fill: none; stroke: #555555; stroke-width: 1; }
  .grid { stroke: #dddddd; stroke-width: 1; }
  .curve { fill: none; stroke-width: 1.6; stroke-linejoin: round; }
  .nodes20 { stroke: #d55e00; }
  .nodes40 { stroke: #cc79a7; stroke-dasharray: 6 2; }
  .sliding { stroke: #0072b2; stroke-width: 2.6; }
  @media (prefers-color-scheme: dark) {
    .page { fill: #16181d; }
    text { fill: #dddddd; }
    .axis { stroke: #aaaaaa; }
    .grid { stroke: #33363d; }
    .nodes20 { stroke: #e69f00; }
    .sliding { stroke: #56b4e9; }
  }
"""


def trace(program: str, curve: Curve) -> list:
    """Shortening and load of each point of the path."""
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "run", str(SOURCE / "examples" / "channel.toml"), "--out", folder, "--quiet", "--no-units",
                   "--force", "--set", f"contact.points='{curve.points}'", "--set", f"path.max_step={STEP}",
                   "--set", f"member.column.elements={curve.elements}"]
        result = subprocess.run(command, capture_output=True, text=True)
        if result.returncode != 0:
            sys.exit(f"{' '.join(command)}\nended with status {result.returncode}:\n{result.stderr}")
        with open(Path(folder, "path.csv"), newline="") as table:
            return [(float(row["shortening"]), float(row["lambda"])) for row in csv.DictReader(table)]


def x_of(shortening: float) -> float:
    return LEFT + (shortening - SHORTENING[0]) / (SHORTENING[1] - SHORTENING[0]) * (RIGHT - LEFT)


def y_of(load: float) -> float:
    return BOTTOM - (load - LOAD[0]) / (LOAD[1] - LOAD[0]) * (BOTTOM - TOP)


def polyline(points: list, name: str) -> str:
    places = " ".join(f"{x_of(shortening):.1f},{y_of(load):.1f}" for shortening, load in points)
    return f'<polyline class="curve {name}" points="{places}"/>'


def axes() -> list:
    lines = []
    for load in range(3, 8):
        y = y_of(load)
        lines.append(f'<line class="grid" x1="{LEFT}" y1="{y:.1f}" x2="{RIGHT}" y2="{y:.1f}"/>')
        lines.append(f'<text x="{LEFT - 8}" y="{y + 5:.1f}" text-anchor="end">{load}</text>')
    for hundredth in range(8, 21, 2):
        x = x_of(hundredth / 100)
        lines.append(f'<line class="grid" x1="{x:.1f}" y1="{TOP}" x2="{x:.1f}" y2="{BOTTOM}"/>')
        lines.append(f'<text x="{x:.1f}" y="{BOTTOM + 20}" text-anchor="middle">{hundredth / 100:.2f}</text>')
    middle = (TOP + BOTTOM) / 2
    lines.append(f'<rect class="axis" x="{LEFT}" y="{TOP}" width="{RIGHT - LEFT}" height="{BOTTOM - TOP}"/>')
    lines.append(f'<text x="{(LEFT + RIGHT) / 2}" y="{HEIGHT - 10}" text-anchor="middle">shortening [cm]</text>')
    lines.append(f'<text transform="translate(20 {middle}) rotate(-90)" text-anchor="middle">load [kN]</text>')
    return lines


def legend() -> list:
    lines = []
    for i, curve in enumerate(CURVES):
        y = TOP + 26 + 22 * i
        lines.append(f'<line class="curve {curve.name}" x1="{LEFT + 16}" y1="{y}" x2="{LEFT + 52}" y2="{y}"/>')
        lines.append(f'<text x="{LEFT + 62}" y="{y + 5}">{curve.label}</text>')
    return lines


def picture(program: str) -> str:
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" '
             f'viewBox="0 0 {WIDTH} {HEIGHT}" role="img">',
             "<title>A column between two walls: load over shortening</title>",
             f"<style>{STYLE}</style>",
             f'<clipPath id="box"><rect x="{LEFT}" y="{TOP}" width="{RIGHT - LEFT}" height="{BOTTOM - TOP}"/></clipPath>',
             f'<rect class="page" width="{WIDTH}" height="{HEIGHT}"/>', *axes(), '<g clip-path="url(#box)">']
    lines += [polyline(trace(program, curve), curve.name) for curve in CURVES]
    return "\n".join([*lines, "</g>", *legend(), "</svg>"]) + "\n"


def main() -> None:
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    SOURCE.joinpath("docs", "teeth.svg").write_text(picture(sys.argv[1]))


if __name__ == "__main__":
    main()
