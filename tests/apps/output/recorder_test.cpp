#include "model/recorder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "apps/output/result_json.hpp"
#include "model/deck/reader.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/support/deck_tables.hpp"

namespace arcwall::recorder_test {

using namespace test::tables;
namespace {

const std::string truss =
    title("Two bars") + units("m", "kN") + material("m", 1e4) + general_section("s", 1.0, 1.0) +
    points({{"left", -10.0, 0.0}, {"top", 0.0, 1.0}, {"right", 10.0, 0.0}}) + member("a", "left", "top", "truss", 1) +
    member("b", "top", "right", "truss", 1) + supports({{"left", "x z"}, {"right", "x z"}}) + force("top", 0.0, -1.0) +
    flat_wall("floor", "below", -0.5, on_axis) + contact(R"(points = "nodes")") +
    path(R"(step = 0.3; branches = "primary"; stop = { contacts = 1 })") + monitor("w", "top", "z");

// A branch made by hand: what the recorder adds does not depend on how the path was found.
Arc arc_at(const Model& model, double w, double arc, std::vector<EventKind> kinds) {
  Arc result;
  result.to.state.x = Vector::Zero(model.structure().size({}));
  const Index top = model.structure().members()[0].nodes.back();
  result.to.state.x[*model.structure().unknown(model.structure().dof(top, Dof::z))] = w;
  result.to.state.lambda = 2.0 * w;
  result.to.state.active_set = ActiveSet(static_cast<std::size_t>(model.contact()->contact_count()), 0);
  result.to.arc = arc;
  result.to.iterations = 3;
  result.to.residual = 1e-13;
  result.to.count = {.unstable = 0, .stability = Stability::stable};
  for (const EventKind kind : kinds)
    result.events.push_back({.kind = kind, .label = "w", .state = result.to.state, .arc = arc, .guards = {0}});
  return result;
}

class RecorderTest : public testing::Test {
 protected:
  const Model model_{deck::read_deck_text(truss, "folder/two-bars.toml")};
  Record record_ = empty_record(model_);
};

TEST_F(RecorderTest, NamesDeckColumnsAndUnits) {
  EXPECT_EQ(record_.deck, "two-bars.toml");
  EXPECT_EQ(record_.title, "Two bars");
  EXPECT_EQ(record_.energy_unit, "kN m");
  ASSERT_EQ(record_.columns.size(), 1u);
  EXPECT_EQ(record_.columns[0].name, "w");
  EXPECT_EQ(record_.columns[0].unit, "m");
}

TEST_F(RecorderTest, APointHasMonitorsEnergyAndItsPlaceInTheBranch) {
  Recorder recorder(model_, record_);
  recorder.add(arc_at(model_, 0.0, 0.0, {EventKind::start}));
  recorder.add(arc_at(model_, -0.25, 0.5, {}));

  ASSERT_EQ(record_.points.size(), 2u);
  const RecordPoint& point = record_.points[1];
  EXPECT_EQ(point.step, 1);
  EXPECT_EQ(point.monitors, std::vector<double>{-0.25});
  EXPECT_EQ(point.event, std::nullopt);
  // Green strain: Π = 2 · ½ EA L ε² − λ (−w), ε = w (w + 2 h)/(2 L²) with w upwards.
  const double L = std::sqrt(101.0), strain = -0.25 * (-0.25 + 2.0) / (2.0 * 101.0);
  EXPECT_NEAR(point.energy, 1e4 * L * strain * strain + point.lambda * -0.25, 1e-12);
  EXPECT_EQ(record_.branches[0].points, 2);
  EXPECT_EQ(record_.branches[0].least_lambda, -0.5);
  EXPECT_EQ(record_.branches[0].greatest_lambda, 0.0);
}

TEST_F(RecorderTest, ARowShowsTheLastEventThatIsNoChangeOfContact) {
  using enum EventKind;
  Recorder recorder(model_, record_);
  recorder.add(arc_at(model_, 0.0, 0.0, {start, contact_closes}));
  recorder.add(arc_at(model_, 0.1, 0.1, {contact_closes, contact_limit_point}));
  recorder.add(arc_at(model_, 0.2, 0.2, {contact_closes, contact_opens}));
  recorder.end({EndReason::min_step, "why"});

  EXPECT_EQ(record_.points[0].event, start);
  EXPECT_EQ(record_.points[1].event, contact_limit_point);
  EXPECT_EQ(record_.points[2].event, end);
}

TEST_F(RecorderTest, EventsAreNumberedAndSayWhatChanges) {
  Recorder recorder(model_, record_);
  recorder.add(arc_at(model_, 0.0, 0.0, {EventKind::start}));
  recorder.add(arc_at(model_, -0.25, 0.5, {EventKind::contact_closes, EventKind::contact_limit_point}));
  recorder.add(arc_at(model_, -0.5, 0.7, {EventKind::turning_point}));

  ASSERT_EQ(record_.events.size(), 4u);
  for (Index id = 0; id < 4; ++id) EXPECT_EQ(record_.events[static_cast<std::size_t>(id)].id, id);
  const RecordEvent& closes = record_.events[1];
  EXPECT_EQ(closes.step, 1);
  EXPECT_EQ(closes.monitors, std::vector<double>{-0.25});
  ASSERT_EQ(closes.contacts.size(), 1u);
  EXPECT_EQ(closes.contacts[0].label.wall, "floor");
  EXPECT_EQ(closes.contacts[0].x, model_.contact()->candidate(0).point().position({.x = Vector::Zero(2)}).x());
  EXPECT_TRUE(record_.events[2].contacts.empty());
  EXPECT_EQ(record_.events[3].monitor, "w");
  EXPECT_EQ(closes.monitor, std::nullopt);
}

TEST_F(RecorderTest, TheEndIsAnEventOfTheLastPoint) {
  Recorder recorder(model_, record_);
  recorder.add(arc_at(model_, -0.25, 0.5, {EventKind::start}));
  recorder.end({EndReason::stop, "w = -0.25"});

  const RecordEvent& end = record_.events.back();
  EXPECT_EQ(end.kind, EventKind::end);
  EXPECT_EQ(end.step, 0);
  EXPECT_EQ(end.lambda, -0.5);
  EXPECT_EQ(end.residual, 1e-13);
  EXPECT_EQ(end.unstable_before, 0);
  EXPECT_EQ(end.branch_end->detail, "w = -0.25");
  EXPECT_EQ(record_.branches[0].end->reason, EndReason::stop);
}

// The end of a branch at a branch point, and the start of the one that leaves it, are no surer than that.
TEST_F(RecorderTest, EndsAndStartsAtABranchPointAreAsUncertainAsThat) {
  const auto point = std::make_shared<BranchPoint>();
  Recorder first(model_, record_);
  first.add(arc_at(model_, 0.0, 0.0, {EventKind::start}));
  Arc arc = arc_at(model_, -0.25, 0.5, {EventKind::branch_point});
  point->state = arc.to.state;
  arc.events[0].branching = point;
  arc.events[0].lambda_uncertainty = 0.01;
  first.add(arc);
  first.end({EndReason::switched_branch, ""});
  Recorder second(model_, record_, BranchRecord{.id = 1, .parent = 0, .origin = point});
  second.add(arc_at(model_, -0.25, 0.0, {EventKind::start}));
  second.add(arc_at(model_, -0.5, 0.7, {}));
  second.end({EndReason::stop, ""});

  ASSERT_EQ(record_.events.size(), 5u);
  EXPECT_EQ(record_.branches[1].origin, 1);
  EXPECT_EQ(record_.events[0].lambda_uncertainty, 0.0);
  EXPECT_EQ(record_.events[2].kind, EventKind::end);
  EXPECT_EQ(record_.events[2].lambda_uncertainty, 0.01);
  EXPECT_EQ(record_.events[3].kind, EventKind::start);
  EXPECT_EQ(record_.events[3].lambda_uncertainty, 0.01);
  EXPECT_EQ(record_.events[4].lambda_uncertainty, 0.0);
}

TEST_F(RecorderTest, ABranchWithoutPointsHasNoEndEvent) {
  Recorder recorder(model_, record_);
  recorder.end({EndReason::no_continuation, ""});
  EXPECT_TRUE(record_.events.empty());
  EXPECT_EQ(record_.branches[0].end->reason, EndReason::no_continuation);
}

TEST_F(RecorderTest, ASecondBranchCountsItsOwnSteps) {
  Recorder first(model_, record_);
  first.add(arc_at(model_, 0.0, 0.0, {EventKind::start}));
  first.end({EndReason::stop, ""});
  Recorder second(model_, record_, BranchRecord{.id = 1, .parent = 0});
  second.add(arc_at(model_, 0.1, 0.0, {EventKind::start}));

  EXPECT_EQ(record_.branches[1].parent, 0);
  EXPECT_EQ(record_.points[1].branch, 1);
  EXPECT_EQ(record_.points[1].step, 0);
  EXPECT_EQ(record_.events.back().id, 2);
}

TEST_F(RecorderTest, TheResultSaysWhatWasRunAndHowItEnded) {
  Recorder recorder(model_, record_);
  recorder.add(arc_at(model_, 0.0, 0.0, {EventKind::start}));
  recorder.end({EndReason::max_points, "1 points"});

  // The check value of CRC-32: that of the digits 1 to 9.
  const auto json = result_json(model_, {.deck = "two-bars.toml", .deck_text = "123456789"}, record_,
                                {.total = 2.0, .tracing = 1.5}, 6);

  EXPECT_EQ(json["schema"], 1);
  EXPECT_EQ(json["deck"]["file"], "two-bars.toml");
  EXPECT_EQ(json["deck"]["crc32"], "cbf43926");
  EXPECT_EQ(json["model"]["nodes"], 3);
  EXPECT_EQ(json["model"]["unknowns"], 2);
  EXPECT_EQ(json["model"]["contact_candidates"], model_.contact()->contact_count());
  EXPECT_EQ(json["counts"].dump(), R"({"branches":1,"points":1,"events":2,"iterations":3})");
  EXPECT_EQ(json["seconds"]["tracing"], 1.5);
  EXPECT_EQ(json["status"], 6);
  EXPECT_EQ(json["branches"][0]["end"]["reason"], "max_points");
}

// The beam touches at k = M/2.8 with (1 − cos k)/k = 0.08, M = 0.448961, before the end of the increment from 0.4 to
// 0.45.
TEST(RecordedIncrements, AnEventLiesWithinTheIncrementAtWhoseEndItIsReported) {
  const test::TracedDeck run(test::example("foundation"),
                             {"path.method=\"incremental\"", "path.step=0.05", "path.output_at={lambda=[0.5]}",
                              "path.stop={lambda=[-1.0, 0.5]}"});
  const auto& events = run.record().events;
  const auto closes = std::find_if(events.begin(), events.end(),
                                   [](const RecordEvent& event) { return event.kind == EventKind::contact_closes; });
  ASSERT_NE(closes, events.end());
  EXPECT_NEAR(closes->lambda, 0.45, 1e-12);
  EXPECT_NEAR(closes->lambda_uncertainty, 0.05, 1e-12);
  EXPECT_LE(std::abs(closes->lambda - 0.448961), closes->lambda_uncertainty);
}

}  // namespace
}  // namespace arcwall::recorder_test
