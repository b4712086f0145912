#include "apps/output/events_text.hpp"

#include <gtest/gtest.h>

#include "apps/cli/progress.hpp"
#include "apps/output/load_text.hpp"
#include "apps/output/text_table.hpp"
#include "model/version.hpp"
#include "tests/apps/output/sample_record.hpp"

namespace arcwall::events_text_test {
namespace {

TEST(EventsText, IsATableForPeople) {
  EXPECT_EQ(events_text(sample_record()),
            "A sample\n"
            "sample.toml, trace-path " +
                program_version() + R"(

id  step     λ  kind                 what                                                                        mid [cm]  turn [rad]  unstable
 0     0     0  start                                                                                                   0           0  0
 1     1   0.1  contact-closes       upper at column:0.25, upper at column:0.5, upper at column:0.75 and 1 more  0.333333           0  0 → ?
 2     1   0.1  contact-limit-point                                                                              0.333333           0  0 → 1
 3     2  0.05  end                  stop                                                                             0.2         inf  1

)" + count_note(sample_record()) +
                R"(

branch 0: 3 points, ended: mid = 0.2 (stop)
)");
  Record known = sample_record();
  known.events[1].unstable_after = 0;
  EXPECT_EQ(count_note(known), "");
}

// A branch point that is located to 4 % only, and a branch that leaves it.
TEST(EventsText, ShowsNoDigitThatIsNotSureAndSaysSo) {
  Record record = sample_record();
  record.columns.clear();
  for (RecordEvent& event : record.events) event.monitors.clear();
  record.branches.push_back({.id = 1, .parent = 0, .origin = 2, .points = 1});
  record.events[1].lambda = 0.123456789012;
  record.events[1].unstable_after = 0;
  record.events[2].lambda = 1.0120114646;
  record.events[2].lambda_uncertainty = 0.038;
  record.events[3].lambda = 0.123456789012;
  record.events[3].lambda_uncertainty = 1e-9;
  EXPECT_EQ(events_text(record),
            "A sample\n"
            "sample.toml, trace-path " +
                program_version() + R"(

id  branch  step            λ  kind                 what                                                                        unstable
 0       0     0            0  start                                                                                            0
 1       0     1  0.123456789  contact-closes       upper at column:0.25, upper at column:0.5, upper at column:0.75 and 1 more  0
 2       0     1  1.01 ± 0.05  contact-limit-point                                                                              0 → 1
 3       0     2   0.12345679  end                  stop                                                                        1

λ = a ± b: the event lies between a − b and a + b and could not be located more closely; smaller steps may do so.

branch 0: 3 points, ended: mid = 0.2 (stop)
  at λ = 1.01 ± 0.05 (event 2): branch 1: 1 point
)");
}

TEST(EventsText, NamesTheBranchOnlyIfThereAreSeveral) {
  Record record = sample_record();
  EXPECT_EQ(events_text(record).find("id  branch  step"), std::string::npos);
  record.branches.push_back({.id = 1, .parent = 0});
  EXPECT_NE(events_text(record).find("id  branch  step"), std::string::npos);
}

TEST(EventsText, SaysHowABranchWithoutDetailEnded) {
  EXPECT_EQ(how_it_ended({EndReason::interrupted, ""}), "the run was interrupted (interrupted)");
  EXPECT_EQ(how_it_ended({EndReason::stop, "w = 1"}), "w = 1 (stop)");
}

TEST(TextTable, CountsCharactersNotBytes) {
  using Side = TableColumn::Side;
  EXPECT_EQ(text_table({{"a"}, {"λ", Side::right}}, {{"→→", "1"}, {"b", "20"}}),
            "a    λ\n"
            "→→   1\n"
            "b   20\n");
}

}  // namespace
TEST(EventsText, SaysWhatLambdaIs) {
  EXPECT_NE(events_text(sample_record(), {"displacement in x of B, times 2 cm"})
                .find("\nλ: displacement in x of B, times 2 cm\n\n"),
            std::string::npos);
  const auto named = [](const std::string& driven) {
    deck::Deck deck{.units = {.length = "cm", .force = "kN"}};
    if (driven == "movement") deck.prescribed = {{.point = "B", .x = -2.0}};
    if (driven == "force") deck.loads = {{.action = deck::PointLoad{.force = {.x = 1.0}}}};
    if (driven == "both") deck.prescribed = {{.point = "B", .x = -2.0}, {.point = "C", .z = 1.0}};
    if (driven == "pressure") deck.loads = {{.action = deck::Pressure{.member = "arch", .pressure = -3.0}}};
    return name_of_lambda(deck);
  };
  EXPECT_EQ(named("movement"), "displacement in x of B, times 2 cm");
  EXPECT_EQ(named("pressure"), "pressure on arch, times 3 kN/cm");
  EXPECT_EQ(named("force"), "");
  EXPECT_EQ(named("both"), "");
}

// The same words in the progress line; of stages each has its own.
TEST(EventsText, SaysWhatLambdaIsInEachStage) {
  deck::Deck deck{.units = {.length = "cm", .force = "kN"}};
  deck.prescribed = {{.point = "B", .x = -2.0}};
  deck.walls = {{.name = "hill", .motion = deck::WallMotion{.z = -3.0}}, {.name = "floor"}};
  deck.stages = {{.name = "shorten", .drives = {"prescribed.0"}},
                 {.name = "push", .drives = {"wall.hill"}},
                 {.name = "both", .drives = {"prescribed.0", "wall.hill"}}};
  const auto names = names_of_lambda(deck);
  EXPECT_EQ(names, (std::vector<std::string>{"displacement in x of B, times 2 cm", "way of hill, times 3 cm", ""}));

  Record record = sample_record();
  record.stages = {"shorten", "push", "both"};
  record.branches.front().stage = 1;
  EXPECT_NE(events_text(record, names)
                .find("\nλ of shorten: displacement in x of B, times 2 cm\nλ of push: way of hill, times 3 cm\n\n"),
            std::string::npos);
  RecordPoint point = record.points.front();
  point.lambda = 0.25;
  EXPECT_NE(progress_text(record, point, names).find("λ=0.25 (way of hill, times 3 cm)  "), std::string::npos)
      << progress_text(record, point, names);
  record.branches.front().stage = 2;
  EXPECT_NE(progress_text(record, point, names).find("λ=0.25  "), std::string::npos);
}

}  // namespace arcwall::events_text_test
