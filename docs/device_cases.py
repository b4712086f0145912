"""The examples of devices, each with a number that can be had by hand. `tests/apps/devices_test.cpp` holds them."""

import math

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
