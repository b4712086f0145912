"""What structures look like, and what they carry."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

__all__ = ["ContactMark", "MemberShape", "Shape", "WallShape"]


@dataclass(frozen=True, repr=False)
class MemberShape:
    """A member's axis from end to end, at fixed fractions, at nodes and where contacts are; arrays of one shape (n,).

    Where forces jump (a load, a contact, a support) a point is there twice, before and behind.
    """

    fraction: np.ndarray  #: of the member's stress-free length
    x: np.ndarray  #: present place [length]
    z: np.ndarray
    ux: np.ndarray  #: displacement from the stress-free shape [length]
    uz: np.ndarray
    angle: np.ndarray  #: of the section's normal [rad]
    rotation: np.ndarray  #: of the section, from the stress-free shape [rad]
    axial_force: np.ndarray  #: tension is positive [force]
    moment: np.ndarray  #: positive where it adds to the curvature [force·length]

    def __repr__(self) -> str:
        return f"<arcwall.MemberShape of {len(self.x)} places>"


@dataclass(frozen=True)
class ContactMark:
    """A closed contact as a picture has it."""

    wall: str
    member: str
    fraction: float
    x: float  #: of the point that touches [length]
    z: float
    force: tuple[float, float]  #: of the wall on the structure, along x and z [force]
    pressure: float | None  #: [force/length]; None for a point force


@dataclass(frozen=True, repr=False)
class WallShape:
    """The surface of a wall where the structure may come, at the point's λ."""

    x: np.ndarray  #: [length]
    z: np.ndarray
    side: str  #: ``above`` or ``below`` the structure

    def __repr__(self) -> str:
        return f"<arcwall.WallShape of {len(self.x)} places, {self.side}>"


@dataclass(frozen=True)
class Shape:
    """What a structure looks like at a point, and what it carries."""

    members: dict[str, MemberShape]
    contacts: tuple[ContactMark, ...]
    walls: dict[str, WallShape]
    lam: float


def shape_of(
    members: Mapping[str, np.ndarray], contacts: Iterable[Any], walls: Mapping[str, tuple[np.ndarray, str]], lam: float
) -> Shape:
    """A shape of what the engine gives: a table for each member, labels and numbers of contacts, a line for each wall."""
    return Shape(
        members={name: MemberShape(*np.ascontiguousarray(table.T)) for name, table in members.items()},
        contacts=tuple(
            ContactMark(wall, member, at, x, z, (fx, fz), p) for (wall, member, at), x, z, fx, fz, p in contacts
        ),
        walls={name: WallShape(line[:, 0].copy(), line[:, 1].copy(), side) for name, (line, side) in walls.items()},
        lam=lam,
    )
