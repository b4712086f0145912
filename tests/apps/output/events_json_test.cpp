#include "apps/output/events_json.hpp"

#include <gtest/gtest.h>

#include "apps/output/events_text.hpp"
#include "model/event_names.hpp"
#include "model/version.hpp"
#include "tests/apps/output/sample_record.hpp"

namespace arcwall::events_json_test {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> keys(const Json& json) {
  std::vector<std::string> result;
  for (const auto& item : json.items()) result.push_back(item.key());
  return result;
}

const std::vector<std::string> common{"id",
                                      "kind",
                                      "branch",
                                      "step",
                                      "arc",
                                      "lambda",
                                      "monitors",
                                      "unstable_before",
                                      "unstable_after",
                                      "residual",
                                      "lambda_uncertainty"};

TEST(EventsJson, NamesDeckVersionAndBranches) {
  const Json json = events_json(sample_record());

  EXPECT_EQ(keys(json), (std::vector<std::string>{"deck", "version", "branches", "events"}));
  EXPECT_EQ(json["deck"], "sample.toml");
  EXPECT_EQ(json["version"], program_version());
  EXPECT_EQ(
      json["branches"].dump(),
      R"([{"id":0,"parent":null,"origin":null,"after_jump":false,"mirror_image":false,"points":3,"lambda":[0.0,0.1],"end":{"reason":"stop","detail":"mid = 0.2"}}])");
}

TEST(EventsJson, AnEventHasTheKeysOfItsKind) {
  const Json events = events_json(sample_record())["events"];
  const auto with = [](std::vector<std::string> more) {
    std::vector<std::string> all = common;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };

  ASSERT_EQ(events.size(), 4u);
  EXPECT_EQ(keys(events[0]), common);
  EXPECT_EQ(keys(events[1]), with({"contact"}));
  EXPECT_EQ(keys(events[2]), common);
  EXPECT_EQ(keys(events[3]), with({"reason", "detail"}));
  EXPECT_EQ(events[1]["kind"], "contact-closes");
  EXPECT_EQ(events[1]["contact"].size(), 4u);
  EXPECT_EQ(events[1]["contact"][0].dump(), R"({"wall":"upper","member":"column","fraction":0.25,"x":0.5})");
  EXPECT_EQ(events[3]["reason"], "stop");
}

TEST(EventsJson, ADisplacementLimitNamesItsMonitorAndABranchPointItsType) {
  Record record = sample_record();
  record.events[0].kind = EventKind::turning_point;
  record.events[0].monitor = "mid";
  record.events[1].kind = EventKind::branch_point;
  record.events[1].branch_type = BranchType::one_sided;
  record.events[1].mode = {1.0, 0.5};

  const Json events = events_json(record)["events"];

  EXPECT_EQ(events[0]["monitor"], "mid");
  EXPECT_EQ(events[1]["type"], "one-sided");
  EXPECT_EQ(events[1]["mode"].dump(), R"({"mid":1.0,"turn":0.5})");
  EXPECT_FALSE(events[1].contains("contact"));
}

// Of a change of contact, and of an end, behind which the equilibria form a continuum.
TEST(EventsJson, AContinuumIsAFamily) {
  Record record = sample_record();
  record.events[0].kind = EventKind::contact_spreads;
  record.events[0].continuum = Continuum{.parts = 3, .energy = -4.5, .length = 0.25};
  const Json events = events_json(record)["events"];
  EXPECT_EQ(events[0]["family"].dump(), R"({"parts":3,"energy":-4.5,"length":0.25})");
  EXPECT_FALSE(events[1].contains("family"));
  EXPECT_TRUE(event_detail(record.events[0]).ends_with("of 3 lengths only the sum is determined"));
}

TEST(EventsJson, WhatIsUnknownOrNotFiniteIsNull) {
  const Json events = events_json(sample_record())["events"];
  EXPECT_EQ(events[1]["unstable_before"], 0);
  EXPECT_TRUE(events[1]["unstable_after"].is_null());
  EXPECT_TRUE(events[3]["monitors"]["turn"].is_null());
}

TEST(EventsJson, NumbersReadBackAsTheSame) {
  const Json json = Json::parse(to_text(events_json(sample_record()), JsonLayout::lines));
  EXPECT_EQ(json["events"][1]["arc"].get<double>(), 0.30000000000000004);
  EXPECT_EQ(json["events"][1]["monitors"]["mid"].get<double>(), 1.0 / 3.0);
}

TEST(EventsJson, OneLineIsOneLineWhateverTheBytes) {
  const std::string text = to_text(Json{{"deck", "a\nb\xff"}}, JsonLayout::one_line);
  EXPECT_EQ(text.find('\n'), text.size() - 1);
  EXPECT_TRUE(Json::accept(text));
}

TEST(EventNames, EveryNameReadsBack) {
  for (int i = 0; i <= static_cast<int>(EventKind::branch_point); ++i) {
    const auto kind = static_cast<EventKind>(i);
    EXPECT_EQ(event_kind(to_text(kind)), kind) << to_text(kind);
  }
  for (int i = 0; i <= static_cast<int>(EndReason::rigid_body_motion); ++i) {
    const auto reason = static_cast<EndReason>(i);
    EXPECT_EQ(end_reason(to_text(reason)), reason) << to_text(reason);
    EXPECT_FALSE(explanation(reason).empty());
  }
  EXPECT_EQ(event_kind("limit_point"), std::nullopt);
  EXPECT_EQ(end_reason(""), std::nullopt);
}

}  // namespace
}  // namespace arcwall::events_json_test
