"""arcwall: equilibrium paths of beams, frames and trusses among rigid obstacles, and of equations of one's own.

    import arcwall

    path = arcwall.Deck.load("channel.toml").trace()
    path.events["limit-point"][0].lam
    path.plot(x="mid")

Importing it changes nothing of the process: no signals, locale, threads or memory. Several paths may be traced at once, each
in a thread of its own.
"""

from ._engine import version as __version__
from .branch_map import BranchMap, BranchMapEdge, BranchMapRange, BranchMapSegment
from .curves import Curve
from .deck import Deck
from .errors import ArcwallError, DeckError, Diagnostic, FileError, NoAnswer, NoStart, NotFinite
from .event_curves import CurveSpecial, EventCurve, WorstCombination
from .events import Branch, Contact, Continuum, End, Event, Events, Found, Jump, JumpContact, Point, Return, Search
from .path import Path, State, Tracing, load
from .shapes import ContactMark, MemberShape, Shape, WallShape
from .studies import ConvergedEvent, Convergence
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
    "load",
    "trace",
]
