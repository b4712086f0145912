// Decks whose bounds and values to land on lie just behind a change of contact, where the first point of the next
// active set is a finite stretch away. Two are from the survey of random decks, where such bounds were jumped over.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "continuation/tracer.hpp"
#include "core/text.hpp"
#include "model/deck/reader.hpp"
#include "model/model.hpp"

namespace arcwall::bounds_behind_changes_test {
namespace {

// A beam is bent onto a flat floor by moments at its ends: it touches in the middle, and the touch spreads.
constexpr const char* foundation = R"toml(
title = "A bound just behind the spreading of a contact"
units = { length = "cm", force = "kN" }
material.steel = { E = 2.1e4 }
section.square = { shape = "rectangle", width = 0.2, height = 0.2 }
point = { left = [0.0, 0.0], right = [2.0, 0.0] }
member.beam = { from = "left", to = "right", theory = "euler-bernoulli", material = "steel", section = "square", elements = 40 }
support = { left = ["x", "z"], right = ["z"] }
load = [{ at = "left", moment = -1.0 }, { at = "right", moment = 1.0 }]
wall = [{ name = "foundation", side = "below", profile = { type = "flat", z = -0.18 } }]
monitor = [{ name = "mid", at = "beam:0.5", component = "z" }, { name = "turn", at = "right", component = "rotation" }]
path = { step = 0.1, stop = { lambda = [-1.0, 1.35] } }
)toml";

// A guided beam is pressed into a hollow.
constexpr const char* concave_floor = R"toml(
title = "guided beam on a parabola floor"
material.steel = { E = 2.1e4 }
section.s = { shape = "rectangle", width = 1.47, height = 0.494 }
point = { left = [0.0, 0.0], right = [14.24, 0.0] }
member.beam = { from = "left", to = "right", theory = "euler-bernoulli", material = "steel", section = "s", elements = 24 }
support = { left = ["x", "z", "rotation"], right = ["z", "rotation"] }
load = [{ on = "beam", distributed = [0.0, -2.86] }]
path = { step = 0.1, stop = { lambda = [-1.0, 4.36] } }
[[wall]]
name = "lower0"
side = "below"
profile = { type = "parabola", apex = [5.715, -1.706], curvature = 0.009966 }
)toml";

struct Traced {
  std::shared_ptr<const Model> model{};
  std::vector<Arc> arcs{};
  BranchEnd end{};

  double last_lambda() const { return arcs.back().to.state.lambda; }
  double monitor(std::size_t which, const State& state) const {
    return model->monitors().at(which).quantity->value(state);
  }
};

Traced traced(const char* deck, const std::vector<std::string>& assignments = {}) {
  Traced path{.model = std::make_shared<Model>(deck::read_deck_text(deck, "deck.toml", assignments))};
  std::string reason;
  Tracer tracer(path.model->system(), path.model->start(reason).value(), path.model->options());
  while (auto arc = tracer.next()) {
    path.arcs.push_back(std::move(*arc));
    if (path.arcs.size() > 200) tracer.stop({.reason = EndReason::interrupted, .detail = "the bound was jumped over"});
  }
  path.end = tracer.end().value();
  return path;
}

std::string up_to(double lambda) { return "path.stop.lambda=[-1.0, " + round_trip(lambda) + "]"; }

std::size_t arc_with(const Traced& path, EventKind kind) {
  for (std::size_t i = 0; i < path.arcs.size(); ++i)
    for (const Event& event : path.arcs[i].events)
      if (event.kind == kind) return i;
  ADD_FAILURE() << "no such event";
  return 0;
}

// Bounds of λ between the event and the point behind it end the path, on the bound itself.
void expect_bounds_behind(const char* deck, EventKind kind, double farther) {
  const Traced whole = traced(deck, {up_to(farther)});
  const std::size_t at = arc_with(whole, kind);
  ASSERT_LT(at + 1, whole.arcs.size());
  const double from = whole.arcs[at].to.state.lambda, to = whole.arcs[at + 1].to.state.lambda;
  ASSERT_GT(to, from);
  for (const double part : {1e-6, 1e-3, 0.03, 0.2, 0.5, 0.9, 0.9999}) {
    SCOPED_TRACE("part " + round_trip(part));
    const double bound = from + part * (to - from);
    const Traced path = traced(deck, {up_to(bound)});
    EXPECT_EQ(path.end.reason, EndReason::stop);
    EXPECT_NEAR(path.last_lambda(), bound, 1e-11 * bound);
    EXPECT_LE(path.arcs.size(), at + 3);
    EXPECT_EQ(path.arcs.back().to.count.unstable, whole.arcs[at + 1].to.count.unstable);
  }
}

}  // namespace

// λ = 1.343072 at the event, 1.36001 at the first point behind it.
TEST(BoundsBehindChanges, ABoundBehindContactSpreadsEndsThePathOnItself) {
  const Traced path = traced(foundation);
  EXPECT_EQ(path.end.reason, EndReason::stop);
  EXPECT_NEAR(path.last_lambda(), 1.35, 1e-11);
  EXPECT_EQ(path.arcs.back().to.count.unstable, 0);
  EXPECT_EQ(path.arcs.size(), 8U);
  EXPECT_NEAR(path.arcs[arc_with(path, EventKind::contact_spreads)].to.state.lambda, 1.343072137, 1e-8);
}

TEST(BoundsBehindChanges, EveryBoundBehindContactSpreadsDoes) {
  expect_bounds_behind(foundation, EventKind::contact_spreads, 2.0);
}

// A bound of a monitor, between its values at the event and at the first point behind it.
TEST(BoundsBehindChanges, ABoundOfAMonitorBehindContactSpreadsEndsThePath) {
  const Traced whole = traced(foundation, {up_to(2.0)});
  const std::size_t at = arc_with(whole, EventKind::contact_spreads);
  const auto turn = [](const Traced& path, std::size_t i) { return path.monitor(1, path.arcs[i].to.state); };
  const double bound = 0.5 * (turn(whole, at) + turn(whole, at + 1));
  const Traced path = traced(foundation, {up_to(2.0), "path.stop.turn=[" + round_trip(std::min(bound, 0.0)) + ", " +
                                                          round_trip(std::max(bound, 0.0)) + "]"});
  EXPECT_EQ(path.end.reason, EndReason::stop);
  EXPECT_NEAR(turn(path, path.arcs.size() - 1), bound, 1e-11);
  EXPECT_LE(path.arcs.size(), at + 3);
}

// Values that are landed on behind the event lie on the curve of a mesh with four times the elements, to the error of
// the coarse one.
TEST(BoundsBehindChanges, PointsBehindContactSpreadsLieOnTheCurveOfAFineMesh) {
  const std::vector<double> values{1.3431, 1.344, 1.346, 1.35, 1.355};
  const auto with = [](int elements) {
    return traced(foundation, {"path.output_at.lambda=[1.3431, 1.344, 1.346, 1.35, 1.355]", up_to(1.5),
                               "member.beam.elements=" + std::to_string(elements)});
  };
  const Traced coarse = with(40), fine = with(160);
  const auto turn_at = [](const Traced& path, double lambda) {
    std::vector<double> found;
    for (const Arc& arc : path.arcs)
      if (std::abs(arc.to.state.lambda - lambda) <= 1e-11) found.push_back(path.monitor(1, arc.to.state));
    EXPECT_EQ(found.size(), 1U) << "lambda = " << lambda;
    return found.empty() ? 0.0 : found.front();
  };
  for (const double lambda : values)
    EXPECT_NEAR(turn_at(coarse, lambda), turn_at(fine, lambda), 1e-6) << "lambda = " << lambda;
}

TEST(BoundsBehindChanges, ABoundBehindASpreadInAHollowEndsThePath) {
  const Traced path = traced(concave_floor);
  EXPECT_EQ(path.end.reason, EndReason::stop);
  EXPECT_NEAR(path.last_lambda(), 4.36, 1e-10);
}

}  // namespace arcwall::bounds_behind_changes_test
