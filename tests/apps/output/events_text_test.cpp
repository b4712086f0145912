#include "apps/output/events_text.hpp"

#include <gtest/gtest.h>

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
 1     1   0.1  contact-closes       upper at column:0.25, upper at column:0.5, upper at column:0.75 and 1 more  0.333333      1e-300  0 → ?
 2     1   0.1  contact-limit-point                                                                              0.333333      1e-300  0 → 1
 3     2  0.05  end                  stop                                                                             0.2         inf  1

branch 0: 3 points, ended: mid = 0.2 (stop)
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
}  // namespace arcwall::events_text_test
