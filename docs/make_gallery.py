#!/usr/bin/env python3
"""Traces the decks of the gallery and writes docs/gallery.md and docs/gallery/*.svg.

    python3 docs/make_gallery.py build/release/apps/trace-path

Pictures are those of each run's report.html, references those of docs/make_validation.py,
here at the mesh of the deck.
"""

import re
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from device_cases import devices, pushed, snap_fit_by_hand, with_friction
from make_validation import SOURCE, Case, Run, cases, trace, trace_into

FOLDER = SOURCE / "docs/gallery"


@dataclass
class Picture:
    name: str
    case: str  # title in make_validation.py
    quantity: str  # of that case
    event: str  # at which the shape is shown: its last one of this kind
    title: str
    text: str
    label: str  # of the quantity
    by_hand: str = ""  # formula


PICTURES = [
    Picture("channel-perfect", "Perfect column in a channel, theory euler-bernoulli", "the contact zone buckles", "branch-point",
            "The perfect column",
            "A column between two walls buckles and touches the wall. A contact zone grows, buckles off the wall "
            "at a bifurcation and snaps through.",
            "Bifurcation of the contact zone"),
    Picture("channel", "Column in a channel, half sine of 0.00176 cm", "load of first contact", "contact-closes",
            "A column in a channel",
            "The same column with a half sine as imperfection, up to its first contact.",
            "First contact"),
    Picture("channel-thick", "Column in a channel, Essenburg's theory", "load of first contact", "contact-closes",
            "A thick column in a channel",
            "The same column with variable thickness (Essenburg's theory).",
            "First contact"),
    Picture("foundation", "Bending onto a foundation, contact at nodes", "moment of first contact", "contact-spreads",
            "Bending onto a foundation",
            "A beam is bent onto a rigid foundation. The contact point becomes a zone, whose ends move outwards.",
            "Moment of first contact"),
    Picture("thick", "Thick beam on a foundation, Essenburg's theory, order 2", "moment of first contact", "contact-opens",
            "A thick beam lifts off",
            "A thick beam on the same foundation: its middle lifts off again.",
            "Moment of first contact"),
    Picture("lee", "Lee's frame", "first limit load", "turning-point",
            "Lee's frame",
            "A frame with snap-through and snap-back: two limit points and two turning points of the "
            "displacement.",
            "First limit load"),
    Picture("arch", "Deep arch of 215°, hinged and clamped", "first limit load", "limit-point",
            "A deep arch",
            "An arch hinged at one end and clamped at the other, far beyond its first limit load.",
            "First limit load"),
    Picture("semicircle", "Pinned semicircular arch", "load at which it sways", "branch-point",
            "A semicircle sways",
            "A semicircular arch sways at a bifurcation below the limit load of its symmetric path.",
            "Bifurcation"),
    Picture("pressed-arch", "Pinned semicircular arch under pressure, theory euler-bernoulli", "pressure at which it sways", "end",
            "A semicircle under pressure",
            "Follower pressure stays normal to the deformed arch. The arch sways at 3 EI/R³; the sway branch is "
            "stable.",
            "Bifurcation"),
    Picture("shallow-arch", "Shallow pinned circular arch", "first branch point", "limit-point",
            "A shallow arch",
            "Bifurcation and limit point are 0.1 % apart.",
            "First bifurcation"),
    Picture("williams", "Williams' toggle", "first limit load", "limit-point",
            "Williams' toggle",
            "The toggle frame of 1964, with a snap of a quarter of an inch.",
            "First limit load"),
    Picture("truss", "Truss of two bars, Green's strain", "first limit load", "limit-point",
            "Two bars",
            "Two bars snap through: the smallest example with limit points.",
            "First limit load"),
    Picture("truss-sway", "Steep truss of two bars, strain: green", "load at which it sways", "branch-point",
            "A steep truss",
            "A steep truss sways before it snaps through.",
            "Bifurcation"),
    Picture("cantilever", "Cantilever rolled up by an end moment", "rotation of the free end at half the moment", "end",
            "A strip rolled up",
            "A moment rolls a strip up into a circle.",
            "Rotation of the tip at half the moment"),
    Picture("column", "Pinned column, extensible", "first buckling load", "end",
            "Euler's column",
            "Euler's column, followed until its ends meet.",
            "First buckling load"),
    Picture("roorda", "Roorda's frame, nearly inextensible", "limit load, moment 0.01 λ", "limit-point",
            "Roorda's frame",
            "Two bars at a right angle: the frame on which imperfection sensitivity was first measured.",
            "Limit load, moment 0.01 λ"),
    Picture("diamond", "Diamond frame", "inwards at λ = 1", "end",
            "A diamond drawn out",
            "A hinged square is pulled at two corners.",
            "Displacement inwards at λ = 1"),
    Picture("snap-fit", "Snap-fit", "greatest push by the way of the nose there", "turning-point",
            "A snap-fit",
            "A catch moves under a hook. The push increases along the flat flank, vanishes on its top and becomes"
            " negative on the steep flank. Followed backwards, the path describes removal, which needs a larger "
            "force.",
            "Maximum push"),
    Picture("guidewire", "Guidewire in a bend", "push far in the bend", "end",
            "A guidewire in a bend",
            "The tip of a wire slides along the outer wall of a bend, and the wire leans on the inner wall. The "
            "push increases to what bends each new length of wire, and stays constant.",
            "Push far in the bend"),
    Picture("drill-string", "Drill string in a bore", "weight on the bit at which it buckles", "end",
            "A drill string in its bore",
            "A hanging string is pressed on its bit and buckles at its lower end, at a quarter of its own weight."
            " The bore then supports it.",
            "Weight on the bit at buckling"),
    Picture("mems-switch", "Bistable switch", "greatest force", "limit-point",
            "A bistable switch",
            "A shuttle on two cosine beams snaps through onto a stop. The force decreases from its maximum at a "
            "sixth of the height to a negative value.",
            "Maximum force"),
    Picture("harvester", "Precompressed harvester", "deflection at rest", "end",
            "A harvester",
            "A strip is shortened in a first load step and so buckles. In a second step a load makes it snap to "
            "the other side, onto a stop. It sways at a bifurcation before.",
            "Deflection at rest"),
    Picture("leaf-spring", "Leaf spring on a former", "deflection at λ = 4", "end",
            "A leaf spring on a former",
            "A leaf is bent onto a round former; a contact zone grows from the clamp. The leaf becomes stiffer, "
            "and the moment at the clamp stays constant.",
            "Deflection at λ = 4"),
    Picture("rail", "Heated rail", "force at which it buckles", "limit-point",
            "A heated rail",
            "A rail on yielding ballast buckles sideways when heated. Beyond the first limit point it would jump "
            "far out at the same temperature.",
            "Buckling force"),
    Picture("pipeline", "Pipeline on the seabed", "thrust at which it lifts off", "end",
            "A pipeline on the seabed",
            "A pipe with a hump rests on the seabed, with one free span. Heat causes a thrust. The crest lifts "
            "off at a limit load and jumps up.",
            "Thrust at lift-off"),
    Picture("portal", "Portal with a stop", "load at which it sways", "end",
            "A portal with a stop",
            "A portal frame sways under loads on its corners until a stop supports it.",
            "Sway load"),
    Picture("ring", "Ring between plates", "force at the way R/100", "end",
            "A ring between plates",
            "An unconstrained ring is squeezed between two plates, with one contact point each.",
            "Force at displacement R/100"),
    Picture("bow", "Bow pressed onto a floor", "force at which contact spreads", "end",
            "A bow pressed onto a floor",
            "The ends of a bow are pressed down to the floor, and a contact zone grows. The force increases "
            "without bound.",
            "Force at the start of the zone"),
    Picture("lattice", "Lattice of curved bars", "force at which the first row gives way", "turning-point",
            "A lattice of curved bars",
            "A plate presses on two rows of curved bars, which buckle one after the other at the same force. "
            "Between them the force drops to a tenth.",
            "Buckling force of the first row"),
]

# With friction: each number of the case is given by the run, by hand and by shooting.
FRICTION = [
    Picture("snap-fit-friction", "Snap-fit with friction", "insertion, removal", "turning-point",
            "A snap-fit with friction",
            "The catch is pushed through the hook and drawn back, with friction. The usual formula is 12 % low for insertion and 33 % high "
            "for removal.",
            "Insertion force, removal force",
            "P (μ + t)/(1 − μ t) with P = 3 EI y/ℓ³ at the end of a flank of slope t"),
    Picture("clip", "Pipe clip with friction", "insertion, removal", "turning-point",
            "A clip for a pipe",
            "A pipe is pressed into a clip and drawn out again. Removal needs 40 % more force than insertion, though the pipe is the same "
            "from both sides.",
            "Insertion force, removal force",
            "maximum over γ of (r sin γ − a) F_x/(C_zx F_x + C_zz F_z), with the compliance C of a curved beam. F is the pipe's normal at γ, "
            "turned by atan μ"),
    Picture("guidewire-friction", "Guidewire through an S with friction", "push", "end",
            "A guidewire through an S",
            "A guidewire is pushed through two bends of 60°. At each end of a bend it crosses from wall to wall, where friction adds to the "
            "push; it oscillates by 4 % as nodes pass.",
            "Push beyond the S",
            "2 μ F (1 + 2 √2 e^(−μθ) + e^(−2 μθ)) with F = EI/(R √(48 c R)), c half the clearance"),
    Picture("drill-pipe", "Drill pipe that locks up", "force on the bit", "end",
            "A drill pipe that locks up",
            "A rod that has buckled into ten half waves is pushed through a slot with rough walls, the planar model of a drill pipe. "
            "Friction takes its share at each crest: 1000 N at the top are 191 N at the bit.",
            "Force on the bit",
            "F exp(−5/2 μ h L/a²) for half waves of length a in a slot of width h"),
    Picture("rail-lift", "Rail lifted in the heat", "height", "value-crossing",
            "A hot rail on ballast",
            "A track is heated by 60 degrees, then lifted by a jack against its weight and the friction of the ballast. Above 19 cm the "
            "jack has to pull it down: the track would buckle upwards.",
            "Height in centimetres",
            "2.408e-3 q L⁴/EI with EA α T = 80.76 EI/L² + (q L/EI) √(1.597e-5 EA μ q L⁵ − ¼ (μ EI)²), Hobbs 1984"),
]


def drawings(report: str, kind: str, events: list) -> tuple:
    """The first chart, the walls and the shape at the last event of a kind."""
    page = re.sub(r"<script.*?</script>", "", report, flags=re.S)
    style = "".join(re.findall(r"<style>(.*?)</style>", page, flags=re.S))
    chart = re.search(r'<svg class="chart".*?</svg>', page, flags=re.S).group(0)
    wanted = [e["id"] for e in events if e["kind"] == kind]
    shapes = re.findall(r'<svg class="shape"[^>]*aria-label="Shape at event (\d+)".*?</svg>', page, flags=re.S)
    # Events of one point share a picture: that of the last at or before the one that is wanted.
    chosen = max((int(s) for s in shapes if int(s) <= wanted[-1]), default=int(shapes[-1]))
    shape = re.search(rf'<svg class="shape"[^>]*aria-label="Shape at event {chosen}".*?</svg>', page, flags=re.S).group(0)
    walls = re.search(r'<g id="walls">.*?</g>', page, flags=re.S)
    if walls:
        shape = re.sub(r'<use href="#walls"\s*/>|<use href="#walls"></use>', walls.group(0), shape)
    return style, chart, shape


def compose(style: str, chart: str, shape: str) -> str:
    """Chart and shape beside each other."""
    def placed(svg: str, x: int, width: int, height: int) -> str:
        svg = re.sub(r"<title>.*?</title>", "", svg, flags=re.S)
        return svg.replace("<svg ", f'<svg x="{x}" y="0" width="{width}" height="{height}" ', 1)
    # Rules for what is drawn; those of the page's layout stay behind, and variables, which some viewers do not know.
    drawn = {word for words in re.findall(r'class="([^"]*)"', chart + shape) for word in words.split()}
    rules = "\n".join(rule for rule in re.findall(r"^(?:svg\.|\.)[^{\n]*\{[^}\n]*\}", style, flags=re.M)
                      if "width: 100%" not in rule and any(drawn.issuperset(re.findall(r"\.([a-z][\w-]*)", selector))
                                                           for selector in rule.split("{")[0].split(",")))
    for name, value in re.findall(r"(--[\w-]+):\s*([^;}]+)", style):
        rules = rules.replace(f"var({name})", value.strip())
    return ('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1240 440">'
            f"<style>{rules}</style><rect width=\"1240\" height=\"440\" fill=\"#fff\"/>"
            f"{placed(chart, 0, 720, 440)}{placed(shape, 730, 500, 440)}</svg>\n")


def draw(program: str, picture: Picture, case: Case) -> Run:
    """The run of a case, whose picture it writes."""
    with tempfile.TemporaryDirectory() as folder:
        traced = trace_into(folder, program, SOURCE / case.deck, [])
        svg = compose(*drawings(Path(folder, "report.html").read_text(), picture.event, traced.events))
    (FOLDER / f"{picture.name}.svg").write_text(svg)
    return traced


def entry(program: str, picture: Picture, known: dict) -> str:
    case = known[picture.case]
    quantity = next(q for q in case.quantities if q.what == picture.quantity)
    traced = draw(program, picture, case)
    return (f"## {picture.title}\n\n{picture.text}\n\n![load and shape](gallery/{picture.name}.svg)\n\n"
            f"`{case.deck}`. {picture.label}: **{quantity.of(traced):.6g}**, reference {quantity.reference:.6g}.\n")


def friction_entry(program: str, picture: Picture, known: dict) -> str:
    case = known[picture.case]
    quantities = {q.what: q for q in case.quantities}
    traced = draw(program, picture, case)
    numbers = "; ".join(f"{label}: **{quantities[what].of(traced):.6g}**, by hand {quantities[what + ' by hand'].reference:.4g}, by "
                        f"shooting {quantities[what].reference:.6g}"
                        for label, what in zip(picture.label.split(", "), picture.quantity.split(", "), strict=True))
    return (f"## {picture.title}\n\n{picture.text}\n\n![load and shape](gallery/{picture.name}.svg)\n\n"
            f"`{case.deck}`. {numbers}.\n\nBy hand: {picture.by_hand}.\n")


def snap_fit_by_friction(program: str) -> str:
    """Forces of the snap-fit over the coefficient of friction."""
    table = "| μ | insertion | by hand | removal | by hand |\n| --- | --- | --- | --- | --- |\n"
    for mu in (0.0, 0.1, 0.2, 0.3, 0.4):
        run = trace(program, SOURCE / "examples/snap-fit-friction.toml", [f"wall.catch.friction={mu}"])
        table += (f"| {mu:g} | {pushed('insert')(run):.4g} | {snap_fit_by_hand(mu, 0.5):.4g} | {pushed('remove')(run):.4g} "
                  f"| {snap_fit_by_hand(mu, 1.0):.4g} |\n")
    return table


HEAD = """# Gallery

*Examples.* The report of each run: load over the first monitor, with events, and the shape at one of them. Copy the decks of
`examples/` with `trace-path examples`. [Validation](validation.md) has the origin of the references, more quantities and more
meshes. `docs/make_gallery.py` writes this page.
"""


def main() -> None:
    if len(sys.argv) != 2:
        sys.exit("usage: python3 docs/make_gallery.py TRACE_PATH")
    program = str(Path(sys.argv[1]).resolve())
    FOLDER.mkdir(exist_ok=True)
    known = {case.title: case for case in [*cases(), *devices(), *with_friction()]}
    with_forces = [friction_entry(program, picture, known) for picture in FRICTION]
    with_forces.insert(1, snap_fit_by_friction(program))
    page = "\n".join([HEAD, *(entry(program, picture, known) for picture in PICTURES), *with_forces])
    (SOURCE / "docs/gallery.md").write_text(page)


if __name__ == "__main__":
    main()
