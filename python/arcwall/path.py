"""Equilibrium paths of decks."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _engine
from .branch_map import BranchMap, branch_map_of
from .curves import Curve, row_of
from .events import Point, Search, point_of, searches_of
from .shapes import Shape, shape_of

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes

    from .deck import Deck
    from .studies import Convergence

__all__ = ["Path", "State", "Tracing"]


@dataclass(frozen=True)
class State:
    """State of a path at a point.

    Examples
    --------
    >>> path = arcwall.Deck.load("truss.toml").trace()
    >>> state = path.state(-1)
    >>> state.x.shape, state.lam == path["lambda"][-1], state.closed.size
    ((2,), True, 0)
    """

    x: np.ndarray  #: degrees of freedom and contact unknowns, float64 of shape (unknowns,)
    lam: float  #: load factor λ
    closed: np.ndarray  #: True for each closed contact; bool of shape (contacts,)


class _Points(Sequence[Point]):
    """Points of a path, created on access."""

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
    """Equilibrium path of a deck: points, events and branches.

    `Deck.trace`, `Deck.tracing` and `load` return one. It can be copied, pickled and continued by `resume`.

    Examples
    --------
    >>> path = arcwall.Deck.load("channel.toml").trace()
    >>> path
    <arcwall.Path of 48 points, 7 events, 1 branches>
    >>> path.units["length"], path.monitors["mid"], round(float(path["mid"][-1]), 6)
    ('cm', 'cm', -0.15)
    """

    # `deck_of` makes a deck of a text, a name and assignments; decks import paths, not paths decks.
    def __init__(self, run: Any, deck_of: Callable[[bytes, str, list[str]], Deck]):
        super().__init__(run)
        self._deck_of = deck_of

    @property
    def deck(self) -> Deck:
        """Deck of the path, a copy."""
        name, text, assignments = self._run.description()
        return self._deck_of(text.encode(), name, assignments)

    @property
    def warnings(self) -> list[str]:
        """Warnings about the deck, one sentence each."""
        return self._run.warnings()

    @property
    def search(self) -> tuple[Search, ...]:
        """Searches for disconnected branches, one for each λ; empty without ``path.search``."""
        return searches_of(self._run.search())

    @property
    def branch_map(self) -> BranchMap:
        """Branch map, as in ``branches.json``.

        It is empty for ``path.method = "incremental"`` and for decks with load steps.
        """
        return branch_map_of(self._run.branch_map())

    @property
    def units(self) -> dict[str, str]:
        """Units of length, force and energy; empty if the deck gives none."""
        return dict(zip(("length", "force", "energy"), self._run.units()))

    @property
    def points(self) -> Sequence[Point]:
        """Points as `Point` objects, with their contacts."""
        return _Points(self._run)

    @property
    def contacts(self) -> pd.DataFrame:
        """Closed contacts of all points as a new pandas DataFrame, as in ``contacts.csv``; needs pandas.

        With friction it has the columns ``friction``, ``state``, ``slip`` and ``anchor``.

        Examples
        --------
        >>> path = arcwall.Deck.load("channel.toml").trace()
        >>> list(path.contacts.columns[:4]), len(path.contacts) == path["contacts"].sum()
        (['branch', 'step', 'lambda', 'wall'], True)
        """
        import pandas as pd

        names = ["wall", "member", "fraction", "x", "force", "pressure"]
        if "dissipation" in self.columns:
            names += ["friction", "state", "slip", "anchor"]
        rows = [
            (point.branch, point.step, point.lam, *(getattr(contact, name) for name in names))
            for point in self.points
            for contact in point.contacts
        ]
        return pd.DataFrame(rows, columns=["branch", "step", "lambda", *names])

    def loop_work(self, stage_a: str, stage_b: str) -> float:
        """Return the work lost in friction from the start of one load step to the end of another.

        Over a closed loop it is the work that the driving load or displacement does.

        Parameters
        ----------
        stage_a, stage_b : str
            Names of the first and the last load step.

        Returns
        -------
        float
            Work [force·length].

        Raises
        ------
        ValueError
            If the path has no friction, or no points of a load step, or if they are in the other order.
        """
        if "dissipation" not in self.columns:
            raise ValueError("the path has no friction, so no loop has work")
        rows = []
        for stage in (stage_a, stage_b):
            names: list[str] = list(self["stage"]) if "stage" in self.columns else []
            of = [i for i, name in enumerate(names) if name == stage]
            if not of:
                raise ValueError(f"the path has no points of a load step {stage!r}")
            rows.append(of)
        first, last = rows[0][0], rows[1][-1]
        if last < first:
            raise ValueError(f"load step {stage_b!r} comes before {stage_a!r}")
        return float(self["dissipation"][last] - self["dissipation"][first])

    def tracing(self) -> Tracing:
        """Return an iterator that continues the path point by point.

        Returns
        -------
        Tracing

        Examples
        --------
        >>> path = arcwall.Deck.load("truss.toml").trace(max_points=5)
        >>> next(path.tracing()).index, len(path)
        (5, 6)
        """
        return Tracing(self)

    def state(self, point: int) -> State:
        """Return a copy of the state at a point.

        Parameters
        ----------
        point : int
            Row in ``table``; a negative one counts from the end.

        Returns
        -------
        State

        Raises
        ------
        IndexError
            If there is no such point.
        """
        x, lam, closed = self._run.state(row_of(point, len(self)))
        return State(x, lam, np.asarray(closed, dtype=bool))

    def shape(self, point: int) -> Shape:
        """Return the deformed structure at a point.

        Parameters
        ----------
        point : int
            Row in ``table``; a negative one counts from the end.

        Returns
        -------
        Shape

        Raises
        ------
        IndexError
            If there is no such point.

        Examples
        --------
        >>> path = arcwall.Deck.load("channel.toml").trace()
        >>> shape = path.shape(path.events["limit-point"][0].point)
        >>> [mark.wall for mark in shape.contacts]
        ['upper', 'upper']
        """
        index = row_of(point, len(self))
        members, contacts, walls = self._run.shape(index)
        return shape_of(members, contacts, walls, float(self["lambda"][index]))

    def converge(self, *, levels: int = 3, factor: int = 2) -> Convergence:
        """Estimate the mesh errors of the events; see `Deck.converge`.

        Parameters
        ----------
        levels : int, default 3
            Number of meshes, 2 to 8.
        factor : int, default 2
            Refinement from mesh to mesh, 2 to 10.

        Returns
        -------
        Convergence

        Raises
        ------
        ValueError
            If ``levels`` or ``factor`` is out of range.
        """
        return self.deck.converge(levels=levels, factor=factor)

    def report(self) -> str:
        """Return ``report.html``, one self-contained page.

        Returns
        -------
        str
        """
        return self._run.report()

    def save(self, folder: str | os.PathLike[str], *, force: bool = False, pictures: bool = True) -> None:
        """Write a run folder with the files of ``trace-path run``.

        `load` and ``trace-path resume`` read it.

        Parameters
        ----------
        folder : str or os.PathLike
            Folder to write into.
        force : bool, default False
            Whether to write into a folder with other files.
        pictures : bool, default True
            Whether to write ``report.html`` and the shapes for ParaView.

        Raises
        ------
        FileError
            If the folder cannot be written or has other files.
        ValueError
            If the path has no points.

        Examples
        --------
        >>> path = arcwall.Deck.load("truss.toml").trace()
        >>> path.save("truss-run", pictures=False)
        >>> arcwall.load("truss-run").events == path.events
        True
        """
        if not len(self):
            raise ValueError("a path without points cannot be saved: trace one")
        self._run.save(os.fspath(folder), force, pictures)

    # --- pictures -------------------------------------------------------------------------------------------------------

    def plot_shape(self, point: int = -1, *, ax: Axes | None = None) -> Axes:
        """Draw the structure and its walls at a point, and the first shape in grey; needs matplotlib.

        Parameters
        ----------
        point : int, default -1
            Row in ``table``; a negative one counts from the end.
        ax : matplotlib.axes.Axes, optional
            Axes to draw into; new ones by default.

        Returns
        -------
        matplotlib.axes.Axes

        Raises
        ------
        IndexError
            If there is no such point.

        Examples
        --------
        >>> arcwall.Deck.load("channel.toml").trace().plot_shape().get_title()
        'λ = 9'
        """
        from . import pictures

        return pictures.plot_shape(self.shape(point), self.shape(0), self.units["length"], ax)

    def animate(self, *, every: int = 1, interval: int = 50) -> FuncAnimation:
        """Make an animation of the shapes along the path; needs matplotlib.

        Parameters
        ----------
        every : int, default 1
            Draw each point with a row that is a multiple of it.
        interval : int, default 50
            Time of each frame [ms].

        Returns
        -------
        matplotlib.animation.FuncAnimation

        Raises
        ------
        ValueError
            If ``every`` is less than 1 or the path has no points.
        """
        from . import pictures

        if every < 1:
            raise ValueError(f"every = {every} is no number of points; give 1 or more")
        shapes = [self.shape(i) for i in range(0, len(self), every)]
        if not shapes:
            raise ValueError("a path without points cannot be drawn")
        return pictures.animate(shapes, self.units["length"], interval)

    # --- copies ---------------------------------------------------------------------------------------------------------

    def __reduce__(self) -> tuple[Any, ...]:
        name, text, assignments = self._run.description()
        if not len(self):
            return _begun, (self._deck_of, name, text, assignments)
        return _restored, (self._deck_of, self._run.checkpoint())

    def __copy__(self) -> Path:
        return self.__deepcopy__({})

    def __deepcopy__(self, memo: dict[int, Any]) -> Path:
        make, arguments = self.__reduce__()
        return make(*arguments)


def _begun(deck_of: Any, name: str, text: bytes, assignments: list[str]) -> Path:
    return Path(_engine.Run(name, text, assignments), deck_of)


def _restored(deck_of: Any, checkpoint: bytes) -> Path:
    return Path(_engine.Run.of_checkpoint(checkpoint, "a pickled path"), deck_of)


class Tracing(Iterator[Point]):
    """Iterator that traces a path point by point; returned by `Deck.tracing` and `Path.tracing`.

    Between two points a program may use ``path`` freely. Ctrl-C raises KeyboardInterrupt there.

    Parameters
    ----------
    path : Path
        Path to continue.

    Examples
    --------
    >>> tracing = arcwall.Deck.load("channel.toml").tracing()
    >>> for point in tracing:
    ...     if point.contacts:
    ...         break
    >>> point.event, round(point.lam, 6), len(tracing.path)
    ('contact-closes', 0.430011, 16)
    """

    def __init__(self, path: Path):
        self.path = path  #: path traced so far

    def __iter__(self) -> Tracing:
        return self

    def __next__(self) -> Point:
        if self.path._run.advance(1, math.inf) == 0:
            raise StopIteration
        return self.path.points[-1]

    def __repr__(self) -> str:
        return f"<arcwall.Tracing of {self.path!r}>"
