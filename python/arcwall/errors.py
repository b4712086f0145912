"""Errors of the package. Messages name place, value and cure; `DeckError` also has them as objects."""

from __future__ import annotations

from dataclasses import dataclass, field

__all__ = ["ArcwallError", "DeckError", "Diagnostic", "FileError", "NoAnswer", "NoStart", "NotFinite"]


@dataclass(frozen=True)
class Diagnostic:
    """One error of a deck, with its position and its cure.

    Examples
    --------
    >>> deck = arcwall.Deck.load("truss.toml").copy({"material.bar.E": -1.0})
    >>> error = deck.check()[0]
    >>> error.key, error.message
    ('material.bar.E', '-1 is out of range')
    """

    file: str  #: name of the file as given; empty if there is none
    line: int  #: line from 1; 0 if unknown
    column: int  #: column from 1; 0 if unknown
    key: str  #: dotted key, such as ``member.column.elements``; may be empty
    message: str  #: error, with the value found
    cure: str  #: what to write instead; may be empty
    text: str = field(repr=False)  #: all of these in one line

    def __str__(self) -> str:
        return self.text


class ArcwallError(Exception):
    """Base class of all errors of the package.

    Examples
    --------
    >>> try:
    ...     arcwall.load("no-such-folder")
    ... except arcwall.ArcwallError as error:
    ...     print(type(error).__name__)
    FileError
    """


class DeckError(ArcwallError, ValueError):
    """A deck has errors; also a ValueError.

    Parameters
    ----------
    diagnostics : list of Diagnostic
        All errors of the deck, in the order of its text; the attribute of the same name.

    Examples
    --------
    >>> deck = arcwall.Deck.load("truss.toml").copy({"path.step": 0.0, "material.bar.E": -1.0})
    >>> try:
    ...     deck.trace()
    ... except arcwall.DeckError as error:
    ...     print(sorted(one.key for one in error.diagnostics))
    ['material.bar.E', 'path.step']
    """

    def __init__(self, diagnostics: list[Diagnostic]):
        super().__init__(diagnostics)
        self.diagnostics = list(diagnostics)  #: all errors of the deck

    def __str__(self) -> str:
        return "\n".join(str(one) for one in self.diagnostics)


class FileError(ArcwallError, OSError):
    """A file or run folder cannot be read or written, or belongs to another program; also an OSError.

    Examples
    --------
    >>> try:
    ...     arcwall.load("no-such-folder")
    ... except arcwall.FileError as error:
    ...     print("no-such-folder" in str(error))
    True
    """


class NoStart(ArcwallError, RuntimeError):
    """No equilibrium was found at the start of a path; also a RuntimeError.

    Examples
    --------
    >>> class Parabola(arcwall.System):  # x² + 1 = 0 has no real solution
    ...     residual = staticmethod(lambda x, lam: x**2 + 1.0)
    ...     jacobian = staticmethod(lambda x, lam: [[2.0 * x[0]]])
    ...     dlam = staticmethod(lambda x, lam: [0.0])
    >>> try:
    ...     arcwall.trace(Parabola(), [1.0])
    ... except arcwall.NoStart as error:
    ...     print("no equilibrium at the start" in str(error))
    True
    """


class NoAnswer(ArcwallError, RuntimeError):
    """An analysis of an event is not possible; also a RuntimeError.

    The event is not on the path, or it cannot be followed. The message gives the reason.

    Examples
    --------
    >>> deck = arcwall.Deck.load("truss.toml")
    >>> try:
    ...     deck.worst("branch-point", ["material.bar.E"], 1.0)
    ... except arcwall.NoAnswer as error:
    ...     print("none of kind branch-point" in str(error))
    True
    """


class NotFinite(ArcwallError, ValueError):
    """A function of a system returned nan or infinity; also a ValueError.

    Residuals and derivatives may be undefined at trial states: the tracer then shortens the step. It raises this
    error if no shorter step succeeds. The attribute ``arcwall_state`` is the pair of x and λ.

    Examples
    --------
    >>> import numpy as np
    >>> class Root(arcwall.System):  # x = √(1 − λ) ends at λ = 1
    ...     residual = staticmethod(lambda x, lam: x - np.sqrt(1.0 - lam))
    ...     jacobian = staticmethod(lambda x, lam: [[1.0]])
    ...     dlam = staticmethod(lambda x, lam: [0.5 / np.sqrt(1.0 - lam)])
    >>> with np.errstate(all="ignore"):
    ...     try:
    ...         arcwall.trace(Root(), [1.0], stop={"lambda": (-1.0, 2.0)})
    ...     except arcwall.NotFinite as error:
    ...         print(f"{error.arcwall_path['lambda'].max():.5f}")
    1.00000
    """
