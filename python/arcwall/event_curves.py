"""What becomes of an event while numbers of the deck vary: curves in two parameters, and the worst combination."""

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
    """Something that happens on a curve of events."""

    kind: str  #: ``begins``, ``ends``, ``cusp``: the number turns, or ``crossing``: another event is met
    point: int  #: row of ``curve.table``
    key: float  #: the number of the deck there
    lam: float  #: λ of the event there
    monitors: Mapping[str, float]
    why: str  #: in words
    reason: str | None = None  #: of ``begins`` and ``ends``, as of the end of a branch: ``stop``, ``min_step``, …


class EventCurve:
    """An event of a deck, followed while a number of the deck varies; made by ``deck.curve()``.

    Each point is the event of the deck with another value of the number. Columns are arrays of shape (points,) in the order
    of the curve, from its low end through the deck's own value to its high one; they cannot be written into. A curve can be
    pickled and copied.
    """

    def __init__(
        self, deck: Deck, json: Mapping[str, Any], columns: Any, shapes: Any, files: Mapping[str, str], text: str, picture: str
    ):
        self.deck = deck  #: with the question that this answers as its table ``[curve]``
        self.event: str = json["event"]["kind"]  #: kind of the event that is followed
        self.number: int = json["event"]["number"]  #: which of that kind along the path, from 1
        self.parameter: str = json["parameter"]  #: the number that varies, by its key
        self.unit: str = json["unit"]  #: of that number; empty where it has none
        self.value: float = json["value"]  #: the deck's own
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
        self.units: dict[str, str] = {}  #: of the columns; empty where one has none
        for name, unit, values in columns:
            values.setflags(write=False)
            self._columns[name], self.units[name] = values, unit
        self._shapes, self._files, self._text, self._picture = shapes, dict(files), text, picture

    def __len__(self) -> int:
        """The number of points."""
        return len(self["lambda"])

    @property
    def columns(self) -> list[str]:
        """The names of the columns: ``arc``, ``key``, ``lambda``, the monitors, ``slope``, ``unstable_before``,
        ``unstable_after`` and ``contacts``."""
        return list(self._columns)

    def __getitem__(self, name: str) -> np.ndarray:
        """A column, shape (points,), float64 but for ``contacts``: ``key`` is the number of the deck, ``slope`` dλ/dkey, nan at a
        cusp; ``unstable_before`` and ``unstable_after`` count on both sides of the event along the path, nan where that is open.
        KeyError for another name."""
        try:
            return self._columns[name]
        except KeyError:
            raise KeyError(f"{name!r} is no column; there are {', '.join(self.columns)}") from None

    __iter__ = None  # type: ignore[assignment]

    @property
    def table(self) -> pd.DataFrame:
        """All columns as a pandas DataFrame, one row a point; a new one each time."""
        import pandas as pd

        return pd.DataFrame(self._columns)

    def _of_kind(self, *kinds: str) -> tuple[CurveSpecial, ...]:
        return tuple(one for one in self.specials if one.kind in kinds)

    @property
    def cusps(self) -> tuple[CurveSpecial, ...]:
        """Where the number turns: beyond that value there is no such event, and on this side there are two."""
        return self._of_kind("cusp")

    @property
    def crossings(self) -> tuple[CurveSpecial, ...]:
        """Where another event is met at the same λ."""
        return self._of_kind("crossing")

    @property
    def ends(self) -> tuple[CurveSpecial, ...]:
        """The two ends, with the reason for which the curve was followed no farther."""
        return self._of_kind("begins", "ends")

    def deck_at(self, point: int) -> Deck:
        """The deck with the number's value at a point: ``curve.deck_at(i).trace()`` has the event at the same λ."""
        return self.deck.copy({self.parameter: float(self["key"][row_of(point, len(self))])})

    def shape(self, point: int) -> Shape:
        """The structure at a point of the curve, at the event."""
        index = row_of(point, len(self))
        deck, lam = self.deck_at(index), float(self["lambda"][index])
        members, contacts = self._shapes[index]
        return shape_of(members, contacts, _engine.walls(deck._name, deck._text, deck._assignments, lam), lam)

    def plot(self, x: str = "key", y: str = "lambda", *, ax: Axes | None = None) -> Axes:
        """Draws column ``y`` over column ``x`` and returns the axes: through where the path is stable on one side of the event,
        dashed where it is on neither, dotted where that is open; specials are marked. Needs matplotlib."""
        from .pictures import plot_event_curve

        return plot_event_curve(self, x, y, ax)

    def report(self) -> str:
        """``report.html`` of ``trace-path curve`` as a text."""
        return self._files["report.html"]

    def save(self, folder: str | os.PathLike[str], *, force: bool = False) -> None:
        """Writes the files of ``trace-path curve``: curve.csv, curve.json and report.html.

        ``force``: also into a folder that something else filled, as a run. FileError where they cannot be written.
        """
        _engine.write_curve(os.fspath(folder), os.path.basename(self.deck.name), force, list(self._files.items()))

    def _repr_html_(self) -> str:
        return self._picture

    def __str__(self) -> str:
        """The specials as a table."""
        return self._text

    def __repr__(self) -> str:
        what = f"{self.event} {self.number} over {self.parameter}"
        return f"<arcwall.EventCurve of {what}, {len(self)} points, {len(self.cusps)} cusps, {len(self.crossings)} crossings>"


@dataclass(frozen=True)
class WorstCombination:
    """The change of some numbers of a deck, of a given norm, that lowers an event most; made by ``deck.worst()``."""

    event: str  #: kind of the event
    number: int  #: which of that kind along the path, from 1
    radius: float  #: root of the sum of squares of the change
    own_lam: float  #: λ of the event of the deck
    lam: float  #: with the worst values
    own: Mapping[str, float]  #: the deck's values, by their keys
    values: Mapping[str, float]  #: the worst ones
    slopes: Mapping[str, float]  #: dλ/dvalue there
    settled: bool  #: the change points against the slopes, as it does at the lowest
    runs: int  #: of decks
    deck: Deck = field(repr=False)  #: with the worst values
    text: str = field(repr=False)  #: the program's table

    def __str__(self) -> str:
        return self.text


def worst_of(deck: Deck, json: Mapping[str, Any], text: str) -> WorstCombination:
    """That of ``curve.json``; ``deck`` is the one that was asked."""
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
