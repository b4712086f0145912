"""The page of a deck with sliders, from Python."""

import json
import os
import pathlib
import signal
import subprocess
import sys
import time
import urllib.error
import urllib.request

import pytest

import arcwall


def answer(address, path="", body=None):
    with urllib.request.urlopen(urllib.request.Request(address + path, data=body), timeout=60) as response:
        return response.read().decode()


def test_page_has_the_deck_and_traces_it(channel):
    with arcwall.explore(channel, browser=False) as page:
        assert page.is_open
        assert "<title>" in answer(page.address)
        deck = json.loads(answer(page.address, "deck"))
        assert deck == {"file": channel.name, "text": pathlib.Path(channel.name).read_text()}
        last = json.loads(answer(page.address, "trace", deck["text"].encode()).splitlines()[-1])
        limit = channel.trace().events["limit-point"][0]
        assert f"{limit.lam:.6f}"[:7] in last["page"]
        with pytest.raises(urllib.error.HTTPError, match="403"):
            answer(page.address[:-2] + "x/")
    assert not page.is_open
    with pytest.raises(urllib.error.URLError):
        answer(page.address)


def test_values_that_were_set_are_in_the_text(channel):
    changed = channel.copy({"wall.upper.profile.z": 0.23})
    with arcwall.explore(changed, browser=False) as page:
        text = json.loads(answer(page.address, "deck"))["text"]
    assert arcwall.Deck.parse(text)["wall.upper.profile.z"] == 0.23


def test_browser_is_given_the_address(channel, monkeypatch):
    opened = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    with arcwall.explore(channel.name) as page:
        assert opened == [page.address]
        assert page.address in page._repr_html_()
    assert "closed" in repr(page)


def test_unreadable_files_are_refused():
    with pytest.raises(arcwall.DeckError):
        arcwall.explore("no-such-deck.toml", browser=False)


def test_process_ends_with_its_kernel(channel):
    script = f"import arcwall, time; print(arcwall.explore({channel.name!r}, browser=False).address, flush=True); time.sleep(60)"
    kernel = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
    address = kernel.stdout.readline().strip()
    assert "<title>" in answer(address)
    os.kill(kernel.pid, signal.SIGKILL)
    kernel.wait()
    kernel.stdout.close()
    for _ in range(200):
        try:
            answer(address)
        except OSError:
            return
        time.sleep(0.05)
    pytest.fail("the page is still served")
