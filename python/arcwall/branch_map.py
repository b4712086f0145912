"""Branch map of a path: its states over λ, and the events and jumps that connect them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from .values import Value

__all__ = ["BranchMap", "BranchMapEdge", "BranchMapRange", "BranchMapSegment"]


@dataclass(frozen=True, repr=False)
class BranchMapSegment(Value):
    """Segment of a branch with monotonic λ, constant contact pattern and constant stability.

    Examples
    --------
    >>> path = arcwall.Deck.load("truss.toml").trace()
    >>> [(segment.steps, segment.unstable) for segment in path.branch_map.segments]
    [((0, 6), 0), ((6, 12), 1), ((12, 21), 0)]
    """

    id: int  #: number of the segment, from 0
    branch: int  #: id of its branch
    steps: tuple[int, int]  #: steps of the points at its two ends
    contact_pattern: str  #: walls in contact along the members, such as ``upper lower upper``; ``upper=`` is a contact zone
    lam: tuple[float, float]  #: λ at its two ends
    energy: tuple[float, float]  #: total potential energy at its two ends [force·length]
    unstable: int | None  #: number of unstable directions; None if undetermined
    images: tuple[int, ...]  #: ids of branches that contain its mirror image, which has no segment of its own


@dataclass(frozen=True, repr=False)
class BranchMapEdge(Value):
    """Connection of two segments of a branch map.

    Examples
    --------
    >>> path = arcwall.Deck.load("truss.toml").trace()
    >>> [(edge.kind, edge.start, edge.end) for edge in path.branch_map.edges]
    [('limit-point', 0, 1), ('limit-point', 1, 2), ('jump', 0, 2)]
    """

    kind: str  #: kind of the event, or ``jump``, ``reached_branch``, ``search`` (two branches from one found state)
    lam: float  #: λ of the connection
    events: tuple[int, ...]  #: ids of its events
    start: int  #: id of the first segment
    end: int | None  #: id of the second segment; None if no traced branch passes the state after a jump


@dataclass(frozen=True, repr=False)
class BranchMapRange(Value):
    """Range of λ with a constant set of states and a constant stable state of minimum energy.

    Examples
    --------
    >>> last = arcwall.Deck.load("truss.toml").trace().branch_map.ranges[-1]
    >>> last.states, last.stable, last.least
    ((2,), (2,), 2)
    """

    lam: tuple[float, float]  #: minimum and maximum λ
    states: tuple[int, ...]  #: ids of the segments that have a state there
    stable: tuple[int, ...]  #: ids of the stable ones
    least: int | None  #: id of the stable one with minimum energy; None if none is stable


@dataclass(frozen=True, repr=False)
class BranchMap(Value):
    """Branch map of a path, as in ``branches.json``.

    Examples
    --------
    >>> map_ = arcwall.Deck.load("truss.toml").trace().branch_map
    >>> len(map_.segments), len(map_.edges), len(map_.ranges)
    (3, 3, 4)
    """

    segments: tuple[BranchMapSegment, ...]  #: segments of all branches
    edges: tuple[BranchMapEdge, ...]  #: connections between segments
    ranges: tuple[BranchMapRange, ...]  #: ranges of λ, in ascending order


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
