"""How sure the events of a deck are: the same deck on several meshes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["ConvergedEvent", "Convergence"]


@dataclass(frozen=True)
class ConvergedEvent:
    """An event on several meshes; as in ``convergence.json``."""

    kind: str
    number: int  #: counts from 1 among its kind
    what: str
    lam: tuple[float | None, ...]  #: by mesh; None where it has no such event
    order: float | None  #: in which the error falls with the element's length
    irregular: str | None  #: why no order is trusted
    extrapolated: float  #: λ with the error of the mesh taken out
    error: float | None  #: half-width of its error bar
    error_of_deck: float | None  #: of λ on the deck's own mesh


class Convergence:
    """The events of a deck with their error bars, made by ``deck.converge()``. ``print(study)`` shows the tables."""

    def __init__(self, json: Mapping[str, Any], text: str):
        self.json = json  #: all of ``convergence.json``
        self._text = text
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
            )
            for one in json["events"]
        )

    @property
    def table(self) -> pd.DataFrame:
        """The events as a pandas DataFrame, one row each."""
        import pandas as pd

        return pd.DataFrame([vars(event) for event in self.events])

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return f"<arcwall.Convergence of {len(self.events)} events>"
