"""Decks: descriptions of a structure, its loads and walls, and of the path to trace."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from . import _engine, toml
from .errors import DeckError, Diagnostic
from .event_curves import EventCurve, WorstCombination, worst_of
from .path import Path, Tracing
from .studies import Convergence

__all__ = ["Deck", "load"]


class Deck:
    """Deck: the TOML text of a model, with values that replace parts of it.

    All quantities are in the consistent units of the deck. A deck may have errors: `check` lists them, and
    methods that need a valid deck raise `DeckError`. Decks can be compared, copied and pickled.

    Parameters
    ----------
    content : mapping, optional
        Content as a dict of tables, such as ``{"units": {"length": "cm"}, "material": {…}}``; empty by default.
    name : str, default "deck.toml"
        File name for messages and run folders.

    Raises
    ------
    TypeError
        If the content is not a mapping, or has types that TOML lacks.

    Examples
    --------
    >>> deck = arcwall.Deck.load("channel.toml")
    >>> deck["material.steel.E"], deck["path.method"]
    (21000.0, 'spherical')
    >>> deck["wall.upper.profile.z"] = 0.22
    >>> deck.assignments
    ['wall.upper.profile.z=0.22']
    """

    def __init__(self, content: Mapping[str, Any] | None = None, *, name: str = "deck.toml"):
        if content is not None and not isinstance(content, Mapping):
            raise TypeError(f"Deck() takes a dict, not {type(content).__name__}; Deck.load takes a file, Deck.parse a text")
        self._set(toml.document(content or {}), name)

    @classmethod
    def load(cls, file: str | os.PathLike[str]) -> Deck:
        """Read a deck from a file.

        Parameters
        ----------
        file : str or os.PathLike
            File to read.

        Returns
        -------
        Deck

        Raises
        ------
        DeckError
            If the file cannot be read or is not TOML.

        Examples
        --------
        >>> arcwall.Deck.load("truss.toml")["title"]
        'Two-bar truss past both peaks'
        """
        name = os.fspath(file)
        return cls.parse(_engine.read_deck_file(name), name=name)

    @classmethod
    def parse(cls, text: str | bytes, *, name: str = "deck.toml") -> Deck:
        """Read a deck from a text.

        Parameters
        ----------
        text : str or bytes
            TOML text, in UTF-8.
        name : str, default "deck.toml"
            File name for messages and run folders.

        Returns
        -------
        Deck

        Raises
        ------
        DeckError
            If the text is not TOML.

        Examples
        --------
        >>> arcwall.Deck.parse("material.steel.E = 2.1e4")["material.steel.E"]
        21000.0
        """
        if not isinstance(text, (str, bytes)):
            raise TypeError(f"Deck.parse takes a text, not {type(text).__name__}")
        deck = cls.__new__(cls)
        deck._set(text, name)
        return deck

    # A deck of text and assignments that are valid TOML.
    @classmethod
    def _of(cls, text: bytes, name: str, assignments: Iterable[str]) -> Deck:
        deck = cls.__new__(cls)
        deck._text, deck._name, deck._assignments = text, name, list(assignments)
        return deck

    def _set(self, text: str | bytes, name: str) -> None:
        self._text = text.encode() if isinstance(text, str) else bytes(text)
        self._name = os.fspath(name)
        self._assignments: list[str] = []
        _engine.require_toml(self._text, self._name, [])

    @property
    def name(self) -> str:
        """File name of the deck."""
        return self._name

    @property
    def assignments(self) -> list[str]:
        """Values set since the text was read, in the form of the option ``--set``."""
        return list(self._assignments)

    # --- values ---------------------------------------------------------------------------------------------------------

    def __getitem__(self, key: str) -> Any:
        """Return the value of a key, or its default.

        Parameters
        ----------
        key : str
            Dotted key, such as ``wall.upper.profile.z`` or ``load.0.force``. An element of an array has its number
            from 0, or its name.

        Returns
        -------
        object
            Number, text, list, or a copy of a table as a dict.

        Raises
        ------
        KeyError
            If there is no such key; the message has the nearest one.
        """
        return _engine.value(self._text, self._name, self._assignments, _checked_key(key))

    def __setitem__(self, key: str, value: Any) -> None:
        """Replace or add a value.

        Parameters
        ----------
        key : str
            Dotted key.
        value : object
            Number, text, list or dict, as in TOML.

        Raises
        ------
        DeckError
            If the key cannot be set.
        """
        assignment = f"{_checked_key(key)}={toml.value(value)}"
        # Earlier assignments of this key are dropped, unless later assignments need them.
        others = [one for one in self._assignments if not one.startswith(f"{key}=")]
        for before in (others, self._assignments):
            assignments = [*before, assignment]
            try:
                _engine.require_toml(self._text, self._name, assignments)
                break
            except DeckError:
                if before is self._assignments:
                    raise
        self._assignments = assignments

    def __contains__(self, key: object) -> bool:
        try:
            self[key]  # type: ignore[index]
        except (KeyError, DeckError, TypeError):
            return False
        return True

    __iter__ = None  # type: ignore[assignment]

    def update(self, values: Mapping[str, Any]) -> None:
        """Set several values, in their order: either all or none.

        Parameters
        ----------
        values : mapping
            Values by their dotted keys.

        Raises
        ------
        DeckError
            If a key cannot be set; the deck is then unchanged.

        Examples
        --------
        >>> deck = arcwall.Deck.load("truss.toml")
        >>> deck.update({"material.bar.E": 2e5, "path.step": 2.0})
        >>> deck["path.step"]
        2.0
        """
        before = self._assignments
        try:
            for key, value in values.items():
                self[key] = value
        except BaseException:
            self._assignments = before
            raise

    def copy(self, values: Mapping[str, Any] | None = None) -> Deck:
        """Return a copy of the deck, with some values replaced.

        Parameters
        ----------
        values : mapping, optional
            Values by their dotted keys.

        Returns
        -------
        Deck

        Raises
        ------
        DeckError
            If a key cannot be set.

        Examples
        --------
        >>> stiff = arcwall.Deck.load("truss.toml").copy({"material.bar.E": 2e5})
        >>> round(stiff.trace().events["limit-point"][0].lam, 6)
        75.839603
        """
        deck = self._of(self._text, self._name, self._assignments)
        deck.update(values or {})
        return deck

    def to_dict(self) -> dict[str, Any]:
        """Return the content without defaults; ``Deck(deck.to_dict())`` is an equal deck.

        Returns
        -------
        dict

        Examples
        --------
        >>> arcwall.Deck.load("truss.toml").to_dict()["units"]
        {'length': 'm', 'force': 'kN'}
        """
        return _engine.document(self._text, self._name, self._assignments)

    def __str__(self) -> str:
        """Return the deck as TOML with all defaults, like ``deck.toml`` of a run folder."""
        return _engine.written(self._text, self._name, self._assignments)

    def __repr__(self) -> str:
        sets = "".join(f", {text}" for text in self._assignments[:4]) + (", …" if len(self._assignments) > 4 else "")
        return f"<arcwall.Deck {self._name}{sets}>"

    def __eq__(self, other: object) -> bool:
        """Return True if two valid decks have the same content, defaults included."""
        if not isinstance(other, Deck):
            return NotImplemented
        return str(self) == str(other)

    __hash__ = None  # type: ignore[assignment]

    # --- runs -----------------------------------------------------------------------------------------------------------

    def check(self) -> list[Diagnostic]:
        """List all errors of the deck, in the order of its text.

        Returns
        -------
        list of Diagnostic
            Empty if the deck is valid.

        Examples
        --------
        >>> wrong = arcwall.Deck.load("truss.toml").copy({"path.method": "spherica"})
        >>> [(error.key, error.cure) for error in wrong.check()]
        [('path.method', 'did you mean spherical?')]
        """
        return _engine.check(self._text, self._name, self._assignments)[0]

    def warnings(self) -> list[str]:
        """List the warnings about the deck.

        Returns
        -------
        list of str
            One sentence each; empty for a deck with errors.

        Examples
        --------
        >>> arcwall.Deck.load("truss.toml").warnings()
        []
        """
        return _engine.check(self._text, self._name, self._assignments)[1]

    def tracing(self, *, sensitivity: Iterable[str] | None = None, jumps: bool | None = None) -> Tracing:
        """Return an iterator that traces the deck point by point.

        ``tracing.path`` is the path traced so far. A program may stop at any point and continue later.

        Parameters
        ----------
        sensitivity : iterable of str, optional
            Keys of the parameters n for dλ/dn of each event; by default ``path.sensitivity`` of the deck.
        jumps : bool, optional
            Whether to determine jumps after each loss of stability; by default ``path.jumps`` of the deck.

        Returns
        -------
        Tracing

        Raises
        ------
        DeckError
            If the deck has errors.

        Examples
        --------
        >>> tracing = arcwall.Deck.load("truss.toml").tracing()
        >>> [point.index for point in tracing][-1], tracing.path.ended
        (21, True)
        """
        wanted = {"path.sensitivity": _list_of_keys(sensitivity), "path.jumps": jumps}
        deck = self.copy({key: value for key, value in wanted.items() if value is not None})
        return Tracing(Path(_engine.Run(deck._name, deck._text, deck._assignments), Deck._of))

    def trace(
        self,
        *,
        max_points: int | None = None,
        max_seconds: float | None = None,
        sensitivity: Iterable[str] | None = None,
        jumps: bool | None = None,
    ) -> Path:
        """Trace all branches of the deck; the result is bit-identical to that of ``trace-path run``.

        Ctrl-C raises KeyboardInterrupt at the next point. Use `tracing` to keep the points traced by then.

        Parameters
        ----------
        max_points : int, optional
            Maximum number of points of this call; unlimited by default. `Path.resume` continues.
        max_seconds : float, optional
            Maximum time of this call [s]; unlimited by default.
        sensitivity : iterable of str, optional
            Keys of the parameters n for dλ/dn of each event; by default ``path.sensitivity`` of the deck.
        jumps : bool, optional
            Whether to determine jumps after each loss of stability; by default ``path.jumps`` of the deck.

        Returns
        -------
        Path

        Raises
        ------
        DeckError
            If the deck has errors.
        NoStart
            If no equilibrium was found at the start.

        Examples
        --------
        >>> path = arcwall.Deck.load("truss.toml").trace(sensitivity=["material.bar.E"])
        >>> round(path.events["limit-point"][0].sensitivity["material.bar.E"] * 1e5, 6)
        37.919801
        """
        path = self.tracing(sensitivity=sensitivity, jumps=jumps).path
        path.resume(max_points=max_points, max_seconds=max_seconds)
        return path

    # --- answers --------------------------------------------------------------------------------------------------------

    def converge(self, *, levels: int = 3, factor: int = 2) -> Convergence:
        """Estimate the mesh errors of the events on several meshes, like ``trace-path converge``.

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
        DeckError
            If the deck has errors.
        ValueError
            If ``levels`` or ``factor`` is out of range.

        Examples
        --------
        >>> study = arcwall.Deck.load("channel.toml").copy({"member.column.elements": 20}).converge(levels=2)
        >>> [event.kind for event in study.events][:3]
        ['contact-closes', 'contact-splits', 'limit-point']
        """
        for name, number, most in (("levels", levels, 8), ("factor", factor, 10)):
            if not isinstance(number, int) or not 2 <= number <= most:
                raise ValueError(f"{name} = {number!r} is out of range; give a whole number from 2 to {most}")
        return Convergence(*_engine.study(self._name, self._text, self._assignments, levels, factor))

    def curve(
        self,
        event: str | None = None,
        parameter: str | None = None,
        range: Sequence[float] | None = None,
        *,
        number: int | None = None,
        step: float | None = None,
        max_points: int | None = None,
        output_at: Sequence[float] | None = None,
    ) -> EventCurve:
        """Follow an event while a parameter of the deck varies, like ``trace-path curve``.

        The curve extends to both sides of the deck's own value and passes its turning points. The deck's table
        ``[curve]`` supplies omitted arguments.

        Parameters
        ----------
        event : str, optional
            Kind of the event, such as ``limit-point``.
        parameter : str, optional
            Key of the parameter, such as ``wall.upper.profile.z``.
        range : sequence of float, optional
            Minimum and maximum of the parameter; the deck's own value is between them.
        number : int, optional
            Number of the event among those of its kind, from 1; 1 by default.
        step : float, optional
            Increment of the parameter in the first predictor; by default 1/100 of the range.
        max_points : int, optional
            Maximum number of points on each side of the deck's own value.
        output_at : sequence of float, optional
            Values of the parameter at which to output exact points.

        Returns
        -------
        EventCurve

        Raises
        ------
        DeckError
            If the deck has errors or the arguments do not fit it.
        NoAnswer
            If the event is not on the path or cannot be followed.

        Examples
        --------
        >>> truss = arcwall.Deck.load("truss.toml")
        >>> curve = truss.curve("limit-point", "material.bar.E", (9.9e4, 1.01e5))
        >>> [round(float(load), 6) for load in curve["lambda"][[0, -1]]]
        [37.540603, 38.298999]
        """
        wanted = {"parameter": parameter, "range": range, "step": step, "max_points": max_points, "output_at": output_at}
        deck = self._asking(event, number, wanted, {"worst", "radius"})
        return EventCurve(deck, *_engine.event_curve(deck._name, deck._text, deck._assignments))

    def worst(
        self,
        event: str | None = None,
        keys: Iterable[str] | None = None,
        radius: float | None = None,
        *,
        number: int | None = None,
    ) -> WorstCombination:
        """Find the change of parameters, of a given norm, that lowers the λ of an event most.

        The deck's table ``[curve]`` supplies omitted arguments.

        Parameters
        ----------
        event : str, optional
            Kind of the event, such as ``limit-point``.
        keys : iterable of str, optional
            Keys of the parameters.
        radius : float, optional
            Euclidean norm of the change of the parameters, in their units.
        number : int, optional
            Number of the event among those of its kind, from 1; 1 by default.

        Returns
        -------
        WorstCombination

        Raises
        ------
        DeckError
            If the deck has errors or the arguments do not fit it.
        NoAnswer
            If the event is not on the path, or its λ has no derivative with respect to a parameter.

        Examples
        --------
        >>> worst = arcwall.Deck.load("truss.toml").worst("limit-point", ["material.bar.E"], 1000.0)
        >>> round(worst.values["material.bar.E"], 3), round(worst.lam, 6)
        (99000.0, 37.540603)
        """
        wanted = {"worst": _list_of_keys(keys), "radius": radius}
        deck = self._asking(event, number, wanted, {"parameter", "range", "step", "max_points", "output_at"})
        return worst_of(deck, *_engine.worst(deck._name, deck._text, deck._assignments))

    # The deck with the given arguments in its table [curve], without the keys of other analyses.
    def _asking(self, event: str | None, number: int | None, wanted: Mapping[str, Any], others: set[str]) -> Deck:
        given = {key: value for key, value in wanted.items() if value is not None}
        if event is None and number is None and not given:
            return self
        own = self.to_dict().get("curve", {})
        kept = {key: value for key, value in own.items() if key not in others} if isinstance(own, dict) else {}
        if given.get("parameter", kept.get("parameter")) != kept.get("parameter"):  # these belong to the other parameter
            kept = {key: value for key, value in kept.items() if key not in ("range", "step", "output_at")}
        if event is not None:
            kept["event"] = {"kind": event}
        if number is not None:
            kept["event"] = {**kept.get("event", {}), "number": number}
        table = {**kept, **given}
        if "output_at" in given and not len(given["output_at"]):  # no values at all
            del table["output_at"]
        return self.copy({"curve": table})


def load(folder: str | os.PathLike[str]) -> Path:
    """Read the path of a run folder from its ``checkpoint``.

    An interrupted path can be continued by `Path.resume`. The folder is not changed.

    Parameters
    ----------
    folder : str or os.PathLike
        Run folder of `Path.save` or ``trace-path run``.

    Returns
    -------
    Path

    Raises
    ------
    FileError
        If the folder has no checkpoint of this version.

    Examples
    --------
    >>> arcwall.Deck.load("truss.toml").trace(max_points=5).save("truss-begun", pictures=False)
    >>> path = arcwall.load("truss-begun")
    >>> path.ended, len(path.resume())
    (False, 22)
    """
    return Path(_engine.Run.of_folder(os.fspath(folder)), Deck._of)


def _list_of_keys(keys: Iterable[str] | None) -> list[str] | None:
    return None if keys is None else [keys] if isinstance(keys, str) else list(keys)


def _checked_key(key: str) -> str:
    if not isinstance(key, str):
        raise TypeError(f'a deck is asked by texts like "material.steel.E", not by {key!r}')
    if not key or any(c in key for c in "=\n\r[]{}"):
        raise KeyError(f"{key!r} is no key of a deck; write it as in material.steel.E or load.0.force")
    return key
