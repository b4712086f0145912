"""Mesh error of the events of a deck, estimated on several meshes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["ConvergedEvent", "ConvergedMonitor", "Convergence"]


@dataclass(frozen=True)
class ConvergedMonitor:
    """Monitor at an event on several meshes, as in ``convergence.json``.

    Examples
    --------
    >>> event = arcwall.Deck.load("truss.toml").converge(levels=2).events[0]
    >>> len(event.monitors["w"].values)
    2
    """

    values: tuple[float | None, ...]  #: value for each mesh, coarsest first; None if the mesh has no such event
    order: float | None  #: convergence order with the element length; None if irregular
    irregular: str | None  #: why no order was determined; None if it was
    extrapolated: float  #: extrapolated value, or that of the finest mesh without an order
    error: float | None  #: half-width of the error bar of ``extrapolated``; None if unknown
    error_of_deck: float | None  #: mesh error on the deck's own mesh; None if unknown


@dataclass(frozen=True)
class ConvergedEvent:
    """Event on several meshes, as in ``convergence.json``.

    Examples
    --------
    >>> event = arcwall.Deck.load("truss.toml").converge(levels=2).events[0]
    >>> event.kind, event.number, round(event.extrapolated, 6)
    ('limit-point', 1, 37.919801)
    """

    kind: str  #: kind of the event, such as ``limit-point``
    number: int  #: number among the events of its kind, from 1
    what: str  #: detail of the event, such as ``maximum`` or the wall
    lam: tuple[float | None, ...]  #: λ for each mesh, coarsest first; None if the mesh has no such event
    order: float | None  #: convergence order of λ with the element length; None if irregular
    irregular: str | None  #: why no order was determined; None if it was
    extrapolated: float  #: extrapolated λ, or λ of the finest mesh without an order
    error: float | None  #: half-width of the error bar of ``extrapolated``; None if unknown
    error_of_deck: float | None  #: mesh error of λ on the deck's own mesh; None if unknown
    monitors: Mapping[str, ConvergedMonitor] = field(default_factory=dict)  #: the same of the monitors, by name


class Convergence:
    """Events of a deck with their mesh errors; returned by `Deck.converge`.

    ``print(study)`` shows the tables of ``trace-path converge``.

    Examples
    --------
    >>> study = arcwall.Deck.load("truss.toml").converge(levels=2)
    >>> [(event.kind, event.what) for event in study.events]
    [('limit-point', 'maximum'), ('limit-point', 'minimum')]
    """

    def __init__(self, json: Mapping[str, Any], text: str):
        self.json = json  #: content of ``convergence.json``
        self._text = text
        #: events with their values on each mesh
        self.events = tuple(
            ConvergedEvent(
                kind=one["kind"],
                number=one["number"],
                what=one["what"],
                lam=tuple(one["lambda"]),
                order=one["order"],
                irregular=one["irregular"],
                extrapolated=one["extrapolated"],
                error=one["error"],
                error_of_deck=one["error_of_deck"],
                monitors={
                    name: ConvergedMonitor(
                        values=tuple(of["values"]),
                        order=of["order"],
                        irregular=of["irregular"],
                        extrapolated=of["extrapolated"],
                        error=of["error"],
                        error_of_deck=of["error_of_deck"],
                    )
                    for name, of in one["monitors"].items()
                },
            )
            for one in json["events"]
        )

    @property
    def table(self) -> pd.DataFrame:
        """Events as a new pandas DataFrame, one row each; needs pandas."""
        import pandas as pd

        return pd.DataFrame([{k: v for k, v in vars(event).items() if k != "monitors"} for event in self.events])

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return f"<arcwall.Convergence of {len(self.events)} events>"
