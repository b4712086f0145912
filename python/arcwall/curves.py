"""Columns, events and branches of a traced path."""

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
    """Traced points as columns, with events and branches: the base class of `Path` and `SystemPath`.

    Columns have one value for each point. Branches follow one another in the order in which they were traced.

    Examples
    --------
    >>> path = arcwall.Deck.load("truss.toml").trace()
    >>> len(path), path["lambda"].shape, path.columns[:5]
    (22, (22,), ['branch', 'step', 'arc', 'lambda', 'w'])
    """

    _run: Any

    def __init__(self, run: Any):
        self._run = run
        self._cache: dict[Any, Any] = {}
        self._cached_size: Any = None

    # Values read from the record are kept until the path has more points.
    def _cached(self, what: Any, make: Any) -> Any:
        size = (self._run.size(), self._run.has_ended())
        if size != self._cached_size:
            self._cache, self._cached_size = {}, size
        if what not in self._cache:
            self._cache[what] = make()
        return self._cache[what]

    def __len__(self) -> int:
        """Return the number of points."""
        return self._run.size()

    @property
    def ended(self) -> bool:
        """True if every branch has ended; otherwise `resume` continues the path."""
        return self._run.has_ended()

    def resume(self: C, *, max_points: int | None = None, max_seconds: float | None = None) -> C:
        """Continue the path; the result is bit-identical to an uninterrupted trace.

        Nothing happens if every branch has ended.

        Parameters
        ----------
        max_points : int, optional
            Maximum number of points that this call adds; unlimited by default.
        max_seconds : float, optional
            Maximum time of this call [s]; unlimited by default.

        Returns
        -------
        Curve
            The path itself.

        Raises
        ------
        ValueError
            If a limit is negative.

        Examples
        --------
        >>> path = arcwall.Deck.load("truss.toml").trace(max_points=5)
        >>> len(path), path.ended
        (5, False)
        >>> len(path.resume()), path.ended
        (22, True)
        """
        self._run.advance(_limit_of(max_points), _seconds_of(max_seconds))
        return self

    @property
    def title(self) -> str:
        """Title of the deck; empty for a system."""
        return self._run.title()

    @property
    def monitors(self) -> Mapping[str, str]:
        """Names of the monitors with their units; a unit is empty if the deck gives none."""
        return dict(self._run.columns())

    def _monitor_column(self, name: str) -> np.ndarray | None:
        names = [monitor for monitor, _ in self._run.columns()]
        return self._run.monitor(names.index(name)) if name in names else None

    def __getitem__(self, name: str) -> np.ndarray:
        """Return a column as a read-only array of shape (points,).

        Parameters
        ----------
        name : str
            Name of a column or monitor.

        Returns
        -------
        numpy.ndarray
            float64 for ``lambda``, ``arc``, ``energy``, ``unstable`` and monitors; int64 for ``branch``, ``step``,
            ``contacts`` and ``iterations``; objects for ``stability`` and ``event``. ``unstable`` is nan if
            undetermined; ``event`` is None without an event.

        Raises
        ------
        KeyError
            If there is no such column.

        Examples
        --------
        >>> path = arcwall.Deck.load("truss.toml").trace()
        >>> round(float(path["w"][-1]), 6)
        1.2
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
        """Names of the columns of ``table``, in their order."""
        names = self._run.column_names()
        return [*names[:4], *self.monitors, *names[4:]]

    @property
    def table(self) -> pd.DataFrame:
        """All columns as a new pandas DataFrame, one row for each point; needs pandas."""
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
        """Located events, in the order of branches and points."""
        return self._cached("events", self._read_events)[0]

    @property
    def branches(self) -> tuple[Branch, ...]:
        """Branches with their origins and ends."""
        return self._cached("events", self._read_events)[1]

    # --- pictures -------------------------------------------------------------------------------------------------------

    def plot(self, x: str | None = None, y: str = "lambda", *, ax: Axes | None = None, events: bool = True) -> Axes:
        """Draw one column over another; needs matplotlib.

        Stable parts are solid, unstable ones dashed, undecided ones dotted.

        Parameters
        ----------
        x, y : str, optional
            Columns of the axes; by default the first monitor and λ.
        ax : matplotlib.axes.Axes, optional
            Axes to draw into; new ones by default.
        events : bool, default True
            Whether to mark the events, as ``report.html`` does.

        Returns
        -------
        matplotlib.axes.Axes

        Raises
        ------
        KeyError
            If there is no such column.
        TypeError
            If a column is not numeric.

        Examples
        --------
        >>> axes = arcwall.Deck.load("truss.toml").trace().plot()
        >>> axes.get_xlabel(), axes.get_ylabel()
        ('w [m]', 'load factor λ')
        """
        from . import pictures

        if x is None:
            x = next(iter(self.monitors), "arc")
        across, up = (pictures.Column(name, self[name], self.monitors.get(name, "")) for name in (x, y))
        marks = [(event.point, event.kind) for event in self.events] if events else []
        return pictures.plot(across, up, self._run.lines(), marks, self.title, ax)

    def _repr_html_(self) -> str:
        """Return the curve of ``report.html`` over the first monitor, as a self-contained element."""
        if not len(self):
            return "<div>a path without points</div>"
        return self._run.curve(0 if self._run.columns() else None)

    def __repr__(self) -> str:
        kind = type(self).__name__
        state = "" if self.ended else ", goes on"
        return f"<arcwall.{kind} of {len(self)} points, {len(self.events)} events, {len(self.branches)} branches{state}>"


def row_of(point: Any, size: int) -> int:
    """Return the row, from 0, of a point that may count from the end. Raises IndexError beyond the path."""
    index = operator.index(point)
    if not -size <= index < size:
        raise IndexError(f"there is no point {index}; the path has {size}")
    return index % size


def _limit_of(points: int | None) -> int:
    """Return the maximum number of points that a call adds."""
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
