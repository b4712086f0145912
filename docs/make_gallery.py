#!/usr/bin/env python3
"""Traces the decks of the gallery and writes docs/gallery.md and docs/gallery/*.svg.

    python3 docs/make_gallery.py build/release/apps/trace-path

Pictures are those of each run's report.html, references those of docs/make_validation.py,
here at the mesh of the deck.
"""

import re
import resource
import statistics
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from device_cases import devices
from make_validation import SOURCE, cases, trace_into

FOLDER = SOURCE / "docs/gallery"
TIMED = 5  # runs of each deck, of which the median is told


@dataclass
class Picture:
    name: str
    case: str  # title in make_validation.py
    quantity: str  # of that case
    event: str  # at which the shape is shown: its last one of this kind
    title: str
    text: str


PICTURES = [
    Picture("channel-perfect", "Perfect column in a channel, theory classic", "the flat part buckles", "branch-point",
            "The perfect column",
            "A column between two walls: it buckles, touches, lies on the wall, buckles off it at a branch point and snaps through."),
    Picture("channel", "Column in a channel, half sine of 0.00176 cm", "load of the first touch", "contact-closes",
            "A column in a channel",
            "The same with an imperfection, up to a little behind the first touch."),
    Picture("channel-thick", "Column in a channel, Essenburg's theory", "load of the first touch", "contact-closes",
            "A thick column in a channel",
            "The same column with a thickness that changes."),
    Picture("foundation", "Bending onto a foundation, contact at nodes", "moment of first contact", "contact-spreads",
            "Bending onto a foundation",
            "A beam bent onto a rigid foundation: a point of contact becomes a stretch, whose edges run outwards."),
    Picture("thick", "Thick beam on a foundation, Essenburg's theory, order 2", "moment of first contact", "contact-opens",
            "A thick beam lifts off",
            "A thick beam on the same foundation: its middle lifts off again."),
    Picture("lee", "Lee's frame", "first limit load", "turning-point",
            "Lee's frame",
            "A frame that snaps through and back: two limit points and two turning points of the displacement."),
    Picture("arch", "Deep arch of 215°, hinged and clamped", "first limit load", "limit-point",
            "A deep arch",
            "An arch hinged at one end and clamped at the other, far past its first limit load."),
    Picture("semicircle", "Pinned semicircular arch", "load at which it sways", "branch-point",
            "A half circle sways",
            "A half circle sways at a branch point long before the limit load that symmetry would give it."),
    Picture("pressed-arch", "Pinned semicircular arch under pressure, theory classic", "pressure at which it sways", "end",
            "A half circle under pressure",
            "Pressure stays across the axis when the arch moves. It sways at 3 EI/R³, to a side on which it is stable."),
    Picture("shallow-arch", "Shallow pinned circular arch", "first branch point", "limit-point",
            "A shallow arch",
            "Branch point and limit point 0.1 % apart."),
    Picture("williams", "Williams' toggle", "first limit load", "limit-point", "Williams' toggle",
            "The toggle frame of 1964, a snap of a quarter of an inch."),
    Picture("truss", "Truss of two bars, Green's strain", "first limit load", "limit-point",
            "Two bars",
            "Two bars that snap through: the smallest example there is."),
    Picture("truss-sway", "Steep truss of two bars, strain: green", "load at which it sways", "branch-point",
            "A steep truss",
            "A steep truss sways sideways before it snaps through."),
    Picture("cantilever", "Cantilever rolled up by an end moment", "turn of the tip at half of the way", "end",
            "A strip rolled up",
            "A strip rolled up into a circle by a moment."),
    Picture("column", "Pinned column, extensible", "first buckling load", "end", "Euler's column",
            "Euler's column, followed to where its ends meet."),
    Picture("roorda", "Roorda's frame, nearly inextensible", "limit load, moment 0.01 λ", "limit-point",
            "Roorda's frame",
            "Two bars at a right angle, the frame on which imperfection sensitivity was first measured."),
    Picture("diamond", "Diamond frame", "inwards at λ = 1", "end", "A diamond drawn out",
            "A hinged square drawn out at two corners."),
    Picture("snap-fit", "Snap-fit", "greatest push by the way of the nose there", "turning-point", "A snap-fit",
            "A catch moves under a hook: the push grows up its flat flank, vanishes on its top, and is negative where the hook snaps down the steep "
            "one. Backwards the same path is the removal, whose force is the greater by about what the steeper flank asks for."),
    Picture("guidewire", "Guidewire in a bend", "push far in the bend", "end", "A guidewire in a bend",
            "The tip of a wire slides along the outer wall of a bend, and the wire leans on the inner one. The push grows to what it takes to "
            "bend each new length of wire, and stays there."),
    Picture("drill-string", "Drill string in a bore", "weight on the bit at which it buckles", "end", "A drill string in its bore",
            "Pressed on its bit a hanging string buckles below and leans on its bore. It buckles at a quarter of its own weight; the bore then holds it."),
    Picture("mems-switch", "Bistable switch", "greatest force", "limit-point", "A bistable switch",
            "A shuttle on two cosine beams snaps through onto a stop. The force falls from its peak at a sixth of the height to a negative value, "
            "at which the stop is met before the second resting place."),
    Picture("harvester", "Precompressed harvester", "deflection at rest", "end", "A harvester",
            "A strip is shortened in a first stage and so bent; in a second one a load makes it snap to the other side, to a stop. "
            "It sways at a branch point before it snaps."),
    Picture("leaf-spring", "Leaf spring on a former", "deflection at λ = 4", "end", "A leaf spring on a former",
            "A leaf is bent onto a round former and lies on it from the clamp on. It becomes stiffer as less of it is free, while the moment at the "
            "clamp stays what the former's radius asks for."),
    Picture("rail", "Heated rail", "force at which it buckles", "limit-point", "A heated rail",
            "A rail on ballast that yields buckles sideways under heat. Behind the first limit point it would jump far out at the same "
            "temperature, and its compression falls."),
    Picture("pipeline", "Pipeline on the seabed", "thrust at which it lifts off", "end", "A pipeline on the seabed",
            "A pipe that is not quite straight lies on the seabed, pressed flat by its weight but for a free span under its hump. Heat makes "
            "a thrust, under which the crest lifts off at a limit load and jumps up."),
    Picture("portal", "Portal with a stop", "load at which it sways", "end", "A portal with a stop",
            "A portal frame sways under loads on its corners until a stop holds it. It then carries more, and the stop little."),
    Picture("ring", "Ring between plates", "force at the way R/100", "end", "A ring between plates",
            "A ring that nothing else holds is squeezed between two plates, which touch it at a point each. It might roll and slide, and "
            "the program says that it does neither."),
    Picture("bow", "Bow pressed onto a floor", "force at which contact spreads", "end", "A bow pressed onto a floor",
            "The ends of a bow are pressed down to the floor, and it unrolls on it. The force grows without bounds as less of it stands off."),
    Picture("lattice", "Lattice of curved bars", "force at which the first row gives way", "turning-point", "A lattice of curved bars",
            "A plate presses on two rows of curved bars, which give way one after the other. Both do so at the same force, and between "
            "them it falls to a tenth."),
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
                      if "width: 100%" not in rule and drawn.issuperset(re.findall(r"\.([a-z][\w-]*)", rule.split("{")[0])))
    for name, value in re.findall(r"(--[\w-]+):\s*([^;}]+)", style):
        rules = rules.replace(f"var({name})", value.strip())
    return ('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1240 440">'
            f"<style>{rules}</style><rect width=\"1240\" height=\"440\" fill=\"#fff\"/>"
            f"{placed(chart, 0, 720, 440)}{placed(shape, 730, 500, 440)}</svg>\n")


def entry(program: str, picture: Picture, known: dict) -> str:
    case = known[picture.case]
    quantity = next(q for q in case.quantities if q.what == picture.quantity)
    with tempfile.TemporaryDirectory() as folder:
        seconds = []
        for _ in range(TIMED):
            before = processor_seconds()
            traced = trace_into(folder, program, SOURCE / case.deck, [])
            seconds.append(processor_seconds() - before)
        svg = compose(*drawings(Path(folder, "report.html").read_text(), picture.event, traced.events))
    (FOLDER / f"{picture.name}.svg").write_text(svg)
    return (f"## {picture.title}\n\n{picture.text}\n\n![load and shape](gallery/{picture.name}.svg)\n\n"
            f"`{case.deck}`, {1e3 * statistics.median(seconds):.0f} ms. {quantity.what[0].upper() + quantity.what[1:]}: "
            f"**{quantity.of(traced):.10g}**, reference {quantity.reference:.10g} ({quantity.origin}).\n")


HEAD = """# Gallery

What the report of each run shows: the load over the first monitor, with the events, and the shape at one of them. The devices at
the end come with the program (`trace-path examples`). The page is
written by `docs/make_gallery.py`; more quantities and meshes are in [validation.md](validation.md). Times are the processor's of whole
processes with their falls and reports, the median of {timed} ({processor}).
"""


def processor_seconds() -> float:
    """Of all that has been started and has ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def processor() -> str:
    return re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text()).group(1)


def main() -> None:
    if len(sys.argv) != 2:
        sys.exit("usage: python3 docs/make_gallery.py TRACE_PATH")
    program = str(Path(sys.argv[1]).resolve())
    FOLDER.mkdir(exist_ok=True)
    known = {case.title: case for case in [*cases(), *devices()]}
    head = HEAD.format(timed=TIMED, processor=processor())
    page = "\n".join([head, *(entry(program, picture, known) for picture in PICTURES)])
    (SOURCE / "docs/gallery.md").write_text(page)


if __name__ == "__main__":
    main()
