"""Paths of decks: what a run has traced."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _engine
from .branch_map import BranchMap, branch_map_of
from .curves import Curve, row_of
from .deck import Deck
from .events import Point, Search, point_of, searches_of
from .shapes import Shape, shape_of

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes

    from .studies import Convergence

__all__ = ["Path", "State", "Tracing", "load"]


@dataclass(frozen=True)
class State:
    """All that varies along a path at a point."""

    x: np.ndarray  #: unknowns, as the engine has them (docs/theory.md, sections 1 and 8.1); shape (unknowns,)
    lam: float
    closed: np.ndarray  #: which contacts are closed; bool, shape (contacts,)


class _Points(Sequence[Point]):
    """The points of a path, made as they are asked for."""

    def __init__(self, run: Any):
        self._run = run

    def __len__(self) -> int:
        return self._run.size()

    def __getitem__(self, which: Any) -> Any:
        if isinstance(which, slice):
            return [self[i] for i in range(*which.indices(len(self)))]
        index = row_of(which, len(self))
        return point_of(self._run.point(index), index)

    def __repr__(self) -> str:
        return f"<{len(self)} points of a path>"


class Path(Curve):
    """What was traced of a deck: points, events and branches. It owns all that it needs, the deck may go.

    Made by ``deck.trace()``, ``deck.tracing().path`` and ``arcwall.load(folder)``. It can be pickled and copied, with all that is
    needed to go on.
    """

    @property
    def deck(self) -> Deck:
        """The deck that was traced."""
        name, text, assignments = self._run.description()
        return Deck._of(text.encode(), name, assignments)

    @property
    def warnings(self) -> list[str]:
        """What one should know of the deck though it is no error."""
        return self._run.warnings()

    @property
    def search(self) -> tuple[Search, ...]:
        """What was looked for beside the traced branches and found, at one λ after the other; empty without ``path.search``."""
        return searches_of(self._run.search())

    @property
    def branch_map(self) -> BranchMap:
        """The branch map: the states over λ, and what leads from one to another, as in ``branches.json``. Empty for load
        increments and for decks with stages."""
        return branch_map_of(self._run.branch_map())

    @property
    def units(self) -> dict[str, str]:
        """The deck's units of length, force and energy; empty texts where it names none."""
        return dict(zip(("length", "force", "energy"), self._run.units()))

    @property
    def points(self) -> Sequence[Point]:
        """The points as objects, with their contacts and forces."""
        return _Points(self._run)

    def tracing(self) -> Tracing:
        """Goes on a point at a time."""
        return Tracing(self)

    def state(self, point: int) -> State:
        """The state at a point: a copy."""
        x, lam, closed = self._run.state(row_of(point, len(self)))
        return State(x, lam, np.asarray(closed, dtype=bool))

    def shape(self, point: int) -> Shape:
        """The deformed structure at a point of the path: its row in ``table``, or −1 for the last."""
        index = row_of(point, len(self))
        members, contacts, walls = self._run.shape(index)
        return shape_of(members, contacts, walls, float(self["lambda"][index]))

    def converge(self, *, levels: int = 3, factor: int = 2) -> Convergence:
        """How sure the events are: the deck on several meshes, as ``deck.converge()``."""
        return self.deck.converge(levels=levels, factor=factor)

    def report(self) -> str:
        """``report.html`` as a text: one page that needs no other file and no network."""
        return self._run.report()

    def save(self, folder: str | os.PathLike[str], *, force: bool = False, pictures: bool = True) -> None:
        """Writes a run folder, file by file what ``trace-path run`` writes; ``arcwall.load`` and ``trace-path resume`` read it.

        ``force``: also into a folder that something else filled. ``pictures``: ``report.html`` and the shapes for ParaView.
        FileError where it cannot be written; ValueError for a path without points.
        """
        if not len(self):
            raise ValueError("a path without points cannot be saved: trace one")
        self._run.save(os.fspath(folder), force, pictures)

    # --- pictures -------------------------------------------------------------------------------------------------------

    def plot_shape(self, point: int = -1, *, ax: Axes | None = None) -> Axes:
        """Draws the walls, the structure at a point and, in grey, at the first one; returns the axes. Needs matplotlib."""
        from .pictures import plot_shape

        return plot_shape(self, point, ax)

    def animate(self, *, every: int = 1, interval: int = 50) -> FuncAnimation:
        """The shapes along the path as an animation of matplotlib, of every n-th point, ``interval`` milliseconds each."""
        from .pictures import animate

        return animate(self, every, interval)

    # --- copies ---------------------------------------------------------------------------------------------------------

    def __reduce__(self) -> tuple[Any, ...]:
        name, text, assignments = self._run.description()
        if not len(self):
            return _begun, (name, text, assignments)
        return _restored, (self._run.checkpoint(),)

    def __copy__(self) -> Path:
        return self.__deepcopy__({})

    def __deepcopy__(self, memo: dict[int, Any]) -> Path:
        make, arguments = self.__reduce__()
        return make(*arguments)


def _begun(name: str, text: bytes, assignments: list[str]) -> Path:
    return Path(_engine.Run(name, text, assignments))


def _restored(checkpoint: bytes) -> Path:
    return Path(_engine.Run.of_checkpoint(checkpoint, "a pickled path"))


class Tracing(Iterator[Point]):
    """Traces a path while it is iterated. Between two points anything may be done with ``path``; Ctrl-C stops it there."""

    def __init__(self, path: Path):
        self.path = path  #: what was traced so far

    def __iter__(self) -> Tracing:
        return self

    def __next__(self) -> Point:
        if self.path._run.advance(1, math.inf) == 0:
            raise StopIteration
        return self.path.points[-1]

    def __repr__(self) -> str:
        return f"<arcwall.Tracing of {self.path!r}>"


def load(folder: str | os.PathLike[str]) -> Path:
    """The path in a run folder, from its ``checkpoint``; one that was stopped from outside can go on.

    FileError where there is none, or one of another version. Nothing in the folder is changed.
    """
    return Path(_engine.Run.of_folder(os.fspath(folder)))
