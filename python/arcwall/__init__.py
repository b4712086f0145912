"""arcwall: equilibrium paths of beams, frames and trusses among rigid obstacles, and of equations of one's own.

    import arcwall

    path = arcwall.Deck.load("channel.toml").trace()
    path.events["limit-point"][0].lam
    path.plot(x="mid")

Importing it changes nothing of the process: no signals, locale, threads or memory. Several paths may be traced at once, each
in a thread of its own.
"""

from ._engine import version as __version__
from .curves import Curve
from .deck import Deck
from .errors import ArcwallError, DeckError, Diagnostic, FileError, NoStart
from .events import Branch, Contact, End, Event, Events, Point
from .path import ContactMark, MemberShape, Path, Shape, State, Tracing, WallShape, load
from .studies import ConvergedEvent, Convergence
from .systems import Detector, System, SystemPath, trace

__all__ = [
    "ArcwallError",
    "Branch",
    "Contact",
    "ContactMark",
    "ConvergedEvent",
    "Convergence",
    "Curve",
    "Deck",
    "DeckError",
    "Detector",
    "Diagnostic",
    "End",
    "Event",
    "Events",
    "FileError",
    "MemberShape",
    "NoStart",
    "Path",
    "Point",
    "Shape",
    "State",
    "System",
    "SystemPath",
    "Tracing",
    "WallShape",
    "__version__",
    "load",
    "trace",
]
