"""What paths of decks and of systems have in common: columns, events and branches."""

from __future__ import annotations

import math
import operator
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from .events import Branch, Event, Events, branch_of, event_of

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes

__all__ = ["Curve"]

C = TypeVar("C", bound="Curve")


class Curve:
    """Points of paths as columns: one value a point, branch after branch in the order in which they were traced."""

    _run: Any

    def __init__(self, run: Any):
        self._run = run
        self._cache: dict[Any, Any] = {}
        self._cached_size: Any = None

    # What was read off the record serves until there are more points.
    def _cached(self, what: Any, make: Any) -> Any:
        size = (self._run.size(), self._run.has_ended())
        if size != self._cached_size:
            self._cache, self._cached_size = {}, size
        if what not in self._cache:
            self._cache[what] = make()
        return self._cache[what]

    def __len__(self) -> int:
        """The number of points."""
        return self._run.size()

    @property
    def ended(self) -> bool:
        """Whether every branch has its end; otherwise one can go on."""
        return self._run.has_ended()

    def resume(self: C, *, max_points: int | None = None, max_seconds: float | None = None) -> C:
        """Goes on where the path is, to the last bit as if it had never stopped; returns the path itself.

        ``max_points`` counts those of this call. Nothing happens where every branch has ended.
        """
        self._run.advance(_limit_of(max_points), _seconds_of(max_seconds))
        return self

    @property
    def title(self) -> str:
        """The deck's title; empty of a system."""
        return self._run.title()

    @property
    def monitors(self) -> Mapping[str, str]:
        """The names of the monitors, with their units (empty where a deck names none)."""
        return dict(self._run.columns())

    def _monitor_column(self, name: str) -> np.ndarray | None:
        names = [monitor for monitor, _ in self._run.columns()]
        return self._run.monitor(names.index(name)) if name in names else None

    def __getitem__(self, name: str) -> np.ndarray:
        """A column as an array of shape (points,), which cannot be written into: the same one each time.

        ``lambda``, ``arc``, ``energy`` and the monitors are float64 in the deck's units; ``branch``, ``step``, ``contacts`` and
        ``iterations`` int64; ``unstable`` is float64, nan where the count is open; ``stability`` and ``event`` are texts, None
        where there is no event. KeyError for another name.
        """
        if not isinstance(name, str):
            raise TypeError(f"a path is asked for columns by their names, as in path['lambda'], not for {name!r}")
        return self._cached(("column", name), lambda: self._make_column(name))

    __iter__ = None  # type: ignore[assignment]

    def _make_column(self, name: str) -> np.ndarray:
        values = self._monitor_column(name)
        if values is None:
            try:
                values = self._run.column(name)
            except KeyError:
                known = [*self._run.column_names(), *self.monitors]
                raise KeyError(f"{name!r} is no column; there are {', '.join(known)}") from None
        array = np.asarray(values, dtype=object) if isinstance(values, list) else np.asarray(values)
        array.setflags(write=False)
        return array

    @property
    def columns(self) -> list[str]:
        """The names of the columns of ``table``, in their order."""
        names = self._run.column_names()
        return [*names[:4], *self.monitors, *names[4:]]

    @property
    def table(self) -> pd.DataFrame:
        """All columns as a pandas DataFrame, one row a point; a new one each time, to be changed at will."""
        import pandas as pd

        return pd.DataFrame({name: self[name] for name in self.columns})

    def _read_events(self) -> tuple[Events, tuple[Branch, ...]]:
        json = self._run.events()
        branches = tuple(branch_of(one) for one in json["branches"])
        first = np.concatenate([[0], np.cumsum([one.points for one in branches])]).astype(int)
        return Events([self._event(one, int(first[one["branch"]]) + one["step"]) for one in json["events"]]), branches

    def _event(self, json: Mapping[str, Any], point: int) -> Event:
        return event_of(json, point)

    @property
    def events(self) -> Events:
        """The located points: ``path.events["limit-point"][0].lam``."""
        return self._cached("events", self._read_events)[0]

    @property
    def branches(self) -> tuple[Branch, ...]:
        """Where each branch begins, and how it ended."""
        return self._cached("events", self._read_events)[1]

    # --- pictures -------------------------------------------------------------------------------------------------------

    def plot(self, x: str | None = None, y: str = "lambda", *, ax: Axes | None = None, events: bool = True) -> Axes:
        """Draws column ``y`` over column ``x``, by default the first monitor, and returns the axes.

        Stable parts are drawn through, unstable ones dashed, undecided ones dotted; events have the marks of ``report.html``.
        Needs matplotlib.
        """
        from .pictures import plot

        return plot(self, x, y, ax, events)

    def _repr_html_(self) -> str:
        """The curve of ``report.html``, self-contained, over the first monitor."""
        if not len(self):
            return "<div>a path without points</div>"
        return self._run.curve(0 if self._run.columns() else None)

    def __repr__(self) -> str:
        kind = type(self).__name__
        state = "" if self.ended else ", goes on"
        return f"<arcwall.{kind} of {len(self)} points, {len(self.events)} events, {len(self.branches)} branches{state}>"


def row_of(point: Any, size: int) -> int:
    """A point's row from 0, of one that may count from the end. IndexError where there is none."""
    index = operator.index(point)
    if not -size <= index < size:
        raise IndexError(f"there is no point {index}; the path has {size}")
    return index % size


def _limit_of(points: int | None) -> int:
    """As many points more as one call may trace."""
    most = 2**62
    if points is None:
        return most
    count = operator.index(points)
    if count < 0:
        raise ValueError(f"max_points = {count} is negative")
    return min(count, most)


def _seconds_of(seconds: float | None) -> float:
    if seconds is None:
        return math.inf
    if not seconds >= 0.0:
        raise ValueError(f"max_seconds = {seconds!r} is no time; give 0 or more")
    return float(seconds)
