"""Located points of a path, its branches and its points, as values."""

from __future__ import annotations

import operator
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from .values import Value

if TYPE_CHECKING:
    import pandas as pd

__all__ = [
    "Branch", "Contact", "Continuum", "End", "Event", "Events", "Found", "Jump", "JumpContact", "Point", "Search", "Return",
]  # fmt: skip


@dataclass(frozen=True, repr=False)
class Contact(Value):
    """A place of the structure on a wall."""

    wall: str
    member: str
    fraction: float  #: of the member's length; nan where it is unknown
    x: float  #: present place [length]
    force: float | None = None  #: of the wall, along its normal [force]; None where a contact changes
    pressure: float | None = None  #: [force/length]; None for a point force


@dataclass(frozen=True, repr=False)
class Continuum(Value):
    """A continuum of equilibria with one load and energy, of which the path keeps to one or at which it ends."""

    parts: int  #: flat parts on walls, new ones being points yet
    energy: float  #: total potential [force·length]
    length: float  #: sum of the lengths of the parts [length]


@dataclass(frozen=True, repr=False)
class End(Value):
    """Why a branch ended."""

    reason: str  #: ``stop``, ``closed_loop``, ``max_points``, ``min_step``, …
    detail: str  #: which bound it was; what to try
    partner: int | None = None  #: the branch that it joined or that goes on
    family: Continuum | None = None  #: that lies ahead


@dataclass(frozen=True, repr=False)
class JumpContact(Value):
    """A contact point or a contact zone of a state that a structure jumps to."""

    wall: str
    member: str
    fraction: float  #: of the member's length, where it begins; nan where it is unknown
    kind: str  #: ``point`` or ``zone``
    force: float  #: in sum [force]


@dataclass(frozen=True, repr=False)
class Jump(Value):
    """The jump of a structure at constant λ from an event at which it loses its stability.

    ``reason`` says why that was not found, and then all but ``lam`` and ``why`` is None or empty.
    """

    lam: float  #: λ, that of the event
    reason: str | None = None  #: None, ``no_equilibrium``, ``not_found`` or ``two_destinations``
    why: str | None = None  #: the reason in words
    monitors: Mapping[str, float] = field(default_factory=dict)
    contacts: tuple[JumpContact, ...] = ()  #: along the members
    contact_pattern: str = ""  #: the walls of these, as ``upper lower upper``; ``upper=`` of a stretch
    energy: float | None = None  #: total potential there [force·length]
    energy_released: float | None = None  #: energy before less energy behind [force·length]
    unstable: int | None = None  #: as of points
    on_branch: int | None = None  #: the branch that passes through the state, if one does
    arc: float | None = None  #: along it [path metric]
    return_: Return | None = None  #: the jump back as λ goes back; None: no loss of stability is known
    energy_dissipated: float | None = None  #: in the hysteresis loop, if that closes [force·length]
    two_destinations: tuple[Jump, ...] = ()  #: of this reason: in one sense of the critical mode and in the other


@dataclass(frozen=True, repr=False)
class Return(Value):
    """Where the state after a jump loses its stability as λ goes back."""

    lam: float
    kind: str  #: of the event
    monitors: Mapping[str, float]
    jump: Jump | None = None  #: the jump from there


@dataclass(frozen=True, repr=False)
class Found(Value):
    """An equilibrium that no traced branch passed when it was found."""

    contact_pattern: str  #: as of a jump
    monitors: Mapping[str, float]
    energy: float  #: total potential [force·length]
    unstable: int | None  #: as of points
    became: str  #: ``traced``, ``on_branch``, ``beyond_stop``, ``not_traced`` or ``pending``
    branches: tuple[int, ...]  #: that begin there, or the one that passes it


@dataclass(frozen=True, repr=False)
class Search(Value):
    """What was looked for beside the traced branches at one λ. What was not found may be there all the same."""

    lam: float
    known: int  #: equilibria of traced branches
    guesses: int
    outcomes: Mapping[str, int]  #: how many guesses ended how: ``found``, ``mirror_image``, ``known``, ``nodes_only``, ``not_found``
    found: tuple[Found, ...]


@dataclass(frozen=True, repr=False)
class Event(Value):
    """A located point of a path at which something happens, as in ``events.json``."""

    id: int  #: counts from 0 over all branches
    kind: str  #: ``limit-point``, ``branch-point``, ``contact-closes``, …
    branch: int
    step: int  #: of the point it lies on
    point: int  #: the same, as a row of ``path.table``
    arc: float  #: arc length [path metric]
    lam: float  #: λ
    monitors: Mapping[str, float]
    unstable_before: int | None
    unstable_after: int | None
    residual: float  #: relative
    lambda_uncertainty: float  #: half-width in λ of what is left uncertain
    contacts: tuple[Contact, ...] = ()  #: that change
    #: dλ/dn by numbers of the deck that were asked for; None where there is none, see ``no_sensitivity``
    sensitivity: Mapping[str, float | None] = field(default_factory=dict)
    no_sensitivity: Mapping[str, str] = field(default_factory=dict)  #: why
    extremum: str | None = None  #: of λ at a limit point: ``maximum`` or ``minimum``
    monitor: str | None = None  #: which one turns; the label of an event function
    type: str | None = None  #: of a branch point: ``pitchfork``, ``transcritical``, ``one-sided``, ``multiple``
    multiplicity: int | None = None  #: of a branch point: critical modes
    unconfirmed: bool = False  #: zero is touched without a change of sign, as nearly as can be told
    mesh_artefact: bool = False  #: a branch point that only contact at nodes makes
    branches: tuple[int, ...] = ()  #: that leave a branch point
    #: of a branch point: rates of the monitors along the critical mode; of a system of one's own the mode itself
    mode: Any = None
    end: End | None = None  #: of an end
    family: Continuum | None = None  #: of a change of contact: the branch keeps to one of these from here on
    #: the jump; None where there is none, and where ``path.jumps`` is not asked for
    jump: Jump | None = None
    stage: str | None = None
    unstable_load_control: int | None = None


@dataclass(frozen=True, repr=False)
class Branch(Value):
    """Arcs joined end to end."""

    id: int
    parent: int | None  #: the branch it leaves
    origin: int | None  #: the event at which it does
    mirror_image: bool  #: its mirror image leaves there too and is not traced
    points: int
    lam: tuple[float, float]  #: least and greatest λ of its points
    end: End | None  #: None while it goes on
    stage: str | None = None
    disconnected: bool = False  #: it leaves no branch: ``path.search`` has found where it begins


@dataclass(frozen=True, repr=False)
class Point(Value):
    """A converged point of a path: a row of ``path.csv``, with its contacts."""

    index: int  #: row of ``path.table``
    branch: int
    step: int
    arc: float
    lam: float
    monitors: Mapping[str, float]
    unstable: int | None
    stability: str  #: ``stable``, ``unstable`` or ``undecided``
    contacts: tuple[Contact, ...]  #: closed ones, of which each carries a force
    energy: float | None
    iterations: int
    residual: float
    event: str | None
    stage: str | None = None
    unstable_load_control: int | None = None


class Events(Sequence[Event]):
    """Events in their order. ``events[0]`` is one, ``events["limit-point"]`` those of a kind, ``events[2:4]`` a part."""

    def __init__(self, events: Sequence[Event], kind: str = ""):
        self._events = tuple(events)
        self._kind = kind  # of which all are; empty: any

    @overload
    def __getitem__(self, which: int) -> Event: ...
    @overload
    def __getitem__(self, which: str | slice) -> Events: ...
    def __getitem__(self, which: int | str | slice) -> Event | Events:
        if isinstance(which, str):
            if which not in KINDS:
                raise KeyError(f"{which!r} is no kind of event; there are {', '.join(KINDS)}")
            return Events([event for event in self._events if event.kind == which], which)
        if isinstance(which, slice):
            return Events(self._events[which], self._kind)
        index = operator.index(which)
        if not -len(self) <= index < len(self):
            raise IndexError(f"there is no event {index}; the path has {len(self)}{self._kind and ' of kind ' + self._kind}")
        return self._events[index]

    @property
    def table(self) -> pd.DataFrame:
        """The events as a pandas DataFrame, one row each: what and where, λ, the monitors, and unstable directions."""
        import pandas as pd

        names = ["id", "kind", "branch", "step", "point", "lambda"]
        counts = ["unstable_before", "unstable_after"]
        monitors = list(self._events[0].monitors) if self._events else []
        rows = [
            (e.id, e.kind, e.branch, e.step, e.point, e.lam, *e.monitors.values(), e.unstable_before, e.unstable_after)
            for e in self._events
        ]
        table = pd.DataFrame(rows, columns=[*names, *monitors, *counts])
        return table.astype(dict.fromkeys(counts, float))

    def __len__(self) -> int:
        return len(self._events)

    def __iter__(self) -> Iterator[Event]:
        return iter(self._events)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Events):
            return NotImplemented
        return self._events == other._events

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        lines = [f"{event.id:3d}  {event.kind:<20} λ = {event.lam:.10g}" for event in self._events]
        return "<arcwall.Events\n" + "\n".join(lines) + ">" if lines else "<arcwall.Events, none>"


KINDS = (
    "start",
    "end",
    "contact-closes",
    "contact-opens",
    "contact-spreads",
    "contact-splits",
    "contact-shrinks",
    "contacts-merge",
    "contact-transfers",
    "limit-point",
    "contact-limit-point",
    "turning-point",
    "branch-point",
    "user",
)


def _float(value: float | None) -> float:
    return float("nan") if value is None else value


def _floats(values: Mapping[str, float | None]) -> dict[str, float]:
    return {name: _float(value) for name, value in values.items()}


def end_of(json: Mapping[str, Any] | None) -> End | None:
    return None if json is None else End(json["reason"], json["detail"], json.get("partner"), _family_of(json))


def _family_of(json: Mapping[str, Any]) -> Continuum | None:
    of = json.get("family")
    return of and Continuum(of["parts"], _float(of["energy"]), _float(of["length"]))


def _jump_of(json: Mapping[str, Any] | None) -> Jump | None:
    if json is None:
        return None
    if "reason" in json:
        each = (_jump_of(one) for one in json.get("two_destinations", ()))
        return Jump(_float(json["lambda"]), json["reason"], json["why"], two_destinations=tuple(one for one in each if one))
    return Jump(
        lam=_float(json["lambda"]),
        monitors=_floats(json["monitors"]),
        contacts=tuple(
            JumpContact(c["wall"], c["member"], _float(c["fraction"]), c["kind"], _float(c["force"]))
            for c in json["contacts"]
        ),
        contact_pattern=json["contact_pattern"],
        energy=_float(json["energy"]),
        energy_released=_float(json["energy_released"]),
        unstable=json["unstable"],
        on_branch=json.get("on_branch"),
        arc=json.get("arc"),
        return_=_return_of(json.get("return")),
        energy_dissipated=json.get("energy_dissipated"),
    )


def _return_of(json: Mapping[str, Any] | None) -> Return | None:
    if json is None:
        return None
    return Return(_float(json["lambda"]), json["kind"], _floats(json["monitors"]), _jump_of(json.get("jump")))


def searches_of(json: Mapping[str, Any] | None) -> tuple[Search, ...]:
    """Those of result.json."""
    return tuple(
        Search(
            lam=_float(at["lambda"]),
            known=at["known"],
            guesses=at["guesses"],
            outcomes=at["outcomes"],
            found=tuple(
                Found(f["contact_pattern"], _floats(f["monitors"]), _float(f["energy"]), f["unstable"], f["became"], tuple(f["branches"]))
                for f in at["found"]
            ),
        )
        for at in (json or {}).get("at", ())
    )


def event_of(json: Mapping[str, Any], point: int, mode: np.ndarray | None = None) -> Event:
    """An event as in events.json, on that point of its path."""
    return Event(
        id=json["id"],
        kind=json["kind"],
        branch=json["branch"],
        step=json["step"],
        point=point,
        arc=_float(json["arc"]),
        lam=_float(json["lambda"]),
        monitors=_floats(json["monitors"]),
        unstable_before=json["unstable_before"],
        unstable_after=json["unstable_after"],
        residual=_float(json["residual"]),
        lambda_uncertainty=_float(json["lambda_uncertainty"]),
        contacts=tuple(Contact(c["wall"], c["member"], _float(c["fraction"]), _float(c["x"])) for c in json.get("contact", ())),
        sensitivity=json.get("sensitivity", {}),
        no_sensitivity=json.get("no_sensitivity", {}),
        extremum=json.get("extremum"),
        monitor=json.get("monitor"),
        type=json.get("type"),
        multiplicity=json.get("multiplicity"),
        unconfirmed=json.get("unconfirmed", False),
        mesh_artefact=json.get("mesh_artefact", False),
        branches=tuple(json.get("branches", ())),
        mode=json.get("mode") if mode is None else mode,
        end=end_of(json) if "reason" in json else None,
        family=_family_of(json),
        jump=_jump_of(json.get("jump")),
        stage=json.get("stage"),
        unstable_load_control=json.get("unstable_load_control"),
    )


def branch_of(json: Mapping[str, Any]) -> Branch:
    return Branch(
        id=json["id"],
        parent=json["parent"],
        origin=None if json["origin"] == "search" else json["origin"],
        mirror_image=json["mirror_image"],
        points=json["points"],
        lam=(_float(json["lambda"][0]), _float(json["lambda"][1])),
        end=end_of(json["end"]),
        stage=json.get("stage"),
        disconnected=json["origin"] == "search",
    )


def point_of(json: Mapping[str, Any], index: int) -> Point:
    return Point(
        index=index,
        branch=json["branch"],
        step=json["step"],
        arc=_float(json["arc"]),
        lam=_float(json["lambda"]),
        monitors=_floats(json["monitors"]),
        unstable=json["unstable"],
        stability=json["stability"],
        contacts=tuple(Contact(wall, member, at, x, force, p) for (wall, member, at), x, force, p in json["forces"]),
        energy=json["energy"],
        iterations=json["iterations"],
        residual=json["residual"],
        event=json["event"],
        stage=json.get("stage"),
        unstable_load_control=json.get("unstable_load_control"),
    )
