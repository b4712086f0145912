"""Curves of events, worst combinations and jumps: against closed forms, and as the program has them.

Two bars of half-span b = 10 and rise h = 1 with Green strain, EA = 10⁴ and a spring k below the top: in the depth w the load is
P = EA w (w − h)(w − 2h)/L³ + k w, L² = b² + h².
"""

import copy
import json
import os
import pickle
import signal
import threading

import matplotlib
import numpy as np
import pandas as pd
import pytest
from conftest import EXAMPLES

import arcwall
from arcwall import Deck, DeckError, NoAnswer

matplotlib.use("Agg")

L3 = 101.0**1.5


def load_at(w, k=0.0):
    return 1e4 * w * (w - 1) * (w - 2) / L3 + k * w


def snap_depth(k=0.0):
    """P′ = 0 first."""
    return 1 - np.sqrt((1 - k * L3 / 1e4) / 3)


@pytest.fixture
def bars():
    bar = {"theory": "truss", "strain": "green", "elements": 1, "material": "m", "section": "s"}
    return Deck({
        "title": "Two bars",
        "material": {"m": {"E": 1e4}},
        "section": {"s": {"shape": "general", "A": 1.0, "I": 1.0}},
        "point": {"left": [-10.0, 0.0], "top": [0.0, 1.0], "right": [10.0, 0.0]},
        "support": {"left": ["x", "z"], "right": ["x", "z"]},
        "load": [{"at": "top", "force": [0.0, -1.0]}],
        "path": {"step": 0.3, "branches": "primary", "stop": {"w": [-2.5, 0.5]}},
        "monitor": [{"name": "w", "at": "top", "component": "z"}],
        "member": {"a": {"from": "left", "to": "top", **bar}, "b": {"from": "top", "to": "right", **bar}},
    })  # fmt: skip


@pytest.fixture
def sprung(bars):
    return bars.copy({"spring": [{"at": "top", "stiffness": {"z": 1.0}}]})


def curve_of(deck, **more):
    return deck.curve("limit-point", "spring.0.stiffness.z", (0.5, 12.0), output_at=[4.0], **more)


# P′ = 0 along the curve, and its cusp where P″ = 0 as well: w = h, k = P = EA h²/L³.
def test_a_curve_has_the_points_and_the_cusp_of_the_closed_form(sprung):
    curve = curve_of(sprung)
    w, k = -curve["w"], curve["key"]
    assert curve["lambda"] == pytest.approx(load_at(w, k), abs=1e-8)
    assert 1e4 * (3 * w**2 - 6 * w + 2) / L3 + k == pytest.approx(0.0, abs=1e-8)
    assert len(curve) == len(w) > 10 and 4.0 in k and curve.value == 1.0 and curve.parameter == "spring.0.stiffness.z"
    (cusp,) = curve.cusps
    assert cusp.key == pytest.approx(1e4 / L3, rel=1e-10) and cusp.lam == pytest.approx(1e4 / L3, rel=1e-7)
    assert k[cusp.point] == cusp.key and np.isnan(curve["slope"][cusp.point]) and cusp.why == "the number turns"
    others = np.arange(len(k)) != cusp.point
    assert curve["slope"][others] == pytest.approx(w[others], abs=1e-6)  # dP/dk with w held
    begin, end = curve.ends
    assert (begin.kind, begin.point, end.kind, end.point) == ("begins", 0, "ends", len(k) - 1)
    assert {begin.reason, end.reason} == {"stop"} and "range" in begin.why and curve.crossings == ()
    at = int(np.flatnonzero(k == 4.0)[0])
    assert (curve["unstable_before"][at], curve["unstable_after"][at]) == (0.0, 1.0)


def test_a_run_with_the_number_of_a_point_has_the_event_there(sprung):
    curve = curve_of(sprung)
    limit = curve.deck_at(0).trace().events["limit-point"][0]
    assert limit.lam == pytest.approx(curve["lambda"][0], rel=1e-12)
    shape = curve.shape(0)
    assert shape.lam == curve["lambda"][0] and shape.members["a"].z[-1] == pytest.approx(1.0 + curve["w"][0], abs=1e-12)
    with pytest.raises(IndexError, match="there is no point"):
        curve.deck_at(len(curve))


# Byte for byte what the program writes, which keeps a checkpoint besides.
def test_a_curve_is_that_of_the_program(sprung, program, tmp_path):
    curve = curve_of(sprung)
    file = tmp_path / "bars.toml"
    file.write_text(str(sprung))
    deck = Deck.load(file)
    mine = curve_of(deck)
    table = program("curve", file, "--out", tmp_path / "program", "--set", mine.deck.assignments[0])
    mine.save(tmp_path / "python")
    names = sorted(one.name for one in (tmp_path / "python").iterdir())
    assert names == ["curve.csv", "curve.json", "report.html"]
    assert {one.name for one in (tmp_path / "program").iterdir()} == {*names, "checkpoint"}
    for name in names:
        assert (tmp_path / "program" / name).read_bytes() == (tmp_path / "python" / name).read_bytes(), name
    assert str(mine) == table and mine.report() == (tmp_path / "python" / "report.html").read_text()
    read = pd.read_csv(tmp_path / "python" / "curve.csv", float_precision="round_trip")
    assert [name.split(" ")[0] for name in read.columns] == ["point", *curve.columns]
    assert np.array_equal(read["lambda"], mine["lambda"]) and np.array_equal(read["lambda"], curve["lambda"])
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "letter.txt").write_text("dear")
    with pytest.raises(arcwall.FileError, match="is not empty"):
        mine.save(tmp_path / "other")
    deck.trace(max_points=3).save(tmp_path / "run")
    with pytest.raises(arcwall.FileError, match="is the folder of a run.*name another folder, or write over it with force=True"):
        mine.save(tmp_path / "run")


def test_a_curve_is_a_table_a_picture_and_a_pickle(sprung):
    curve = curve_of(sprung)
    assert list(curve.table.columns) == curve.columns and len(curve.table) == len(curve)
    assert not curve["lambda"].flags.writeable
    with pytest.raises(KeyError, match="no column; there are arc"):
        curve["lamda"]
    axes = curve.plot()
    assert axes.get_xlabel() == "spring.0.stiffness.z" and "λ" in axes.get_ylabel()
    lines = [line for line in axes.lines if line.get_linestyle() in ("-", "--", ":")]
    assert np.array_equal(np.concatenate([lines[0].get_xdata(), *(line.get_xdata()[1:] for line in lines[1:])]), curve["key"])
    assert len(axes.lines) - len(lines) == len(curve.specials) == 3
    assert curve.plot(x="w", y="key", ax=axes) is axes
    html = curve._repr_html_()
    assert "<svg" in html and "http" not in html
    assert "1 cusps" in repr(curve) and "limit-point 1" in repr(curve)
    for other in (pickle.loads(pickle.dumps(curve)), copy.deepcopy(curve)):
        assert np.array_equal(other["key"], curve["key"]) and other.specials == curve.specials and other.deck == curve.deck


def test_the_question_may_stand_in_the_deck(sprung):
    table = {"event": {"kind": "limit-point"}, "parameter": "spring.0.stiffness.z", "range": [0.5, 3.0], "output_at": [2.0]}
    deck = sprung.copy({"curve": table})
    curve = deck.curve()
    assert curve["key"][[0, -1]].tolist() == [0.5, 3.0] and 2.0 in curve["key"] and curve.number == 1
    second = deck.curve(number=2, range=(0.9, 1.1), output_at=[])
    assert second.number == 2 and second["key"][-1] == 1.1 and second["lambda"][0] < curve["lambda"][0]
    other = deck.curve(parameter="material.m.E", range=(0.9e4, 1.1e4))  # what the deck outputs at was another number's
    assert other["key"][0] == 0.9e4
    assert deck.worst(keys=["spring.0.stiffness.z"], radius=0.1).values["spring.0.stiffness.z"] == pytest.approx(0.9)
    assert deck["curve.range"] == [0.5, 3.0]  # the deck is as it was


def test_questions_that_are_wrong_are_refused(sprung):
    key = "spring.0.stiffness.z"
    for arguments, error, text in [
        ((), DeckError, "does not say which event is followed; give the event, the number"),
        (("limit-point",), DeckError, "nothing varies"),
        (("limit point", key, (0.5, 2.0)), DeckError, "limit-point"),
        (("limit-point", "spring.0.stifness.z", (0.5, 2.0)), DeckError, "did you mean"),
        (("limit-point", key), DeckError, "range.*is missing"),
        (("limit-point", key, (2.0, 3.0)), DeckError, "is outside"),
        (("limit-point", key, (2.0, 0.5)), DeckError, "no interval"),
        (("limit-point", key, 3.0), DeckError, "range"),
        (("limit-point", key, object()), TypeError, "a deck has no object"),
        (("contact-closes", key, (0.5, 2.0)), NoAnswer, "none of kind contact-closes"),
    ]:
        with pytest.raises(error, match=text):
            sprung.curve(*arguments)
    with pytest.raises(DeckError, match="does not say which event"):
        sprung.worst()
    with pytest.raises(NoAnswer, match="only 2 of kind limit-point, not 3"):
        sprung.curve("limit-point", key, (0.5, 2.0), number=3)
    with pytest.raises(DeckError, match="there is no key parameter; worst"):
        sprung.copy({"curve": {"event": {"kind": "limit-point"}, "worst": [key], "radius": 0.1}}).curve()


# λ depends on the sum of two springs: to lower it by a change of norm r both fall by r/√2.
def test_the_worst_combination_is_that_of_the_closed_form(bars, program, tmp_path):
    spring = {"at": "top", "stiffness": {"z": 1.0}}
    deck = bars.copy({"spring": [spring, {"at": "top", "stiffness": {"z": 2.0}}]})
    keys = ["spring.0.stiffness.z", "spring.1.stiffness.z"]
    worst = deck.worst("limit-point", keys, 0.5)
    falls = 0.5 / np.sqrt(2)
    assert list(worst.values.values()) == pytest.approx([1.0 - falls, 2.0 - falls], abs=1e-6)
    assert worst.own == dict(zip(keys, [1.0, 2.0])) and worst.radius == 0.5 and worst.settled and worst.runs >= 2
    k = 3.0 - 2 * falls
    assert worst.lam == pytest.approx(load_at(snap_depth(k), k), rel=1e-9)
    assert worst.own_lam == pytest.approx(load_at(snap_depth(3.0), 3.0), rel=1e-9)
    assert list(worst.slopes.values()) == pytest.approx([snap_depth(k)] * 2, rel=1e-6)
    assert worst.deck.trace().events["limit-point"][0].lam == pytest.approx(worst.lam, rel=1e-12)
    file = tmp_path / "bars.toml"
    file.write_text(str(deck))
    question = f'curve={{ event = {{ kind = "limit-point" }}, worst = {json.dumps(keys)}, radius = 0.5 }}'
    assert program("curve", file, "--set", question, "--out", tmp_path / "program") == str(worst)
    stored = json.loads((tmp_path / "program" / "curve.json").read_text())
    assert stored["lambda"] == worst.lam and {one["key"]: one["value"] for one in stored["worst"]} == worst.values


def test_an_interrupt_stops_a_curve(channel):
    deck = channel.copy({"member.column.elements": 400, "path.max_step": 1e-3, "path.step": 1e-3})
    threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        deck.curve("limit-point", "wall.upper.profile.z", (0.19, 0.21))


# --- searches ---------------------------------------------------------------------------------------------------------


def test_a_search_finds_the_other_states_of_the_closed_form(bars):
    more = {"path.search": True, "path.search_at": [1.0], "path.search_guesses": 10, "path.stop.event": "limit-point"}
    path = bars.copy(more).trace()
    (at,) = path.search
    assert at.lam == 1.0 and at.known == 1 and sum(at.outcomes.values()) == at.guesses >= 10
    assert [load_at(-found.monitors["w"]) for found in at.found] == pytest.approx([1.0, 1.0], abs=1e-9)
    assert sorted(found.unstable for found in at.found) == [0, 1]
    assert all(found.became == "traced" and path.branches[found.branches[0]].disconnected for found in at.found)
    assert not path.branches[0].disconnected and path.branches[1].origin is None
    assert bars.trace().search == ()


# --- jumps ---------------------------------------------------------------------------------------------------------


# From w = h (1 − 1/√3) the truss falls to h (1 + 2/√3) and releases 7.3888900263118; it comes back by the same.
def test_a_jump_is_that_of_the_closed_form(bars):
    path = bars.trace(jumps=True)
    snap = path.events["limit-point"][0]
    jump = snap.jump
    assert jump.reason is None and jump.lam == snap.lam and jump.unstable == 0 and jump.on_branch == 0
    assert jump.monitors["w"] == pytest.approx(-1 - 2 / np.sqrt(3), abs=1e-9)
    assert jump.energy_released == pytest.approx(7.3888900263118, abs=1e-9)
    assert jump.return_.lam == pytest.approx(-snap.lam, abs=1e-9) and jump.return_.kind == "limit-point"
    assert jump.return_.jump.monitors["w"] == pytest.approx(2 / np.sqrt(3) - 1, abs=1e-9)
    assert jump.energy_dissipated == pytest.approx(14.777780052624, abs=1e-9)
    assert jump.contacts == () and jump.contact_pattern == ""
    assert path.events["start"][0].jump is None  # which does not fall
    assert bars.trace(jumps=False).events["limit-point"][0].jump is None  # which was not asked


def test_jumps_are_found_when_every_branch_has_its_end(bars):
    path = bars.trace(jumps=True, max_points=8)
    assert not path.ended and all(event.jump is None for event in path.events)
    assert path.resume().events["limit-point"][0].jump is not None
    again = pickle.loads(pickle.dumps(path))
    assert again.events == path.events and again.events["limit-point"][0].jump.return_.jump is not None


# The column snaps off one wall and comes to rest between both.
def test_a_jump_among_walls_is_that_of_events_json(channel, program, tmp_path):
    program("run", EXAMPLES / "channel.toml", "--quiet", "--no-pictures", "--set", "path.jumps=true", "--out", tmp_path)
    stored = json.loads((tmp_path / "events.json").read_text())["events"]
    events = channel.trace(jumps=True).events
    assert [event.jump is not None for event in events] == ["jump" in event for event in stored]
    jump, wanted = next((e.jump, s["jump"]) for e, s in zip(events, stored) if "jump" in s)
    assert (jump.lam, jump.contact_pattern, jump.energy_released) == (wanted["lambda"], wanted["contact_pattern"], wanted["energy_released"])
    assert [vars(contact) for contact in jump.contacts] == wanted["contacts"] and len(jump.contacts) > 1
    assert jump.monitors == wanted["monitors"]


def test_the_branch_map_is_that_of_branches_json(bars, tmp_path):
    path = bars.trace(jumps=True)
    path.save(tmp_path / "run", pictures=False)
    stored, found = json.loads((tmp_path / "run" / "branches.json").read_text()), path.branch_map
    assert [(one.lam[0], one.unstable) for one in found.segments] == [(s["lambda"][0], s["unstable"]) for s in stored["segments"]]
    assert [(one.kind, one.start, one.end) for one in found.edges] == [(e["kind"], e["from"], e["to"]) for e in stored["edges"]]
    assert [list(one.states) for one in found.ranges] == [one["states"] for one in stored["ranges"]]
    snap = path.events["limit-point"][0]  # the segment that ends there is stable, the next one is not
    assert (snap.extremum, found.segments[0].lam[1], found.segments[0].unstable) == ("maximum", snap.lam, 0)
    assert found.segments[1].unstable == 1 and "jump" in {one.kind for one in found.edges}


def test_a_jump_that_was_not_found_says_why():
    jump = arcwall.events._jump_of({"lambda": 2.0, "reason": "no_equilibrium", "why": "nothing holds it"})
    assert (jump.lam, jump.reason, jump.why) == (2.0, "no_equilibrium", "nothing holds it")
    assert jump.energy_released is None and jump.return_ is None and jump.monitors == {} and jump.contacts == ()
