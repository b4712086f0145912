"""Events while parameters of the deck vary: event curves and worst combinations."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _engine
from .curves import row_of
from .shapes import Shape, shape_of
from .values import Value

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes

    from .deck import Deck

__all__ = ["CurveSpecial", "EventCurve", "WorstCombination"]


@dataclass(frozen=True, repr=False)
class CurveSpecial(Value):
    """Special point of an event curve.

    Examples
    --------
    >>> truss = arcwall.Deck.load("truss.toml")
    >>> curve = truss.curve("limit-point", "material.bar.E", (9.9e4, 1.01e5))
    >>> [(special.kind, special.key, special.reason) for special in curve.specials]
    [('begins', 99000.0, 'stop'), ('ends', 101000.0, 'stop')]
    """

    kind: str  #: ``begins``, ``ends``, ``cusp`` (turning point of the parameter) or ``crossing`` (with another event)
    point: int  #: row of the point in ``curve.table``
    key: float  #: value of the parameter
    lam: float  #: λ of the event
    monitors: Mapping[str, float]  #: monitors, by name
    why: str  #: explanation
    reason: str | None = None  #: reason of ``begins`` and ``ends``: ``stop``, ``min_step``, …


class EventCurve:
    """Curve of an event while a parameter of the deck varies; returned by `Deck.curve`.

    Each point is the event of the deck with another value of the parameter. Columns are read-only arrays of shape
    (points,), from the low end of the curve to its high end. A curve can be copied and pickled.

    Examples
    --------
    >>> spring = {"spring": [{"at": "top", "stiffness": {"z": 190.0}}]}
    >>> truss = arcwall.Deck.load("truss.toml").copy(spring)
    >>> curve = truss.curve("limit-point", "spring.0.stiffness.z", (180.0, 220.0))
    >>> cusp = curve.cusps[0]
    >>> round(cusp.key, 4), round(cusp.lam, 4)
    (197.0371, 98.5185)
    """

    def __init__(
        self, deck: Deck, json: Mapping[str, Any], columns: Any, shapes: Any, files: Mapping[str, str], text: str, picture: str
    ):
        self.deck = deck  #: deck, with the arguments of the curve as its table ``[curve]``
        self.event: str = json["event"]["kind"]  #: kind of the event
        self.number: int = json["event"]["number"]  #: number among the events of its kind, from 1
        self.parameter: str = json["parameter"]  #: key of the parameter
        self.unit: str = json["unit"]  #: unit of the parameter; may be empty
        self.value: float = json["value"]  #: the deck's own value of the parameter
        #: begin, end, cusps and crossings, in the order of the curve
        self.specials = tuple(
            CurveSpecial(
                kind=one["kind"],
                point=one["point"],
                key=one["key"],
                lam=one["lambda"],
                monitors=one["monitors"],
                why=one["why"],
                reason=one.get("reason"),
            )
            for one in json["specials"]
        )
        self._columns: dict[str, np.ndarray] = {}
        self.units: dict[str, str] = {}  #: units of the columns; may be empty
        for name, unit, values in columns:
            values.setflags(write=False)
            self._columns[name], self.units[name] = values, unit
        self._shapes, self._files, self._text, self._picture = shapes, dict(files), text, picture

    def __len__(self) -> int:
        """Return the number of points."""
        return len(self["lambda"])

    @property
    def columns(self) -> list[str]:
        """Names of the columns.

        These are ``arc``, ``key``, ``lambda``, the monitors, ``slope``, ``unstable_before``, ``unstable_after``,
        ``contacts``, and ``slope-NAME`` for each monitor.
        """
        return list(self._columns)

    def __getitem__(self, name: str) -> np.ndarray:
        """Return a column as a read-only array of shape (points,).

        Parameters
        ----------
        name : str
            ``key`` is the parameter and ``slope`` is dλ/dkey, nan at a cusp. ``unstable_before`` and
            ``unstable_after`` are the numbers of unstable directions on the path, nan if undetermined.

        Returns
        -------
        numpy.ndarray
            float64, except for ``contacts`` (int64).

        Raises
        ------
        KeyError
            If there is no such column.
        """
        try:
            return self._columns[name]
        except KeyError:
            raise KeyError(f"{name!r} is no column; there are {', '.join(self.columns)}") from None

    __iter__ = None  # type: ignore[assignment]

    @property
    def table(self) -> pd.DataFrame:
        """All columns as a new pandas DataFrame, one row for each point; needs pandas."""
        import pandas as pd

        return pd.DataFrame(self._columns)

    def _of_kind(self, *kinds: str) -> tuple[CurveSpecial, ...]:
        return tuple(one for one in self.specials if one.kind in kinds)

    @property
    def cusps(self) -> tuple[CurveSpecial, ...]:
        """Turning points of the parameter, at which two events merge."""
        return self._of_kind("cusp")

    @property
    def crossings(self) -> tuple[CurveSpecial, ...]:
        """Points at which another event occurs at the same λ."""
        return self._of_kind("crossing")

    @property
    def ends(self) -> tuple[CurveSpecial, ...]:
        """Both ends, with their reasons."""
        return self._of_kind("begins", "ends")

    def deck_at(self, point: int) -> Deck:
        """Return the deck with the parameter's value at a point.

        Parameters
        ----------
        point : int
            Row in ``table``; a negative one counts from the end.

        Returns
        -------
        Deck

        Raises
        ------
        IndexError
            If there is no such point.

        Examples
        --------
        >>> truss = arcwall.Deck.load("truss.toml")
        >>> curve = truss.curve("limit-point", "material.bar.E", (9.9e4, 1.01e5))
        >>> curve.deck_at(-1)["material.bar.E"]
        101000.0
        """
        return self.deck.copy({self.parameter: float(self["key"][row_of(point, len(self))])})

    def shape(self, point: int) -> Shape:
        """Return the deformed structure of the event at a point.

        Parameters
        ----------
        point : int
            Row in ``table``; a negative one counts from the end.

        Returns
        -------
        Shape

        Raises
        ------
        IndexError
            If there is no such point.
        """
        index = row_of(point, len(self))
        deck, lam = self.deck_at(index), float(self["lambda"][index])
        members, contacts = self._shapes[index]
        return shape_of(members, contacts, _engine.walls(deck._name, deck._text, deck._assignments, lam), lam)

    def plot(self, x: str = "key", y: str = "lambda", *, ax: Axes | None = None) -> Axes:
        """Draw one column over another, with marks at special points; needs matplotlib.

        Lines are solid if the path is stable on one side of the event, dashed if on neither, dotted if undetermined.

        Parameters
        ----------
        x, y : str, optional
            Columns of the axes; by default the parameter and λ.
        ax : matplotlib.axes.Axes, optional
            Axes to draw into; new ones by default.

        Returns
        -------
        matplotlib.axes.Axes

        Raises
        ------
        KeyError
            If there is no such column.
        """
        from . import pictures

        across, up = (
            pictures.Column(self.parameter if name == "key" else name, self[name], self.units[name]) for name in (x, y)
        )
        unstable = zip(self["unstable_before"], self["unstable_after"])
        specials = [(special.point, special.kind) for special in self.specials]
        return pictures.plot_event_curve(across, up, unstable, specials, f"{self.event} {self.number}", ax)

    def report(self) -> str:
        """Return ``report.html`` of ``trace-path curve``.

        Returns
        -------
        str
        """
        return self._files["report.html"]

    def save(self, folder: str | os.PathLike[str], *, force: bool = False) -> None:
        """Write the files of ``trace-path curve``: curve.csv, curve.json and report.html.

        Parameters
        ----------
        folder : str or os.PathLike
            Folder to write into.
        force : bool, default False
            Whether to write into a folder with other files.

        Raises
        ------
        FileError
            If the folder cannot be written or has other files.
        """
        _engine.write_curve(os.fspath(folder), os.path.basename(self.deck.name), force, list(self._files.items()))

    def _repr_html_(self) -> str:
        return self._picture

    def __str__(self) -> str:
        """Return the special points as a table."""
        return self._text

    def __repr__(self) -> str:
        what = f"{self.event} {self.number} over {self.parameter}"
        return f"<arcwall.EventCurve of {what}, {len(self)} points, {len(self.cusps)} cusps, {len(self.crossings)} crossings>"


@dataclass(frozen=True)
class WorstCombination:
    """Change of parameters, of a given norm, that lowers the λ of an event most; returned by `Deck.worst`.

    ``print(worst)`` shows the table of ``trace-path curve``.

    Examples
    --------
    >>> worst = arcwall.Deck.load("truss.toml").worst("limit-point", ["material.bar.E"], 1000.0)
    >>> worst.own, worst.settled
    ({'material.bar.E': 100000.0}, True)
    >>> round(worst.own_lam, 6), round(worst.lam, 6)
    (37.919801, 37.540603)
    """

    event: str  #: kind of the event
    number: int  #: number among the events of its kind, from 1
    radius: float  #: Euclidean norm of the change, in the units of the parameters
    own_lam: float  #: λ of the event with the deck's own values
    lam: float  #: λ of the event with the worst values
    own: Mapping[str, float]  #: the deck's own values, by key
    values: Mapping[str, float]  #: worst values, by key
    slopes: Mapping[str, float]  #: dλ/dvalue at the worst values, by key
    settled: bool  #: True if the search converged: the change is opposite to the slopes
    runs: int  #: number of decks traced
    deck: Deck = field(repr=False)  #: deck with the worst values
    text: str = field(repr=False)  #: table of ``trace-path curve``

    def __str__(self) -> str:
        return self.text


def worst_of(deck: Deck, json: Mapping[str, Any], text: str) -> WorstCombination:
    """Read the worst combination of ``curve.json`` for a deck."""
    values = {one["key"]: one["value"] for one in json["worst"]}
    return WorstCombination(
        event=json["event"]["kind"],
        number=json["event"]["number"],
        radius=json["radius"],
        own_lam=json["own_lambda"],
        lam=json["lambda"],
        own={one["key"]: one["own"] for one in json["worst"]},
        values=values,
        slopes={one["key"]: one["slope"] for one in json["worst"]},
        settled=json["settled"],
        runs=json["runs"],
        deck=deck.copy(values),
        text=text,
    )
