"""Events, branches and points of a path, as values."""

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
    """Contact of the structure with a wall, at a point of a path or in an event.

    Examples
    --------
    >>> path = arcwall.Deck.load("channel.toml").trace()
    >>> [(contact.wall, round(contact.force, 3)) for contact in path.points[-1].contacts]
    [('upper', 6.896), ('lower', 6.893), ('upper', 6.896)]
    """

    wall: str  #: name of the wall
    member: str  #: name of the member
    fraction: float  #: fraction of the member's length, 0 to 1; nan if unknown
    x: float  #: current coordinate x [length]
    force: float | None = None  #: force along the wall's normal [force]; in events None without friction
    pressure: float | None = None  #: contact pressure [force/length]; None for a point force
    state: str | None = None  #: ``stick``, ``slip+`` or ``slip-`` along the wall's tangent; None without friction
    friction: float | None = None  #: friction force T along the wall's tangent [force]; None without friction
    slip: float | None = None  #: slip since it closed [length]; None without friction, and in events
    anchor: float | None = None  #: x of the point of the wall where it sticks [length]; else None


@dataclass(frozen=True, repr=False)
class Continuum(Value):
    """One-parameter family of equilibria with the same λ and energy.

    Only the total length of several contact zones is determined, not the length of each.

    Examples
    --------
    >>> perfect = {"member.column.imperfection": [], "member.column.elements": 20, "path.stop.lambda": [-1.0, 20.0]}
    >>> deck = arcwall.Deck.load("channel.toml").copy({**perfect, "path.equilibrium_family": "stop"})
    >>> end = deck.trace().branches[-1].end
    >>> end.reason, end.family.parts
    ('equilibrium_family', 3)
    """

    parts: int  #: number of contact zones; a new one has length 0
    energy: float  #: total potential energy [force·length]
    length: float  #: total length of the zones [length]


@dataclass(frozen=True, repr=False)
class End(Value):
    """End of a branch, with its reason.

    Examples
    --------
    >>> arcwall.Deck.load("truss.toml").trace().branches[0].end
    End(reason='stop', detail='w = 1.2')
    """

    reason: str  #: ``stop``, ``closed_loop``, ``max_points``, ``min_step``, …
    detail: str  #: bound that was reached, or position and cause of an early end
    partner: int | None = None  #: id of the branch that was reached, or on which the path continues
    family: Continuum | None = None  #: family of equilibria beyond the end


@dataclass(frozen=True, repr=False)
class JumpContact(Value):
    """Contact point or contact zone of the state after a jump.

    Examples
    --------
    >>> jump = arcwall.Deck.load("channel.toml").trace().events["limit-point"][0].jump
    >>> [(contact.wall, contact.kind) for contact in jump.contacts]
    [('upper', 'point'), ('lower', 'point'), ('upper', 'point')]
    """

    wall: str  #: name of the wall
    member: str  #: name of the member
    fraction: float  #: fraction of the member's length at which it begins, 0 to 1; nan if unknown
    kind: str  #: ``point`` or ``zone``
    force: float  #: total contact force [force]


@dataclass(frozen=True, repr=False)
class Jump(Value):
    """Jump of the structure at constant λ from an event at which it loses stability.

    If the state after the jump was not determined, ``reason`` and ``why`` explain it. All other fields
    except ``lam`` and ``two_destinations`` are then None or empty.

    Examples
    --------
    >>> jump = arcwall.Deck.load("channel.toml").trace().events["limit-point"][0].jump
    >>> jump.contact_pattern, round(jump.energy_released, 5), round(jump.return_.lam, 6)
    ('upper lower upper', 0.42178, 4.246891)
    """

    lam: float  #: λ of the event
    reason: str | None = None  #: None, ``no_equilibrium``, ``not_found`` or ``two_destinations``
    why: str | None = None  #: explanation of the reason
    monitors: Mapping[str, float] = field(default_factory=dict)  #: monitors of the state after the jump, by name
    contacts: tuple[JumpContact, ...] = ()  #: contacts of that state, along the members
    contact_pattern: str = ""  #: walls of these contacts, such as ``upper lower upper``; ``upper=`` is a contact zone
    energy: float | None = None  #: total potential energy of that state [force·length]
    energy_released: float | None = None  #: energy before the jump minus energy after it [force·length]
    unstable: int | None = None  #: number of unstable directions of that state; None if undetermined
    on_branch: int | None = None  #: id of the traced branch through that state; None if there is none
    arc: float | None = None  #: arc length of that state along the branch [path metric]
    return_: Return | None = None  #: loss of stability as λ is reversed; None if none is known
    energy_dissipated: float | None = None  #: energy dissipated per hysteresis loop, if it closes [force·length]
    two_destinations: tuple[Jump, ...] = ()  #: one jump for each sign of the critical mode, for the reason of this name


@dataclass(frozen=True, repr=False)
class Return(Value):
    """Loss of stability after a jump, as λ is reversed.

    Examples
    --------
    >>> back = arcwall.Deck.load("truss.toml").trace().events["limit-point"][0].jump.return_
    >>> round(back.lam, 6), back.kind, round(back.jump.monitors["w"], 6)
    (-37.919801, 'limit-point', -0.07735)
    """

    lam: float  #: λ of the event
    kind: str  #: kind of the event
    monitors: Mapping[str, float]  #: monitors at the event, by name
    jump: Jump | None = None  #: jump from the event


@dataclass(frozen=True, repr=False)
class Found(Value):
    """Equilibrium found by a search, on no branch that was traced before.

    Examples
    --------
    >>> search = {"search": True, "search_at": [10.0], "search_guesses": 5}
    >>> deck = arcwall.Deck.load("truss.toml").copy({f"path.{key}": value for key, value in search.items()})
    >>> path = deck.copy({"path.stop.event": "limit-point"}).trace()
    >>> [(found.unstable, found.became) for found in path.search[0].found]
    [(0, 'traced'), (1, 'traced')]
    """

    contact_pattern: str  #: walls in contact along the members, such as ``upper lower upper``
    monitors: Mapping[str, float]  #: monitors, by name
    energy: float  #: total potential energy [force·length]
    unstable: int | None  #: number of unstable directions; None if undetermined
    became: str  #: ``traced``, ``on_branch``, ``beyond_stop``, ``not_traced`` or ``pending``
    branches: tuple[int, ...]  #: ids of the branches that start there, or of the one through it


@dataclass(frozen=True, repr=False)
class Search(Value):
    """Search at one λ for equilibria on disconnected branches.

    A search does not prove that there are no others.

    Examples
    --------
    >>> search = {"search": True, "search_at": [10.0], "search_guesses": 5}
    >>> deck = arcwall.Deck.load("truss.toml").copy({f"path.{key}": value for key, value in search.items()})
    >>> at = deck.copy({"path.stop.event": "limit-point"}).trace().search[0]
    >>> at.lam, at.known, len(at.found)
    (10.0, 1, 2)
    """

    lam: float  #: λ of the search
    known: int  #: number of equilibria on traced branches
    guesses: int  #: number of initial guesses
    outcomes: Mapping[str, int]  #: guesses by outcome: ``found``, ``mirror_image``, ``known``, ``nodes_only``, ``not_found``
    found: tuple[Found, ...]  #: equilibria found


@dataclass(frozen=True, repr=False)
class Event(Value):
    """Located event of a path, as in ``events.json``.

    Examples
    --------
    >>> limit = arcwall.Deck.load("truss.toml").trace().events["limit-point"][0]
    >>> round(limit.lam, 6), limit.extremum, limit.unstable_before, limit.unstable_after
    (37.919801, 'maximum', 0, 1)
    """

    id: int  #: number of the event, from 0 over all branches
    kind: str  #: ``limit-point``, ``branch-point``, ``contact-closes``, …
    branch: int  #: id of its branch
    step: int  #: step of its point along the branch
    point: int  #: row of its point in ``path.table``
    arc: float  #: arc length along the branch [path metric]
    lam: float  #: load factor λ
    monitors: Mapping[str, float]  #: monitors, by name
    unstable_before: int | None  #: number of unstable directions before the event; None if undetermined
    unstable_after: int | None  #: number of unstable directions after the event; None if undetermined
    residual: float  #: relative residual of equilibrium
    lambda_uncertainty: float  #: half-width of the uncertainty of λ
    contacts: tuple[Contact, ...] = ()  #: contacts that change
    #: dλ/dn by the key of each requested parameter n; None if ``no_sensitivity`` has a reason
    sensitivity: Mapping[str, float | None] = field(default_factory=dict)
    #: dm/dn of the monitors m along the event, by key and name
    monitor_sensitivity: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    no_sensitivity: Mapping[str, str] = field(default_factory=dict)  #: reasons for missing sensitivities, by key
    extremum: str | None = None  #: ``maximum`` or ``minimum`` of λ, at a limit point
    monitor: str | None = None  #: monitor that turns or passes a value, or label of the event function
    value: float | None = None  #: value that the monitor passes, at a ``value-crossing``
    type: str | None = None  #: type of a branch point: ``pitchfork``, ``transcritical``, ``one-sided`` or ``multiple``
    multiplicity: int | None = None  #: number of critical modes of a branch point
    unconfirmed: bool = False  #: True if the event function reaches zero without a confirmed change of sign
    mesh_artefact: bool = False  #: True if only node contact may cause the branch point
    branches: tuple[int, ...] = ()  #: ids of the traced branches that leave a branch point
    #: critical mode of a branch point: rates of the monitors by name; for a `System` the vector, shape (n,)
    mode: Any = None
    end: End | None = None  #: reason of an ``end``
    family: Continuum | None = None  #: family of equilibria of which the branch follows one, from this contact change on
    #: jump at constant λ; None without a loss of stability, or without ``path.jumps``
    jump: Jump | None = None
    stage: str | None = None  #: name of the load step; None if the deck has none
    #: number of unstable directions under load control, if λ prescribes displacements; else None
    unstable_load_control: int | None = None

    @property
    def contact(self) -> Contact | None:
        """First contact that changes; None if none does."""
        return self.contacts[0] if self.contacts else None

    @property
    def sense(self) -> int | None:
        """Slip of that contact after the event: 1 along the wall's tangent, -1 against it, 0 if it sticks, else None."""
        return {"slip+": 1, "slip-": -1, "stick": 0}.get((self.contact.state if self.contact else None) or "")

    @property
    def T(self) -> float | None:
        """Friction force of that contact [force]; None without friction."""
        return self.contact.friction if self.contact else None

    @property
    def p(self) -> float | None:
        """Contact force of that contact [force]; None without friction."""
        return self.contact.force if self.contact else None


@dataclass(frozen=True, repr=False)
class Branch(Value):
    """Branch of a path.

    Examples
    --------
    >>> branch = arcwall.Deck.load("truss.toml").trace().branches[0]
    >>> branch.points, branch.end.reason, branch.disconnected
    (22, 'stop', False)
    """

    id: int  #: number of the branch, from 0
    parent: int | None  #: id of the branch that it leaves; None for the first and for disconnected branches
    origin: int | None  #: id of the event at which it leaves, or from which it jumps; None as for ``parent``
    mirror_image: bool  #: True if its mirror image leaves the same event and is not traced
    points: int  #: number of its points
    lam: tuple[float, float]  #: minimum and maximum λ of its points
    end: End | None  #: its end; None if it can be continued
    stage: str | None = None  #: name of the load step; None if the deck has none
    disconnected: bool = False  #: True if it starts at an equilibrium that a search found
    after_jump: bool = False  #: True if it starts after a jump from its parent


@dataclass(frozen=True, repr=False)
class Point(Value):
    """Converged point of a path: a row of ``path.csv``, with its contacts.

    Examples
    --------
    >>> point = arcwall.Deck.load("channel.toml").trace().points[-1]
    >>> point.lam, point.stability, len(point.contacts)
    (9.0, 'stable', 3)
    """

    index: int  #: row of the point in ``path.table``
    branch: int  #: id of its branch
    step: int  #: step along the branch, from 0
    arc: float  #: arc length along the branch [path metric]
    lam: float  #: load factor λ
    monitors: Mapping[str, float]  #: monitors, by name
    unstable: int | None  #: number of unstable directions; None if undetermined
    stability: str  #: ``stable``, ``unstable`` or ``undecided``
    contacts: tuple[Contact, ...]  #: closed contacts with their forces
    energy: float | None  #: total potential energy [force·length]
    iterations: int  #: Newton iterations of the step
    residual: float  #: relative residual of equilibrium
    event: str | None  #: kind of the event at this point; None without one
    stage: str | None = None  #: name of the load step; None if the deck has none
    #: number of unstable directions under load control, if λ prescribes displacements; else None
    unstable_load_control: int | None = None


class Events(Sequence[Event]):
    """Sequence of the events of a path, in the order of its branches and points.

    ``events[0]`` is an `Event`, ``events[2:4]`` a slice and ``events["limit-point"]`` the events of a kind.

    Parameters
    ----------
    events : sequence of Event
        The events.
    kind : str, optional
        Kind of all of them; empty by default, for events of different kinds.

    Raises
    ------
    KeyError
        For an unknown kind of event.
    IndexError
        For a number beyond the events.

    Examples
    --------
    >>> events = arcwall.Deck.load("truss.toml").trace().events
    >>> events["limit-point"]
    <arcwall.Events
      1  limit-point          λ = 37.9198013
      2  limit-point          λ = -37.9198013>
    """

    def __init__(self, events: Sequence[Event], kind: str = ""):
        self._events = tuple(events)
        self._kind = kind  # kind of all events; empty if they differ

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
        """Events as a new pandas DataFrame, one row each; needs pandas.

        The columns are those of position, λ, the monitors and the numbers of unstable directions.
        """
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
    "contact-slips",
    "contact-sticks",
    "contact-transfers",
    "limit-point",
    "contact-limit-point",
    "turning-point",
    "value-crossing",
    "reversal",
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
    """Read the searches of ``result.json``."""
    return tuple(
        Search(
            lam=_float(at["lambda"]),
            known=at["known"],
            guesses=at["guesses"],
            outcomes=at["outcomes"],
            found=tuple(
                Found(
                    contact_pattern=f["contact_pattern"],
                    monitors=_floats(f["monitors"]),
                    energy=_float(f["energy"]),
                    unstable=f["unstable"],
                    became=f["became"],
                    branches=tuple(f["branches"]),
                )
                for f in at["found"]
            ),
        )
        for at in (json or {}).get("at", ())
    )


def _changed_contact(json: Mapping[str, Any]) -> Contact:
    return Contact(
        json["wall"],
        json["member"],
        _float(json["fraction"]),
        _float(json["x"]),
        force=json.get("force"),
        state=json.get("state"),
        friction=json.get("friction"),
    )


def event_of(json: Mapping[str, Any], point: int, mode: np.ndarray | None = None) -> Event:
    """Read an event of ``events.json`` at the given point of its path."""
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
        contacts=tuple(_changed_contact(c) for c in json.get("contact", ())),
        sensitivity=json.get("sensitivity", {}),
        monitor_sensitivity=json.get("monitor_sensitivity", {}),
        no_sensitivity=json.get("no_sensitivity", {}),
        extremum=json.get("extremum"),
        monitor=json.get("monitor"),
        value=json.get("value"),
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
        after_jump=json["after_jump"],
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
        contacts=tuple(
            Contact(wall, member, at, x, force, p, *(friction or ()))
            for (wall, member, at), x, force, p, friction in json["forces"]
        ),
        energy=json["energy"],
        iterations=json["iterations"],
        residual=json["residual"],
        event=json["event"],
        stage=json.get("stage"),
        unstable_load_control=json.get("unstable_load_control"),
    )
