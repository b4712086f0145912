// Equilibria that no traced branch passes, against closed forms and shooting.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "answers/sessions.hpp"
#include "apps/output/events_json.hpp"
#include "apps/output/events_text.hpp"
#include "apps/output/exit_status.hpp"
#include "apps/output/path_csv.hpp"
#include "apps/output/run_warnings.hpp"
#include "apps/output/search_rows.hpp"
#include "core/error.hpp"
#include "model/shape.hpp"
#include "tests/apps/deck_texts.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/expect_whole.hpp"

namespace arcwall::search_test {
namespace {

using test::TracedDeck;

// Two bars of half-span 10 and rise 1, traced up to their snap.
const std::string truss = test::low_truss + R"toml([path]
step = 0.3
branches = "primary"
search = true
search_at = [1.0]
search_guesses = 20
stop = { lambda = [-2.0, 5.0], event = "limit-point" }
)toml";

// With y = w + h the bars carry λ = EA y (y² − h²)/L³: y³ − h² y − c = 0, c = λ L³/EA, by Viète's cosines.
std::vector<double> roots_of_the_truss(double lambda) {
  const double c = lambda * std::pow(101.0, 1.5) / 1e4, angle = std::acos(1.5 * std::sqrt(3.0) * c) / 3.0;
  std::vector<double> w;
  for (int k = 0; k < 3; ++k)
    w.push_back(-2.0 / std::sqrt(3.0) * std::cos(angle - 2.0 * std::numbers::pi * k / 3.0) - 1.0);
  std::sort(w.begin(), w.end());
  return w;
}

// A column with a half sine as imperfection, in a channel that presses its flat part onto one wall and draws it off the
// other.
std::string channel() {
  std::string deck =
      test::pressed_column_in_channel(40, "search = true, search_at = [6.5], stop = { lambda = [-1.0, 10.0] }") +
      test::shortening;
  const std::string third = ", { shape = \"sine\", amplitude = 0.0001, waves = 3 }";
  deck.erase(deck.find(third), third.size());
  return deck;
}

// An equilibrium of the channel at λ = 6.5.
struct Expected {
  std::string word;  // of it, or of its image from left to right
  double shortening, energy;
  Index unstable;
  bool always = true;  // found by every seed that was tried
};

std::string reversed(const std::string& word) {
  std::string other;
  for (std::size_t end = word.size(); end != std::string::npos && end > 0;) {
    const std::size_t space = word.rfind(' ', end - 1);
    const std::size_t first = space == std::string::npos ? 0 : space + 1;
    other += (other.empty() ? "" : " ") + word.substr(first, end - first);
    end = space == std::string::npos ? 0 : space;
  }
  return other;
}

// Shooting with the classical Runge-Kutta method from contact to contact, Newton's method closing the arcs. The flat
// part on the upper wall is that of the traced branch.
const std::vector<Expected> in_channel{
    {"", 0.0619010781, -0.2011642493, 3},
    {"lower lower", 0.1346641302, -0.5023986066, 0},
    {"lower lower", 0.1372136184, -0.5019826449, 1},
    {"upper upper", 0.1373224865, -0.5026761898, 1},
    {"upper lower upper", 0.3510879754, -0.8732452339, 0},
    {"lower upper lower", 0.3510879756, -0.8732452528, 0},
    {"upper lower", 0.2077965336, -0.8043281694, 0},
    {"upper lower", 0.2237987525, -0.6792030616, 1},
    {"lower upper", 0.2238101719, -0.6793257214, 1},
    {"lower lower", 0.1153809013, -0.4244756216, 1},
    {"upper=", 0.1154073397, -0.4250887835, 1},
    {"upper", 0.1102877376, -0.4003327061, 2, false},
    {"lower", 0.1102490178, -0.3998614630, 2, false},
    {"upper", 0.0968527103, -0.3469004233, 2},
    {"lower", 0.0968161522, -0.3464120183, 2},
};

bool is_this(const RecordFound& found, const Expected& expected) {
  const bool word = found.contact_pattern == expected.word || found.contact_pattern == reversed(expected.word);
  return word && found.unstable == expected.unstable && std::abs(found.monitors.at(1) - expected.shortening) < 1e-6 &&
         std::abs(found.energy - expected.energy) < 1e-6;
}

// Traced until a point of a branch that was found, then taken up from a checkpoint every few points.
Record taken_up(const std::string& deck, int stride) {
  Session run = make_session({.deck = "deck.toml", .deck_text = deck});
  EXPECT_TRUE(run.begin());
  for (int points = 1; run.next() != nullptr; ++points)
    if (points % stride == 0) run = resume_session(run.checkpoint(), "checkpoint", Session::Resume::go_on);
  return run.record();
}

std::string all_of(const Record& record) {
  return path_csv(record, UnitLabels::shown) + to_text(events_json(record), JsonLayout::lines) +
         search_json(record).dump();
}

}  // namespace

TEST(Search, FindsTheOtherEquilibriaOfATruss) {
  const TracedDeck traced(truss);
  const Record& record = traced.record();
  ASSERT_EQ(record.searches.size(), 1u);
  const RecordSearch& search = record.searches[0];
  EXPECT_EQ(search.known, 1);
  ASSERT_EQ(search.found.size(), 2u);
  std::vector<RecordFound> found = search.found;
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.monitors[0] < b.monitors[0]; });
  const std::vector<double> w = roots_of_the_truss(1.0);
  EXPECT_NEAR(found[0].monitors[0], w[0], 1e-10);
  EXPECT_NEAR(found[1].monitors[0], w[1], 1e-10);
  EXPECT_EQ(found[0].unstable, 0);
  EXPECT_EQ(found[1].unstable, 1);
}

// The inverted truss and the one in between are not connected with the first branch, which ends before it comes there.
TEST(Search, TracesWhatIsFoundBothWays) {
  const TracedDeck traced(truss);
  const Record& record = traced.record();
  ASSERT_EQ(record.branches.size(), 5u);
  const auto json = events_json(record);
  EXPECT_TRUE(json["branches"][0]["origin"].is_null());
  for (const RecordFound& found : record.searches[0].found) {
    ASSERT_EQ(found.fate, FoundFate::traced);
    ASSERT_EQ(found.branches.size(), 2u);
    std::vector<double> slopes;
    for (const Index id : found.branches) {
      const RecordBranch& branch = record.branches[static_cast<std::size_t>(id)];
      EXPECT_TRUE(branch.found);
      EXPECT_GT(branch.points, 2);
      EXPECT_EQ(json["branches"][static_cast<std::size_t>(id)]["origin"], "search");
      const auto first = std::find_if(record.points.begin(), record.points.end(),
                                      [&](const RecordPoint& point) { return point.branch == id; });
      EXPECT_EQ(first->lambda, 1.0);
      slopes.push_back((first + 1)->lambda - first->lambda);
    }
    EXPECT_GT(slopes[0], 0.0);
    EXPECT_LT(slopes[1], 0.0);
  }
  const std::string text = events_text(record);
  EXPECT_NE(text.find("at λ = 1, found: branch 1:"), std::string::npos) << text;
  EXPECT_NE(text.find(search_note()), std::string::npos) << text;
}

TEST(Search, CountsWhatBecameOfItsTries) {
  const TracedDeck traced(truss);
  const auto json = search_json(traced.record());
  const auto& at = json["at"][0];
  EXPECT_EQ(at["lambda"], 1.0);
  EXPECT_EQ(at["known"], 1);
  int sum = 0;
  for (const char* outcome : {"found", "mirror_image", "known", "nodes_only", "not_found"})
    sum += at["outcomes"][outcome].get<int>();
  EXPECT_EQ(at["outcomes"].size(), 5u);
  EXPECT_EQ(at["guesses"], sum);
  EXPECT_GE(sum, 20);
  EXPECT_EQ(at["found"][0]["became"], "traced");
  EXPECT_TRUE(search_json(TracedDeck(truss, {"path.search=false"}).record()).is_null());
}

TEST(Search, LeavesWhatIsBeyondTheStopsUntraced) {
  const TracedDeck traced(truss, {"path.stop.w=[-1.5, 0.5]"});
  const auto& found = traced.record().searches.at(0).found;
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(
      std::count_if(found.begin(), found.end(), [](const auto& one) { return one.fate == FoundFate::beyond_stop; }), 1);
  EXPECT_EQ(traced.record().branches.size(), 3u);
}

// Two bars of half-span 1 and rise 5 sway with P L³ = 2 z and x² + z² = 23, the place of the top from the feet. That
// branch leaves the one through the state that is found, upside down, at z = −√23.
TEST(Search, TracesWhatBifurcatesFromABranchThatIsFound) {
  const std::string deck =
      test::truss_of(1.0, 5.0, 1.0) + test::monitor("u", "top", "x") +
      test::path(
          "step = 0.01; search = true; search_at = [0.03]; search_guesses = 1; stop = { lambda = [-0.5, 0.06] }");
  const TracedDeck traced(deck);
  const Record& record = traced.record();
  const auto child = std::find_if(record.branches.begin(), record.branches.end(),
                                  [](const RecordBranch& branch) { return branch.parent.has_value(); });
  ASSERT_NE(child, record.branches.end());
  EXPECT_FALSE(child->found);
  EXPECT_TRUE(record.branches[static_cast<std::size_t>(*child->parent)].found);
  const double cube = std::pow(26.0, 1.5);
  EXPECT_NEAR(record.events[static_cast<std::size_t>(*child->origin)].lambda, -2.0 * std::sqrt(23.0) / cube, 1e-9);
  EXPECT_GT(child->points, 3);
  for (const RecordPoint& point : record.points) {
    if (point.branch != child->id) continue;
    const double z = 5.0 + point.monitors.at(0), x = point.monitors.at(1);
    EXPECT_NEAR(point.lambda * cube, 2.0 * z, 1e-8);
    EXPECT_NEAR(x * x + z * z, 23.0, 1e-8);
  }
  test::expect_verified(traced);
}

// Where the whole path is traced nothing is left to be found.
TEST(Search, FindsNothingWhereThePathPassesAll) {
  std::string whole = truss;
  const std::string event = ", event = \"limit-point\"";
  whole.erase(whole.find(event), event.size());
  const TracedDeck traced(whole, {"path.stop.lambda=[-5.0, 5.0]"});
  EXPECT_EQ(traced.record().searches.at(0).known, 3);
  EXPECT_TRUE(traced.record().searches.at(0).found.empty());
  EXPECT_EQ(traced.record().branches.size(), 1u);
}

// At five values over the range of the events, of which the first branch has one here: then over that of its points.
TEST(Search, ChoosesItsValuesByThePath) {
  std::string deck = truss;
  deck.erase(deck.find("search_at"), std::string("search_at = [1.0]\n").size());
  const TracedDeck traced(deck, {"path.search_guesses=2"});
  ASSERT_EQ(traced.record().searches.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(traced.record().searches[i].lambda, (0.1 + 0.2 * double(i)) * 3.7920, 1e-3);
}

TEST(Search, DependsOnItsSeedAlone) {
  const TracedDeck once(truss), again(truss), other(truss, {"path.search_seed=7"});
  EXPECT_EQ(all_of(once.record()), all_of(again.record()));
  EXPECT_EQ(other.record().searches.at(0).found.size(), 2u);
}

TEST(Search, SurvivesTheCheckpoint) {
  const std::string deck = truss + "jumps = true\n";
  const Record whole = TracedDeck(deck).record();
  EXPECT_EQ(all_of(taken_up(deck, 1)), all_of(whole));
  EXPECT_EQ(all_of(taken_up(deck, 7)), all_of(whole));
}

// What a checkpoint says of a find must fit the run.
TEST(Search, IsReadOnlyWhereItFitsTheRun) {
  Session run = make_session({.deck = "deck.toml", .deck_text = truss});
  ASSERT_TRUE(run.begin());
  while (run.next() != nullptr) {
  }
  Session other = resume_session(run.checkpoint(), "checkpoint", Session::Resume::as_ended);
  EXPECT_EQ(all_of(other.record()), all_of(run.record()));
  const_cast<Record&>(run.record()).searches[0].found[0].monitors.push_back(0.0);
  EXPECT_THROW(resume_session(run.checkpoint(), "checkpoint", Session::Resume::as_ended), OutputError);
}

// A stage begins where the one before has ended, beside which nothing counts.
TEST(Search, IsRefusedOfADeckWithStages) {
  try {
    make_session({.deck = "deck.toml", .deck_text = truss + "[[stage]]\nname = \"one\"\ndrives = [\"load.0\"]\n"});
    ADD_FAILURE() << "was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("search = true belongs to a deck without stages"), std::string::npos)
        << error.what();
  }
}

// Who stops a run does not wait for a search.
TEST(Search, IsNotMadeWhereARunIsStopped) {
  Session run = make_session({.deck = "deck.toml", .deck_text = truss});
  ASSERT_TRUE(run.begin());
  ASSERT_NE(run.next(), nullptr);
  run.stop({.reason = EndReason::interrupted, .detail = "enough"});
  EXPECT_EQ(run.next(), nullptr);
  EXPECT_TRUE(run.record().searches.empty());
}

// What nobody asked for may end somewhere far off; a limit that stops it counts.
TEST(Search, LeavesTheStatusToTheOtherBranches) {
  Record record;
  record.branches = {{.id = 0, .end = BranchEnd{.reason = EndReason::stop}},
                     {.id = 1, .found = true, .end = BranchEnd{.reason = EndReason::min_step}}};
  EXPECT_EQ(exit_status(record), ExitStatus::success);
  EXPECT_EQ(found_that_ended_early(record), std::vector<Index>{1});
  EXPECT_NE(warning_of_found(record).find("(1)"), std::string::npos);
  record.branches[1].end->reason = EndReason::max_points;
  EXPECT_EQ(exit_status(record), ExitStatus::limit_met);
  record.branches[1] = {.id = 1, .end = BranchEnd{.reason = EndReason::min_step}};
  EXPECT_EQ(exit_status(record), ExitStatus::ended_early);
  EXPECT_EQ(warning_of_found(record), "");
}

// Of the first branch alone, on which the column lies flat on the upper wall: on the lower wall the same imperfection
// draws it off, so that it stands on two points there. All others are there as well, and none that shooting has not.
TEST(Search, FindsTheEquilibriaOfAColumnInAChannelSlow) {
  const TracedDeck traced(channel());
  const Record& record = traced.record();
  const RecordSearch& search = record.searches.at(0);
  EXPECT_EQ(search.known, 1);
  for (const RecordFound& found : search.found)
    EXPECT_TRUE(
        std::any_of(in_channel.begin(), in_channel.end(), [&](const Expected& one) { return is_this(found, one); }))
        << found.contact_pattern << " " << found.monitors.at(1) << " " << found.energy;
  for (const Expected& expected : in_channel) {
    const auto count = std::count_if(search.found.begin(), search.found.end(),
                                     [&](const RecordFound& found) { return is_this(found, expected); });
    EXPECT_LE(count, 1) << expected.word << " " << expected.shortening;
    EXPECT_TRUE(count == 1 || !expected.always) << expected.word << " " << expected.shortening;
  }
  // Two points below lie on a closed curve that no branch of the perfect column is left of: the imperfection isolates
  // it. It is traced once around.
  const auto below = std::find_if(search.found.begin(), search.found.end(),
                                  [&](const RecordFound& found) { return is_this(found, in_channel[1]); });
  ASSERT_NE(below, search.found.end());
  ASSERT_EQ(below->branches.size(), 1u);
  EXPECT_EQ(record.branches[static_cast<std::size_t>(below->branches[0])].end->reason, EndReason::closed_loop);
}

// Where no element says how the body bends the mesh has equilibria of its own, with elements that have collapsed: some
// twenty of the thick column in the example. A body of EA = 210 kN that bears some kN keeps its length but for a
// twentieth, and an arc of 0.3 rad is 0.4 % longer than its chord.
TEST(Search, TellsNoEquilibriumInWhichTheBodyIsCrushedSlow) {
  const TracedDeck traced(test::example("channel"), {"path.search=true", "path.search_at=[6.1]", "path.jumps=false"});
  const Record& record = traced.record();
  ASSERT_GE(record.searches.at(0).found.size(), 3u);
  constexpr double length = 2.0;
  for (const RecordPoint& point : record.points) {
    const RecordBranch& branch = record.branches[static_cast<std::size_t>(point.branch)];
    if (!branch.found || point.step + 1 == branch.points) continue;
    const std::vector<ShapePoint> places = shape_of(traced.model(), point.state).members.at(0).points;
    for (std::size_t i = 0; i + 1 < places.size(); ++i) {
      const double along = length * (places[i + 1].fraction - places[i].fraction);
      EXPECT_GE((places[i + 1].position - places[i].position).norm(), 0.9 * along - 1e-9)
          << "branch " << point.branch << ", step " << point.step << " at " << places[i].fraction;
    }
  }
  test::expect_verified(traced);
}

}  // namespace arcwall::search_test
