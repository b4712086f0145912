"""Decks: reading, values, copies, diagnostics."""

import copy
import pickle

import numpy as np
import pytest
from conftest import EXAMPLES

import arcwall
from arcwall import Deck, DeckError, toml


def test_values_are_read_by_the_names_of_set(channel):
    assert channel["material.steel.E"] == 2.1e4
    assert channel["wall.upper.profile.z"] == 0.2
    assert channel["wall.1.name"] == "lower"
    assert channel["load.0.force"] == [-1.0, 0.0]
    assert channel["load.0.force.0"] == -1.0
    assert channel["member.column"]["elements"] == 40


def test_what_the_deck_leaves_out_has_its_default(channel):
    assert channel["path.method"] == "spherical"
    assert channel["path.max_points"] == 5000
    assert channel["contact.method"] == "multiplier"


def test_a_key_that_is_not_there_names_the_nearest(channel):
    with pytest.raises(KeyError, match='did you mean "upper"'):
        channel["wall.uper.profile.z"]
    with pytest.raises(KeyError, match='names nothing: there is no "points" in contact\'$'):
        channel["contact.points"]
    assert "wall.uper" not in channel
    assert "wall.upper" in channel


def test_setting_a_value_is_what_set_does(channel, program, tmp_path):
    channel["wall.upper.profile.z"] = np.float64(0.25)
    channel["member.column.elements"] = np.int64(20)
    program("run", EXAMPLES / "channel.toml", "--set", "wall.upper.profile.z=0.25", "--set", "member.column.elements=20",
            "--no-pictures", "--out", tmp_path / "run")  # fmt: skip
    assert str(channel) == (tmp_path / "run" / "deck.toml").read_text()


# A deck that is varied in place many times stays as long as it was.
def test_what_was_set_before_is_not_kept(channel):
    for z in (0.21, 0.22, 0.23):
        channel["wall.upper.profile.z"] = z
    assert channel.assignments == ["wall.upper.profile.z=0.23"]
    channel["load"] = [{"at": "right", "force": [-1.0, 0.0]}]
    channel["load.0.constant"] = False
    channel["load"] = [{"at": "right", "force": [-2.0, 0.0]}]
    assert channel["load"] == [{"at": "right", "force": [-2.0, 0.0]}] and channel.check() == []
    deck = channel.copy({"curve": {"event": {"kind": "limit-point"}}, "curve.parameter": "material.steel.E"})
    deck["curve"] = {"event": {"kind": "branch-point"}, "parameter": "material.steel.E", "range": [1.0, 1e5]}
    assert deck["curve.event.kind"] == "branch-point" and deck["curve.range"] == [1.0, 1e5]


def test_values_of_every_kind_come_back(channel):
    for key, value in {
        "title": 'a "title" with \\ and\ttab, ü',
        "path.stop": {"lambda": [-0.5, 2.0]},
        "path.step": 0.1 + 0.2,
        "contact.points": "nodes",
        "load": [{"at": "right", "force": np.array([-2.0, 0.0])}],
        "load.0.constant": False,
    }.items():
        channel[key] = value
        got = channel[key]
        assert np.array_equal(got[0]["force"], [-2.0, 0.0]) if key == "load" else got == value
    assert channel.check() == []


def test_a_dict_makes_the_deck_of_its_text(channel):
    made = Deck(channel.to_dict(), name="channel.toml")
    assert made == channel
    assert np.array_equal(made.trace()["lambda"], channel.trace()["lambda"])


def test_a_document_of_toml_is_read_as_it_was_written():
    content = {"a": 1, "b": {"c d": [1.5, float("inf")], "e": {"f": "x\ny"}}, "g": [{"h": True}, {"h": False, "i": {"j": []}}]}
    assert Deck.parse(toml.document(content)).to_dict() == content


def test_toml_has_no_other_values():
    for value in (None, {1, 2}, b"bytes", 1j, object()):
        with pytest.raises(TypeError, match="a deck has no"):
            toml.value(value)


def test_a_written_deck_reads_as_the_same(channel):
    again = Deck.parse(str(channel), name="channel.toml")
    assert again == channel and str(again) == str(channel)
    assert channel != channel.copy({"material.steel.E": 2.0e4})


def test_copies_share_nothing(channel):
    for other in (channel.copy(), copy.copy(channel), copy.deepcopy(channel), pickle.loads(pickle.dumps(channel))):
        other["material.steel.E"] = 1.0e4
        assert channel["material.steel.E"] == 2.1e4
        assert other["material.steel.E"] == 1.0e4


def test_updates_are_made_wholly_or_not_at_all(channel):
    with pytest.raises(DeckError):
        channel.update({"material.steel.E": 1.0e4, "wall.none.profile.z": 1.0})
    assert channel["material.steel.E"] == 2.1e4


def test_check_lists_all_that_is_wrong_as_objects(channel):
    channel["material.steel.E"] = -1.0
    channel["member.column.elements"] = "many"
    channel["load.0.at"] = "nowhere"
    found = channel.check()
    assert {one.key for one in found} >= {"material.steel.E", "member.column.elements"}
    assert all(one.message and one.text == str(one) for one in found)
    with pytest.raises(DeckError) as error:
        channel.trace()
    assert error.value.diagnostics[0] == found[0]
    assert isinstance(error.value, (ValueError, arcwall.ArcwallError))
    assert str(error.value).splitlines()[0] == str(found[0])


def test_diagnostics_name_line_and_column():
    deck = Deck.parse((EXAMPLES / "truss.toml").read_text().replace("[path]", "[pahs]"), name="mine.toml")
    one = deck.check()[0]
    assert one.file == "mine.toml" and one.line > 10 and one.column > 0
    assert "[path]" in one.cure


def test_a_text_that_is_no_toml_is_refused_at_once():
    with pytest.raises(DeckError, match="not valid TOML|quotes") as error:
        Deck.parse("title = Buckling\n")
    assert error.value.diagnostics[0].line == 1
    with pytest.raises(DeckError, match="there is no such file"):
        Deck.load("/nowhere/deck.toml")


def test_warnings_are_sentences(truss):
    truss["path.stop"] = {}
    truss["path.max_points"] = 5000
    assert isinstance(truss.warnings(), list)


def test_variables_and_formulas(channel):
    walls = {"wall.upper.profile.z": "gap / 2", "wall.lower.profile.z": "-gap / 2"}
    deck = channel.copy({"variables": {"gap": 0.4}, **walls})
    assert deck.check() == []
    assert deck["gap"] == deck["variables.gap"] == 0.4
    assert deck["wall.upper.profile.z"] == "gap / 2"
    deck["gap"] = 0.5
    assert deck["variables.gap"] == 0.5
    assert 'z = "gap / 2"' in str(deck) and "gap = 0.5" in str(deck)
    deck["wall.upper.profile.z"] = "gapp / 2"
    assert "did you mean gap?" in str(deck.check()[0])
