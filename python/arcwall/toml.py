"""Conversion of Python values to TOML, the format of decks."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from numbers import Integral, Real
from typing import Any

__all__ = ["document", "value"]

_BARE = re.compile(r"[A-Za-z0-9_-]+\Z")
_ESCAPES = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\t": "\\t", "\r": "\\r"}


def value(of: Any) -> str:
    """Write a value in one line. Numbers are read back identically. Raises TypeError for types that TOML lacks."""
    if isinstance(of, (str, bytes)):
        return _text(of)
    if isinstance(of, Mapping):
        return "{ " + ", ".join(f"{_key(key)} = {value(item)}" for key, item in of.items()) + " }" if of else "{}"
    if hasattr(of, "tolist"):  # numpy's arrays and numbers
        return value(of.tolist())
    if isinstance(of, bool):
        return "true" if of else "false"
    if isinstance(of, Integral):
        return str(int(of))
    if isinstance(of, Real):
        return _number(float(of))
    if isinstance(of, (list, tuple)):
        return "[" + ", ".join(value(item) for item in of) + "]"
    raise TypeError(f"a deck has no {type(of).__name__}: {of!r}")


def document(of: Mapping[str, Any]) -> str:
    """Write a dict of dicts as a document with a header for each table."""
    lines: list[str] = []
    _add_table(of, "", lines)
    return "\n".join(lines) + "\n"


def _number(number: float) -> str:
    if math.isfinite(number):
        return repr(number)
    return "nan" if math.isnan(number) else "inf" if number > 0 else "-inf"


def _text(text: str | bytes) -> str:
    if isinstance(text, bytes):
        raise TypeError(f"a deck has no bytes: {text!r}")
    return '"' + "".join(_ESCAPES.get(c) or (f"\\u{ord(c):04x}" if ord(c) < 32 or ord(c) == 127 else c) for c in text) + '"'


def _key(key: Any) -> str:
    if not isinstance(key, str):
        raise TypeError(f"a key of a deck is a text, not {key!r}")
    return key if _BARE.match(key) else _text(key)


def _is_list_of_tables(of: Any) -> bool:
    return isinstance(of, (list, tuple)) and len(of) > 0 and all(isinstance(item, Mapping) for item in of)


def _add_table(table: Mapping[str, Any], path: str, lines: list[str]) -> None:
    inner = {key: item for key, item in table.items() if isinstance(item, Mapping) or _is_list_of_tables(item)}
    lines += [f"{_key(key)} = {value(item)}" for key, item in table.items() if key not in inner]
    for key, item in inner.items():
        here = (path + "." if path else "") + _key(key)
        if isinstance(item, Mapping):
            lines += ["", f"[{here}]"]
            _add_table(item, here, lines)
        else:
            for one in item:
                lines += ["", f"[[{here}]]"]
                _add_table(one, here, lines)
