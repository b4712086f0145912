"""Systems of one's own: equations F(x, λ) = 0 as methods of a class."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple, Protocol

import numpy as np

from . import _engine
from .curves import Curve, row_of
from .events import KINDS, Event, event_of

__all__ = ["Detector", "System", "SystemPath", "trace"]


class System(Protocol):
    """What ``arcwall.trace`` follows: any object with these methods. One may derive from this class, and need not.

    ``x`` is a float64 array of shape (n,) that cannot be written into, ``lam`` a float. A method may return anything that numpy
    makes an array of real numbers. ``energy(x, lam)``, a number, is optional.
    """

    def residual(self, x: np.ndarray, lam: float) -> Any:
        """F(x, λ), shape (n,): internal minus external forces. F = 0 is equilibrium."""
        ...

    def jacobian(self, x: np.ndarray, lam: float) -> Any:
        """∂F/∂x, shape (n, n), dense or a matrix of scipy.sparse; symmetric, as F is the gradient of an energy."""
        ...

    def dlam(self, x: np.ndarray, lam: float) -> Any:
        """∂F/∂λ, shape (n,)."""
        ...


class Detector(NamedTuple):
    """An event function: each place where ``function(x, lam)`` passes zero is located and becomes a point of the path."""

    function: Callable[[np.ndarray, float], float]  #: of order 1 and smooth; values below 1e-7 have no sign
    direction: int = 0  #: 1: only where it rises along the path, −1: only where it falls


class SystemPath(Curve):
    """What was traced of a system of one's own. It owns all that it needs.

    It cannot be pickled, as the equations are a program's; its tables, arrays and events can.
    """

    def __init__(self, run: Any, monitors: Mapping[str, Callable[[np.ndarray, float], float]]):
        super().__init__(run)
        self._monitors = dict(monitors)

    @property
    def monitors(self) -> Mapping[str, str]:
        return {name: "" for name in self._monitors}

    def _monitor_column(self, name: str) -> np.ndarray | None:
        if name not in self._monitors:
            return None
        return np.array([self._monitor(name, *self.state(i)) for i in range(len(self))], dtype=float)

    def _monitor(self, name: str, x: np.ndarray, lam: float) -> float:
        try:
            value = np.asarray(self._monitors[name](x, lam))
            if value.size != 1 or value.dtype.kind not in "fiub":
                raise TypeError(f"monitor {name!r} returned {value.dtype} of shape {value.shape}; one real number is wanted")
        except Exception as error:
            error.arcwall_state = x, lam  # type: ignore[attr-defined]
            raise
        return float(value.item())

    def _event(self, json: Mapping[str, Any], point: int) -> Event:
        values = {name: self._monitor(name, *self.state(point)) for name in self._monitors}
        return event_of({**json, "monitors": values}, point, self._run.modes().get(json["id"]))

    @property
    def x(self) -> np.ndarray:
        """The unknowns, shape (points, n)."""
        return self._cached("x", lambda: np.array([self._run.state(i)[0] for i in range(len(self))]))

    def state(self, point: int) -> tuple[np.ndarray, float]:
        """x, shape (n,), and λ at a point."""
        return self._run.state(row_of(point, len(self)))[:2]

    def __reduce__(self) -> Any:
        raise TypeError("a path of a system of one's own cannot be pickled or copied; pickle path.table, path.x or path.events")


def trace(
    system: Any,
    x0: Any,
    lam0: float = 0.0,
    *,
    step: float = 0.02,
    stop: Mapping[Any, tuple[float, float]] | None = None,
    stop_at: Iterable[str] = (),
    output_at: Mapping[Any, Iterable[float]] | None = None,
    events: Mapping[str, Callable[[np.ndarray, float], float] | Detector] | None = None,
    watch: Iterable[int] = (),
    monitors: Mapping[str, Callable[[np.ndarray, float], float]] | None = None,
    branches: str = "primary",
    depth: int = 2,
    method: str = "spherical",
    weights: Any = None,
    min_step: float = 1e-8,
    max_step: float = 0.2,
    max_points: int = 5000,
    max_seconds: float | None = None,
) -> SystemPath:
    """Follows the paths of a system (see System) from a state x0, λ0, which solves its equations or nearly so.

    step            increment of λ of the first predictor; its sign is the direction
    stop            bounds that end a branch: ``{"lambda": (-1, 4), 3: (0, 0.5)}``, a whole number being an unknown
    stop_at         kinds of events of which the first ends a branch
    output_at       values at each of which there is a point, by the same keys
    events          event functions by their labels: each is a function of (x, λ), or a Detector; their events are of kind
                    ``user`` and have the label as ``monitor``
    watch           unknowns whose turning points are events
    monitors        columns of the table: functions of (x, λ), called when they are asked for
    branches        at branch points: ``primary`` stays, ``most-stable`` takes the branch with fewest unstable directions where the
                    one ahead is unstable, ``all`` traces every branch, to ``depth``
    method          ``spherical``, or ``load``: λ goes up by itself, and the path ends where it turns
    weights         of the squared norm of x in the path metric, shape (n,), not negative; by default 1/n
    min_step, max_step   arc lengths [path metric]
    max_points      of a branch
    max_seconds     of this call; ``path.resume()`` goes on

    What a method raises comes out as it is. TypeError and ValueError say what a method returned and what is wanted, NotFinite
    which number is none: of equations where no shorter step avoids that, at the start NoStart. All of them have the attribute
    ``arcwall_state``, a pair of x and λ, and but for those of the start ``arcwall_path``, what was traced until then.
    """
    if isinstance(system, type):
        raise TypeError(f"a system is an object with methods; give {system.__name__}(…), not the class")
    x = np.array(x0, dtype=float, ndmin=1)
    if x.ndim != 1 or x.size == 0 or not np.isfinite(x).all():
        raise ValueError(f"x0 has shape {x.shape}; one array of finite numbers is wanted")
    start = _number("lam0", lam0)
    wishes = _engine.Wishes()
    wishes.step, wishes.least_step, wishes.greatest_step = _steps(step, min_step, max_step)
    wishes.max_points, wishes.depth = _at_least(1, "max_points", max_points), _at_least(0, "depth", depth)
    wishes.branches = _one_of("branches", branches, ("primary", "most-stable", "all"))
    wishes.method = _one_of("method", method, ("spherical", "load"))
    wishes.targets = [*_targets("stop", stop, x.size), *_targets("output_at", output_at, x.size)]
    wishes.stop_events = [_one_of("stop_at", kind, KINDS) for kind in ([stop_at] if isinstance(stop_at, str) else stop_at)]
    wishes.detectors = [_detector(label, of) for label, of in _mapping("events", events).items()]
    wishes.watch = [_unknown(index, x.size) for index in ([watch] if isinstance(watch, int) else watch)]
    metric = np.full(x.size, 1.0 / x.size) if weights is None else np.asarray(weights, dtype=float)
    if metric.shape != x.shape or not (metric >= 0.0).all() or not metric.any():
        raise ValueError(f"weights have shape {metric.shape}; {x.shape} is wanted, not negative and not all zero")
    run = _engine.SystemRun(system, x, start, metric, wishes)
    for name, function in _mapping("monitors", monitors).items():
        if name in run.column_names() or not isinstance(name, str):
            raise ValueError(f"{name!r} is the name of another column, or none; choose another for this monitor")
        if not callable(function):
            raise TypeError(f"monitor {name!r} is no function of (x, lam)")
    path = SystemPath(run, monitors or {})
    try:
        return path.resume(max_seconds=max_seconds)
    except BaseException as error:
        if len(path):
            error.arcwall_path = path  # type: ignore[attr-defined]
        raise


def _one_of(name: str, word: str, words: tuple[str, ...]) -> str:
    if word not in words:
        raise ValueError(f"{name} = {word!r} is none of {', '.join(words)}")
    return word


def _number(name: str, value: Any) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = math.nan
    if not math.isfinite(number):
        raise ValueError(f"{name} = {value!r} is no finite number")
    return number


def _mapping(name: str, given: Mapping[Any, Any] | None) -> Mapping[Any, Any]:
    if given is not None and not isinstance(given, Mapping):
        raise TypeError(f"{name} is a dict, not {type(given).__name__}")
    return given or {}


def _steps(step: float, least: float, greatest: float) -> tuple[float, float, float]:
    step, least, greatest = _number("step", step), _number("min_step", least), _number("max_step", greatest)
    if not (step != 0.0 and 0.0 < least < greatest):
        raise ValueError(
            f"step = {step!r} must be another number than zero, and 0 < min_step = {least!r} < max_step = {greatest!r} hold"
        )
    return step, least, greatest


def _at_least(least: int, name: str, count: Any) -> int:
    if isinstance(count, bool) or not hasattr(count, "__index__") or not least <= count.__index__() <= 2**31 - 1:
        raise ValueError(f"{name} = {count!r} is no whole number from {least} on")
    return int(count.__index__())


def _unknown(index: Any, size: int) -> int:
    if isinstance(index, bool) or not hasattr(index, "__index__") or not -size <= index.__index__() < size:
        raise ValueError(f"{index!r} names no unknown; there are 0 to {size - 1}, and \"lambda\" names λ")
    return index.__index__() % size


# Bounds of `stop`, or values of `output_at`.
def _targets(option: str, wanted: Mapping[Any, Any] | None, size: int) -> list[tuple[int | None, float, bool, str]]:
    stops = option == "stop"
    targets = []
    for key, values in _mapping(option, wanted).items():
        unknown = None if key == "lambda" else _unknown(key, size)
        name = "lambda" if unknown is None else f"x[{unknown}]"
        try:
            numbers = [float(value) for value in values]
        except (TypeError, ValueError):
            raise ValueError(f"{option} of {name} is {values!r}; a list of numbers is wanted") from None
        if stops and (len(numbers) != 2 or not numbers[0] < numbers[1]):
            raise ValueError(f"stop of {name} is {values!r}; a pair of a lower and an upper bound is wanted")
        targets += [(unknown, number, stops, f"{name} = {number!r}") for number in numbers if math.isfinite(number)]
    return targets


def _detector(label: str, of: Any) -> tuple[str, Any, int]:
    detector = of if isinstance(of, Detector) else Detector(of)
    if not callable(detector.function) or detector.direction not in (-1, 0, 1):
        raise TypeError(f"event function {label!r} is no function of (x, lam), or its direction none of −1, 0 and 1")
    return label, detector.function, detector.direction
