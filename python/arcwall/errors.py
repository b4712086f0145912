"""What arcwall raises. Each error says what and where; several also carry it as objects."""

from __future__ import annotations

from dataclasses import dataclass, field

__all__ = ["ArcwallError", "DeckError", "Diagnostic", "FileError", "NoAnswer", "NoStart", "NotFinite"]


@dataclass(frozen=True)
class Diagnostic:
    """One thing that is wrong with a deck, where it stands and what would be right."""

    file: str  #: as it was named; empty where no file is
    line: int  #: counts from 1; 0: unknown
    column: int  #: counts from 1; 0: unknown
    key: str  #: dotted path of the key, as ``member.column.elements``; may be empty
    message: str  #: what is wrong, with the value that was found
    cure: str  #: what would be right; may be empty
    text: str = field(repr=False)  #: all of it in one line

    def __str__(self) -> str:
        return self.text


class ArcwallError(Exception):
    """What all errors of this package have in common."""


class DeckError(ArcwallError, ValueError):
    """A deck is wrong. ``diagnostics`` has everything that was found, not only the first."""

    def __init__(self, diagnostics: list[Diagnostic]):
        super().__init__(diagnostics)
        self.diagnostics = list(diagnostics)

    def __str__(self) -> str:
        return "\n".join(str(one) for one in self.diagnostics)


class FileError(ArcwallError, OSError):
    """A file or a folder cannot be written or read, or is none of this program's."""


class NoStart(ArcwallError, RuntimeError):
    """There is no equilibrium at which a path could start."""


class NoAnswer(ArcwallError, RuntimeError):
    """What is asked about an event has no answer: it is not on the path, or cannot be followed, for the reason given."""


class NotFinite(ArcwallError, ValueError):
    """A function of a system returned nan or infinity where there must be numbers. ``arcwall_state`` is x and λ there.

    Residuals and derivatives may be no numbers at trial states: the step is shortened. This is raised where no shorter one
    succeeds.
    """
