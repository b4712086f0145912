"""Deformed shapes of structures, with their section forces."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

__all__ = ["ContactMark", "MemberShape", "Shape", "WallShape"]


@dataclass(frozen=True, repr=False)
class MemberShape:
    """Deformed axis and section forces of a member, from end to end.

    All arrays are float64 of the same shape (n,). Rows are at fixed fractions, at nodes and at contacts. If
    section forces jump (at a load, contact or support), two rows have the same position.

    Examples
    --------
    >>> path = arcwall.Deck.load("channel.toml").trace()
    >>> column = path.shape(-1).members["column"]
    >>> column.x.shape == column.moment.shape, float(column.fraction[-1])
    (True, 1.0)
    """

    fraction: np.ndarray  #: fraction of the member's stress-free length, 0 to 1
    x: np.ndarray  #: current coordinate x [length]
    z: np.ndarray  #: current coordinate z [length]
    ux: np.ndarray  #: displacement along x from the stress-free shape [length]
    uz: np.ndarray  #: displacement along z from the stress-free shape [length]
    angle: np.ndarray  #: direction of the section's normal [rad]
    rotation: np.ndarray  #: rotation of the section from the stress-free shape [rad]
    axial_force: np.ndarray  #: axial force, tension positive [force]
    moment: np.ndarray  #: bending moment, positive if it increases dθ/ds, θ anticlockwise [force·length]

    def __repr__(self) -> str:
        return f"<arcwall.MemberShape of {len(self.x)} places>"


@dataclass(frozen=True)
class ContactMark:
    """Closed contact of a shape.

    Examples
    --------
    >>> path = arcwall.Deck.load("channel.toml").trace()
    >>> [(mark.wall, round(mark.force[1], 3)) for mark in path.shape(-1).contacts]
    [('upper', -6.896), ('lower', 6.893), ('upper', -6.896)]
    """

    wall: str  #: name of the wall
    member: str  #: name of the member
    fraction: float  #: fraction of the member's length, 0 to 1
    x: float  #: current coordinate x of the contact point [length]
    z: float  #: current coordinate z of the contact point [length]
    force: tuple[float, float]  #: force of the wall on the structure along x and z [force]
    pressure: float | None  #: contact pressure [force/length]; None for a point force


@dataclass(frozen=True, repr=False)
class WallShape:
    """Surface of a wall at the λ of a shape, as far as the structure may reach.

    Examples
    --------
    >>> wall = arcwall.Deck.load("channel.toml").trace().shape(-1).walls["upper"]
    >>> wall.side, float(wall.z.max())
    ('above', 0.2)
    """

    x: np.ndarray  #: coordinate x, shape (n,) [length]
    z: np.ndarray  #: coordinate z, shape (n,) [length]
    side: str  #: ``above`` or ``below`` the structure

    def __repr__(self) -> str:
        return f"<arcwall.WallShape of {len(self.x)} places, {self.side}>"


@dataclass(frozen=True)
class Shape:
    """Deformed structure at a point, with section forces, contacts and walls.

    Examples
    --------
    >>> shape = arcwall.Deck.load("channel.toml").trace().shape(-1)
    >>> list(shape.members), len(shape.contacts), list(shape.walls), shape.lam
    (['column'], 3, ['upper', 'lower'], 9.0)
    """

    members: dict[str, MemberShape]  #: members by their names
    contacts: tuple[ContactMark, ...]  #: closed contacts
    walls: dict[str, WallShape]  #: walls by their names
    lam: float  #: load factor λ of the point


def shape_of(
    members: Mapping[str, np.ndarray], contacts: Iterable[Any], walls: Mapping[str, tuple[np.ndarray, str]], lam: float
) -> Shape:
    """Make a shape of the engine's tables of members, rows of contacts and lines of walls."""
    return Shape(
        members={name: MemberShape(*np.ascontiguousarray(table.T)) for name, table in members.items()},
        contacts=tuple(
            ContactMark(wall, member, at, x, z, (fx, fz), p) for (wall, member, at), x, z, fx, fz, p in contacts
        ),
        walls={name: WallShape(line[:, 0].copy(), line[:, 1].copy(), side) for name, (line, side) in walls.items()},
        lam=lam,
    )
