#include "apps/verify/verify.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "core/text.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/stored_files_of.hpp"
#include "tests/model/friction_decks.hpp"

namespace arcwall::verify::falsified_run_test {

namespace {

using test::example;
using test::TracedDeck;

// A record of one point, cut out of a run.
void expect_confirmed_point(const TracedDeck& traced, const Record& record) {
  const Verdict verdict = verify(traced.model(), record, stored_files_of(record), "checkpoint");
  EXPECT_FALSE(verdict.findings.first().has_value()) << to_text(*verdict.findings.first());
}

}  // namespace

namespace {

class FalsifiedRun : public testing::Test {
 protected:
  FalsifiedRun() : traced_(example("channel"), {"contact.points=\"nodes\"", "member.column.elements=16"}) {}

  // The point before the last that carries contact forces and has no event.
  std::size_t pressed_point() const {
    const auto& points = traced_.record().points;
    for (std::size_t i = points.size(); i-- > 0;)
      if (points[i].contacts > 0 && !points[i].event) return i;
    ADD_FAILURE() << "no point in contact";
    return 0;
  }

  // The verdict on a record whose states differ from what its files say.
  Failure first_failure(const std::function<void(Record&)>& change) const {
    Record record = traced_.record();
    change(record);
    return failure(record, stored_files_of(traced_.record()));
  }

  // With one text in a file replaced by another, where it stands last.
  Failure first_failure(std::string StoredFiles::*file, const std::string& text, const std::string& by) const {
    StoredFiles files = stored_files_of(traced_.record());
    const auto at = (files.*file).rfind(text);
    EXPECT_NE(at, std::string::npos) << text;
    (files.*file).replace(at, text.size(), by);
    return failure(traced_.record(), files);
  }

  Failure failure(const Record& record, const StoredFiles& files) const {
    const Verdict verdict = verify(traced_.model(), record, files, "checkpoint");
    EXPECT_TRUE(verdict.findings.first().has_value()) << "not caught";
    return verdict.findings.first().value_or(Failure{});
  }

  Index structure_unknowns() const { return traced_.model().structure().size({}); }

  TracedDeck traced_;
};

// Another digit at the end of a number.
std::string with_other_digit(std::string number) {
  number.back() = number.back() == '5' ? '6' : '5';
  return number;
}

}  // namespace

TEST_F(FalsifiedRun, ADisplacementOffByAMillionthIsCaught) {
  const std::size_t where = pressed_point();
  const Failure first = first_failure([&](Record& record) { record.points[where].state.x[4] += 1e-6; });
  EXPECT_EQ(first.file, "checkpoint");
  EXPECT_EQ(first.step, traced_.record().points[where].step);
  EXPECT_EQ(first.what, "forces balance at nodes: x at column:0.0625") << "the first that the stretch pulls at";
}

TEST_F(FalsifiedRun, AContactThatPullsIsCaught) {
  const std::size_t where = pressed_point();
  const Failure first =
      first_failure([&](Record& record) { record.points[where].state.x[structure_unknowns()] *= -1.0; });
  EXPECT_EQ(first.file, "checkpoint");
  EXPECT_EQ(first.step, traced_.record().points[where].step);
  EXPECT_NE(first.what.find("contact forces push: "), std::string::npos) << first.what;
}

TEST_F(FalsifiedRun, AContactForceThatDoesNotBalanceIsCaught) {
  const Failure first = first_failure(
      [&](Record& record) { record.points[pressed_point()].state.x[structure_unknowns()] *= 1.0 + 1e-4; });
  EXPECT_NE(first.what.find("contact forces balance: "), std::string::npos) << first.what;
}

TEST_F(FalsifiedRun, APenetrationIsCaught) {
  const std::size_t where = pressed_point();
  const Structure& structure = traced_.model().structure();
  // The middle of the column moved through both walls, 0.2 away.
  const Index w = *structure.unknown(structure.dof(structure.members()[0].nodes[8], Dof::z));
  for (const double by : {1.0, -1.0}) {
    const Failure first = first_failure([&](Record& record) { record.points[where].state.x[w] += by; });
    EXPECT_EQ(first.step, traced_.record().points[where].step);
    EXPECT_TRUE(first.what.find("closed contacts have zero gap") == 0 ||
                first.what.find("open contacts have no negative gap") == 0)
        << first.what;
  }
}

TEST_F(FalsifiedRun, ACountOffByOneIsCaught) {
  for (const int by : {-1, 1}) {
    Record record = traced_.record();
    const std::size_t where = pressed_point();
    record.points[where].count.unstable = *record.points[where].count.unstable + by;
    const Failure first = failure(record, stored_files_of(record));
    EXPECT_EQ(first.file, "path.csv");
    EXPECT_EQ(first.step, record.points[where].step);
    EXPECT_NE(first.what.find("unstable directions"), std::string::npos) << first.what;
  }
}

// Lee's frame with its loaded point moved: under the force that it has there it loses stability at the greatest force,
// with its movement given where that turns.
TEST(FalsifiedMovedRun, ACountUnderDeadLoadsOffByOneIsCaughtSlow) {
  std::string text(example("lee"));
  const std::string load = "[[load]]\nat = \"loaded\"\nforce = [0.0, -1.0]";
  text.replace(text.find(load), load.size(), "[[prescribed]]\nat = \"loaded\"\nz = -90.0");
  const TracedDeck traced(text);
  const Record& record = traced.record();
  const Verdict verdict = verify(traced.model(), record, stored_files_of(record), "checkpoint");
  EXPECT_FALSE(verdict.findings.first().has_value()) << to_text(*verdict.findings.first());
  EXPECT_TRUE(has_check(verdict, "unstable directions under dead loads"));
  std::set<Index> counts;
  for (std::size_t i = 1; i < record.points.size(); i += 5) {
    if (!record.points[i].unstable_load_control || record.points[i].event) continue;
    counts.insert(*record.points[i].unstable_load_control - *record.points[i].count.unstable);
    for (const int by : {-1, 1}) {
      Record falsified = record;
      falsified.points[i].unstable_load_control = *record.points[i].unstable_load_control + by;
      const Verdict found = verify(traced.model(), falsified, stored_files_of(falsified), "checkpoint");
      ASSERT_TRUE(found.findings.first().has_value()) << i;
      EXPECT_NE(found.findings.first()->what.find("unstable_load_control is"), std::string::npos) << i;
    }
  }
  EXPECT_EQ(counts, (std::set<Index>{0, 1}));
}

TEST_F(FalsifiedRun, ADigitOfPathCsvIsCaught) {
  const RecordPoint& last = traced_.record().points.back();
  const auto caught = [&](double number, const std::string& what) {
    const std::string text = round_trip(number);
    const Failure first =
        first_failure(&StoredFiles::path_csv, text, with_other_digit(text.substr(0, 7)) + text.substr(7));
    EXPECT_EQ(first.file, "path.csv");
    EXPECT_EQ(first.step, last.step);
    EXPECT_EQ(first.what, "path.csv matches the states: " + what);
    EXPECT_GT(first.value.value(), first.bound.value());
  };
  caught(last.arc, "arc");
  caught(last.monitors[1], "monitor shortening");
  caught(last.energy, "energy");
  const Failure lambda = first_failure(&StoredFiles::path_csv, "," + round_trip(last.lambda) + ",",
                                       "," + round_trip(std::nextafter(last.lambda, 0.0)) + ",");
  EXPECT_EQ(lambda.what, "path.csv matches the states: lambda");
  EXPECT_EQ(first_failure(&StoredFiles::path_csv, ",stable,", ",stablex,").what,
            "path.csv matches the states: stability is \"stablex\" instead of \"stable\"");
  EXPECT_EQ(first_failure(&StoredFiles::path_csv, ",end\n", ",\n").what,
            "path.csv matches the states: event is \"\" instead of \"end\"");
}

TEST_F(FalsifiedRun, ADigitOfContactsCsvIsCaught) {
  const RecordForce& last = traced_.record().points.back().forces.back();
  const std::string force = round_trip(last.force);
  const Failure first =
      first_failure(&StoredFiles::contacts_csv, force, with_other_digit(force.substr(0, 8)) + force.substr(8));
  EXPECT_EQ(first.file, "contacts.csv");
  EXPECT_NE(first.what.find("force of " + last.label.wall), std::string::npos) << first.what;
  const Failure wall = first_failure(&StoredFiles::contacts_csv, last.label.wall, "other");
  EXPECT_NE(wall.what.find("wall of "), std::string::npos) << wall.what;
}

// What sticks has the place where it does.
TEST(FalsifiedFrictionRun, AnAnchorThatSaysSomethingElseIsCaught) {
  using namespace friction_test;
  const TracedDeck traced(title("A strip that sticks") +
                          strip(0.8, stage("press", "prescribed.0", 0.0005, -1.0, 0.001)));
  const Record& record = traced.record();
  StoredFiles files = stored_files_of(record);
  ASSERT_FALSE(verify(traced.model(), record, files, "checkpoint").findings.first().has_value());
  const std::optional<double> anchor = record.points.back().forces.back().friction->anchor;
  ASSERT_TRUE(anchor);
  const std::string told = "," + round_trip(*anchor) + "\n";
  files.contacts_csv.replace(files.contacts_csv.rfind(told), told.size(), ",0.123\n");
  const auto first = verify(traced.model(), record, files, "checkpoint").findings.first();
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(first->file, "contacts.csv");
  EXPECT_NE(first->what.find("anchor of floor"), std::string::npos) << first->what;
}

TEST_F(FalsifiedRun, AnEventThatSaysSomethingElseIsCaught) {
  const Failure lambda = first_failure(&StoredFiles::events_json, "\"lambda\": ", "\"lambda\": 1");
  EXPECT_EQ(lambda.file, "events.json");
  EXPECT_EQ(lambda.what, "events.json matches the states: lambda");
  const Failure count = first_failure(&StoredFiles::events_json, "\"unstable_before\": 0", "\"unstable_before\": 1");
  EXPECT_EQ(count.file, "events.json");
  EXPECT_NE(count.what.find("unstable_before is 1"), std::string::npos) << count.what;
  EXPECT_EQ(first_failure(&StoredFiles::events_json, "\"events\"", "\"others\"").what,
            "events.json matches the states: it cannot be read");
}

TEST_F(FalsifiedRun, AMissingRowIsCaught) {
  StoredFiles files = stored_files_of(traced_.record());
  files.path_csv.erase(files.path_csv.rfind('\n', files.path_csv.size() - 2) + 1);
  const Failure first = failure(traced_.record(), files);
  EXPECT_EQ(first.file, "path.csv");
  EXPECT_NE(first.what.find("rows"), std::string::npos) << first.what;
}

TEST_F(FalsifiedRun, AStateThatIsNotFiniteIsCaught) {
  const Failure first =
      first_failure([](Record& record) { record.points[3].state.x[2] = std::numeric_limits<double>::quiet_NaN(); });
  EXPECT_EQ(first.step, 3);
  EXPECT_EQ(first.what, "states are finite and complete: its unknowns");
}

// With contact that slides: a place moved along the member is no longer tangent. The record is cut down to one point.
TEST(FalsifiedSlidingRun, APlaceAMomentAndAPenetrationAreCaught) {
  const TracedDeck traced(example("channel"), {"member.column.elements=16"});
  Record record = traced.record();
  const auto pressed = [](const RecordPoint& at) { return at.contacts > 0 && !at.event; };
  const auto where = std::find_if(record.points.begin(), record.points.end(), pressed);
  ASSERT_NE(where, record.points.end());
  const RecordPoint point = *where;
  record.points = {point};
  record.events.clear();
  record.branches[0].points = 1;
  record.branches[0].least_lambda = record.branches[0].greatest_lambda = point.lambda;
  expect_confirmed_point(traced, record);

  const State& state = point.state;
  const auto caught = [&](Index unknown, double by) {
    Record falsified = record;
    falsified.points[0].state.x[unknown] += by;
    const Verdict verdict = verify(traced.model(), falsified, stored_files_of(record), "checkpoint");
    EXPECT_TRUE(verdict.findings.first().has_value());
    const std::string what = verdict.findings.first().value_or(Failure{}).what;
    return what.substr(0, what.find(':'));
  };
  const auto& on = static_cast<const SlidingContactLayout&>(*state.active_set.layout());
  const Index size = state.x.size(), m = on.mesh().breakpoints();
  const auto [run, position] = on.mesh().breakpoint(0);
  const NodeUnknowns touching = on.mesh().node_unknowns(run, position);
  EXPECT_EQ(caught(size - m, 1e-6), "forces balance at nodes") << "a place";
  EXPECT_EQ(caught(size - 2 * m, 1e-6), "tangency multiplier is zero");
  EXPECT_EQ(caught(touching[2], 1e-6), "moving contacts are tangent");
  EXPECT_EQ(caught(touching[1], 1e-3), "closed contacts have zero gap");
}

// --- the list of events
// -----------------------------------------------------------------------------------------------

}  // namespace arcwall::verify::falsified_run_test
