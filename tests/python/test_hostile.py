"""What nobody should do: each is an exception of Python that says what and where, never a crash."""

import copy
import gc
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from conftest import EXAMPLES, SANITIZED

import arcwall
from arcwall import Deck, DeckError


def long_deck():
    """A deck whose path takes seconds: small steps, many points."""
    return Deck.load(EXAMPLES / "channel.toml").copy(
        {"path.max_step": 2e-4, "path.max_points": 1000000, "member.column.elements": 400, "path.step": 1e-3}
    )


@pytest.mark.parametrize("content", [None, 3, [], "deck.toml", b"x"])
def test_decks_of_odd_content_are_refused(content):
    if content is None:
        assert Deck().check()  # an empty deck is wrong, and says so
    else:
        with pytest.raises(TypeError, match="Deck\\(\\) takes a dict"):
            Deck(content)


def test_bytes_that_are_no_text_are_refused():
    for text in (b"\xff\xfe", b"a = \"\xff\"", b"\x00", "a = 1\n\x00"):
        with pytest.raises(DeckError):
            Deck.parse(text)
    with pytest.raises(TypeError, match="takes a text"):
        Deck.parse(None)


def test_keys_of_other_types_are_refused(channel):
    for key in (None, 3, ("a", "b"), b"title"):
        with pytest.raises(TypeError, match="asked by texts"):
            channel[key]
        with pytest.raises(TypeError, match="asked by texts"):
            channel[key] = 1
    for key in ("", "title=1", "a\nb", "[path]"):
        with pytest.raises(KeyError, match="no key of a deck"):
            channel[key] = 1
    with pytest.raises(KeyError):
        channel["."]
    for value in (None, object(), {1: 2}, [None]):
        with pytest.raises(TypeError):
            channel["title"] = value
    assert channel.check() == []


def test_values_that_are_no_numbers_are_diagnosed(channel):
    for value in (float("nan"), float("inf"), -1.0, "two", [1.0], True, 10**30):
        deck = channel.copy()
        try:
            deck["material.steel.E"] = value
        except DeckError:  # more than TOML's whole numbers hold
            assert value == 10**30
            continue
        assert deck.check(), value


def test_what_is_asked_by_names_is_no_list(channel):
    path = channel.trace(max_points=2)
    for mapping in (channel, path):
        with pytest.raises(TypeError, match="not iterable"):
            list(mapping)
    with pytest.raises(TypeError, match="asked for columns by their names"):
        path[0]


def test_deep_values_are_refused(channel):
    deep = []
    for _ in range(5000):
        deep = [deep]
    with pytest.raises((DeckError, RecursionError)):
        channel["title"] = deep


def test_points_of_odd_numbers_are_refused(channel):
    path = channel.trace()
    for point in (len(path), -len(path) - 1, 10**30):
        with pytest.raises(IndexError, match="there is no point"):
            path.shape(point)
    for point in ("1", 1.5, None):
        with pytest.raises((TypeError, AttributeError)):
            path.shape(point)


def test_a_path_without_points_is_one(channel):
    path = channel.tracing().path
    assert len(path) == 0 and len(path.events) == 0 and path.branches == () and path.table.empty
    assert "0 points" in repr(path)
    with pytest.raises(ValueError, match="without points"):
        path.save("/nowhere")
    with pytest.raises(IndexError):
        path.shape(0)


def test_arrays_of_a_path_cannot_be_written(channel):
    path = channel.trace()
    with pytest.raises(ValueError):
        path["lambda"][0] = 1.0
    with pytest.raises(ValueError):
        path.state(0).x[0] = 1.0


def test_arrays_outlive_their_path(channel):
    path = channel.trace()
    arrays, shape = [path[name] for name in ("lambda", "mid", "branch")], path.shape(5)
    kept = [array.copy() for array in arrays]
    del path
    gc.collect()
    assert all(np.array_equal(a, b) for a, b in zip(arrays, kept)) and shape.members["column"].x.size


def test_engine_objects_cannot_be_made_without_their_content():
    for make in (arcwall._engine.Run, arcwall._engine.SystemRun):
        with pytest.raises(TypeError):
            make()
    with pytest.raises(AttributeError):
        len(arcwall.Path.__new__(arcwall.Path))


def test_pickles_that_were_cut_are_refused(channel):
    path = channel.trace(max_points=3)
    make, (deck_of, checkpoint) = path.__reduce__()
    for bytes_of in (b"", checkpoint[:-1], checkpoint[: len(checkpoint) // 2], checkpoint[:100] + b"x" + checkpoint[101:]):
        with pytest.raises(arcwall.FileError):
            make(deck_of, bytes_of)


def test_a_path_is_traced_by_one_thread_at_a_time():
    path = long_deck().tracing().path
    thread = threading.Thread(target=path.resume, kwargs={"max_seconds": 0.5})
    thread.start()
    refused = 0
    while thread.is_alive():
        for use in (lambda: len(path), path.resume, lambda: path["lambda"], lambda: copy.copy(path), lambda: path.save("/x")):
            try:
                use()
            except RuntimeError as error:
                assert "another thread" in str(error)
                refused += 1
            except (ValueError, arcwall.FileError):
                assert not thread.is_alive() or len(path) == 0
        time.sleep(0.01)
    thread.join()
    assert refused > 5 and len(path) > 0


def test_other_threads_run_while_a_path_is_traced():
    path = long_deck().tracing().path
    thread = threading.Thread(target=path.resume, kwargs={"max_seconds": 1.0})
    thread.start()
    count = 0
    while thread.is_alive():
        time.sleep(0.001)
        count += 1
    assert count > 10  # some 1000 where the lock is free, also on a busy machine; a few where it is kept


# Ctrl-C: KeyboardInterrupt within moments, and what was traced stands and can go on.
def test_an_interrupt_stops_a_path_between_points():
    path = long_deck().tracing().path
    timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        path.resume(max_seconds=20)
    assert time.monotonic() - begin < 5.0
    size = len(path)
    assert size > 0 and not path.ended
    assert len(path.resume(max_points=2)) == size + 2


def test_an_interrupt_stops_a_study_of_meshes():
    threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        long_deck().converge()


# Each in a child: a crash of it would be seen by its status.
@pytest.mark.parametrize("forget", ["deck", "path", "tracing"])
def test_ends_of_processes_are_clean(forget):
    script = f"""
import arcwall, sys
deck = arcwall.Deck.load({str(EXAMPLES / "channel.toml")!r})
tracing = deck.tracing()
next(tracing)
path = tracing.path
kept = dict(deck=deck, path=path, tracing=tracing)
del deck, path, tracing
del kept[{forget!r}]
sys.modules["kept"] = kept
"""
    assert subprocess.run([sys.executable, "-c", script]).returncode == 0


def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


# One process, many traces: what is resident after the first of them is what is there after all.
@pytest.mark.skipif(SANITIZED, reason="the sanitizer keeps what is freed")
def test_memory_is_flat(channel):
    deck = channel.copy({"member.column.elements": 8, "path.max_points": 12})

    def traces(count):
        for _ in range(count):
            path = deck.trace()
            path["lambda"], path.events
        gc.collect()

    traces(200)
    before = resident()
    traces(1000)
    assert resident() - before < 1 << 20


@pytest.mark.skipif(SANITIZED, reason="the sanitizer keeps what is freed")
def test_memory_is_flat_where_systems_raise():
    class Fold:
        def residual(self, x, lam):
            if lam > self.end:
                raise KeyError("beyond")
            return x * x + lam

        def jacobian(self, x, lam):
            return [[2 * x[0]]]

        def dlam(self, x, lam):
            return [1.0]

    def traces(count):
        for i in range(count):
            system = Fold()
            system.end = -0.5 if i % 2 else 1.0
            try:
                assert arcwall.trace(system, [1.0], -1.0, stop={"lambda": (-2, 1)}).events
            except KeyError as error:
                assert len(error.arcwall_path)
        gc.collect()

    traces(100)
    before = resident()
    traces(300)
    assert resident() - before < 1 << 20
