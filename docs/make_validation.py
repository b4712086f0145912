#!/usr/bin/env python3
"""Traces the validation cases and prints docs/validation.md.

    python3 docs/make_validation.py build/release/apps/trace-path > docs/validation.md

Each case is a deck of examples/ or docs/validation/ that is run at several meshes by --set. What is compared is one event,
or one point that the path lands on, with a reference that does not come from this program.
"""

import csv
import json
import math
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

SOURCE = Path(__file__).resolve().parent.parent
SHOOTING = "shooting with Taylor series of order 24, 80 bit"
CHECKED = SHOOTING + "; collocation agrees to 3e-11 in the limit loads"
FIRST_INTEGRAL = "extensible elastica between its contacts, by its first integral"
BETWEEN_CONTACTS = "extensible elastica between its contacts, by shooting and by quadrature of its first integral"
IMPERFECT = "extensible elastica with the imperfection as its stress-free shape, by shooting"
PAST_A_FORCE = "extensible elastica between support, contact, force and support, by shooting"
PRESSED = "extensible elastica under pressure, by multiple shooting"
UNSTRETCHED = "closed form where the axis does not stretch"
ELEMENTS = "an independent finite element program, quadratic elements, converged with up to 640 on half of the beam"
ENDED_EARLY = 3  # what was traced is written; such runs are marked on the page
RUN_IS_USABLE = (0, ENDED_EARLY)


@dataclass
class Run:
    events: list  # of events.json
    points: list  # rows of path.csv
    early: bool  # the branch ended early, after what is compared

    def event(self, kind: str, number: int) -> dict:
        """The event of that kind, counted from 0."""
        return [event for event in self.events if event["kind"] == kind][number]

    def at(self, value: float) -> dict:
        """The point of path.csv that landed on this λ."""
        return min(self.points, key=lambda point: abs(float(point["lambda"]) - value))


@dataclass
class Quantity:
    what: str
    of: Callable[[Run], float]
    reference: float
    origin: str


@dataclass
class Case:
    title: str
    deck: str
    meshes: dict  # label → values for --set
    quantities: list
    always: tuple = ()  # values for --set at every mesh
    note: str = ""


def load(kind: str, number: int = 0) -> Callable[[Run], float]:
    return lambda run: run.event(kind, number)["lambda"]


def monitor(name: str, kind: str, number: int = 0) -> Callable[[Run], float]:
    return lambda run: run.event(kind, number)["monitors"][name]


def landed(name: str, value: float) -> Callable[[Run], float]:
    return lambda run: float(run.at(value)[name])


def greatest_turn(run: Run) -> float:
    """The greatest λ at which the path turns, smooth or at a change of contact."""
    return max(e["lambda"] for e in run.events if e["kind"] in ("limit-point", "contact-limit-point"))


def middle(kind: str, wall: str) -> Callable[[Run], float]:
    """λ of the first event of that kind at the middle of a member."""
    def first(run: Run) -> float:
        return next(e["lambda"] for e in run.events if e["kind"] == kind
                    for c in e["contact"] if c["wall"] == wall and abs(c["fraction"] - 0.5) < 1e-9)
    return first


def essenburg_foundation(order: int) -> Case:
    return Case(f"Thick beam on a foundation, Essenburg's theory, order {order}", "examples/thick.toml",
                meshes({"beam": 1}, [40, 80, 160, 320]), [
        Quantity("lower face at M₀ = 0.4", landed("bottom", 0.4), -0.07108695291778, ELEMENTS),
        Quantity("moment of first contact", load("contact-closes"), 0.45037723841, ELEMENTS),
        Quantity("support's force at M₀ = 2.5", landed("support", 2.5), -3.3619634, ELEMENTS),
        Quantity("moment at which the middle lifts off", middle("contact-opens", "foundation"), 3.8275, ELEMENTS),
        Quantity("lower face at M₀ = 5", landed("bottom", 5.0), -0.07998188154683, ELEMENTS),
    ], always=(f"member.beam.order={order}", "path.land.lambda=[0.4, 2.5]"),
       note="The edge of the contact moves from node to node, which makes what depends on it irregular.")


def essenburg_channel() -> Case:
    return Case("Column in a channel, Essenburg's theory", "docs/validation/channel_essenburg.toml",
                meshes({"column": 1}, [40, 80, 160, 320]), [
        Quantity("load of the first touch", load("contact-closes"), 0.42654681, ELEMENTS),
        Quantity("load at which the middle lifts off", middle("contact-opens", "upper"), 2.4430, ELEMENTS),
        Quantity("load of the snap", greatest_turn, 6.2195, ELEMENTS),
        Quantity("touch of the opposite wall", middle("contact-closes", "lower"), 3.78668, ELEMENTS),
    ], note="The references of the second and the third row are known to 3e-4, that of the last to 2e-5. The paper gives 7.10 to "
            "7.15 for the snap.")


def meshes(members: dict, counts: list) -> dict:
    """Per count n a mesh with n · share elements in each member; the label is their sum."""
    result = {}
    for n in counts:
        shares = {name: round(n * share) for name, share in members.items()}
        label = str(sum(shares.values()))
        result[label] = [f"member.{name}.elements={elements}" for name, elements in shares.items()]
    return result


def perfect_channel(theory: str) -> Case:
    """Every event of the column between walls, from its buckling to the opposite wall."""
    events = [
        ("buckling", load("branch-point"), 0.432686705811),
        ("touch", load("contact-closes"), 0.435739888353),
        ("shortening there", monitor("shortening", "contact-closes"), 0.032153206553),
        ("the contact spreads to a line", load("contact-spreads"), 1.726295916538),
        ("the flat part buckles", load("branch-point", 1), 7.003081493782),
        ("shortening there", monitor("shortening", "branch-point", 1), 0.142961858290),
        ("load at the least shortening", load("displacement-limit"), 6.214791656),
        ("touch of the opposite wall", load("contact-closes", 1), 4.253608535128),
        ("shortening there", monitor("shortening", "contact-closes", 1), 0.313645142120),
        ("three contacts become lines", load("contact-spreads", 1), 14.8210269646),
    ]
    return Case(f"Perfect column in a channel, theory {theory}", "docs/validation/channel_perfect.toml",
                meshes({"column": 1}, [10, 20, 40, 80]),
                [Quantity(what, of, reference, BETWEEN_CONTACTS) for what, of, reference in events],
                always=(f"member.column.theory='{theory}'",), note="Behind the last event only the sum of the lengths of "
                "the three lines is determined, and the path keeps to equal ones.")


def clamped_channel(theory: str) -> Case:
    """Both ends clamped: the contact alone spreads though they lose their curvature with it."""
    events = [
        ("buckling", load("branch-point"), 1.7416248517343),
        ("touch", load("contact-closes"), 1.7429697472686),
        ("the contact spreads to a line", load("contact-spreads"), 7.144943444364),
        ("the flat part buckles", load("branch-point", 1), 16.875454912815),
        ("shortening there", monitor("shortening", "branch-point", 1), 0.167042775151),
    ]
    return Case(f"Perfect clamped column between walls, theory {theory}", "docs/validation/channel_perfect.toml",
                meshes({"column": 1}, [10, 20, 40, 80]),
                [Quantity(what, of, reference, BETWEEN_CONTACTS) for what, of, reference in events],
                always=(f"member.column.theory='{theory}'", "support={left=['x','z','rotation'],right=['z','rotation']}",
                        "wall.0.profile.z=0.1", "wall.1.profile.z=-0.1", "path.stop.event='contact-opens'"))


def force_passed(theory: str) -> Case:
    """Contact that is at 0.5858 of the beam at λ = 0.1 and at 0.6159 at λ = 0.2, with a force at 0.6."""
    return Case(f"Contact that slides past a force, theory {theory}", "docs/validation/force_passed.toml",
                meshes({"beam": 1}, [10, 20, 40, 80]), [
        Quantity("load of the touch", load("contact-closes"), 0.036708473020, PAST_A_FORCE),
        Quantity("middle before the force, at λ = 0.1", landed("middle", 0.1), -0.1453815351894, PAST_A_FORCE),
        Quantity("way of the right end there", landed("way", 0.1), 0.0307517213423, PAST_A_FORCE),
        Quantity("middle behind the force, at λ = 0.2", landed("middle", 0.2), -0.1427713048494, PAST_A_FORCE),
        Quantity("way of the right end there", landed("way", 0.2), 0.0351409318456, PAST_A_FORCE),
    ], always=(f"member.beam.theory='{theory}'",), note="Near the contact the force acts inside an element, which has an error of its own: on 10 and 20 elements "
                "in the last four rows, and on 40 in the last two.")


def tips(theory: str) -> list:
    """Cantilevers whose tips lie down on a floor, and on a cylinder where the contact moves inside."""
    shooting = "extensible elastica shot from the contact to the clamp"
    return [
        Case(f"Tip that lies down on a floor, theory {theory}", "docs/validation/tip_on_floor.toml",
             meshes({"strip": 1}, [10, 20, 40, 80]), [
            Quantity("load of the touch", load("contact-closes"), 0.4008018816, shooting),
            Quantity("load at which the tip lies down", load("contact-spreads"), 3.6092847770, shooting),
            Quantity("force of the clamp, at three times that", landed("V", 10.827854330940692), 5.4915969725, shooting),
        ], always=(f"member.strip.theory='{theory}'",), note="The elements take a load along them to order 4."),
        Case(f"Tip that slides onto a cylinder, theory {theory}", "docs/validation/tip_on_cylinder.toml",
             meshes({"strip": 1}, [10, 20, 40, 80]), [
            Quantity("load of the touch", load("contact-closes"), 0.2135655724265, shooting),
            Quantity("load at which contact leaves the tip", load("contact-passes"), 2.6229685102, shooting),
            Quantity("force of the contact, at λ = 8", landed("p", 8.0), 5.794849810795 * math.cos(0.154871139219), shooting),
        ], always=(f"member.strip.theory='{theory}'",)),
    ]


def outlines(theory: str) -> list:
    """A strip on a round peg, and a hook over a ramp with rounded corners."""
    peg = "extensible elastica shot from the clamp to the peg and on to the end"
    hook = "extensible elastica of arm and hook, shot from the clamp to the ramp"
    return [
        Case(f"Strip on a peg, theory {theory}", "docs/validation/peg.toml", meshes({"strip": 1}, [10, 20, 40, 80]), [
            Quantity("load of the touch", load("contact-closes"), 0.2081006194318634, peg),
            Quantity("z of the tip, at twice that", landed("z", 0.4162012388637268), -0.07814581171568506, peg),
        ], always=(f"member.strip.theory='{theory}'",)),
        Case(f"Hook that snaps over a ramp, theory {theory}", "docs/validation/snap_in.toml",
             meshes({"arm": 1, "hook": 0.2}, [10, 20, 40, 80]), [
            Quantity("way at which it meets the ramp", load("contact-closes"), 0.2, "the ramp's slope"),
            Quantity("push on the slope, at a way of 0.3", landed("pull", 0.3), -0.09347242107181895, hook),
            Quantity("greatest push, where the rounding begins", landed("pull", 0.3738367530457536), -0.1530718437958801, hook),
            Quantity("lift on the top", landed("lift", 0.5), 0.2834606857296881, hook),
            Quantity("pull on the way down, at a way of 0.75", landed("pull", 0.75), 0.09370791120256898, hook),
            Quantity("way at which it lets go", load("contact-opens"), 0.85, "the ramp's slope"),
        ], always=(f"member.arm.theory='{theory}'", f"member.hook.theory='{theory}'")),
    ]


def root(f: Callable[[float], float], low: float, high: float) -> float:
    """A zero of f by bisection."""
    rises = f(high) > 0.0
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if (f(middle) > 0.0) == rises else (middle, high)
    return 0.5 * (low + high)


def steep_truss(strain: str) -> Case:
    """The steep truss, b = 1 and h = 5: z of the apex at which it sways and at which the load is greatest, by the strain."""
    b, h = 1.0, 5.0
    L = math.hypot(b, h)
    length = lambda z: math.hypot(b, z)
    stretch = lambda z: math.log(length(z) / L)
    force, sways, limit = {
        "green": (lambda z: z * (h * h - z * z) / L**3, lambda z: z * z - h * h + 2 * b * b, lambda z: z - h / math.sqrt(3)),
        "engineering": (lambda z: 2 * z * (1 / length(z) - 1 / L),
                        lambda z: length(z)**3 - L * length(z)**2 + L * b * b, lambda z: length(z)**3 - b * b * L),
        "log": (lambda z: -2 * L * stretch(z) * z / length(z)**2,
                lambda z: (1 - stretch(z)) * b * b + z * z * stretch(z),
                lambda z: z * z + (b * b - z * z) * stretch(z)),
    }[strain]
    z_sways, z_limit = root(sways, 4.0, h), root(limit, 0.0, 4.0)
    return Case(f"Steep truss of two bars, strain: {strain}", "docs/validation/truss_sway.toml",
                {"2": [f"member.{m}.strain='{strain}'" for m in ("left", "right")]}, [
        Quantity("load at which it sways", load("branch-point"), force(z_sways), "closed form"),
        Quantity("way there", monitor("w", "branch-point"), h - z_sways, "closed form"),
        Quantity("limit load", load("limit-point"), force(z_limit), "closed form"),
    ])


def buckling(n: int, EA: float, GA: float = math.inf) -> float:
    """P (1 − P/EA + P/GA) = n² π² EI/L², the smaller root, EI = L = 1."""
    a, euler = 1 / GA - 1 / EA, (n * math.pi)**2
    return 2 * euler / (1 + math.sqrt(1 + 4 * a * euler))


def column_on_springs() -> list:
    """Pinned columns with L = EI = 1 on springs. Bending has the wave number k of (1 − P/EA) P = k² by stress-free length."""
    EA = 1000.0
    shrink = lambda P: 1 - P / EA
    k = lambda P: math.sqrt(shrink(P) * P)
    euler, two_waves = buckling(1, EA), buckling(2, EA)
    middle, ends, foundation = 80.0, 2.0, 400.0
    over_spring = root(lambda P: shrink(P) * middle / (2 * P) * (0.5 * math.cos(k(P) / 2) - math.sin(k(P) / 2) / k(P))
                       - math.cos(k(P) / 2), 1.0001 * euler, 0.9999 * two_waves)
    between = root(lambda P: math.sin(k(P) / 2) + k(P) / ends * math.cos(k(P) / 2), 1.0001 * euler, two_waves)
    in_waves = lambda q: root(lambda P: q * q - shrink(P) * P + shrink(P)**2 * foundation / q**2, 0.0, 400.0)
    of = lambda name, spring, load_of: Case(
        f"Pinned column, {name}", "docs/validation/column.toml", meshes({"column": 1}, [4, 8, 16, 32]),
        [Quantity("first buckling load", load("branch-point"), load_of, "closed form")], always=(f"spring=[{spring}]",))
    turned = f"stiffness={{rotation={ends}}}"
    return [
        of("a spring across in its middle", f"{{at='column:0.5', stiffness={{z={middle}}}}}", over_spring),
        of("springs against rotation at its ends", f"{{at='foot', {turned}}}, {{at='head', {turned}}}", between),
        of("on a foundation", f"{{on='column', foundation={{z={foundation}}}}}",
           min(in_waves(m * math.pi) for m in (1, 2, 3))),
    ]


def under_pressure() -> list:
    """Pressure that follows the axis of an arch and of a quarter of a ring."""
    arch = lambda theory: Case(
        f"Pinned semicircular arch under pressure, theory {theory}", "docs/validation/pressed_arch.toml",
        meshes({"west": 1, "east": 1}, [8, 16, 32, 64]),
        [Quantity("pressure at which it sways", load("branch-point"), 3.00127583475769, PRESSED)],
        always=tuple(f"member.{m}.theory='{theory}'" for m in ("west", "east")))
    return [
        arch("classic"), arch("elastica"),
        Case("Ring under pressure", "docs/validation/pressed_ring.toml", meshes({"quarter": 1}, [4, 8, 16]),
             [Quantity("pressure at which it buckles", load("branch-point"), 3.0, UNSTRETCHED)]),
    ]


def walls(clearance: float) -> str:
    """Flat walls below and above the axis z = 0, as one value for --set."""
    wall = lambda name, side, z: (f"{{name='{name}', side='{side}', acts_on='axis', profile={{type='flat', z={z}}}}}")
    return f"wall=[{wall('under', 'below', -clearance)}, {wall('over', 'above', clearance)}]"


def buckling_on_springs(k: float, EA: float) -> float:
    """The least P with EI q² − s P q + s² k = 0, q = (mπ/L)² and s = 1 − P/EA, EI = L = 1."""
    neutral = lambda P, q: q * q - (1 - P / EA) * P * q + (1 - P / EA)**2 * k
    return min(root(lambda P: neutral(P, (m * math.pi)**2), 0.0, 0.4 * EA) for m in range(1, 5))


def driven_otherwise() -> list:
    """Paths along which λ moves supports, walls or temperatures instead of multiplying a load."""
    channel = "docs/validation/channel_third_harmonic.toml"
    in_channel = ("contact.points='sliding'", "member.column.theory='elastica'", "path.branches='follow'",
                  "monitor.1={name='P', at='right', component='reaction-x', sign=-1}")
    return [
        Case("Column in a channel, end shortening prescribed", channel, meshes({"column": 1}, [20, 40, 80]), [
            Quantity("shortening at the first touch", load("contact-closes"), 0.032143539028, IMPERFECT),
            Quantity("greatest shortening before the snap", load("limit-point"), 0.140743077449, IMPERFECT),
            Quantity("force there", monitor("P", "limit-point"), 6.863020510418, IMPERFECT),
            Quantity("least shortening", load("limit-point", 1), 0.136241802660, IMPERFECT),
            Quantity("force there", monitor("P", "limit-point", 1), 6.211668066388, IMPERFECT),
        ], always=(*in_channel, "load=[]", "prescribed=[{at='right', x=-1.0}]", "path.step=0.004",
                   "path.stop={lambda=[-0.01, 0.33]}")),
        Case("Column in a channel, heated between fixed ends", channel, meshes({"column": 1}, [20, 40, 80]), [
            Quantity("strain of heat at the first touch", load("contact-closes"), 0.01581703139244, IMPERFECT),
            Quantity("greatest heat before the snap", load("limit-point"), 0.06540564515039, IMPERFECT),
            Quantity("force there", monitor("P", "limit-point"), 6.428468994643, IMPERFECT),
            Quantity("least heat", load("limit-point", 1), 0.06348366363517, IMPERFECT),
        ], always=(*in_channel, "material.steel.expansion=1.0", "load=[{on='column', temperature=1.0}]",
                   "support.right=['x', 'z']", "path.step=0.001", "path.stop={lambda=[-0.01, 0.15]}")),
        Case("Lee's frame, deflection prescribed", "examples/lee.toml",
             meshes({"column": 1, "short": 0.2, "long": 0.8}, [10, 20, 40]), [
            Quantity("deflection at which it snaps", load("limit-point"), 61.002978851425, CHECKED),
            Quantity("deflection at which it snaps back", load("limit-point", 1), 50.746251363189, CHECKED),
        ], always=("load=[]", "prescribed=[{at='loaded', z=-1.0}]", "path.step=1.0", "path.watch=[]",
                   "path.stop={lambda=[-1.0, 90.0]}",
                   *(f"member.{name}.theory='elastica'" for name in ("column", "short", "long")))),
        Case("Heated rail on ballast that yields", "examples/rail.toml", meshes({"rail": 1}, [8, 16, 32, 64]), [
            Quantity("force at which it buckles", monitor("force", "branch-point"),
                     2100 * (math.pi / 4) ** 2 + 500 / (math.pi / 4) ** 2, "closed form; fixed ends keep the axis' length"),
        ], always=("path.branches='primary'",),
             note="A foundation with a law buckles at the load of its first stiffness."),
        Case("Sine arch under a round indenter", "docs/validation/indenter.toml", meshes({"arch": 1}, [10, 20, 40]), [
            Quantity("way at the greatest push", load("displacement-limit"), 0.056131352628, SHOOTING),
            Quantity("greatest push", monitor("F", "displacement-limit"), 0.17024981411406, SHOOTING),
            Quantity("way at the least push", load("displacement-limit", 1), 0.147704654127, SHOOTING),
            Quantity("least push", monitor("F", "displacement-limit", 1), 0.039265852399, SHOOTING),
        ]),
        Case("Ring between plates, held by nothing else", "docs/validation/ring_between_plates.toml",
             meshes({"right": 1, "left": 1}, [12, 24, 48]), [
            Quantity("force at a way of R/10", landed("F", 0.1), 0.6253825639848148, "extensible elastica of a quarter, by shooting"),
            Quantity("way at which the touches spread", load("contact-spreads"), 0.5644732048945937, "extensible elastica of a quarter, by shooting"),
            Quantity("force there", monitor("F", "contact-spreads"), 2.7864167288521418, "extensible elastica of a quarter, by shooting"),
            Quantity("force at a way of R", landed("F", 1.0), 5.7419796992860315, "extensible elastica of a quarter, by shooting"),
        ], note="Soft springs stand in for what holds it from sliding and rolling: one part in a million of the force."),
    ]


def cases() -> list:
    EA, h, half_span = 1e5, 0.5, 5.0
    L = math.hypot(half_span, h)
    green = 2 * EA * h**3 / (3 * math.sqrt(3) * L**3)
    engineering = 2 * EA * (1 - (half_span / L) ** (2 / 3)) ** 1.5
    strains = {name: [f"member.{m}.strain='{name}'" for m in ("left", "right")] for name in ("green", "engineering")}
    radius = 10 / math.pi  # of the half circle into which the cantilever is rolled
    return [
        Case("Truss of two bars, Green's strain", "examples/truss.toml", {"2": strains["green"]}, [
            Quantity("first limit load", load("limit-point"), green, "closed form"),
            Quantity("way there", monitor("w", "limit-point"), h * (1 - 1 / math.sqrt(3)), "closed form"),
            Quantity("second limit load", load("limit-point", 1), -green, "closed form"),
        ]),
        Case("Truss of two bars, engineering strain", "examples/truss.toml", {"2": strains["engineering"]}, [
            Quantity("first limit load", load("limit-point"), engineering, "closed form"),
        ]),
        Case("Truss of two bars, logarithmic strain", "examples/truss.toml",
             {"2": [f"member.{m}.strain='log'" for m in ("left", "right")]}, [
            Quantity("first limit load", load("limit-point"), 1e5 * 3.82989288e-4, "closed form, to nine digits"),
        ]),
        *(steep_truss(strain) for strain in ("green", "engineering", "log")),
        Case("Cantilever rolled up by an end moment", "examples/cantilever.toml",
             meshes({"strip": 1}, [5, 10, 20, 40]), [
            Quantity("turn of the tip at half of the way", landed("turn", 100 * math.pi), math.pi, "closed form"),
            Quantity("z of the tip there", landed("z", 100 * math.pi), 2 * radius, "closed form"),
        ]),
        Case("Williams' toggle", "docs/validation/williams.toml", meshes({"left": 1, "right": 1}, [2, 4, 8, 16]), [
            Quantity("first limit load", load("limit-point"), 33.8703851779, SHOOTING),
            Quantity("way there", monitor("down", "limit-point"), 0.232156872412, SHOOTING),
            Quantity("second limit load", load("limit-point", 1), 31.2817744575, SHOOTING),
        ]),
        Case("Lee's frame", "examples/lee.toml",
             meshes({"column": 1, "short": 0.2, "long": 0.8}, [10, 20, 40, 80]), [
            Quantity("first limit load", load("limit-point"), 1.855672753757, CHECKED),
            Quantity("way there", monitor("down", "limit-point"), 48.735137245104, CHECKED),
            Quantity("load at the first displacement limit", load("displacement-limit"), 1.194410418780, CHECKED),
            Quantity("load at the second displacement limit", load("displacement-limit", 1), -0.438048021661, CHECKED),
            Quantity("second limit load", load("limit-point", 1), -0.941443155560, CHECKED),
        ]),
        Case("Lee's frame, elastica of order 6", "examples/lee.toml",
             meshes({"column": 1, "short": 0.2, "long": 0.8}, [5, 10, 20]), [
            Quantity("first limit load", load("limit-point"), 1.855672753757, CHECKED),
            Quantity("way there", monitor("down", "limit-point"), 48.735137245104, CHECKED),
            Quantity("second limit load", load("limit-point", 1), -0.941443155560, CHECKED),
        ], always=tuple(f"member.{name}.theory='elastica'" for name in ("column", "short", "long"))),
        Case("Deep arch of 215°, hinged and clamped", "examples/arch.toml",
             meshes({"west": 1, "east": 1}, [8, 16, 32, 64]), [
            Quantity("first limit load", load("limit-point"), 897.294947593916, CHECKED),
            Quantity("load at the first displacement limit", load("displacement-limit"), 559.219378191646, CHECKED),
            Quantity("second limit load", load("limit-point", 1), -73.051143418756, CHECKED),
        ], always=("path.watch=['down']",),
             note="DaDeppo and Schmidt 1975 give 8.97 EI/R² for the inextensible arch, 897 here."),
        Case("Shallow pinned circular arch", "docs/validation/shallow_arch.toml",
             meshes({"west": 1, "east": 1}, [8, 16, 32, 64]), [
            Quantity("first limit load", load("limit-point"), 1280.60663728179, SHOOTING),
            Quantity("first branch point", load("branch-point"), 1279.36308536489, SHOOTING),
            Quantity("way there", monitor("down", "branch-point"), 293.892593560, SHOOTING),
            Quantity("second limit load", load("limit-point", 1), -477.994067635700, SHOOTING),
        ]),
        *under_pressure(),
        Case("Pinned semicircular arch", "docs/validation/semicircle.toml", meshes({"west": 1, "east": 1}, [8, 16, 32, 64]), [
            Quantity("load at which it sways", load("branch-point"), 20.8420786502809, CHECKED),
            Quantity("way there", monitor("down", "branch-point"), 24.7455260913, SHOOTING),
            Quantity("limit load without sway", load("limit-point"), 36.0888659301171, CHECKED),
            Quantity("limit load of the branch that sways", load("limit-point", 1), 27.6290182852711, CHECKED),
        ]),
        Case("Clamped semicircular arch, nearly inextensible", "docs/validation/semicircle_clamped.toml",
             meshes({"west": 1, "east": 1}, [8, 16, 32, 64]), [
            Quantity("limit load", load("limit-point"), 10.4572627019098, SHOOTING),
        ], note="The reference is for the inextensible arch, here EA R²/EI = 1e8."),
        Case("Pinned column, extensible", "docs/validation/column.toml", meshes({"column": 1}, [4, 8, 16, 32]), [
            Quantity("first buckling load", load("branch-point"), buckling(1, 1000.0), "closed form"),
            Quantity("second buckling load", load("branch-point", 1), buckling(2, 1000.0), "closed form"),
        ]),
        Case("Pinned column, flexible in shear", "docs/validation/column.toml", meshes({"column": 1}, [4, 8, 16, 32]), [
            Quantity("first buckling load", load("branch-point"), buckling(1, 1000.0, 500.0), "closed form"),
            Quantity("second buckling load", load("branch-point", 1), buckling(2, 1000.0, 500.0), "closed form"),
        ], always=("member.column.theory='exact'",)),
        *column_on_springs(),
        Case("Pinned column between springs without clearance", "docs/validation/column.toml",
             meshes({"column": 1}, [8, 16, 32, 64]), [
            Quantity("first buckling load", load("branch-point"), buckling_on_springs(1000.0, 1000.0), "closed form"),
        ], always=(walls(0.0), "contact={method='penalty', penalty=1000.0}", "path.stop.lambda=[-1.0, 80.0]")),
        Case("Pinned column between walls with a clearance of 10⁻⁷ of its length", "docs/validation/column.toml",
             meshes({"column": 1}, [8, 16, 32, 64]), [
            Quantity("touch", load("contact-closes"), buckling(1, 1000.0), "closed form in the limit of no clearance"),
            Quantity("the contact spreads to a line", load("contact-spreads"), buckling(2, 1000.0),
                     "closed form in the limit of no clearance"),
        ], always=(walls(1e-7), "path.branches='follow'")),
        Case("Clamped column, extensible", "docs/validation/column_clamped.toml",
             meshes({"column": 1}, [6, 12, 24, 48]), [
            Quantity("first buckling load", load("branch-point"), buckling(2, 1000.0), "closed form"),
        ]),
        Case("Roorda's frame, nearly inextensible", "docs/validation/roorda.toml",
             meshes({"column": 1, "beam": 1}, [4, 8, 16, 32]), [
            Quantity("limit load, moment 0.01 λ", load("limit-point"), 12.43820240758229, SHOOTING),
        ], note="Inextensible, P_c = 13.8859429 without the moment; Koiter (1967) gives P/P_c = 1 − 0.3805 θ beside it. "
                "The branches themselves are compared in the tests."),
        Case("Diamond frame", "docs/validation/diamond.toml",
             meshes({name: 1 for name in ("one", "two", "three", "four")}, [4, 8, 16]), [
            Quantity("inwards at λ = 1", landed("inwards", 1.0), 0.1392338882316943, SHOOTING),
            Quantity("apart at λ = 1", landed("apart", 1.0), 2 * 0.11325021615356089, SHOOTING),
        ]),
        Case("Bending onto a foundation, contact at nodes", "examples/foundation.toml",
             meshes({"beam": 1}, [10, 20, 40, 80]), [
            Quantity("moment of first contact", load("contact-closes"), 0.448961073442, "circular arc, closed form"),
            Quantity("moment at which the contact spreads", load("contact-closes", 1), 1.34307213737, FIRST_INTEGRAL),
            Quantity("turn of the end at M₀ = 1", landed("turn", 1.0), 0.209846018033, FIRST_INTEGRAL),
            Quantity("turn of the end at M₀ = 2.5", landed("turn", 2.5), 0.329610888261, FIRST_INTEGRAL),
        ], always=("contact.points='nodes'", "monitor=[{name='turn', at='right', component='rotation'}]", "path.land.lambda=[1.0, 2.5]",
                   "path.stop.lambda=[-1.0, 3.0]")),
        *(essenburg_foundation(order) for order in (1, 2)),
        *(perfect_channel(theory) for theory in ("classic", "elastica")),
        *(clamped_channel(theory) for theory in ("classic", "elastica")),
        Case("Column in a channel, half sine of 0.00176 cm", "docs/validation/channel_half_sine.toml",
             meshes({"column": 1}, [20, 40, 80, 160]), [
            Quantity("load of the first touch", load("contact-closes"), 0.430656908534, IMPERFECT),
            Quantity("shortening there", monitor("shortening", "contact-closes"), 0.032101003206, IMPERFECT),
        ]),
        Case("Column in a channel, half sine and third harmonic of 0.0001 cm",
             "docs/validation/channel_third_harmonic.toml", meshes({"column": 1}, [20, 40, 80, 160]), [
            Quantity("greatest load before the snap", greatest_turn, 6.863204701, IMPERFECT),
        ], note="The reference is for an arc length of 2 instead of a chord of 2, a difference of 4e-6. The touchdown jumps "
                "from node to node and the load is that of the highest tooth of the path, so finer meshes do not come "
                "nearer in these steps (theory.md, section 7)."),
        essenburg_channel(),
        *(force_passed(theory) for theory in ("classic", "elastica")),
        *(case for theory in ("classic", "elastica") for case in tips(theory)),
        *(case for theory in ("classic", "elastica") for case in outlines(theory)),
        *driven_otherwise(),
    ]


def trace(program: str, deck: Path, values: list) -> Run:
    with tempfile.TemporaryDirectory() as folder:
        return trace_into(folder, program, deck, values)


def trace_into(folder: str, program: str, deck: Path, values: list) -> Run:
    command = [program, "run", str(deck), "--out", folder, "--quiet", "--no-units", "--force"]
    for value in values:
        command += ["--set", value]
    result = subprocess.run(command, capture_output=True, text=True)
    if result.returncode not in RUN_IS_USABLE:
        sys.exit(f"{' '.join(command)}\nended with status {result.returncode}:\n{result.stderr}")
    events = json.loads(Path(folder, "events.json").read_text())["events"]
    with open(Path(folder, "path.csv"), newline="") as table:
        return Run(events=events, points=list(csv.DictReader(table)), early=result.returncode == ENDED_EARLY)


def order(errors: list) -> str:
    """Exponent between the two finest meshes that are above round-off; each has half the element length of the one before.

    Errors that change sign or do not shrink have none."""
    resolved = [error for error in errors if abs(error) > 1e-10]
    if len(resolved) < 2:
        return "–"
    if min(resolved) * max(resolved) < 0 or any(abs(b) > abs(a) for a, b in zip(resolved, resolved[1:])):
        return "irregular"
    return f"{math.log2(resolved[-2] / resolved[-1]):.1f}"


def section(program: str, case: Case) -> str:
    runs = [trace(program, SOURCE / case.deck, [*case.always, *values]) for values in case.meshes.values()]
    labels = [f"{label} elements" for label in case.meshes]
    text = f"## {case.title}\n\n`{case.deck}`. {case.note}".rstrip() + "\n\n"
    text += "| quantity | reference | " + " | ".join(labels) + " | relative error, finest | order |\n"
    text += "| --- " * (len(labels) + 4) + "|\n"
    for quantity in case.quantities:
        found = [quantity.of(run) for run in runs]
        errors = [value / quantity.reference - 1 for value in found]
        cells = [f"{value:.10g}" + ("†" if run.early else "") for value, run in zip(found, runs)]
        text += (f"| {quantity.what} | {quantity.reference:.12g} | " + " | ".join(cells) +
                 f" | {abs(errors[-1]):.1e} | {order(errors)} |\n")
    origins = list(dict.fromkeys(quantity.origin for quantity in case.quantities))
    if any(run.early for run in runs):
        text += "\n† The branch ended early behind this (status 3).\n"
    return text + "\nReference: " + "; ".join(origins) + ".\n"


HEAD = """# Validation

What the program finds against values that do not come from it, at several meshes. The page is written by
`docs/make_validation.py` from runs of `trace-path`; the decks are in `examples/` and `docs/validation/`. `order` is the exponent
of the element length in the error, from the two finest meshes above round-off: 4 for smooth paths and first touches of
classic beams, initially curved ones included, and 6 for beams of theory `elastica`. Where node contact has to place a
touchdown between two nodes it is 1, or the error is irregular ([theory.md](theory.md), section 7).

References called *shooting* are solutions of the boundary value problem of the extensible elastica (a plane beam without shear
flexibility, stretch 1 + N/EA, dead loads) that were computed independently of this program and are converged in all digits
that stand here.

What is no structure of a deck is compared in `tests/published` with closed forms and independent values: Bratu's problem with the
exact folds of its difference scheme, the sinusoidal shallow arch, the star dome with its double points, and the normal forms of
singular points.

Parts that lift off a straight wall are compared with the place where κ₀″ = 0 on four meshes each, and no wall pulls; and a touch
beside a short arch that becomes a part with a beam of small slopes, solved by series and polynomials: loads to 2e-7, places to 1e-8
(`tests/apps/lifting_parts_test.cpp`). Changes of contact stay where they are to 1e-9 whatever value is landed on right behind them
(`tests/apps/values_behind_changes_test.cpp`). An arch between two touches of which one becomes a part (loads to 1e-6 and 1e-5), a touch that
spreads beside a neutral span (5e-7), and three toggles that come back to their upright path above a floor (2e-8 to 3e-6) are compared with
own shooting (`tests/model/part_loads_test.cpp`, `tests/model/missed_corners_test.cpp`), and so is a touch that becomes two beside a point of a spline that pushes, to
the load at which one of them lets go (4e-10 on 52 elements; `tests/apps/curved_parts_test.cpp`).

Rods that nothing but a bore holds are compared with own shooting: in a round one the loads at which the middle touches and spreads (1e-7 on 48 elements), in a
square one those at which the foot and the top come to lie on its walls, and where the top is at ten times that load; on its floor with closed forms of
small slopes: a force lifts 2 F/q of it, a moment √(2 M/q) (`tests/apps/loading/rods_in_bores_test.cpp`). A column between four pegs touches three of them one after the
other where own shooting says so (5e-9 on 48 elements; `tests/apps/four_pegs_test.cpp`).

Whole runs of ten decks are compared in `tests/apps/deck_answers_test.cpp`, event by event, six of them with closed forms and
shooting and four with finer meshes and shorter steps: bounds just behind the spreading of a touch, stops that are smaller than an
element or shorter than the structure, a snap-fit, a slender column, a toggle on a floor and columns between walls.

Monitors are compared in `tests/apps/monitors_test.cpp`: the greatest moment of a cantilever that bends far with its load times the arm (1e-8), of
a uniform load with q L²/8 between two nodes (1e-7) and, where a growing end moment takes over, with both closed forms on either side of
μ = (3 − √8)/2 (1e-6); gaps with clearance less deflection and with the distance from a circle (1e-9, 1e-12); spring forces with statics and
with k u, of two cantilevers that a spring joins with a third of the load; the pressure of soil with q and with k times the settlement.

Searches are compared in `tests/apps/search_test.cpp`: the equilibria of a truss with a closed form, and those of a column in a channel with a half sine, lying flat on one wall at λ = 6.5, with
shooting, which knows 16 of up to three contacts, images counted once. From the first branch alone 13 to 15 of the other 15 are found with 50 tries, all of two and three contacts among them, none that is false, each to 10⁻⁶ of
shortening and energy ([how-to](how-to/disconnected-branches.md) has the tries and their cost). Falls are compared in `tests/apps/landing_test.cpp` with closed forms and shooting, and in
`tests/apps/landing_motion_test.cpp` on ten problems with a slow motion among stiff springs.

A knock-down map over two imperfections by runs and by curves is the same to 1e-13 (`tests/apps/curve_session_test.cpp`).

Curves of events are compared in `tests/apps/curve_test.cpp`: limit points of a truss on a spring and their cusp with the closed form to
1e-9, the pitchfork of a column with Euler's load, the load of a truss with a side load H with 0.60678 H^(2/3) below the perfect one's, a
pinned arch's cusp and crossing with shooting, and every other kind with decks that are run again, to 1e-9.
"""


def main() -> None:
    if len(sys.argv) != 2:
        sys.exit("usage: python3 docs/make_validation.py TRACE_PATH > docs/validation.md")
    program = str(Path(sys.argv[1]).resolve())
    print("\n".join([HEAD, *(section(program, case) for case in cases())]), end="")


if __name__ == "__main__":
    main()
