#!/usr/bin/env python3
"""Traces the validation cases and prints docs/validation.md.

    python3 docs/make_validation.py build/release/apps/trace-path > docs/validation.md

Each case is a deck of examples/ or docs/validation/ that is run at several meshes by --set. Compared is one event, or one
output point, with a reference that does not come from this program.
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
# Explained at the head of the page.
SHOOTING = "Taylor series"
CHECKED = "Taylor series, collocation"
FIRST_INTEGRAL = "first integral"
BETWEEN_CONTACTS = "shooting, first integral"
IMPERFECT = PAST_A_FORCE = "shooting"
PRESSED = "multiple shooting"
UNSTRETCHED = "closed form, inextensible"
ELEMENTS = "finite elements"
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
        Quantity("moment at which the middle separates", middle("contact-opens", "foundation"), 3.8275, ELEMENTS),
        Quantity("lower face at M₀ = 5", landed("bottom", 5.0), -0.07998188154683, ELEMENTS),
    ], always=(f"member.beam.order={order}", "path.output_at.lambda=[0.4, 2.5]"),
       note="The edge of the contact moves from node to node.")


def essenburg_channel() -> Case:
    return Case("Column in a channel, Essenburg's theory", "docs/validation/channel_essenburg.toml",
                meshes({"column": 1}, [40, 80, 160, 320]), [
        Quantity("load of first contact", load("contact-closes"), 0.42654681, ELEMENTS),
        Quantity("load at which the middle separates", middle("contact-opens", "upper"), 2.4430, ELEMENTS),
        Quantity("load of the snap", greatest_turn, 6.2195, ELEMENTS),
        Quantity("contact with the opposite wall", middle("contact-closes", "lower"), 3.78668, ELEMENTS),
    ], note="The references of rows two and three are known to 3e-4, that of the last to 2e-5.")


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
        ("first contact", load("contact-closes"), 0.435739888353),
        ("shortening there", monitor("shortening", "contact-closes"), 0.032153206553),
        ("the contact point spreads", load("contact-spreads"), 1.726295916538),
        ("the contact zone buckles", load("branch-point", 1), 7.003081493782),
        ("shortening there", monitor("shortening", "branch-point", 1), 0.142961858290),
        ("load at the minimum shortening", load("turning-point"), 6.214791656),
        ("contact with the opposite wall", load("contact-closes", 1), 4.253608535128),
        ("shortening there", monitor("shortening", "contact-closes", 1), 0.313645142120),
        ("three contact points spread", load("contact-spreads", 1), 14.8210269646),
    ]
    return Case(f"Perfect column in a channel, theory {theory}", "docs/validation/channel_perfect.toml",
                meshes({"column": 1}, [10, 20, 40, 80]),
                [Quantity(what, of, reference, BETWEEN_CONTACTS) for what, of, reference in events],
                always=(f"member.column.theory='{theory}'",), note="Beyond the last event only the sum of the lengths of "
                "the three zones is determined; the path keeps them equal.")


def clamped_channel(theory: str) -> Case:
    """Both ends clamped: the contact alone spreads though they lose their curvature with it."""
    events = [
        ("buckling", load("branch-point"), 1.7416248517343),
        ("first contact", load("contact-closes"), 1.7429697472686),
        ("the contact point spreads", load("contact-spreads"), 7.144943444364),
        ("the contact zone buckles", load("branch-point", 1), 16.875454912815),
        ("shortening there", monitor("shortening", "branch-point", 1), 0.167042775151),
    ]
    return Case(f"Perfect clamped column between walls, theory {theory}", "docs/validation/channel_perfect.toml",
                meshes({"column": 1}, [10, 20, 40, 80]),
                [Quantity(what, of, reference, BETWEEN_CONTACTS) for what, of, reference in events],
                always=(f"member.column.theory='{theory}'", "support={left=['x','z','rotation'],right=['z','rotation']}",
                        "wall.0.profile.z=0.1", "wall.1.profile.z=-0.1", "path.stop.event='contact-opens'"))


def force_passed(theory: str) -> Case:
    """Contact that is at 0.5858 of the beam at λ = 0.1 and at 0.6159 at λ = 0.2, with a force at 0.6."""
    return Case(f"Contact point that passes a force, theory {theory}", "docs/validation/force_passed.toml",
                meshes({"beam": 1}, [10, 20, 40, 80]), [
        Quantity("load of first contact", load("contact-closes"), 0.036708473020, PAST_A_FORCE),
        Quantity("deflection of the middle at λ = 0.1, before the force", landed("middle", 0.1), -0.1453815351894, PAST_A_FORCE),
        Quantity("displacement of the right end there", landed("way", 0.1), 0.0307517213423, PAST_A_FORCE),
        Quantity("deflection of the middle at λ = 0.2, past the force", landed("middle", 0.2), -0.1427713048494, PAST_A_FORCE),
        Quantity("displacement of the right end there", landed("way", 0.2), 0.0351409318456, PAST_A_FORCE),
    ], always=(f"member.beam.theory='{theory}'",), note="On coarse meshes the force acts inside the element at the "
                "contact point.")


def tips(theory: str) -> list:
    """Cantilevers whose tips lie down on a floor, and on a cylinder where the contact moves inside."""
    shooting = "shooting"
    return [
        Case(f"Free end that comes to rest on a floor, theory {theory}", "docs/validation/tip_on_floor.toml",
             meshes({"strip": 1}, [10, 20, 40, 80]), [
            Quantity("load of first contact", load("contact-closes"), 0.4008018816, shooting),
            Quantity("load at which contact spreads from the end", load("contact-spreads"), 3.6092847770, shooting),
            Quantity("clamp force at three times that load", landed("V", 10.827854330940692), 5.4915969725, shooting),
        ], always=(f"member.strip.theory='{theory}'",), note="Loads along members limit the order to 4."),
        Case(f"Contact that moves from a free end onto a cylinder, theory {theory}", "docs/validation/tip_on_cylinder.toml",
             meshes({"strip": 1}, [10, 20, 40, 80]), [
            Quantity("load of first contact", load("contact-closes"), 0.2135655724265, shooting),
            Quantity("load at which contact leaves the end", load("contact-transfers"), 2.6229685102, shooting),
            Quantity("contact force at λ = 8", landed("p", 8.0), 5.794849810795 * math.cos(0.154871139219), shooting),
        ], always=(f"member.strip.theory='{theory}'",)),
    ]


def outlines(theory: str) -> list:
    """A strip on a round peg, and a hook over a ramp with rounded corners."""
    peg = hook = "shooting"
    return [
        Case(f"Strip on a peg, theory {theory}", "docs/validation/peg.toml", meshes({"strip": 1}, [10, 20, 40, 80]), [
            Quantity("load of first contact", load("contact-closes"), 0.2081006194318634, peg),
            Quantity("z of the free end at twice that load", landed("z", 0.4162012388637268), -0.07814581171568506, peg),
        ], always=(f"member.strip.theory='{theory}'",)),
        Case(f"Hook that snaps over a ramp, theory {theory}", "docs/validation/snap_in.toml",
             meshes({"arm": 1, "hook": 0.2}, [10, 20, 40, 80]), [
            Quantity("displacement at first contact", load("contact-closes"), 0.2, "the ramp's slope"),
            Quantity("push on the slope, displacement 0.3", landed("pull", 0.3), -0.09347242107181895, hook),
            Quantity("maximum push, where the rounding begins", landed("pull", 0.3738367530457536), -0.1530718437958801, hook),
            Quantity("lift on the top", landed("lift", 0.5), 0.2834606857296881, hook),
            Quantity("pull on the far slope, displacement 0.75", landed("pull", 0.75), 0.09370791120256898, hook),
            Quantity("displacement at release", load("contact-opens"), 0.85, "the ramp's slope"),
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
        Quantity("displacement there", monitor("w", "branch-point"), h - z_sways, "closed form"),
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
        arch("euler-bernoulli"), arch("elastica"),
        Case("Ring under pressure", "docs/validation/pressed_ring.toml", meshes({"quarter": 1}, [4, 8, 16]),
             [Quantity("pressure at which it buckles", load("branch-point"), 3.0, UNSTRETCHED)]),
    ]


def walls(clearance: float) -> str:
    """Flat walls below and above the axis z = 0, as one value for --set."""
    wall = lambda name, side, z: (f"{{name='{name}', side='{side}', contact_surface='axis', profile={{type='flat', z={z}}}}}")
    return f"wall=[{wall('under', 'below', -clearance)}, {wall('over', 'above', clearance)}]"


def buckling_on_springs(k: float, EA: float) -> float:
    """The least P with EI q² − s P q + s² k = 0, q = (mπ/L)² and s = 1 − P/EA, EI = L = 1."""
    neutral = lambda P, q: q * q - (1 - P / EA) * P * q + (1 - P / EA)**2 * k
    return min(root(lambda P: neutral(P, (m * math.pi)**2), 0.0, 0.4 * EA) for m in range(1, 5))


def driven_otherwise() -> list:
    """Paths along which λ moves supports, walls or temperatures instead of multiplying a load."""
    channel = "docs/validation/channel_third_harmonic.toml"
    in_channel = ("contact.points='moving'", "member.column.theory='elastica'", "path.branches='most-stable'",
                  "monitor.1={name='P', at='right', component='reaction-x', sign=-1}")
    return [
        Case("Column in a channel, end shortening prescribed", channel, meshes({"column": 1}, [20, 40, 80]), [
            Quantity("shortening at first contact", load("contact-closes"), 0.032143539028, IMPERFECT),
            Quantity("maximum shortening before the snap", load("limit-point"), 0.140743077449, IMPERFECT),
            Quantity("force there", monitor("P", "limit-point"), 6.863020510418, IMPERFECT),
            Quantity("minimum shortening", load("limit-point", 1), 0.136241802660, IMPERFECT),
            Quantity("force there", monitor("P", "limit-point", 1), 6.211668066388, IMPERFECT),
        ], always=(*in_channel, "load=[]", "prescribed=[{at='right', x=-1.0}]", "path.step=0.004",
                   "path.stop={lambda=[-0.01, 0.33]}")),
        Case("Column in a channel, heated between fixed ends", channel, meshes({"column": 1}, [20, 40, 80]), [
            Quantity("thermal strain at first contact", load("contact-closes"), 0.01581703139244, IMPERFECT),
            Quantity("maximum thermal strain before the snap", load("limit-point"), 0.06540564515039, IMPERFECT),
            Quantity("force there", monitor("P", "limit-point"), 6.428468994643, IMPERFECT),
            Quantity("minimum thermal strain", load("limit-point", 1), 0.06348366363517, IMPERFECT),
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
                     2100 * (math.pi / 4) ** 2 + 500 / (math.pi / 4) ** 2, "closed form"),
        ], always=("path.branches='primary'",),
             note="The buckling load is that of the law's initial stiffness."),
        Case("Sine arch under a round indenter", "docs/validation/indenter.toml", meshes({"arch": 1}, [10, 20, 40]), [
            Quantity("displacement at the maximum push", load("turning-point"), 0.056131352628, SHOOTING),
            Quantity("maximum push", monitor("F", "turning-point"), 0.17024981411406, SHOOTING),
            Quantity("displacement at the minimum push", load("turning-point", 1), 0.147704654127, SHOOTING),
            Quantity("minimum push", monitor("F", "turning-point", 1), 0.039265852399, SHOOTING),
        ]),
        Case("Ring between plates, without supports", "docs/validation/ring_between_plates.toml",
             meshes({"right": 1, "left": 1}, [12, 24, 48]), [
            Quantity("force at a displacement of R/10", landed("F", 0.1), 0.6253825639848148, "shooting of a quarter"),
            Quantity("displacement at which contact spreads", load("contact-spreads"), 0.5644732048945937, "shooting of a quarter"),
            Quantity("force there", monitor("F", "contact-spreads"), 2.7864167288521418, "shooting of a quarter"),
            Quantity("force at a displacement of R", landed("F", 1.0), 5.7419796992860315, "shooting of a quarter"),
        ], note="Weak springs carry 10⁻⁶ of the force."),
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
            Quantity("displacement there", monitor("w", "limit-point"), h * (1 - 1 / math.sqrt(3)), "closed form"),
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
            Quantity("rotation of the free end at half the moment", landed("turn", 100 * math.pi), math.pi, "closed form"),
            Quantity("z of the free end there", landed("z", 100 * math.pi), 2 * radius, "closed form"),
        ]),
        Case("Williams' toggle", "docs/validation/williams.toml", meshes({"left": 1, "right": 1}, [2, 4, 8, 16]), [
            Quantity("first limit load", load("limit-point"), 33.8703851779, SHOOTING),
            Quantity("displacement there", monitor("down", "limit-point"), 0.232156872412, SHOOTING),
            Quantity("second limit load", load("limit-point", 1), 31.2817744575, SHOOTING),
        ]),
        Case("Lee's frame", "examples/lee.toml",
             meshes({"column": 1, "short": 0.2, "long": 0.8}, [10, 20, 40, 80]), [
            Quantity("first limit load", load("limit-point"), 1.855672753757, CHECKED),
            Quantity("displacement there", monitor("down", "limit-point"), 48.735137245104, CHECKED),
            Quantity("load at the first turning point", load("turning-point"), 1.194410418780, CHECKED),
            Quantity("load at the second turning point", load("turning-point", 1), -0.438048021661, CHECKED),
            Quantity("second limit load", load("limit-point", 1), -0.941443155560, CHECKED),
        ]),
        Case("Lee's frame, elastica of order 6", "examples/lee.toml",
             meshes({"column": 1, "short": 0.2, "long": 0.8}, [5, 10, 20]), [
            Quantity("first limit load", load("limit-point"), 1.855672753757, CHECKED),
            Quantity("displacement there", monitor("down", "limit-point"), 48.735137245104, CHECKED),
            Quantity("second limit load", load("limit-point", 1), -0.941443155560, CHECKED),
        ], always=tuple(f"member.{name}.theory='elastica'" for name in ("column", "short", "long"))),
        Case("Deep arch of 215°, hinged and clamped", "examples/arch.toml",
             meshes({"west": 1, "east": 1}, [8, 16, 32, 64]), [
            Quantity("first limit load", load("limit-point"), 897.294947593916, CHECKED),
            Quantity("load at the first turning point", load("turning-point"), 559.219378191646, CHECKED),
            Quantity("second limit load", load("limit-point", 1), -73.051143418756, CHECKED),
        ], always=("path.watch=['down']",),
             note="DaDeppo and Schmidt 1975 give 8.97 EI/R² for the inextensible arch, 897 here."),
        Case("Shallow pinned circular arch", "docs/validation/shallow_arch.toml",
             meshes({"west": 1, "east": 1}, [8, 16, 32, 64]), [
            Quantity("first limit load", load("limit-point"), 1280.60663728179, SHOOTING),
            Quantity("first branch point", load("branch-point"), 1279.36308536489, SHOOTING),
            Quantity("displacement there", monitor("down", "branch-point"), 293.892593560, SHOOTING),
            Quantity("second limit load", load("limit-point", 1), -477.994067635700, SHOOTING),
        ]),
        *under_pressure(),
        Case("Pinned semicircular arch", "docs/validation/semicircle.toml", meshes({"west": 1, "east": 1}, [8, 16, 32, 64]), [
            Quantity("load at which it sways", load("branch-point"), 20.8420786502809, CHECKED),
            Quantity("displacement there", monitor("down", "branch-point"), 24.7455260913, SHOOTING),
            Quantity("limit load without sway", load("limit-point"), 36.0888659301171, CHECKED),
            Quantity("limit load of the sway branch", load("limit-point", 1), 27.6290182852711, CHECKED),
        ]),
        Case("Clamped semicircular arch, nearly inextensible", "docs/validation/semicircle_clamped.toml",
             meshes({"west": 1, "east": 1}, [8, 16, 32, 64]), [
            Quantity("limit load", load("limit-point"), 10.4572627019098, SHOOTING),
        ], note="EA R²/EI = 1e8; the reference is inextensible."),
        Case("Pinned column, extensible", "docs/validation/column.toml", meshes({"column": 1}, [4, 8, 16, 32]), [
            Quantity("first buckling load", load("branch-point"), buckling(1, 1000.0), "closed form"),
            Quantity("second buckling load", load("branch-point", 1), buckling(2, 1000.0), "closed form"),
        ]),
        Case("Pinned column, flexible in shear", "docs/validation/column.toml", meshes({"column": 1}, [4, 8, 16, 32]), [
            Quantity("first buckling load", load("branch-point"), buckling(1, 1000.0, 500.0), "closed form"),
            Quantity("second buckling load", load("branch-point", 1), buckling(2, 1000.0, 500.0), "closed form"),
        ], always=("member.column.theory='reissner'",)),
        *column_on_springs(),
        Case("Pinned column between springs without clearance", "docs/validation/column.toml",
             meshes({"column": 1}, [8, 16, 32, 64]), [
            Quantity("first buckling load", load("branch-point"), buckling_on_springs(1000.0, 1000.0), "closed form"),
        ], always=(walls(0.0), "contact={method='penalty', penalty=1000.0}", "path.stop.lambda=[-1.0, 80.0]")),
        Case("Pinned column between walls with a clearance of 10⁻⁷ of its length", "docs/validation/column.toml",
             meshes({"column": 1}, [8, 16, 32, 64]), [
            Quantity("first contact", load("contact-closes"), buckling(1, 1000.0), "closed form without clearance"),
            Quantity("contact spreads", load("contact-spreads"), buckling(2, 1000.0),
                     "closed form without clearance"),
        ], always=(walls(1e-7), "path.branches='most-stable'")),
        Case("Clamped column, extensible", "docs/validation/column_clamped.toml",
             meshes({"column": 1}, [6, 12, 24, 48]), [
            Quantity("first buckling load", load("branch-point"), buckling(2, 1000.0), "closed form"),
        ]),
        Case("Roorda's frame, nearly inextensible", "docs/validation/roorda.toml",
             meshes({"column": 1, "beam": 1}, [4, 8, 16, 32]), [
            Quantity("limit load, moment 0.01 λ", load("limit-point"), 12.43820240758229, SHOOTING),
        ], note="Inextensible, P_c = 13.8859429 without the moment; Koiter (1967): P/P_c = 1 − 0.3805 θ near it."),
        Case("Diamond frame", "docs/validation/diamond.toml",
             meshes({name: 1 for name in ("one", "two", "three", "four")}, [4, 8, 16]), [
            Quantity("inwards at λ = 1", landed("inwards", 1.0), 0.1392338882316943, SHOOTING),
            Quantity("apart at λ = 1", landed("apart", 1.0), 2 * 0.11325021615356089, SHOOTING),
        ]),
        Case("Bending onto a foundation, contact at nodes", "examples/foundation.toml",
             meshes({"beam": 1}, [10, 20, 40, 80]), [
            Quantity("moment of first contact", load("contact-closes"), 0.448961073442, "closed form"),
            Quantity("moment at which the contact spreads", load("contact-closes", 1), 1.34307213737, FIRST_INTEGRAL),
            Quantity("end rotation at M₀ = 1", landed("turn", 1.0), 0.209846018033, FIRST_INTEGRAL),
            Quantity("end rotation at M₀ = 2.5", landed("turn", 2.5), 0.329610888261, FIRST_INTEGRAL),
        ], always=("contact.points='nodes'", "monitor=[{name='turn', at='right', component='rotation'}]", "path.output_at.lambda=[1.0, 2.5]",
                   "path.stop.lambda=[-1.0, 3.0]")),
        *(essenburg_foundation(order) for order in (1, 2)),
        *(perfect_channel(theory) for theory in ("euler-bernoulli", "elastica")),
        *(clamped_channel(theory) for theory in ("euler-bernoulli", "elastica")),
        Case("Column in a channel, half sine of 0.00176 cm", "docs/validation/channel_half_sine.toml",
             meshes({"column": 1}, [20, 40, 80, 160]), [
            Quantity("load of first contact", load("contact-closes"), 0.430656908534, IMPERFECT),
            Quantity("shortening there", monitor("shortening", "contact-closes"), 0.032101003206, IMPERFECT),
        ]),
        Case("Column in a channel, half sine and third harmonic of 0.0001 cm",
             "docs/validation/channel_third_harmonic.toml", meshes({"column": 1}, [20, 40, 80, 160]), [
            Quantity("maximum load before the snap", greatest_turn, 6.863204701, IMPERFECT),
        ], note="Contact at nodes. The reference has an arc length, not a chord, of 2: a difference of 4e-6."),
        essenburg_channel(),
        *(force_passed(theory) for theory in ("euler-bernoulli", "elastica")),
        *(case for theory in ("euler-bernoulli", "elastica") for case in tips(theory)),
        *(case for theory in ("euler-bernoulli", "elastica") for case in outlines(theory)),
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


@dataclass
class Section:
    title: str
    errors: list  # relative, of each quantity on the finest mesh
    rows: list  # of cells; the first row describes the case


COLUMNS = ("| case, quantity | reference | error, coarsest mesh | error, finest mesh | order |\n" + "| --- " * 5 + "|\n")


def section(program: str, case: Case) -> Section:
    runs = [trace(program, SOURCE / case.deck, [*case.always, *values]) for values in case.meshes.values()]
    labels = list(case.meshes)
    labels[-1] += " elements"
    shown = [0, -1] if len(runs) > 1 else [-1]
    blank = [""] * (2 - len(shown))

    about = f"**{case.title}**, `{case.deck}`" + (f". {case.note}" if case.note else "")
    origins = list(dict.fromkeys(quantity.origin for quantity in case.quantities))
    rows = [[about, "; ".join(origins), *blank, *(labels[k] for k in shown), ""]]
    finest = []
    for quantity in case.quantities:
        found = [quantity.of(run) for run in runs]
        errors = [value / quantity.reference - 1 for value in found]
        finest.append(abs(errors[-1]))
        cells = [f"{abs(errors[k]):.1e}" + ("†" if runs[k].early else "") for k in shown]
        rows.append([quantity.what, f"{quantity.reference:.12g}", *blank, *cells, order(errors)])
    return Section(case.title, finest, rows)


def grouped(sections: list) -> dict:
    """The sections of each group of GROUPS."""
    left, groups = list(sections), {}
    for group, titles in GROUPS.items():
        groups[group] = [one for one in left if one.title.startswith(titles)]
        left = [one for one in left if one not in groups[group]]
    if left:
        sys.exit(f"no group of the summary has {left[0].title}")
    return groups


def theories_side_by_side(of: list) -> list:
    """Rows of all sections; those that differ in the theory only are one section, with cells "first; second"."""
    rows, same = [], {}
    for one in of:
        same.setdefault(one.title.partition(", theory ")[0], []).append(one)
    for title, each in same.items():
        if len(each) > 1:
            theories = "; ".join(one.title.partition(", theory ")[2] for one in each)
            for one in each:
                one.rows[0][0] = one.rows[0][0].replace(f"**{one.title}**", f"**{title}, theories {theories}**")
        beside = zip(*(one.rows for one in each), strict=True)
        rows += [["; ".join(dict.fromkeys(cells)) for cells in zip(*row, strict=True)] for row in beside]
    return rows


def table(group: str, of: list) -> str:
    text = f"\n## {group[0].upper()}{group[1:]}\n\n{COLUMNS}"
    for row in theories_side_by_side(of):
        text += " ".join(f"| {cell}".rstrip() for cell in row) + " |\n"
    return text + ("\n† The branch ended early after this (status 3).\n" if "†" in text else "")


def summary(groups: dict) -> str:
    """One row per group of cases: how many values are compared, and their errors on the finest meshes."""
    text = "| problems | values compared | median error | largest |\n| --- | --- | --- | --- |\n"
    for group, of in groups.items():
        errors = sorted(error for one in of for error in one.errors)
        text += f"| {group} | {len(errors)} | {errors[len(errors) // 2]:.0e} | {errors[-1]:.0e} |\n"
    return text


HEAD = """# Validation

*Reference.* Results of `trace-path` on several meshes, compared with values that do not come from it.
`docs/make_validation.py` writes this page; the decks are in `examples/` and `docs/validation/`.

References are independent of this program. All but those by finite elements are converged in all digits printed.

| reference | method |
| --- | --- |
| shooting | boundary value problem of the extensible elastica (no shear flexibility, length grows by N/EA) between supports, contacts and forces; imperfections are stress-free |
| Taylor series | shooting with Taylor series of order 24, 80 bit; *collocation* agrees to 3e-11 in the limit loads |
| first integral | quadrature of the elastica's first integral between contacts |
| finite elements | another program, quadratic elements, up to 640 on half of the beam |

A row in bold is a case, with its deck, reference, and coarsest and finest mesh. Errors are relative; of two theories they are separated
by a semicolon.
**Order** is the exponent of the element length in the error, from the two finest meshes above round-off.
Smooth paths and first contacts have order 4 with Euler–Bernoulli members, also curved ones, and 6 with theory `elastica`.
If node contact has its edge between two nodes, the order is 1 or the error is irregular ([theory](theory.md), section 7).

## Summary

"""

TESTS = """
Compared in tests only:

| feature | compared with | agreement | test |
| --- | --- | --- | --- |
| equations without a deck: Bratu's problem, sinusoidal shallow arch, star dome with double points, normal forms of singular points | closed forms, exact folds of the difference scheme | | `tests/published` |
| contact zones that separate inside, straight wall | the position where κ₀″ = 0, four meshes; no tension | | `tests/apps/lifting_parts_test.cpp` |
| contact point beside a short arch that becomes a zone | beam of small slopes | loads 2e-7, positions 1e-8 | `tests/apps/lifting_parts_test.cpp` |
| contact changes with an output value just beyond | the same without it | 1e-9 | `tests/apps/values_behind_changes_test.cpp` |
| arch between two contact points, one of which becomes a zone | shooting | 1e-6, 1e-5 | `tests/model/part_loads_test.cpp` |
| contact point that spreads beside a neutral span | shooting | 5e-7 | `tests/model/part_loads_test.cpp` |
| three toggles that return to their upright path above a floor | shooting | 2e-8 to 3e-6 | `tests/model/missed_corners_test.cpp` |
| contact point that splits beside a spline knot | shooting | 4e-10, 52 elements | `tests/apps/curved_parts_test.cpp` |
| unconstrained rods in a round and a square bore | shooting | 1e-7, 48 elements | `tests/apps/loading/rods_in_bores_test.cpp` |
| rod on a floor: a force F frees 2 F/q, a moment M frees √(2 M/q) | small slopes | | `tests/apps/loading/rods_in_bores_test.cpp` |
| column between four pegs, three contacts in turn | shooting | 5e-9, 48 elements | `tests/apps/four_pegs_test.cpp` |
| ten whole runs, event by event | closed forms and shooting (six), finer meshes and shorter steps (four) | | `tests/apps/deck_answers_test.cpp` |
| maximum moment: cantilever at large rotation; uniform load between nodes; growing end moment | closed forms | 1e-8, 1e-7, 1e-6 | `tests/apps/monitors_test.cpp` |
| stress in outer fibres: cantilever at large rotation, five sections; eccentric column | hand formulas, secant formula | 1e-8, 3e-4 (small slopes) | `tests/apps/stress_monitors_test.cpp` |
| values that λ, displacements and forces pass; last contact | closed forms | 1e-12, 1e-5 | `tests/apps/value_crossings_test.cpp` |
| derivatives of monitors along events | closed forms; differences of whole runs | 1e-7; 1e-6 (stress by a length 2e-5) | `tests/answers/monitor_sensitivity_test.cpp` |
| gaps; spring forces; pressure of soil | clearance less deflection, distance from a circle; statics, k u; q and k times the settlement | 1e-9, 1e-12 | `tests/apps/monitors_test.cpp` |
| search: truss | closed form | | `tests/answers/search_test.cpp` |
| search: column on one wall of a channel, λ = 6.5, 16 equilibria up to mirror images | shooting; 13 to 15 of the other 15 with 50 guesses, all of two and three contacts, none false | 1e-6 | `tests/answers/search_test.cpp` |
| jumps | closed forms and shooting | | `jump_test.cpp` in `tests/apps` |
| jumps, ten problems | slow motion among stiff springs | | `jump_motion_test.cpp` in `tests/apps` |
| knock-down map over two imperfections | runs, event curves | 1e-13 | `tests/answers/curve_session_test.cpp` |
| event curves: limit points and cusp of a truss on a spring, pitchfork of a column, truss with a side load H (0.60678 H^(2/3) lower) | closed forms | 1e-9 | `tests/answers/curve_test.cpp` |
| event curves: cusp and crossing of a pinned arch | shooting | | `tests/answers/curve_test.cpp` |
| event curves of every other kind | new runs | 1e-9 | `tests/answers/curve_test.cpp` |
"""

# Rows of the summary: titles of cases by their beginnings.
GROUPS = {
    "bars at large rotation": ("Truss", "Steep truss"),
    "cantilever and frames": ("Cantilever", "Williams", "Lee's frame", "Roorda", "Diamond"),
    "arches and rings, also under follower pressure": ("Deep arch", "Shallow pinned", "Pinned semicircular", "Clamped semicircular", "Ring under"),
    "columns, springs, foundations, heat": ("Pinned column", "Clamped column", "Heated rail"),
    "moving contact: columns in a channel": ("Perfect column", "Perfect clamped", "Column in a channel, end", "Column in a channel, heated"),
    "moving contact: forces, free ends, outlines, moving walls": ("Contact point that", "Contact that moves", "Free end", "Strip on", "Hook", "Sine arch", "Ring between"),
    "contact at nodes, events before a contact moves": ("Column in a channel, half sine of",),
    "contact at nodes, events after a contact moves": ("Bending onto", "Column in a channel, half sine and"),
    "Essenburg's theory, contact at nodes": ("Thick beam", "Column in a channel, Essenburg"),
}


def main() -> None:
    if len(sys.argv) != 2:
        sys.exit("usage: python3 docs/make_validation.py TRACE_PATH > docs/validation.md")
    program = str(Path(sys.argv[1]).resolve())
    groups = grouped([section(program, case) for case in cases()])
    print(HEAD + summary(groups) + TESTS + "".join(table(group, of) for group, of in groups.items()), end="")


if __name__ == "__main__":
    main()
