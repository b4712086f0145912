"""Pictures of paths with matplotlib, imported when the first one is drawn."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np

from .shapes import Shape

#: Okabe and Ito's palette, as in report.html.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
_DASHES = {"stable": "-", "unstable": "--", "undecided": ":"}
#: Marker, size and whether it is filled.
MARKS = {
    "start": ("o", 5, False),
    "end": ("s", 6, False),
    "contact-closes": ("v", 6, True),
    "contact-opens": ("^", 6, False),
    "contact-spreads": ("d", 6, True),
    "contact-splits": ("P", 6, True),
    "contact-shrinks": ("d", 6, False),
    "contacts-merge": ("P", 6, False),
    "contact-slips": (">", 6, True),
    "contact-sticks": ("s", 4, True),
    "contact-transfers": ("D", 5, False),
    "limit-point": ("o", 6, True),
    "contact-limit-point": ("h", 10, False),
    "turning-point": ("s", 6, True),
    "value-crossing": ("D", 5, True),
    "reversal": ("<", 6, False),
    "branch-point": ("*", 10, True),
    "user": ("p", 7, True),
}
_SPECIAL_MARKS = {
    "begins": MARKS["start"],
    "ends": MARKS["end"],
    "cusp": MARKS["limit-point"],
    "crossing": MARKS["branch-point"],
}


class Column(NamedTuple):
    """Column of a table, with its unit: what an axis shows."""

    name: str
    values: np.ndarray
    unit: str

    @property
    def label(self) -> str:
        """Label of the axis."""
        shown = {"lambda": "load factor λ", "arc": "arc length"}.get(self.name, self.name)
        return f"{shown} [{self.unit}]" if self.unit else shown


def _axes(ax: Any) -> Any:
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt

    return plt.subplots()[1]


def _draw_mark(ax: Any, x: Any, y: Any, mark: tuple[str, int, bool]) -> None:
    marker, size, filled = mark
    ax.plot(x, y, marker, ms=size, mfc="black" if filled else "white", mec="black", zorder=3)


def _draw_line(ax: Any, x: Column, y: Column, first: int, last: int, stability: str, colour: str) -> None:
    part = slice(first, last + 1)
    ax.plot(x.values[part], y.values[part], _DASHES[stability], color=colour, linewidth=1.8)


def _label(ax: Any, x: Column, y: Column, title: str) -> Any:
    ax.set_xlabel(x.label)
    ax.set_ylabel(y.label)
    if title:
        ax.set_title(title)
    ax.grid(True, color="#e8eaed")
    return ax


def plot(
    x: Column, y: Column, lines: Iterable[tuple[int, str, int, int]], events: Iterable[tuple[int, str]], title: str, ax: Any
) -> Any:
    """Draw the points of a path: lines by branch, stability, first and last point; events by point and kind."""
    for column in (x, y):
        if column.values.dtype == object:
            raise TypeError(f"column {column.name!r} has no numbers to draw")
    ax = _axes(ax)
    for branch, stability, first, last in lines:
        _draw_line(ax, x, y, first, last, stability, COLOURS[branch % len(COLOURS)])
    for point, kind in events:
        _draw_mark(ax, x.values[point], y.values[point], MARKS[kind])
    return _label(ax, x, y, title)


def plot_event_curve(
    x: Column, y: Column, unstable: Iterable[tuple[float, float]], specials: Iterable[tuple[int, str]], title: str, ax: Any
) -> Any:
    """Draw an event curve: numbers of unstable directions before and after each point; specials by point and kind."""
    ax = _axes(ax)
    stability = [_stability_beside(*counts) for counts in unstable]
    first = 0
    for last in range(1, len(stability)):  # a line has the stability of its second point
        if last + 1 == len(stability) or stability[last + 1] != stability[last]:
            _draw_line(ax, x, y, first, last, stability[last], COLOURS[0])
            first = last
    for point, kind in specials:
        _draw_mark(ax, x.values[point], y.values[point], _SPECIAL_MARKS[kind])
    return _label(ax, x, y, title)


# Stable if one side of the event is stable.
def _stability_beside(before: float, after: float) -> str:
    if np.isnan(before) or np.isnan(after):
        return "undecided"
    return "stable" if min(before, after) == 0.0 else "unstable"


def _draw_members(ax: Any, shape: Shape, **style: Any) -> list[Any]:
    return [ax.plot(member.x, member.z, **style)[0] for member in shape.members.values()]


def _draw_walls(ax: Any, shape: Shape) -> list[Any]:
    return [ax.plot(wall.x, wall.z, color="#69727d", linewidth=2.5)[0] for wall in shape.walls.values()]


def _draw_contacts(ax: Any, shape: Shape) -> Any:
    places = np.array([(mark.x, mark.z) for mark in shape.contacts]).reshape(-1, 2)
    return ax.plot(places[:, 0], places[:, 1], "o", color="#d55e00", ms=5, zorder=3)[0]


def plot_shape(shape: Shape, first: Shape, unit: str, ax: Any) -> Any:
    """Draw a shape, and the first one of its path in grey."""
    ax = _axes(ax)
    _draw_walls(ax, shape)
    _draw_members(ax, first, color="#c3c9d0", linewidth=1.2, linestyle="--")
    _draw_members(ax, shape, color=COLOURS[0], linewidth=2.2)
    _draw_contacts(ax, shape)
    ax.set_xlabel(f"x [{unit}]" if unit else "x")
    ax.set_ylabel(f"z [{unit}]" if unit else "z")
    ax.set_title(f"λ = {shape.lam:.6g}")
    return ax


def animate(shapes: Sequence[Shape], unit: str, interval: int) -> Any:
    """Make an animation of shapes, at least one."""
    from matplotlib.animation import FuncAnimation

    ax = plot_shape(shapes[0], shapes[0], unit, None)
    figure = ax.figure
    all_x = np.concatenate([m.x for s in shapes for m in s.members.values()])
    all_z = np.concatenate([m.z for s in shapes for m in s.members.values()])
    ax.set_xlim(*_limits(all_x))
    ax.set_ylim(*_limits(np.concatenate([all_z, *(w.z for w in shapes[0].walls.values())])))
    moving: list[Any] = []

    def frame(i: int) -> list[Any]:
        while moving:
            moving.pop().remove()
        moving.extend(_draw_walls(ax, shapes[i]))
        moving.extend(_draw_members(ax, shapes[i], color=COLOURS[0], linewidth=2.2))
        moving.append(_draw_contacts(ax, shapes[i]))
        ax.set_title(f"λ = {shapes[i].lam:.6g}")
        return moving

    for line in list(ax.lines):
        line.remove()
    _draw_members(ax, shapes[0], color="#c3c9d0", linewidth=1.2, linestyle="--")
    return FuncAnimation(figure, frame, frames=len(shapes), interval=interval, init_func=lambda: [])


def _limits(values: np.ndarray) -> tuple[float, float]:
    least, most = float(values.min()), float(values.max())
    margin = 0.05 * (most - least) or 1.0
    return least - margin, most + margin
