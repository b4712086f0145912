"""A program as users have it, for mypy: what the package's annotations promise. It is not run."""

from typing import Any, Optional, assert_type

import numpy as np

import arcwall

deck = arcwall.Deck.load("channel.toml")
assert_type(deck.check(), list[arcwall.Diagnostic])
path = deck.trace(jumps=True, sensitivity=["material.steel.E"], max_seconds=2.0).resume()
assert_type(path, arcwall.Path)
assert_type(path["lambda"], np.ndarray[Any, Any])
limit = path.events["limit-point"][0]
assert_type(limit, arcwall.Event)
assert_type(limit.sensitivity["material.steel.E"], Optional[float])
assert_type(limit.jump, Optional[arcwall.Jump])
if limit.jump is not None and limit.jump.return_ is not None:
    assert_type(limit.jump.return_.jump, Optional[arcwall.Jump])
    assert_type([contact.wall for contact in limit.jump.contacts], list[str])
for point in deck.tracing():
    assert_type(point.contacts[0].force, Optional[float])
assert_type(path.shape(limit.point).members["column"].moment, np.ndarray[Any, Any])
curve = deck.curve("limit-point", "wall.upper.profile.z", (0.1, 0.3), output_at=[0.2])
assert_type([cusp.key for cusp in curve.cusps], list[float])
worst = deck.worst("limit-point", ["wall.upper.profile.z"], 0.01, number=1)
assert_type(worst.deck.converge(levels=2).events[0].extrapolated, float)


class Line(arcwall.System):
    def residual(self, x: np.ndarray, lam: float) -> np.ndarray:
        return x - lam

    def jacobian(self, x: np.ndarray, lam: float) -> np.ndarray:
        return np.eye(1)

    def dlam(self, x: np.ndarray, lam: float) -> np.ndarray:
        return -np.ones(1)


line = arcwall.trace(Line(), [0.0], stop={"lambda": (-1.0, 1.0)}, events={"e": lambda x, lam: float(x[0])})
assert_type(line.x, np.ndarray[Any, Any])
