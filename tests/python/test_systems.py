"""Systems of one's own: events, branches, and hostile callbacks."""

import math
import pickle
import signal
import subprocess
import sys
import traceback

import numpy as np
import pytest
import scipy.sparse as sp

import arcwall
from arcwall import Detector, NoStart, NotFinite


class Function:
    """F = f(x, λ) in one unknown, with its derivatives."""

    def __init__(self, f, f_x, f_lam):
        self.residual = lambda x, lam: np.array([f(x[0], lam)])
        self.jacobian = lambda x, lam: np.array([[f_x(x[0], lam)]])
        self.dlam = lambda x, lam: np.array([f_lam(x[0], lam)])


def fold():
    """F = x² + λ: equilibria x = ±√−λ, one fold at 0."""
    return Function(lambda x, lam: x * x + lam, lambda x, lam: 2 * x, lambda x, lam: 1.0)


def pitchfork(e=0.0):
    """F = x³ − λ x − e. e = 0: x = 0, and λ = x² from λ = 0 on. Else a fold at x = −(e/2)^⅓, λ = 3 (e/2)^⅔."""
    return Function(lambda x, lam: x**3 - lam * x - e, lambda x, lam: 3 * x * x - lam, lambda x, lam: -x)


class Bratu:
    """u″ + λ eᵘ = 0 on (0, 1), u = 0 at the ends, by central differences at n inner points."""

    def __init__(self, n, sparse=True):
        self.n, self.sparse = n, sparse
        self.scale = (n + 1) ** 2
        ones = np.ones(n)
        self.stiffness = self.scale * sp.diags([-ones[1:], 2 * ones, -ones[1:]], [-1, 0, 1], format="csc")

    def residual(self, u, lam):
        return self.stiffness @ u - lam * np.exp(u)

    def jacobian(self, u, lam):
        J = self.stiffness - sp.diags(lam * np.exp(u), format="csc")
        return J if self.sparse else J.toarray()

    def dlam(self, u, lam):
        return -np.exp(u)

    def energy(self, u, lam):
        return 0.5 * u @ (self.stiffness @ u) - lam * np.exp(u).sum()


# The fold of the differences with 49 inner points, computed with 20 digits from the extended system of Seydel (1979).
@pytest.mark.parametrize("sparse", [True, False])
def test_the_fold_of_bratus_problem_is_found_exactly(sparse):
    monitors = {"top": lambda u, lam: u.max()}
    path = arcwall.trace(Bratu(49, sparse), np.zeros(49), stop={24: (-1.0, 3.0)}, step=0.2, monitors=monitors)
    (limit,) = path.events["limit-point"]
    assert limit.lam == pytest.approx(3.5130993908836101689, abs=1e-11)
    assert (limit.unstable_before, limit.unstable_after) == (0, 1)
    assert path.ended and path.events[-1].end.reason == "stop" and path.x[-1, 24] == pytest.approx(3.0, abs=1e-12)
    assert path.x.shape == (len(path), 49)
    assert np.array_equal(path["top"], path.x.max(axis=1)) and limit.monitors["top"] == path["top"][limit.point]
    for u, lam in zip(path.x, path["lambda"]):
        assert abs(Bratu(49).residual(u, lam)).max() < 1e-7


def test_energies_are_those_of_the_system():
    system = Bratu(9)
    path = arcwall.trace(system, np.zeros(9), stop={"lambda": (-1, 3)})
    assert path["energy"] == pytest.approx([system.energy(u, lam) for u, lam in zip(path.x, path["lambda"])], rel=1e-14)
    del Bratu.energy
    try:
        assert np.isnan(arcwall.trace(Bratu(9), np.zeros(9), stop={"lambda": (-1, 3)})["energy"]).all()
    finally:
        Bratu.energy = lambda self, u, lam: 0.5 * u @ (self.stiffness @ u) - lam * np.exp(u).sum()


# x = 0 and λ = x² cross at 0.
def test_branches_of_a_pitchfork_are_all_traced():
    path = arcwall.trace(pitchfork(), [0.0], -1.0, stop={"lambda": (-1.5, 1.0)}, branches="all", step=0.1)
    (point,) = path.events["branch-point"]
    assert point.type == "pitchfork" and point.lam == pytest.approx(0.0, abs=1e-9) and point.mode.shape == (1,)
    assert len(path.branches) == 3 and point.branches == (1, 2)
    for branch in (1, 2):
        on = path["branch"] == branch
        assert path["lambda"][on] == pytest.approx(path.x[on, 0] ** 2, abs=1e-9)
    assert {path.x[path["branch"] == b, 0][-1] > 0 for b in (1, 2)} == {True, False}


def test_the_fold_of_an_imperfect_pitchfork():
    e = 0.01
    start = np.roots([1.0, 0.0, -1.0, -e]).real
    x0 = start[np.argmin(abs(start + 1.0))]  # on the branch of the other sign
    path = arcwall.trace(pitchfork(e), [x0], 1.0, step=-0.05, stop={"lambda": (-1.0, 1.5), 0: (-2.0, 2.0)})
    (limit,) = path.events["limit-point"]
    assert limit.lam == pytest.approx(3 * (e / 2) ** (2 / 3), rel=1e-9)


# A chain of two equal rigid links with hinge springs c under a dead load λ along it: K = c [[2, −1], [−1, 1]] − λ l I, so that
# its straight form is critical at λ = c/l (3 ∓ √5)/2.
class Pendulums:
    def residual(self, a, lam):
        return np.array([2 * a[0] - a[1] - lam * np.sin(a[0]), a[1] - a[0] - lam * np.sin(a[1])])

    def jacobian(self, a, lam):
        return np.array([[2 - lam * np.cos(a[0]), -1.0], [-1.0, 1 - lam * np.cos(a[1])]])

    def dlam(self, a, lam):
        return -np.sin(a)


def test_a_chain_of_pendulums_is_critical_where_its_eigenvalues_say():
    path = arcwall.trace(Pendulums(), [0.0, 0.0], stop={"lambda": (-0.5, 3.0)}, step=0.1)
    critical = [event.lam for event in path.events["branch-point"]]
    assert critical == pytest.approx([(3 - 5**0.5) / 2, (3 + 5**0.5) / 2], abs=1e-9)
    mode = path.events["branch-point"][0].mode
    assert mode[1] / mode[0] == pytest.approx((1 + 5**0.5) / 2, rel=1e-8)


def test_event_functions_are_located():
    events = {
        "half": lambda x, lam: x[0] - 0.5,
        "down": Detector(lambda x, lam: x[0] + 0.5, -1),
        "up": Detector(lambda x, lam: x[0], 1),
    }
    path = arcwall.trace(fold(), [1.0], -1.0, stop={"lambda": (-1.5, 1.0)}, events=events)
    found = {event.monitor: event for event in path.events["user"]}
    assert set(found) == {"half", "down"}
    assert found["half"].lam == pytest.approx(-0.25, abs=1e-9)
    assert path.x[found["down"].point, 0] == pytest.approx(-0.5, abs=1e-9)


def test_values_are_landed_on_and_bounds_of_unknowns_stop():
    path = arcwall.trace(fold(), [1.0], -1.0, output_at={"lambda": [-0.5], 0: [0.25]}, stop={0: (-0.75, 2.0)}, watch=[0])
    assert -0.5 in path["lambda"] and path.x[-1, 0] == pytest.approx(-0.75, abs=1e-12)
    assert path.events[-1].end.detail == "x[0] = -0.75"
    assert np.min(abs(path.x[:, 0] - 0.25)) < 1e-12


def test_kinds_of_events_stop():
    path = arcwall.trace(fold(), [1.0], -1.0, stop_at=["limit-point"])
    assert path.events[-2].kind == "limit-point" and path.events[-1].end.reason == "stop"


def test_a_path_of_a_system_goes_on():
    whole = arcwall.trace(Bratu(9), np.zeros(9), stop={4: (-1.0, 3.0)})
    part = arcwall.trace(Bratu(9), np.zeros(9), stop={4: (-1.0, 3.0)}, max_seconds=0.0)
    assert len(part) == 1 and not part.ended
    assert np.array_equal(part.resume()["lambda"], whole["lambda"]) and np.array_equal(part.x, whole.x)


# A pattern that grows: entries that are zero at the start are left out there.
def test_a_sparse_jacobian_may_gain_entries():
    class Coupled:
        def residual(self, x, lam):
            return np.array([x[0] + x[0] * x[1] ** 2 / 2 - lam, x[1] + x[0] ** 2 * x[1] / 2 - 0.5 * lam])

        def jacobian(self, x, lam):
            off = x[0] * x[1]
            return sp.csc_matrix(np.array([[1 + x[1] ** 2 / 2, off], [off, 1 + x[0] ** 2 / 2]]))

        def dlam(self, x, lam):
            return np.array([-1.0, -0.5])

    path = arcwall.trace(Coupled(), [0.0, 0.0], stop={"lambda": (-1.0, 2.0)})
    assert path.events[-1].end.reason == "stop"
    assert abs(Coupled().residual(path.x[-1], 2.0)).max() < 1e-9


@pytest.mark.filterwarnings("ignore::PendingDeprecationWarning")
@pytest.mark.parametrize("convert", [sp.coo_matrix, sp.csr_matrix, sp.lil_matrix, sp.csc_array, np.matrix, list])
def test_jacobians_may_have_any_form(convert):
    class Form(Pendulums):
        def jacobian(self, a, lam):
            return convert(Pendulums.jacobian(self, a, lam))

    want = arcwall.trace(Pendulums(), [0.0, 0.0], stop={"lambda": (-0.5, 2.0)})
    got = arcwall.trace(Form(), [0.0, 0.0], stop={"lambda": (-0.5, 2.0)})
    assert got["lambda"] == pytest.approx(want["lambda"], abs=1e-9)


def test_the_curve_and_the_table_are_as_those_of_decks():
    path = arcwall.trace(fold(), [1.0], -1.0, stop={"lambda": (-2, 1)}, monitors={"x": lambda x, lam: x[0]})
    assert list(path.table.columns[:5]) == ["branch", "step", "arc", "lambda", "x"]
    assert "<svg" in path._repr_html_()


# --- hostile ------------------------------------------------------------------------------------------------------------


def broken(**methods):
    system = fold()
    for name, method in methods.items():
        setattr(system, name, method)
    return system


def trace(system, **options):
    return arcwall.trace(system, [1.0], -1.0, stop={"lambda": (-2, 1)}, **options)


@pytest.mark.parametrize(
    "methods, error, text",
    [
        (dict(residual=lambda x, lam: np.zeros(2)), ValueError, r"residual\(x, lam\) returned shape \(2,\); \(1,\) is wanted"),
        (dict(residual=lambda x, lam: 0.0), ValueError, r"residual.*shape \(\)"),
        (dict(residual=lambda x, lam: None), TypeError, "residual.*array of object"),
        (dict(residual=lambda x, lam: "no"), TypeError, "residual"),
        (dict(residual=lambda x, lam: np.array([1j])), TypeError, "complex"),
        (dict(residual=lambda x, lam: [[1.0], [2.0, 3.0]]), (TypeError, ValueError), ""),
        (dict(dlam=lambda x, lam: np.zeros((1, 1))), ValueError, r"dlam\(x, lam\) returned shape \(1, 1\)"),
        (dict(jacobian=lambda x, lam: np.eye(2)), ValueError, r"jacobian\(x, lam\) returned shape \(2, 2\); \(1, 1\) is wanted"),
        (dict(jacobian=lambda x, lam: sp.eye(3)), ValueError, r"jacobian.*\(3, 3\); \(1, 1\)"),
        (dict(jacobian=lambda x, lam: 2.0), ValueError, r"jacobian.*shape \(\)"),
        (dict(jacobian=lambda x, lam: sp.eye(1, dtype=complex)), TypeError, "jacobian.*complex"),
        (dict(residual=lambda x: 0.0), TypeError, "positional argument"),
        (dict(energy=lambda x, lam: [1.0, 2.0]), ValueError, r"energy\(x, lam\) returned shape \(2,\)"),
        (dict(residual=3), TypeError, "has no residual"),
    ],
)
def test_what_a_method_must_not_return_is_named(methods, error, text):
    with pytest.raises(error, match=text) as raised:
        trace(broken(**methods))
    if callable(methods.get("residual", len)):
        assert raised.value.arcwall_state[1] == -1.0 and any("at lam = -1" in note for note in raised.value.__notes__)


def test_a_sparse_matrix_with_broken_parts_is_refused():
    def jacobian(x, lam):
        matrix = sp.csc_matrix(np.eye(1))
        matrix.indices = np.array([7], dtype=np.int32)
        matrix.has_canonical_format = True
        return matrix

    with pytest.raises(ValueError, match="do not fit together"):
        trace(broken(jacobian=jacobian))


def test_jacobians_that_are_not_symmetric_are_refused():
    class Skew(Pendulums):
        def jacobian(self, a, lam):
            return sp.csc_matrix([[2.0, -1.0], [0.0, 1.0]])

    with pytest.raises(ValueError, match=r"not symmetric: entry \(0, 1\) is -1, its mirror image 0|not symmetric: entry \(1, 0\)"):
        arcwall.trace(Skew(), [0.0, 0.0])


def test_a_wrong_jacobian_ends_the_path_with_a_reason():
    path = trace(broken(jacobian=lambda x, lam: [[-2.0 * x[0]]]), max_points=50)
    assert path.ended and path.events[-1].end.reason != "stop"


# Errors come out as they are, the same object, with the state in which they arose and the callback in the traceback.
def test_exceptions_come_out_as_they_are():
    class Mine(Exception):
        pass

    error = Mine("no further")

    def residual(x, lam):
        if lam > -0.5:
            raise error
        return x * x + lam

    with pytest.raises(Mine) as raised:
        trace(broken(residual=residual))
    assert raised.value is error
    x, lam = error.arcwall_state
    assert x.shape == (1,) and lam > -0.5
    assert any("residual(x, lam) at lam" in note for note in error.__notes__)
    assert error.arcwall_path["lambda"].max() <= -0.5
    assert "raise error" in "".join(traceback.format_exception(raised.value))


def test_exceptions_of_event_functions_too():
    with pytest.raises(ZeroDivisionError) as raised:
        trace(fold(), events={"bad": lambda x, lam: 1 / 0})
    assert any('event function "bad"' in note for note in raised.value.__notes__)
    with pytest.raises(NotFinite, match='event function "bad" is not finite at lam = ') as raised:
        trace(fold(), events={"bad": lambda x, lam: math.nan})
    assert raised.value.arcwall_state[0].shape == (1,)


def test_a_path_that_an_exception_ended_keeps_its_points_and_says_so():
    calls = []

    def residual(x, lam):
        calls.append(lam)
        if len(calls) == 40:
            raise KeyError("gone")
        return x * x + lam

    path = trace(broken(residual=residual), max_seconds=0.0)
    with pytest.raises(KeyError):
        path.resume()
    assert len(path) > 1 and len(path.table) == len(path) and not path.ended
    with pytest.raises(RuntimeError, match="ended by an exception"):
        path.resume()


def with_domain():
    """x = √(1 − λ): beyond λ = 1 nothing is defined."""
    return Function(
        lambda x, lam: x - math.sqrt(1 - lam) if lam <= 1 else math.nan,
        lambda x, lam: 1.0,
        lambda x, lam: 0.5 / math.sqrt(1 - lam) if lam < 1 else math.nan,
    )


# Trial states may lie beyond: the step is cut until they do not. Where no step is left, that is said with its state, and what
# was traced is there.
def test_residuals_that_are_no_numbers_shorten_the_step_and_at_last_end_the_path():
    assert arcwall.trace(with_domain(), [1.0], stop={"lambda": (-1, 0.999)}).ended
    ahead = r"no step ahead succeeds: (residual|dlam)\(x, lam\) returned nan in entry 0 at lam = 1"
    with pytest.raises(NotFinite, match=ahead) as raised:
        arcwall.trace(with_domain(), [1.0], stop={"lambda": (-1, 2)}, max_points=300)
    x, lam = raised.value.arcwall_state
    path = raised.value.arcwall_path
    assert x.shape == (1,) and 1.0 <= lam < 1.1
    assert path.ended and 0.99 < path["lambda"].max() <= 1.0 and len(path.table) == len(path)
    assert path.events[-1].end.reason in ("min_step", "not_finite", "singular")
    assert path.resume() is path  # and it is said once


# One branch of several leaves its domain: the others are traced when one goes on.
def test_other_branches_go_on_behind_one_that_leaves_its_domain():
    def half(x, lam):
        return math.nan if x[0] > 0.5 else pitchfork().residual(x, lam)[0]

    system = pitchfork()
    whole, system.residual = system.residual, lambda x, lam: np.array([half(x, lam)])
    options = dict(stop={"lambda": (-1.5, 1.0)}, branches="all", step=0.1)
    with pytest.raises(NotFinite) as raised:
        arcwall.trace(system, [0.0], -1.0, **options)
    path = raised.value.arcwall_path.resume()
    assert path.ended and len(path.branches) == 3
    system.residual = whole
    assert path.x[:, 0].max() < 0.51 < arcwall.trace(system, [0.0], -1.0, **options).x[:, 0].max()
    assert sorted(branch.end.reason == "stop" for branch in path.branches) == [False, True, True]


@pytest.mark.parametrize(
    "methods, error, text",
    [
        (dict(residual=lambda x, lam: [math.nan]), NoStart, r"start: residual\(x, lam\) returned nan in entry 0 at lam = -1"),
        (dict(residual=lambda x, lam: [-math.inf]), NoStart, "returned -inf in entry 0"),
        (dict(jacobian=lambda x, lam: [[math.nan]]), NoStart, r"jacobian\(x, lam\) returned nan in entry \(0, 0\) at lam = -1"),
        (dict(jacobian=lambda x, lam: sp.csc_matrix([[math.inf]])), NoStart, r"jacobian.*inf in entry \(0, 0\)"),
        (dict(dlam=lambda x, lam: [math.nan]), NoStart, r"dlam\(x, lam\) returned nan in entry 0 at lam = -1"),
        (dict(energy=lambda x, lam: math.nan), NotFinite, r"energy\(x, lam\) returned nan at lam = -1"),
    ],
)
def test_numbers_that_are_none_are_named_with_their_state(methods, error, text):
    with pytest.raises(error, match=text) as raised:
        trace(broken(**methods))
    x, lam = raised.value.arcwall_state
    assert x.tolist() == [1.0] and lam == -1.0
    assert isinstance(raised.value, arcwall.ArcwallError)


@pytest.mark.parametrize("convert", [np.array, sp.csc_matrix])
@pytest.mark.parametrize("place", [(0, 1), (1, 0)])
def test_a_jacobian_is_looked_at_on_both_sides(convert, place):
    class Holed(Pendulums):
        def jacobian(self, a, lam):
            J = Pendulums.jacobian(self, a, lam)
            J[place] = math.nan
            return convert(J)

    with pytest.raises(NoStart, match=rf"nan in entry \({place[0]}, {place[1]}\)"):
        arcwall.trace(Holed(), [0.0, 0.0])


def test_monitors_that_give_no_number_are_named_with_their_state():
    path = trace(fold(), monitors={"m": lambda x, lam: [1.0, 2.0], "n": lambda x, lam: 1 / 0, "o": lambda x, lam: None})
    for name, error, text in [
        ("m", TypeError, r"monitor 'm' returned float64 of shape \(2,\); one real number is wanted"),
        ("n", ZeroDivisionError, "division"),
        ("o", TypeError, "monitor 'o' returned object"),
    ]:
        with pytest.raises(error, match=text) as raised:
            path[name]
        assert raised.value.arcwall_state[1] == -1.0


def test_starts_that_are_none_are_refused():
    for x0 in ([], [math.nan], [[1.0]], math.inf):
        with pytest.raises(ValueError, match="x0 has shape"):
            arcwall.trace(fold(), x0)
    for x0 in ("a", None, [object()]):
        with pytest.raises((TypeError, ValueError)):
            arcwall.trace(fold(), x0)
    with pytest.raises(NoStart):
        arcwall.trace(Function(lambda x, lam: x * x + 1 + lam * lam, lambda x, lam: 2 * x, lambda x, lam: 2 * lam), [1.0])


@pytest.mark.parametrize(
    "options",
    [
        dict(step=0.0),
        dict(step=math.nan),
        dict(min_step=1.0, max_step=0.1),
        dict(max_points=0),
        dict(max_points=2.5),
        dict(depth=-1),
        dict(max_points=10**12),
        dict(max_seconds=-1.0),
        dict(branches="every"),
        dict(method="newton"),
        dict(stop_at=["limit point"]),
        dict(stop={"lamda": (0, 1)}),
        dict(stop={1: (0, 1)}),
        dict(stop={"lambda": (1, 0)}),
        dict(stop={"lambda": (0, 1, 2)}),
        dict(stop={"lambda": 1.0}),
        dict(output_at={"lambda": 1.0}),
        dict(step="long"),
        dict(watch=[5]),
        dict(weights=[1.0, 2.0]),
        dict(weights=[-1.0]),
        dict(weights=[0.0]),
    ],
)
def test_options_that_mean_nothing_are_refused(options):
    with pytest.raises(ValueError):
        arcwall.trace(fold(), [1.0], -1.0, **options)


def test_options_of_other_kinds_are_refused():
    for option in ("stop", "output_at", "events", "monitors"):
        with pytest.raises(TypeError, match=f"{option} is a dict, not list"):
            arcwall.trace(fold(), [1.0], -1.0, **{option: [3]})
    with pytest.raises(TypeError, match=r"give Pendulums\(…\), not the class"):
        arcwall.trace(Pendulums, [0.0, 0.0])
    for lam0 in ([0.0], "x", math.nan, None):
        with pytest.raises(ValueError, match="lam0 = .* is no finite number"):
            arcwall.trace(fold(), [1.0], lam0)
    assert len(trace(fold(), watch=0).events["turning-point"]) == 0


def test_event_functions_that_are_none_are_refused():
    for of in (3, Detector(lambda x, lam: 1.0, 7)):
        with pytest.raises(TypeError, match="event function 'e'"):
            trace(fold(), events={"e": of})


def test_monitors_that_are_none_are_refused():
    for name in ("lambda", "energy", 3):
        with pytest.raises(ValueError, match="choose another"):
            trace(fold(), monitors={name: lambda x, lam: 0.0})
    with pytest.raises(TypeError, match="monitor 'm'"):
        trace(fold(), monitors={"m": 3})


def test_states_that_are_handed_out_cannot_be_written():
    def residual(x, lam):
        x[0] = 5.0
        return x

    with pytest.raises(ValueError, match="read-only"):
        trace(broken(residual=residual))


def test_a_callback_cannot_trace_its_own_path():
    holder = {}

    def residual(x, lam):
        if "path" in holder:
            holder["path"].resume()
        return x * x + lam

    path = trace(broken(residual=residual), max_seconds=0.0)
    holder["path"] = path
    with pytest.raises(RuntimeError, match="asks for more of its own path"):
        path.resume()


def test_a_callback_may_trace_other_paths():
    def residual(x, lam):
        assert len(trace(fold())) > 5
        return x * x + lam

    assert np.array_equal(trace(broken(residual=residual))["lambda"], trace(fold())["lambda"])


def test_a_system_outlives_its_name():
    system = Bratu(9)
    path = arcwall.trace(system, np.zeros(9), stop={4: (-1.0, 3.0)}, max_seconds=0.0)
    del system
    assert path.resume().ended


def test_a_path_of_a_system_cannot_be_pickled_and_says_what_can():
    path = trace(fold())
    with pytest.raises(TypeError, match="pickle path.table, path.x or path.events"):
        pickle.dumps(path)
    assert pickle.loads(pickle.dumps(path.events)) == path.events


def test_an_interrupt_inside_a_callback_is_one():
    script = """
import os, signal, arcwall
class System:
    def residual(self, x, lam):
        if lam > -0.5: os.kill(os.getpid(), signal.SIGINT)
        return x * x + lam
    def jacobian(self, x, lam): return [[2 * x[0]]]
    def dlam(self, x, lam): return [1.0]
try:
    arcwall.trace(System(), [1.0], -1.0)
except KeyboardInterrupt:
    print("stopped")
"""
    assert subprocess.run([sys.executable, "-c", script], capture_output=True, text=True).stdout == "stopped\n"
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
