"""User-defined systems: equations F(x, λ) = 0 as methods of a class."""

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
    """Protocol of the equations F(x, λ) = 0 that `trace` follows.

    Any object with these methods is a system; it need not derive from this class. The optional method
    ``energy(x, lam)`` returns the total potential energy, a float.

    Notes
    -----
    ``x`` is a read-only float64 array of shape (n,) and ``lam`` a float. Methods return real arrays, or anything that
    numpy converts to them.

    Examples
    --------
    >>> class Fold(arcwall.System):  # λ = 2x − x²
    ...     def residual(self, x, lam):
    ...         return 2.0 * x - x**2 - lam
    ...
    ...     def jacobian(self, x, lam):
    ...         return [[2.0 - 2.0 * x[0]]]
    ...
    ...     def dlam(self, x, lam):
    ...         return [-1.0]
    >>> path = arcwall.trace(Fold(), [0.0], stop={0: (-1.0, 2.0)})
    >>> round(path.events["limit-point"][0].lam, 9)
    1.0
    """

    def residual(self, x: np.ndarray, lam: float) -> Any:
        """Return F(x, λ), internal minus external forces.

        Parameters
        ----------
        x : numpy.ndarray
            Unknowns, shape (n,).
        lam : float
            Load factor λ.

        Returns
        -------
        array_like
            Shape (n,); zero at equilibrium.
        """
        ...

    def jacobian(self, x: np.ndarray, lam: float) -> Any:
        """Return the tangent stiffness ∂F/∂x.

        Parameters
        ----------
        x : numpy.ndarray
            Unknowns, shape (n,).
        lam : float
            Load factor λ.

        Returns
        -------
        array_like or scipy.sparse matrix
            Shape (n, n); symmetric, because F is the gradient of an energy.
        """
        ...

    def dlam(self, x: np.ndarray, lam: float) -> Any:
        """Return ∂F/∂λ.

        Parameters
        ----------
        x : numpy.ndarray
            Unknowns, shape (n,).
        lam : float
            Load factor λ.

        Returns
        -------
        array_like
            Shape (n,).
        """
        ...


class Detector(NamedTuple):
    """Event function with a direction; each located zero becomes a point of the path.

    Examples
    --------
    >>> class Line(arcwall.System):  # x = λ
    ...     residual = staticmethod(lambda x, lam: x - lam)
    ...     jacobian = staticmethod(lambda x, lam: [[1.0]])
    ...     dlam = staticmethod(lambda x, lam: [-1.0])
    >>> half = arcwall.Detector(lambda x, lam: x[0] - 0.5, direction=1)
    >>> path = arcwall.trace(Line(), [0.0], stop={"lambda": (-1.0, 1.0)}, events={"half": half})
    >>> [(event.monitor, round(event.lam, 9)) for event in path.events["user"]]
    [('half', 0.5)]
    """

    function: Callable[[np.ndarray, float], float]  #: smooth function of (x, λ), scaled to order 1; below 1e-7 it counts as 0
    direction: int = 0  #: 1: only where it increases along the path; -1: only where it decreases; 0: both


class SystemPath(Curve):
    """Path of a user-defined system; returned by `trace`.

    It cannot be copied or pickled, because it refers to the system. Its tables, arrays and events can.

    Examples
    --------
    >>> class Line(arcwall.System):  # x = λ
    ...     residual = staticmethod(lambda x, lam: x - lam)
    ...     jacobian = staticmethod(lambda x, lam: [[1.0]])
    ...     dlam = staticmethod(lambda x, lam: [-1.0])
    >>> path = arcwall.trace(Line(), [0.0], stop={"lambda": (-1.0, 1.0)}, monitors={"square": lambda x, lam: x[0] ** 2})
    >>> path.x.shape == (len(path), 1), round(float(path["square"][-1]), 9)
    (True, 1.0)
    """

    def __init__(self, run: Any, monitors: Mapping[str, Callable[[np.ndarray, float], float]]):
        super().__init__(run)
        self._monitors = dict(monitors)

    @property
    def monitors(self) -> Mapping[str, str]:
        """Names of the monitors, with empty units."""
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
        """Unknowns of all points, a float64 array of shape (points, n)."""
        return self._cached("x", lambda: np.array([self._run.state(i)[0] for i in range(len(self))]))

    def state(self, point: int) -> tuple[np.ndarray, float]:
        """Return the state at a point.

        Parameters
        ----------
        point : int
            Row in ``table``; a negative one counts from the end.

        Returns
        -------
        x : numpy.ndarray
            Unknowns, shape (n,).
        lam : float
            Load factor λ.

        Raises
        ------
        IndexError
            If there is no such point.
        """
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
    """Trace the paths of a system from a start near an equilibrium.

    Parameters
    ----------
    system : System
        Equations F(x, λ) = 0.
    x0 : array_like
        Unknowns at the start, shape (n,).
    lam0 : float, default 0.0
        Load factor λ at the start.
    step : float, default 0.02
        Increment of λ in the first predictor; its sign gives the direction.
    stop : mapping, optional
        Bounds that end a branch, such as ``{"lambda": (-1.0, 4.0), 3: (0.0, 0.5)}``. An integer is the index of an
        unknown.
    stop_at : iterable of str, optional
        Kinds of events that end a branch.
    output_at : mapping, optional
        Values at which to output exact points, by the keys of ``stop``.
    events : mapping, optional
        Event functions of (x, λ), or `Detector` objects, by label. Their events have the kind ``user`` and the label
        as ``monitor``.
    watch : iterable of int, optional
        Indices of unknowns whose turning points are events.
    monitors : mapping, optional
        Functions of (x, λ) by name, for columns of the table. They are evaluated on access.
    branches : {"primary", "most-stable", "all"}, default "primary"
        Branch switching: stay on the path; follow the branch with the fewest unstable directions; or trace all.
    depth : int, default 2
        Maximum depth of branches under ``"all"``.
    method : {"spherical", "load"}, default "spherical"
        Arc-length method, or load control. Load control ends at a limit point.
    weights : array_like, optional
        Weights of the squared norm of x in the path metric, shape (n,), not negative; 1/n by default.
    min_step, max_step : float, default 1e-8 and 0.2
        Minimum arc length of a step, and limit of the motion of x in a step, not of λ [path metric].
    max_points : int, default 5000
        Maximum number of points of a branch.
    max_seconds : float, optional
        Maximum time of this call [s]; unlimited by default. `Curve.resume` continues.

    Returns
    -------
    SystemPath

    Raises
    ------
    NoStart
        If no equilibrium was found at the start.
    NotFinite
        If a function returns nan or infinity and no shorter step succeeds.
    TypeError, ValueError
        If an argument, or the result of a method, has the wrong type, shape or value.

    Notes
    -----
    Exceptions of methods are passed on. They, and `NotFinite`, have the attribute ``arcwall_state``, the pair of x and
    λ. After the start, exceptions also have ``arcwall_path``, the path traced so far.

    Examples
    --------
    >>> import numpy as np
    >>> class Bratu(arcwall.System):  # u″ + λ eᵘ = 0, u(0) = u(1) = 0, by central differences
    ...     K = 50**2 * (2.0 * np.eye(49) - np.eye(49, k=1) - np.eye(49, k=-1))
    ...
    ...     def residual(self, u, lam):
    ...         return self.K @ u - lam * np.exp(u)
    ...
    ...     def jacobian(self, u, lam):
    ...         return self.K - np.diag(lam * np.exp(u))
    ...
    ...     def dlam(self, u, lam):
    ...         return -np.exp(u)
    >>> path = arcwall.trace(Bratu(), np.zeros(49), stop={24: (-1.0, 4.0)})
    >>> round(path.events["limit-point"][0].lam, 6)
    3.513099
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
