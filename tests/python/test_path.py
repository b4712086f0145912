"""Paths of decks: tables, events, shapes, run folders, and that they are those of the program."""

import copy
import json
import math
import pickle
import subprocess
import sys
import threading

import numpy as np
import pandas as pd
import pytest
from conftest import EXAMPLES

import arcwall
from arcwall import Deck, FileError, NoStart

DECKS = sorted(file.stem for file in EXAMPLES.glob("*.toml") if not file.stem.startswith("sweep"))


# Every file of a run but result.json, which has times, and the pictures: path.csv has each number to the last bit, and so
# has the checkpoint, states and tangents included.
@pytest.mark.parametrize("name", DECKS)
def test_a_run_folder_is_that_of_the_program_to_the_last_bit(name, program, tmp_path):
    file = EXAMPLES / f"{name}.toml"
    program("run", file, "--quiet", "--no-pictures", "--out", tmp_path / "program")
    path = Deck.load(file).trace()
    path.save(tmp_path / "python", pictures=False)
    files = sorted(one.name for one in (tmp_path / "program").iterdir())
    assert files == sorted(one.name for one in (tmp_path / "python").iterdir())
    for one in files:
        if one != "result.json":
            assert (tmp_path / "program" / one).read_bytes() == (tmp_path / "python" / one).read_bytes(), one
    table = pd.read_csv(tmp_path / "program" / "path.csv", float_precision="round_trip")
    assert np.array_equal(path["lambda"], table["lambda"])
    assert np.array_equal(path["unstable"], table["unstable"].astype(float), equal_nan=True)


def test_events_are_those_of_events_json(channel, program, tmp_path):
    program("run", EXAMPLES / "channel.toml", "--quiet", "--no-pictures", "--out", tmp_path)
    stored = json.loads((tmp_path / "events.json").read_text())["events"]
    events = channel.trace().events
    assert [(e.kind, e.lam, e.step, dict(e.monitors)) for e in events] == [
        (e["kind"], e["lambda"], e["step"], e["monitors"]) for e in stored
    ]
    closes = events["contact-closes"][0]
    assert closes.contacts[0].wall == stored[1]["contact"][0]["wall"]
    assert closes.contacts[0].x == stored[1]["contact"][0]["x"]
    assert events[-1].kind == "end" and events[-1].end.reason == "stop"
    with pytest.raises(KeyError, match="no kind of event"):
        events["limit point"]
    with pytest.raises(IndexError, match="there is no event 1; the path has 1 of kind limit-point"):
        events["limit-point"][1]
    with pytest.raises(IndexError, match="there is no event -8; the path has 7"):
        events[-8]
    with pytest.raises(TypeError):
        events[1.0]
    table = events.table
    assert list(table["lambda"]) == [event.lam for event in events] and list(table["mid"]) == [e["monitors"]["mid"] for e in stored]
    assert list(events["branch-point"].table.columns)[:6] == list(table.columns)[:6] and len(events["branch-point"].table) == 0


def test_the_table_has_a_row_a_point(channel):
    path = channel.trace()
    table = path.table
    assert list(table.columns[:6]) == ["branch", "step", "arc", "lambda", "mid", "shortening"]
    assert len(table) == len(path) == len(path["mid"]) == len(path.points)
    assert path.monitors == {"mid": "cm", "shortening": "cm"}
    assert path["lambda"] is path["lambda"] and not path["lambda"].flags.writeable
    table.loc[0, "lambda"] = 7.0  # the reader's own
    assert path["lambda"][0] == 0.0
    for event in path.events:
        assert path["lambda"][event.point] == event.lam and path.points[event.point].lam == event.lam
    with pytest.raises(KeyError, match="no column; there are branch"):
        path["midd"]


def test_points_carry_their_contacts(channel):
    path = channel.trace()
    last = path.points[-1]
    assert len(last.contacts) == path["contacts"][-1] == 3
    # Equilibrium across the column: two forces from above hold one from below, to the forces of the supports.
    assert {contact.wall for contact in last.contacts} == {"upper", "lower"}
    assert all(contact.force > 0.0 for contact in last.contacts)


def test_a_path_is_traced_a_point_at_a_time(channel):
    whole = channel.trace()
    tracing = channel.tracing()
    seen = []
    for point in tracing:
        seen.append(point.lam)
        if point.index == 9:
            break
    path = tracing.path
    assert len(path) == 10 and not path.ended and path.branches[0].end is None
    first = path["lambda"]
    for point in tracing:  # goes on where it was
        seen.append(point.lam)
    assert np.array_equal(seen, whole["lambda"])
    assert len(first) == 10 and len(path["lambda"]) == len(whole)
    assert path.ended and path.events == whole.events
    assert next(tracing, None) is None


def test_objects_are_shown_in_a_line(channel):
    path = channel.trace(max_points=3)
    start = path.events[0]
    assert repr(start).startswith("Event(id=0, kind='start', branch=0") and "jump" not in repr(start)
    assert eval(repr(start), {"Event": arcwall.Event}) == start
    assert repr(path.points) == "<3 points of a path>" and "3 points" in repr(path.tracing())
    assert len(repr(path.shape(0))) < 400


def test_a_limit_of_points_ends_a_call_alone(channel):
    path = channel.trace(max_points=7)
    assert len(path) == 7 and not path.ended
    assert len(path.resume(max_points=0)) == 7
    assert len(path.resume(max_seconds=1e-9)) == 8
    path.resume()
    assert np.array_equal(path["lambda"], channel.trace()["lambda"])
    assert len(path.resume()) == len(path)
    with pytest.raises(ValueError, match="negative"):
        path.resume(max_points=-1)
    for seconds in (-1.0, math.nan):
        with pytest.raises(ValueError, match="is no time"):
            path.resume(max_seconds=seconds)


def test_a_path_that_was_stopped_is_saved_loaded_and_goes_on(channel, program, tmp_path):
    whole = channel.trace()
    path = channel.trace(max_points=12)
    path.save(tmp_path / "run")
    assert not path.ended  # saving has not ended it
    loaded = arcwall.load(tmp_path / "run")
    assert len(loaded) == 12 and loaded.deck == channel
    assert np.array_equal(loaded.resume()["lambda"], whole["lambda"])
    assert np.array_equal(path.resume()["lambda"], whole["lambda"])
    program("resume", tmp_path / "run", "--quiet")
    assert np.array_equal(arcwall.load(tmp_path / "run")["lambda"], whole["lambda"])
    program("verify", tmp_path / "run")


def test_run_folders_of_others_are_left_alone(channel, tmp_path):
    (tmp_path / "letter.txt").write_text("dear")
    with pytest.raises(FileError, match="is not empty.*name another folder, or write over it with force=True"):
        channel.trace(max_points=2).save(tmp_path)
    channel.trace(max_points=2).save(tmp_path, force=True, pictures=False)
    with pytest.raises(OSError, match="there is no such folder"):
        arcwall.load(tmp_path / "none")
    (tmp_path / "checkpoint").write_bytes(b"nonsense")
    with pytest.raises(FileError):
        arcwall.load(tmp_path)


# Along a member in equilibrium between supports and walls: N and M jump at contacts alone, and the moment vanishes at
# pinned ends.
def test_shapes_have_the_members_the_contacts_and_the_walls(channel):
    path = channel.trace()
    shape = path.shape(-1)
    column = shape.members["column"]
    assert column.x.shape == column.moment.shape and column.fraction[0] == 0.0 and column.fraction[-1] == 1.0
    assert np.all(np.diff(column.fraction) >= 0.0)
    middle = np.argmin(abs(column.fraction - 0.5))
    assert column.z[middle] == pytest.approx(path["mid"][-1], abs=1e-12)
    assert abs(column.moment[[0, -1]]).max() < 1e-9 * abs(column.moment).max()
    assert column.ux[-1] == pytest.approx(-path["shortening"][-1], abs=1e-12)
    assert [mark.wall for mark in shape.contacts] == ["upper", "lower", "upper"]
    assert np.allclose(shape.walls["upper"].z, 0.2) and shape.walls["upper"].side == "above"
    with pytest.raises(IndexError, match="there is no point 99"):
        path.shape(99)


def test_states_are_copies(channel):
    path = channel.trace()
    state = path.state(-1)
    assert state.lam == path["lambda"][-1] and state.closed.sum() == path["contacts"][-1]
    assert not state.x.flags.writeable


def test_branches_say_where_they_leave():
    path = Deck.load(EXAMPLES / "portal.toml").copy({"path.branches": "all", "path.depth": 1}).trace()
    assert len(path.branches) == 3
    branch = path.branches[1]
    origin = path.events[branch.origin]
    assert branch.parent == origin.branch and branch.id in origin.branches
    assert origin.type == "pitchfork" and set(origin.mode) == set(path.monitors)
    assert sum(one.points for one in path.branches) == len(path)


# Differences of decks that are run again with other values, of fourth order.
def test_sensitivities_are_slopes_of_decks_that_are_run_again(truss):
    key = "material.bar.E"
    event = truss.trace(sensitivity=[key]).events["limit-point"][0]
    slope, E = event.sensitivity[key], truss[key]
    at = {k: truss.copy({key: E * (1 + k * 1e-3)}).trace().events["limit-point"][0].lam for k in (-2, -1, 1, 2)}
    assert slope == pytest.approx((at[-2] - 8 * at[-1] + 8 * at[1] - at[2]) / (12e-3 * E), rel=1e-8)


def test_meshes_are_compared(channel, program, tmp_path):
    deck = channel.copy({"member.column.elements": 20})
    study = deck.trace(max_points=1).converge()
    program("converge", EXAMPLES / "channel.toml", "--set", "member.column.elements=20", "--quiet", "--out", tmp_path)
    stored = json.loads((tmp_path / "convergence.json").read_text())
    assert study.json == stored and str(study) == (tmp_path / "convergence.txt").read_text()
    limit = next(event for event in study.events if event.kind == "limit-point")
    assert limit.lam == tuple(stored["events"][2]["lambda"]) and limit.error > 0.0
    assert list(study.table["kind"]) == [event["kind"] for event in stored["events"]]
    with pytest.raises(ValueError, match="levels = 1"):
        deck.converge(levels=1)


def test_paths_are_pickled_and_copied_with_what_is_needed_to_go_on(channel):
    whole = channel.trace()
    part = channel.trace(max_points=20)
    for other in (pickle.loads(pickle.dumps(part)), copy.copy(part), copy.deepcopy(part)):
        assert np.array_equal(other["lambda"], part["lambda"]) and len(other) == 20
        assert np.array_equal(other.resume()["lambda"], whole["lambda"])
        assert len(part) == 20
    assert pickle.loads(pickle.dumps(whole)).events == whole.events
    begun = channel.tracing().path
    assert len(copy.copy(begun).resume(max_points=3)) == 3


def test_a_deck_without_a_start_says_so(channel):
    deck = channel.copy({"load": [{"at": "right", "force": [-1.0, 0.0]}, {"at": "right", "force": [-1e9, 0.0], "constant": True}]})
    with pytest.raises(NoStart, match="no equilibrium"):
        deck.trace()


def test_a_path_outlives_its_deck(channel):
    path = channel.trace()
    before = path["lambda"].copy()
    channel["material.steel.E"] = 1.0
    del channel
    assert np.array_equal(path["lambda"], before)
    assert path.deck["material.steel.E"] == 2.1e4 and path.shape(3).members


# Threads share no state: two decks, traced at once, are as alone.
def test_two_threads_trace_two_decks_at_once(channel):
    decks = [channel, Deck.load(EXAMPLES / "lee.toml")]
    alone = [deck.trace() for deck in decks]
    together = [None, None]

    def trace(which):
        for _ in range(5):
            together[which] = decks[which].trace()

    threads = [threading.Thread(target=trace, args=(which,)) for which in (0, 1)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for one, other in zip(alone, together):
        assert np.array_equal(one["lambda"], other["lambda"]) and one.events == other.events


def test_the_curve_of_the_report_is_self_contained(channel):
    html = channel.trace()._repr_html_()
    assert "<svg" in html and "limit point" in html and "http" not in html and len(html) < 20000
    assert "points" in channel.tracing().path._repr_html_()


# A process that imports the package: its signals, locale and number of threads are what they were.
def test_importing_changes_nothing_of_the_process():
    script = """
import gc, locale, os, signal, threading
def settings():
    status = dict(line.split(":", 1) for line in open("/proc/self/status"))
    return ([signal.getsignal(s) for s in signal.valid_signals()], status["SigIgn"], status["SigCgt"], status["SigBlk"],
            locale.setlocale(locale.LC_ALL), threading.active_count(), status["Threads"], dict(os.environ), gc.isenabled(),
            os.getcwd(), os.umask(0o22))
os.umask(0o22)
before = settings()
import arcwall
arcwall.Deck.load(DECK).trace().save(FOLDER)
after = settings()
assert before == after, (before, after)
"""
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        head = f"DECK, FOLDER = {str(EXAMPLES / 'truss.toml')!r}, {folder + '/run'!r}\n"
        subprocess.run([sys.executable, "-c", head + script], check=True)


def test_nothing_but_numpy_is_needed_to_import():
    script = "import sys, arcwall; print([m for m in ('pandas', 'matplotlib', 'scipy') if m in sys.modules])"
    assert subprocess.run([sys.executable, "-c", script], check=True, capture_output=True, text=True).stdout.strip() == "[]"


def test_numbers_are_finite_where_the_deck_is(channel):
    path = channel.trace()
    assert all(math.isfinite(value) for value in path["energy"])
    assert path.table["event"].notna().sum() == len({event.point for event in path.events})
