"""Equilibrium paths of beams, frames and trusses in contact with rigid obstacles.

A `Deck` describes a structure, its loads and its walls. `Deck.trace` returns its equilibrium `Path` with
points, events and shapes. `trace` follows the equations F(x, λ) = 0 of any other `System`.

Notes
-----
Quantities have the units of the deck, written as [length], [force] or [force·length]. λ is the load factor.
Plane points have the axes x and z.

Importing the package does not change signals, locale, threads or memory of the process. Several paths may be
traced at once, each in its own thread.

The examples of all docstrings assume ``import arcwall`` and a folder with the decks ``channel.toml`` and
``truss.toml``. The command ``trace-path examples NAME --out NAME.toml`` writes such a deck.

Examples
--------
>>> path = arcwall.Deck.load("channel.toml").trace()
>>> limit = path.events["limit-point"][0]
>>> round(limit.lam, 6), limit.extremum
(6.724447, 'maximum')
"""

from ._engine import version as __version__
from .branch_map import BranchMap, BranchMapEdge, BranchMapRange, BranchMapSegment
from .curves import Curve
from .deck import Deck, load
from .errors import ArcwallError, DeckError, Diagnostic, FileError, NoAnswer, NoStart, NotFinite
from .event_curves import CurveSpecial, EventCurve, WorstCombination
from .events import Branch, Contact, Continuum, End, Event, Events, Found, Jump, JumpContact, Point, Return, Search
from .exploring import Exploration, explore
from .path import Path, State, Tracing
from .shapes import ContactMark, MemberShape, Shape, WallShape
from .studies import ConvergedEvent, ConvergedMonitor, Convergence
from .systems import Detector, System, SystemPath, trace

__all__ = [
    "ArcwallError",
    "Branch",
    "BranchMap",
    "BranchMapEdge",
    "BranchMapRange",
    "BranchMapSegment",
    "Contact",
    "ContactMark",
    "Continuum",
    "ConvergedEvent",
    "ConvergedMonitor",
    "Convergence",
    "Curve",
    "CurveSpecial",
    "Deck",
    "DeckError",
    "Detector",
    "Diagnostic",
    "End",
    "Event",
    "EventCurve",
    "Events",
    "Exploration",
    "FileError",
    "Found",
    "Jump",
    "JumpContact",
    "MemberShape",
    "NoAnswer",
    "NoStart",
    "NotFinite",
    "Path",
    "Point",
    "Return",
    "Search",
    "Shape",
    "State",
    "System",
    "SystemPath",
    "Tracing",
    "WallShape",
    "WorstCombination",
    "__version__",
    "explore",
    "load",
    "trace",
]
