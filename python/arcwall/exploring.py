"""The page that `trace-path explore` serves, from Python."""

from __future__ import annotations

import fcntl
import html
import json
import os
import signal
import subprocess
import sys
import webbrowser
from types import TracebackType
from typing import Any

from . import _engine
from .deck import Deck
from .errors import ArcwallError, FileError

__all__ = ["Exploration", "explore"]


class Exploration:
    """Page of a deck with sliders for its numbers, served by a process of its own.

    The process ends when the page is closed in the browser, with `close`, or with the process that started it.
    `explore` returns it.

    Attributes
    ----------
    address : str
        Address of the page on this machine. It contains a random token.

    Examples
    --------
    >>> deck = arcwall.Deck.load("channel.toml")
    >>> with arcwall.explore(deck, browser=False) as page:
    ...     page.address[:17], page.is_open
    ('http://127.0.0.1:', True)
    >>> page.is_open
    False
    """

    def __init__(self, deck: Deck, max_time: float):
        environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}  # one thread, so that it may fork
        self._process = subprocess.Popen([sys.executable, "-c", "from arcwall import exploring; exploring._serve()"],
                                         stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environment)
        assert self._process.stdin is not None and self._process.stdout is not None
        text = str(deck) if deck.assignments else deck._text.decode()
        self._process.stdin.write(json.dumps({"file": deck.name, "text": text, "seconds": max_time}) + "\n")
        self._process.stdin.flush()
        answer = json.loads(self._process.stdout.readline() or '{"problem": "the page server ended"}')
        if "problem" in answer:
            self.close()
            raise FileError(answer["problem"])
        self.address: str = answer["address"]

    @property
    def is_open(self) -> bool:
        """Whether the page is served."""
        return self._process.poll() is None

    def wait(self) -> None:
        """Wait until the page is closed in the browser.

        Examples
        --------
        >>> deck = arcwall.Deck.load("channel.toml")
        >>> arcwall.explore(deck).wait()  # doctest: +SKIP
        """
        self._process.wait()

    def close(self) -> None:
        """End the process that serves the page.

        Examples
        --------
        >>> page = arcwall.explore(arcwall.Deck.load("channel.toml"), browser=False)
        >>> page.close()
        """
        if self.is_open:
            self._process.send_signal(signal.SIGTERM)
        self._process.wait()
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                pipe.close()

    def __enter__(self) -> Exploration:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<arcwall.Exploration at {self.address}{'' if self.is_open else ', closed'}>"

    def _repr_html_(self) -> str:
        address = html.escape(self.address)
        return f'<a href="{address}" target="_blank" rel="noreferrer">{address}</a>' if self.is_open else html.escape(repr(self))


def explore(deck: Deck | str | os.PathLike[str], *, browser: bool = True, max_time: float = 60.0) -> Exploration:
    """Open a page with sliders for the numbers of a deck in the browser. Curve, shapes, events and jumps follow.

    The deck object does not change: the page saves the deck that its reader makes of it.

    Parameters
    ----------
    deck : Deck, str or os.PathLike
        Deck, or the file with it. It may have errors, which the page shows.
    browser : bool, default True
        Open the page in the browser; otherwise `Exploration.address` has its address.
    max_time : float, default 60
        Time after which a trace is stopped [s].

    Returns
    -------
    Exploration

    Raises
    ------
    DeckError
        If the file cannot be read or is not TOML.
    FileError
        If no port is free.

    Examples
    --------
    >>> page = arcwall.explore("channel.toml", browser=False)
    >>> page.is_open
    True
    >>> page.close()
    """
    page = Exploration(deck if isinstance(deck, Deck) else Deck.load(deck), max_time)
    if browser:
        webbrowser.open(page.address)
    return page


# What the process of a page does. It ends with the other end of its standard input, whose process may have been killed.
def _serve() -> None:
    def say(answer: dict[str, Any]) -> None:
        print(json.dumps(answer), flush=True)

    request = json.loads(sys.stdin.readline())
    fcntl.fcntl(0, fcntl.F_SETOWN, os.getpid())
    fcntl.fcntl(0, 10, signal.SIGTERM)  # F_SETSIG, which the module does not name: this signal for SIGIO
    fcntl.fcntl(0, fcntl.F_SETFL, fcntl.fcntl(0, fcntl.F_GETFL) | fcntl.FASYNC)
    try:
        _engine.explore(request["text"], request["file"], request["seconds"], lambda address: say({"address": address}))
    except ArcwallError as error:
        say({"problem": str(error)})
