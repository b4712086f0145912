"""Load steps that grip a point, and members that taper: as the program has them, and against runs with other values."""

import pandas as pd
import pytest

from arcwall import Deck

# A cantilever that a force bends, gripped at its end where it is then, and drawn on.
GRIP = """
title = "Gripped cantilever"
material.m = { E = 1.0 }
section.s = { shape = "general", A = 1e6, I = 1.0 }
point = { a = [0.0, 0.0], b = [1.0, 0.0] }
support = { a = ["x", "z", "rotation"] }
load = [{ at = "b", force = [0.0, -1.0] }]
prescribed = [{ at = "b", z = -1.0, from = "stage" }]
monitor = [{ name = "z", at = "b", component = "z" }, { name = "R", at = "b", component = "reaction-z" }]
member.m = { from = "a", to = "b", theory = "elastica", elements = 10, material = "m", section = "s" }
[[stage]]
name = "bend"
drives = ["load.0"]
step = 0.2
stop = { lambda = [-1.0, 2.0] }
[[stage]]
name = "draw"
drives = ["prescribed.0"]
step = 0.02
stop = { lambda = [-1.0, 0.1] }
"""

# A column that gets narrower towards its free end.
COLUMN = """
title = "A column that tapers"
material.m = { E = 1.0e9 }
section.s = { shape = "rectangle", width = 0.12, width_to = 0.06, height = 0.01, height_to = 0.008 }
point = { clamp = [0.0, 0.0], tip = [10.0, 0.0] }
support = { clamp = ["x", "z", "rotation"] }
load = [{ at = "tip", force = [-1.0, 0.0] }]
path = { step = 0.02, branches = "primary", stop = { event = "branch-point", lambda = [-0.1, 1.0] } }
member.s = { from = "clamp", to = "tip", theory = "elastica", elements = 12, material = "m", section = "s" }
"""


def test_a_grip_is_that_of_the_program_and_is_verified(program, tmp_path):
    file = tmp_path / "grip.toml"
    file.write_text(GRIP)
    program("run", file, "--quiet", "--no-pictures", "--out", tmp_path / "program")
    path = Deck.load(file).trace()
    path.save(tmp_path / "python", pictures=False)
    for one in ("path.csv", "events.json", "checkpoint"):
        assert (tmp_path / "program" / one).read_bytes() == (tmp_path / "python" / one).read_bytes(), one
    table = pd.read_csv(tmp_path / "program" / "path.csv", float_precision="round_trip")
    bent, gripped = table[table["stage"] == "bend"].iloc[-1], table[table["stage"] == "draw"]
    z, R = (next(name for name in table if name.split(" ")[0] == one) for one in ("z", "R"))
    assert gripped.iloc[0][z] == pytest.approx(bent[z], abs=1e-12) and bent[R] == 0.0
    assert gripped.iloc[-1][z] == pytest.approx(bent[z] - 0.1, abs=1e-12) and gripped.iloc[-1][R] < -0.1
    program("verify", tmp_path / "program")
    program("report", tmp_path / "program")
    assert "displacement in z of b" in (tmp_path / "program" / "report.html").read_text()
    assert "from where it is when its stage begins" in program("check", file)


def test_a_grip_may_be_set():
    from_rest = Deck.parse(GRIP.replace(', from = "stage"', ""))
    assert from_rest.copy({"prescribed.0.from": "stage"}).trace()["z"][-1] == Deck.parse(GRIP).trace()["z"][-1]


@pytest.mark.parametrize("key", ["section.s.width_to", "section.s.height_to"])
def test_tapers_have_the_sensitivities_and_curves_of_other_runs(key):
    deck = Deck.parse(COLUMN)

    def load(value):
        return deck.copy({key: value}).trace().events["branch-point"][0].lam

    value = deck[key]
    event = deck.trace(sensitivity=[key]).events["branch-point"][0]
    at = {k: load(value * (1 + k * 1e-3)) for k in (-2, -1, 1, 2)}
    slope = (at[-2] - 8 * at[-1] + 8 * at[1] - at[2]) / (12e-3 * value)
    assert event.sensitivity[key] == pytest.approx(slope, rel=1e-6)
    curve = deck.curve("branch-point", key, (0.8 * value, 1.2 * value))
    for point in (0, len(curve) - 1):
        assert curve["lambda"][point] == pytest.approx(load(curve["key"][point]), rel=1e-9)
