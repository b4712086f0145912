"""Base class of the value types of the package."""

from __future__ import annotations

from dataclasses import MISSING, fields
from typing import Any


class Value:
    """Dataclass whose repr omits fields with default values."""

    def __repr__(self) -> str:
        shown = [one.name for one in fields(self) if one.repr and not self._is_default(one)]  # type: ignore[arg-type]
        return f"{type(self).__name__}({', '.join(f'{name}={getattr(self, name)!r}' for name in shown)})"

    def _is_default(self, field: Any) -> bool:
        value = getattr(self, field.name)
        if field.default_factory is not MISSING:
            return bool(value == field.default_factory())
        return value is field.default or (type(value) is type(field.default) and bool(value == field.default))
