"""Decks: the text that says what a structure is and how its path is followed."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from . import _engine, toml
from .errors import DeckError, Diagnostic

if TYPE_CHECKING:
    from .event_curves import EventCurve, WorstCombination
    from .path import Path, Tracing
    from .studies import Convergence

__all__ = ["Deck"]


class Deck:
    """A deck: the text of one, and values that replace parts of it.

    ``Deck.load(file)`` and ``Deck.parse(text)`` take TOML, ``Deck(dict)`` what TOML would be as a dict. All lengths and
    forces are in the deck's own consistent units. A deck with errors can be made, looked at and mended; ``check()`` lists
    what is wrong, and what needs a right one raises DeckError. Decks can be copied and pickled, and share nothing.
    """

    def __init__(self, content: Mapping[str, Any] | None = None, *, name: str = "deck.toml"):
        """A deck of a dict, as ``{"units": {"length": "cm"}, "wall": [{"name": "floor", …}], …}``."""
        if content is not None and not isinstance(content, Mapping):
            raise TypeError(f"Deck() takes a dict, not {type(content).__name__}; Deck.load takes a file, Deck.parse a text")
        self._set(toml.document(content or {}), name)

    @classmethod
    def load(cls, file: str | os.PathLike[str]) -> Deck:
        """The deck in a file. DeckError if there is none, or if it is no TOML."""
        name = os.fspath(file)
        return cls.parse(_engine.read_text_file(name), name=name)

    @classmethod
    def parse(cls, text: str | bytes, *, name: str = "deck.toml") -> Deck:
        """The deck in a text; ``name`` stands for its file in messages and in run folders. DeckError if it is no TOML."""
        if not isinstance(text, (str, bytes)):
            raise TypeError(f"Deck.parse takes a text, not {type(text).__name__}")
        deck = cls.__new__(cls)
        deck._set(text, name)
        return deck

    # One whose text and assignments are known to be TOML.
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
        """The file it came from, or what stands for it."""
        return self._name

    @property
    def assignments(self) -> list[str]:
        """What was set since the text was read, as ``--set`` of the program takes it."""
        return list(self._assignments)

    # --- values ---------------------------------------------------------------------------------------------------------

    def __getitem__(self, key: str) -> Any:
        """A value by its dotted key, as ``deck["wall.upper.profile.z"]`` or ``deck["load.0.force"]``.

        Elements of arrays count from 0 or go by their name. What the deck leaves out has its default. A table is a copy, as
        a dict. KeyError, with the nearest key that there is, for one that is not.
        """
        return _engine.value(self._text, self._name, self._assignments, _checked_key(key))

    def __setitem__(self, key: str, value: Any) -> None:
        """Replaces or adds a value; lists and dicts are what they are in TOML. DeckError where the key leads nowhere."""
        assignment = f"{_checked_key(key)}={toml.value(value)}"
        # What was set for this key before is of no account, unless other keys that were set lie inside of it.
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
        """Sets several values, in their order: all of them, or none where one cannot be set."""
        before = self._assignments
        try:
            for key, value in values.items():
                self[key] = value
        except BaseException:
            self._assignments = before
            raise

    def copy(self, values: Mapping[str, Any] | None = None) -> Deck:
        """Another deck of the same content, with other values: ``deck.copy({"material.steel.E": 2.0e4})``."""
        deck = self._of(self._text, self._name, self._assignments)
        deck.update(values or {})
        return deck

    def to_dict(self) -> dict[str, Any]:
        """What the deck says, without what it leaves to defaults, as a dict of which ``Deck(…)`` makes the same."""
        return _engine.document(self._text, self._name, self._assignments)

    def __str__(self) -> str:
        """The deck as TOML in which every default stands, which is what a run folder has as ``deck.toml``."""
        return _engine.written(self._text, self._name, self._assignments)

    def __repr__(self) -> str:
        sets = "".join(f", {text}" for text in self._assignments[:4]) + (", …" if len(self._assignments) > 4 else "")
        return f"<arcwall.Deck {self._name}{sets}>"

    def __eq__(self, other: object) -> bool:
        """Whether two decks, which are right, say the same."""
        if not isinstance(other, Deck):
            return NotImplemented
        return str(self) == str(other)

    __hash__ = None  # type: ignore[assignment]

    # --- runs -----------------------------------------------------------------------------------------------------------

    def check(self) -> list[Diagnostic]:
        """All that is wrong with the deck, in the order of the text; empty if it can be traced."""
        return _engine.check(self._text, self._name, self._assignments)[0]

    def warnings(self) -> list[str]:
        """What one should know of a right deck though it is no error: one sentence each."""
        return _engine.check(self._text, self._name, self._assignments)[1]

    def tracing(self, *, sensitivity: Iterable[str] | None = None, jumps: bool | None = None) -> Tracing:
        """Traces while it is iterated, a point at a time: ``for point in deck.tracing(): …``.

        One may stop at any time and go on later; ``tracing.path`` has what was traced so far. DeckError for a wrong deck.
        ``sensitivity``: numbers of the deck by which each event's λ is derived; ``jumps``: whether it is found where the
        structure falls to, when every branch has ended. Both stand in place of what the deck says (docs/answers.md).
        """
        from .path import Path, Tracing

        wanted = {"path.sensitivity": _list_of_keys(sensitivity), "path.jumps": jumps}
        deck = self.copy({key: value for key, value in wanted.items() if value is not None})
        return Tracing(Path(_engine.Run(deck._name, deck._text, deck._assignments)))

    def trace(
        self,
        *,
        max_points: int | None = None,
        max_seconds: float | None = None,
        sensitivity: Iterable[str] | None = None,
        jumps: bool | None = None,
    ) -> Path:
        """Traces all paths of the deck, as ``trace-path run`` does, to the same last bit.

        ``max_points`` and ``max_seconds`` end this call; ``path.resume()`` goes on. DeckError for a wrong deck, NoStart where
        there is no equilibrium to begin with. ``sensitivity`` and ``jumps`` are as of ``tracing()``. Ctrl-C raises
        KeyboardInterrupt at the next point; what was traced by then is kept only by ``tracing()``.
        """
        path = self.tracing(sensitivity=sensitivity, jumps=jumps).path
        path.resume(max_points=max_points, max_seconds=max_seconds)
        return path

    # --- answers --------------------------------------------------------------------------------------------------------

    def converge(self, *, levels: int = 3, factor: int = 2) -> Convergence:
        """Traces the deck on ``levels`` meshes, each ``factor`` times finer than the one before, and says how sure its events
        are, as ``trace-path converge`` does."""
        from .studies import Convergence

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
        """Follows an event while a number of the deck varies, as ``trace-path curve`` does (docs/answers.md): exactly, to both
        sides of the deck's own value and through its turning points.

        event, number   kind of the event, as ``limit-point``, and which of that kind along the path, from 1
        parameter, range  the number by its key, and (least, greatest) value, the deck's own inside
        step            increment of the number of the first predictor; by default 1/100 of the range
        max_points      on each side of the deck's own value
        output_at       values of the number each of which is a point

        What is left out is taken from the deck's table ``[curve]``, if it has one. DeckError for a wrong deck or question,
        NoAnswer where the event is not on the path or cannot be followed.
        """
        from .event_curves import EventCurve

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
        """The combination of numbers that lowers an event most: of all changes of the numbers ``keys`` with the root of the sum
        of their squares equal to ``radius`` (docs/answers.md).

        What is left out is taken from the deck's table ``[curve]``, if it has one. DeckError for a wrong deck or question,
        NoAnswer where the event is not on the path, or its λ has no slope by these numbers.
        """
        from .event_curves import worst_of

        wanted = {"worst": _list_of_keys(keys), "radius": radius}
        deck = self._asking(event, number, wanted, {"parameter", "range", "step", "max_points", "output_at"})
        return worst_of(deck, *_engine.worst(deck._name, deck._text, deck._assignments))

    # The deck with what is wanted in place of that in its table [curve], without what belongs to another question.
    def _asking(self, event: str | None, number: int | None, wanted: Mapping[str, Any], others: set[str]) -> Deck:
        given = {key: value for key, value in wanted.items() if value is not None}
        if event is None and number is None and not given:
            return self
        own = self.to_dict().get("curve", {})
        kept = {key: value for key, value in own.items() if key not in others} if isinstance(own, dict) else {}
        if given.get("parameter", kept.get("parameter")) != kept.get("parameter"):  # these are of the other number
            kept = {key: value for key, value in kept.items() if key not in ("range", "step", "output_at")}
        if event is not None:
            kept["event"] = {"kind": event}
        if number is not None:
            kept["event"] = {**kept.get("event", {}), "number": number}
        table = {**kept, **given}
        if "output_at" in given and not len(given["output_at"]):  # no values at all
            del table["output_at"]
        return self.copy({"curve": table})


def _list_of_keys(keys: Iterable[str] | None) -> list[str] | None:
    return None if keys is None else [keys] if isinstance(keys, str) else list(keys)


def _checked_key(key: str) -> str:
    if not isinstance(key, str):
        raise TypeError(f'a deck is asked by texts like "material.steel.E", not by {key!r}')
    if not key or any(c in key for c in "=\n\r[]{}"):
        raise KeyError(f"{key!r} is no key of a deck; write it as in material.steel.E or load.0.force")
    return key
