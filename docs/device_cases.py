"""The examples of devices, each with a number that can be had by hand. `tests/apps/devices_test.cpp` holds them."""

import math
from typing import Callable

from make_validation import Case, Quantity, Run, landed, load, monitor


def at_end_of_stage(name: str, stage: str):
    return lambda run: float([point for point in run.points if point["stage"] == stage][-1][name])


def cosine_beam(Q: float) -> float:
    """The greatest force of a cosine beam without its second mode over EI h/ℓ³ (Qiu, Lang and Slocum 2004), Q = h/t."""
    ways = [d / 1000 for d in range(1000)]
    return max(1.5 * math.pi**4 * Q**2 * d * ((d - 1.5) ** 2 - 0.25 + 4 / (3 * Q**2)) for d in ways)


def greatest_thrust(EI: float, A: float, k: float, q: float) -> float:
    """The greatest P for which EI w⁗ + P w″ = EI A k⁴ cos kx − q has a span with w′ = w″ = 0 at its ends."""

    def left_over(P: float, c: float) -> float:
        mu, C = math.sqrt(P / EI), EI * A * k**4 / (P - EI * k**2)
        return (q / P - C * math.cos(k * c)) * math.sin(mu * c) / mu + (C * math.sin(k * c) / k - q * c / P) * math.cos(mu * c)

    low, high = 1.5 * EI * k**2, 8 * EI * k**2
    while high - low > 1e-3:
        P = (low + high) / 2
        has_span = any(left_over(P, c / 100) * left_over(P, (c + 1) / 100) < 0 for c in range(800, 1500))
        low, high = (P, high) if has_span else (low, P)
    return low


def device(name: str, title: str, quantity: Quantity) -> Case:
    return Case(title, f"examples/{name}.toml", {}, [quantity])


def yields(r: float, angle: float, EI: float) -> tuple:
    """The tip's compliance across, and across by along, of a circular arc to ± angle, clamped opposite: small slopes."""
    n, span = 20000, math.pi - angle
    places = [angle + span * (i + 0.5) / n for i in range(n)]
    across = [r * (math.cos(angle) - math.cos(a)) for a in places]
    along = [r * (math.sin(a) - math.sin(angle)) for a in places]
    scale = r * span / n / EI
    return scale * sum(z * z for z in across), scale * sum(z * x for z, x in zip(across, along))


def clip_force(r: float, mouth: float, pipe: float, EI: float, mu: float, sense: int) -> float:
    """The maximum force on half of a pipe that goes into a clip (sense 1) or out of it (−1), small slopes."""
    across, both = yields(r, mouth, EI)
    low = math.asin(r * math.sin(mouth) / pipe)
    forces = []
    for i in range(1, 2000):
        angle = low + (math.pi - 2 * low) * i / 2000
        x = math.cos(angle) - sense * mu * math.sin(angle)  # of the force on the tip over the contact force
        z = math.sin(angle) + sense * mu * math.cos(angle)
        forces.append(-sense * (pipe * math.sin(angle) - r * math.sin(mouth)) * x / (across * z + both * x))
    return max(forces)


def lifted(EI: float, EA: float, weight: float, mu: float, strain: float) -> float:
    """Height of Hobbs's span without a force under its middle (1984), the lower one."""
    def excess(L: float) -> float:
        feed = math.sqrt(max(0.0, 1.597e-5 * EA * mu * weight * L**5 - 0.25 * (mu * EI) ** 2))
        return 80.76 * EI / L**2 + weight * L / EI * feed - EA * strain

    low, high = 15.0, 30.0
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if excess(middle) > 0 else (low, middle)
    return 2.408e-3 * weight * low**4 / EI


def lift_at_greatest_push(run: Run) -> float:
    return run.event("turning-point", 0)["monitors"]["lift"]


def devices() -> list:
    bow = (100**2 + 4.5**2) / (2 * 4.5)
    collar = 2.1e8 * math.pi / 4 * (0.08**4 - 0.035**4)
    wire = 6e4 * math.pi / 4 * 0.18**4
    nylon = 1600 * 10 * 1.364**3 / 12
    free = 175000 / (4 * 800)
    leaf = (100 - free) ** 2 / 1600 + (100 - free) / 800 * free + 4 * free**3 / (3 * 175000)
    silicon = 1.6e5 * 100 * 5**3 / 12
    rail = 3 * math.pi / 12
    rubber = 5 * 20 * 2**3 / 12
    pipe = 2.1e8 * math.pi / 4 * (0.162**4 - (0.162 - 0.0127) ** 4)
    arm = 2400 * 5 * 1.5**3 / 12
    return [
        device("snap-fit", "Snap-fit", Quantity(
            "greatest push by the way of the nose there", lambda run: monitor("push", "turning-point")(run) / lift_at_greatest_push(run),
            0.5 * 3 * arm / 20**3 / (1 - 1.5 * 3 * 0.5 / 20), "t (3 EI/ℓ³)/(1 − 3 a t/(2 ℓ)) for a rigid nose and small slopes")),
        device("guidewire", "Guidewire in a bend", Quantity(
            "push far in the bend", landed("push", 60), wire / (2 * 58**2), "EI/(2 R²)")),
        device("drill-string", "Drill string in a bore", Quantity(
            "weight on the bit at which it buckles", load("branch-point"), 1.938332 * (collar * 1.2**2) ** (1 / 3),
            "eigenvalue of the string of 7.968 (EI/p)^⅓ by Runge-Kutta's method; Lubinski 1950: 1.94 (EI p²)^⅓")),
        device("mems-switch", "Bistable switch", Quantity(
            "greatest force", load("limit-point"), 740 * silicon * 40 / 1000**3, "740 EI h/ℓ³, Qiu, Lang and Slocum 2004")),
        device("harvester", "Precompressed harvester", Quantity(
            "deflection at rest", at_end_of_stage("middle", "shorten"), 2 * math.sqrt(0.5 * 100) / math.pi,
            "2 √(δ L)/π for small slopes")),
        device("leaf-spring", "Leaf spring on a former", Quantity(
            "deflection at λ = 4", landed("tip", 4), leaf, "an arc of the former and a cantilever on its end, small slopes")),
        device("rail", "Heated rail", Quantity(
            "force at which it buckles", monitor("force", "branch-point"), 2100 * rail**2 + 500 / rail**2, "EI q² + k/q² of three half waves")),
        device("pipeline", "Pipeline on the seabed", Quantity(
            "thrust at which it lifts off", load("limit-point"), greatest_thrust(pipe, 0.3, math.pi / 30, 1.0),
            "the greatest P for which EI w⁗ + P w″ = EI w₀⁗ − q has a free span without slope and moment at its ends")),
        device("portal", "Portal with a stop", Quantity(
            "load at which it sways", load("branch-point"), 1.34955**2 * 2100 / 16, "k h tan k h = 6")),
        device("ring", "Ring between plates", Quantity(
            "force at the way R/100", landed("force", 0.3), 0.3 * rubber / 30**3 / (math.pi / 4 - 2 / math.pi),
            "(EI/R³)/(π/4 − 2/π) of small ways")),
        device("bow", "Bow pressed onto a floor", Quantity(
            "force at which contact spreads", monitor("press", "contact-spreads"), 2e5 * 20 / 12 / (bow * 100), "EI/(R a) of small slopes")),
        device("lattice", "Lattice of curved bars", Quantity(
            "force at which the first row gives way", monitor("force", "turning-point"), 2 * cosine_beam(3 / 1.364) * nylon * 3 / 40**3,
            "two cosine beams by Qiu, Lang and Slocum 2004, small slopes")),
    ]


def snap_fit_by_hand(mu: float, slope: float) -> float:
    """P (μ + t)/(1 − μ t) at the end of a flank of slope t, where the rounding of 0.3 begins below the top at 1.2."""
    y = 1.2 - 0.3 * (1 - math.cos(math.atan(slope)))
    return 3 * 2400 * 5 * 1.5**3 / 12 * y / 20**3 * (mu + slope) / (1 - mu * slope)


def pushed(stage: str) -> Callable[[Run], float]:
    """The maximum push of the load step "insert", the maximum pull of "remove"."""
    def of(run: Run) -> float:
        pushes = [float(point["push"]) for point in run.points if point["stage"] == stage]
        return max(pushes) if stage == "insert" else -min(pushes)
    return of


def at_last(name: str) -> Callable[[Run], float]:
    return lambda run: float(run.points[-1][name])


def with_friction() -> list:
    """Each number by hand, and by shooting of the extensible elastica with contact at the same nodes."""
    def both(what: str, of: Callable[[Run], float], by_hand: float, by_shooting: float) -> list:
        return [Quantity(f"{what} by hand", of, by_hand, "formula of the deck's first lines, small slopes"),
                Quantity(what, of, by_shooting, "shooting, contact at the same nodes")]

    clip = 2400 * 10 * 2**3 / 12
    R, angle, mu = 60.0, math.pi / 3, 0.2
    crossing = 6e4 * math.pi / 4 * 0.18**4 / (R * math.sqrt(48 * 1.0 * R))
    relief = math.exp(-mu * angle)
    return [
        Case("Snap-fit with friction", "examples/snap-fit-friction.toml", {}, [
            *both("insertion", pushed("insert"), snap_fit_by_hand(0.3, 0.5), 1.589465818552),
            *both("removal", pushed("remove"), snap_fit_by_hand(0.3, 1.0), 1.972334610946)]),
        Case("Pipe clip with friction", "examples/clip.toml", {}, [
            *both("insertion", pushed("insert"), clip_force(11.0, 0.9, 10.8, clip, 0.3, 1), 4.377915125774),
            *both("removal", pushed("remove"), clip_force(11.0, 0.9, 10.8, clip, 0.3, -1), 6.144239492927)]),
        Case("Guidewire through an S with friction", "examples/guidewire-friction.toml", {}, both(
            "push", landed("push", 165), 2 * mu * crossing * (1 + math.sqrt(8) * relief + relief**2), 0.024571967464)),
        Case("Drill pipe that locks up", "examples/drill-pipe.toml", {}, both(
            "force on the bit", at_last("bit"), 1000 * math.exp(-2.5 * 0.4 * 32 * 2000 / 200**2), 190.866441)),
        Case("Rail lifted in the heat", "examples/rail-lift.toml", {}, both(
            "height", load("value-crossing"), 100 * lifted(12600, 3.234e6, 4, 0.6, 1.15e-5 * 60), 18.7978641)),
    ]
