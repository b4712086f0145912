"""The branch map of a path: which states there are over λ, and what leads from one to another."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from .values import Value

__all__ = ["BranchMap", "BranchMapEdge", "BranchMapRange", "BranchMapSegment"]


@dataclass(frozen=True, repr=False)
class BranchMapSegment(Value):
    """A part of a branch with λ growing or falling, the same contacts and the same number of unstable directions."""

    id: int
    branch: int
    steps: tuple[int, int]  #: of the points at its ends
    contact_pattern: str  #: its walls along the members, as ``upper lower upper``; ``upper=`` of a contact zone
    lam: tuple[float, float]  #: λ at its ends
    energy: tuple[float, float]  #: total potential at its ends [force·length]
    unstable: int | None  #: as of points
    images: tuple[int, ...]  #: branches with a mirror image of it, which is no segment of its own


@dataclass(frozen=True, repr=False)
class BranchMapEdge(Value):
    """What leads from one segment to another."""

    kind: str  #: of the event; ``jump``, ``reached_branch``, or ``search`` where a search has found where branches begin
    lam: float
    events: tuple[int, ...]  #: their ids
    start: int  #: segment
    end: int | None  #: segment; None where no branch passes the state that a jump leads to


@dataclass(frozen=True, repr=False)
class BranchMapRange(Value):
    """A range of λ over which the same states are there, and the same stable one has the least energy."""

    lam: tuple[float, float]
    states: tuple[int, ...]  #: segments
    stable: tuple[int, ...]  #: of these
    least: int | None  #: of the stable ones that of least energy


@dataclass(frozen=True, repr=False)
class BranchMap(Value):
    """The branch map of a path, as in ``branches.json``."""

    segments: tuple[BranchMapSegment, ...]
    edges: tuple[BranchMapEdge, ...]
    ranges: tuple[BranchMapRange, ...]  #: by λ


def _pair(values: Sequence[Any]) -> tuple[Any, Any]:
    first, last = values
    return first, last


def branch_map_of(json: Mapping[str, Any]) -> BranchMap:
    return BranchMap(
        segments=tuple(
            BranchMapSegment(
                one["id"], one["branch"], _pair(one["steps"]), one["contact_pattern"], _pair(one["lambda"]),
                _pair(one["energy"]), one["unstable"], tuple(one["images"]),
            )
            for one in json["segments"]
        ),
        edges=tuple(
            BranchMapEdge(one["kind"], one["lambda"], tuple(one["events"]), one["from"], one["to"]) for one in json["edges"]
        ),
        ranges=tuple(
            BranchMapRange(_pair(one["lambda"]), tuple(one["states"]), tuple(one["stable"]), one["least"])
            for one in json["ranges"]
        ),
    )  # fmt: skip
