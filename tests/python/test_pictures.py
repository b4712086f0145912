"""Pictures: what is drawn is what the path has."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest

import arcwall
from arcwall import events, pictures


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


def test_a_plot_has_the_columns_as_its_data(channel):
    path = channel.trace()
    axes = path.plot(x="mid")
    lines = [line for line in axes.lines if line.get_linestyle() in ("-", "--", ":")]
    assert {"-", "--"} <= {line.get_linestyle() for line in lines}  # stable and unstable parts
    x = np.concatenate([line.get_xdata()[1:] for line in lines])
    y = np.concatenate([line.get_ydata()[1:] for line in lines])
    assert np.array_equal(x, path["mid"][1:]) and np.array_equal(y, path["lambda"][1:])
    assert axes.get_xlabel() == "mid [cm]" and "λ" in axes.get_ylabel() and axes.get_title() == "Buckling in a channel"


def test_unstable_parts_are_those_between_the_events(channel):
    path = channel.trace()
    dashed = [line for line in path.plot(events=False).lines if line.get_linestyle() == "--"]
    limit, turn = path.events["limit-point"][0], path.events["contact-limit-point"][0]
    assert dashed[0].get_ydata()[0] == limit.lam and dashed[-1].get_ydata()[-1] == turn.lam


def test_events_have_marks_at_their_points(channel):
    path = channel.trace()
    axes = path.plot(x="shortening", y="mid")
    marks = [line for line in axes.lines if line.get_linestyle() == "None"]
    assert len(marks) == len(path.events)
    for mark, event in zip(marks, path.events):
        assert mark.get_xdata() == path["shortening"][event.point] and mark.get_marker() == pictures.MARKS[event.kind][0]
    assert set(pictures.MARKS) == set(events.KINDS)


def test_several_paths_stand_in_one_picture(channel):
    axes = channel.trace(max_points=5).plot(events=False)
    assert channel.trace(max_points=9).plot(events=False, ax=axes) is axes
    assert len(axes.lines) == 2


def test_columns_of_words_are_not_drawn(channel):
    with pytest.raises(TypeError, match="no numbers"):
        channel.trace(max_points=3).plot(x="stability")
    with pytest.raises(KeyError, match="no column"):
        channel.trace(max_points=3).plot(x="middle")


def test_shapes_are_drawn_where_they_are(channel):
    path = channel.trace()
    axes = path.plot_shape(-1)
    member = path.shape(-1).members["column"]
    assert any(np.array_equal(line.get_xdata(), member.x) and np.array_equal(line.get_ydata(), member.z) for line in axes.lines)
    assert axes.get_xlabel() == "x [cm]"


def test_an_animation_has_a_frame_a_point(channel, tmp_path):
    path = channel.trace(max_points=6)
    animation = path.animate(every=2)
    animation.save(tmp_path / "shapes.gif", writer="pillow")
    assert (tmp_path / "shapes.gif").stat().st_size > 1000
    with pytest.raises(ValueError, match="every = 0"):
        path.animate(every=0)


def test_paths_of_systems_are_drawn_too():
    class Fold:
        def residual(self, x, lam):
            return x * x + lam

        def jacobian(self, x, lam):
            return [[2 * x[0]]]

        def dlam(self, x, lam):
            return [1.0]

    path = arcwall.trace(Fold(), [1.0], -1.0, stop={"lambda": (-2, 1)}, monitors={"x": lambda x, lam: x[0]})
    assert path.plot(x="x").get_xlabel() == "x"
    assert len(path.plot(x="arc", events=False).lines) == 2  # stable, then unstable


def test_a_path_of_one_point_is_drawn(channel):
    assert channel.trace(max_points=1).plot() is not None
