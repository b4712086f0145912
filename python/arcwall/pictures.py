"""Pictures of paths with matplotlib, imported when the first one is drawn."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from .curves import Curve
    from .event_curves import EventCurve
    from .path import Path
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


def _axes(ax: Any) -> Any:
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt

    return plt.subplots()[1]


def _shown(column: str) -> str:
    return {"lambda": "load factor λ", "arc": "arc length"}.get(column, column)


def _with_unit(name: str, unit: str) -> str:
    return f"{name} [{unit}]" if unit else name


def _title(path: Curve, column: str) -> str:
    return _with_unit(_shown(column), path.monitors.get(column, ""))


def _draw_mark(ax: Any, x: Any, y: Any, mark: tuple[str, int, bool]) -> None:
    marker, size, filled = mark
    ax.plot(x, y, marker, ms=size, mfc="black" if filled else "white", mec="black", zorder=3)


def plot(path: Curve, x: str | None, y: str, ax: Any, events: bool) -> Any:
    if x is None:
        x = next(iter(path.monitors), "arc")
    across, up = path[x], path[y]
    for name, column in ((x, across), (y, up)):
        if column.dtype == object:
            raise TypeError(f"column {name!r} has no numbers to draw")
    ax = _axes(ax)
    for branch, stability, first, last in path._run.lines():
        ax.plot(
            across[first : last + 1],
            up[first : last + 1],
            _DASHES[stability],
            color=COLOURS[branch % len(COLOURS)],
            linewidth=1.8,
        )
    for event in path.events if events else ():
        _draw_mark(ax, across[event.point], up[event.point], MARKS[event.kind])
    ax.set_xlabel(_title(path, x))
    ax.set_ylabel(_title(path, y))
    if path.title:
        ax.set_title(path.title)
    ax.grid(True, color="#e8eaed")
    return ax


def plot_event_curve(curve: EventCurve, x: str, y: str, ax: Any) -> Any:
    across, up = curve[x], curve[y]
    ax = _axes(ax)
    stability = [_stability_beside(*counts) for counts in zip(curve["unstable_before"], curve["unstable_after"])]
    first = 0
    for last in range(1, len(curve)):  # a line has the stability of its second point
        if last + 1 == len(curve) or stability[last + 1] != stability[last]:
            ax.plot(
                across[first : last + 1], up[first : last + 1], _DASHES[stability[last]], color=COLOURS[0], linewidth=1.8
            )
            first = last
    for special in curve.specials:
        _draw_mark(ax, across[special.point], up[special.point], _SPECIAL_MARKS[special.kind])
    ax.set_xlabel(_with_unit(curve.parameter if x == "key" else _shown(x), curve.units[x]))
    ax.set_ylabel(_with_unit(curve.parameter if y == "key" else _shown(y), curve.units[y]))
    ax.set_title(f"{curve.event} {curve.number}")
    ax.grid(True, color="#e8eaed")
    return ax


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


def plot_shape(path: Path, point: int, ax: Any) -> Any:
    shape = path.shape(point)
    ax = _axes(ax)
    _draw_walls(ax, shape)
    _draw_members(ax, path.shape(0), color="#c3c9d0", linewidth=1.2, linestyle="--")
    _draw_members(ax, shape, color=COLOURS[0], linewidth=2.2)
    _draw_contacts(ax, shape)
    unit = path.units["length"]
    ax.set_xlabel(f"x [{unit}]" if unit else "x")
    ax.set_ylabel(f"z [{unit}]" if unit else "z")
    ax.set_title(f"λ = {shape.lam:.6g}")
    return ax


def animate(path: Path, every: int, interval: int) -> Any:
    from matplotlib.animation import FuncAnimation

    if every < 1:
        raise ValueError(f"every = {every} is no number of points; give 1 or more")
    points = range(0, len(path), every)
    if not len(points):
        raise ValueError("a path without points cannot be drawn")
    ax = plot_shape(path, 0, None)
    figure = ax.figure
    shapes = [path.shape(i) for i in points]
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
