"""Paths of decks with friction: contacts, events and the work of loops."""

import math

import pytest

from arcwall import Deck

# A block of weight 1 on a spring of stiffness 21, dragged to and fro on a floor, μ = 0.3.
BLOCK = """
title = "Block"
[material.m]
E = 210.0
[section.s]
shape = "general"
A = 1.0
I = 1.0
[point]
A = [0.0, 0.0]
B = [10.0, 0.0]
[member]
bar = { from = "A", to = "B", theory = "truss", strain = "engineering", material = "m", section = "s", elements = 1 }
[support]
A = ["z"]
[[prescribed]]
at = "A"
x = 1.0
[[load]]
at = "B"
force = [0.0, -1.0]
constant = true
[[wall]]
name = "floor"
side = "below"
contact_surface = "axis"
profile = { type = "flat", z = 0.0 }
friction = 0.3
[[stage]]
name = "out"
drives = ["prescribed.0"]
step = 0.005
stop = { lambda = [-1.0, 0.05] }
[[stage]]
name = "back"
drives = ["prescribed.0"]
step = -0.005
stop = { lambda = [-0.1, 1.0] }
[[stage]]
name = "again"
drives = ["prescribed.0"]
step = 0.005
stop = { lambda = [-1.0, 0.1] }
"""
SLIP = 0.3 / 21.0


@pytest.fixture
def block(tmp_path):
    file = tmp_path / "block.toml"
    file.write_text(BLOCK)
    return Deck.load(file).trace()


def test_a_slip_tells_its_contact_and_forces(block):
    slip = block.events["contact-slips"][0]
    assert slip.lam == pytest.approx(SLIP, abs=1e-12)
    assert (slip.contact.wall, slip.contact.state, slip.sense) == ("floor", "slip+", 1)
    assert slip.T == pytest.approx(-0.3) and slip.p == pytest.approx(1.0)
    assert [event.branch for event in block.events["reversal"]] == [1, 2]
    assert block.events["start"][0].contact is None and block.events["start"][0].T is None


def test_a_loop_dissipates_its_work(block):
    assert block.loop_work("out", "out") == pytest.approx(0.3 * (0.05 - SLIP), abs=1e-14)
    assert block.loop_work("back", "again") == pytest.approx(4 * 0.3 * (0.05 - SLIP), abs=1e-13)
    assert all(b >= a for a, b in zip(block["dissipation"], block["dissipation"][1:]))
    with pytest.raises(ValueError, match="no points of a load step 'forth'"):
        block.loop_work("out", "forth")
    with pytest.raises(ValueError, match="comes before"):
        block.loop_work("again", "out")


def test_contacts_are_a_table_with_their_states(block):
    contacts = block.contacts
    assert list(contacts.columns[-4:]) == ["friction", "state", "slip", "anchor"]
    assert set(contacts["state"]) == {"stick", "slip+", "slip-"}
    slipping = contacts[contacts["state"] != "stick"]
    assert len(slipping) == block["slipping"].sum()
    assert (abs(slipping["friction"]) - 0.3).abs().max() < 1e-12
    assert math.isnan(slipping["anchor"].astype(float).iloc[0])


def test_a_path_without_friction_has_no_loops(truss):
    path = truss.trace()
    assert "dissipation" not in path.columns
    with pytest.raises(ValueError, match="no friction"):
        path.loop_work("a", "b")
