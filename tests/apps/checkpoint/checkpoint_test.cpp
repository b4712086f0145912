#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include "answers/sessions.hpp"
#include "apps/output/contacts_csv.hpp"
#include "apps/output/events_json.hpp"
#include "apps/output/path_csv.hpp"
#include "core/error.hpp"
#include "model/checkpoint/archive.hpp"
#include "model/checkpoint/checkpoint_file.hpp"
#include "tests/apps/traced_deck.hpp"

// A run that is kept and taken up again goes on to the last bit as if it had never stopped.
namespace arcwall::checkpoint_test {
namespace {

using Json = nlohmann::json;
using Resume = Session::Resume;
using Assignments = std::vector<std::string>;

Session begun(const std::string& example, const Assignments& assignments = {}) {
  Session run = make_session(
      {.deck = example + ".toml", .deck_text = std::string(test::example(example)), .assignments = assignments});
  EXPECT_TRUE(run.begin()) << run.problem();
  return run;
}

// Taken up from a checkpoint after each `stride` points.
Session traced(const std::string& example, const Assignments& assignments, int stride) {
  Session run = begun(example, assignments);
  for (int points = 1; run.next() != nullptr; ++points)
    if (stride > 0 && points % stride == 0) run = resume_session(run.checkpoint(), "checkpoint", Resume::go_on);
  return run;
}

struct Case {
  std::string example;
  Assignments assignments;
  int stride;
};

std::ostream& operator<<(std::ostream& out, const Case& run) {
  out << run.example;
  for (const std::string& assignment : run.assignments) out << " --set " << assignment;
  return out << ", taken up every " << run.stride << (run.stride == 1 ? " point" : " points");
}

class ResumedRun : public testing::TestWithParam<Case> {};

TEST_P(ResumedRun, EndsWithTheFilesOfAnUninterruptedOne) {
  const auto& [example, assignments, stride] = GetParam();
  Session whole = traced(example, assignments, 0), parts = traced(example, assignments, stride);
  EXPECT_GT(whole.record().points.size(), 5u);
  EXPECT_EQ(path_csv(parts.record(), UnitLabels::shown), path_csv(whole.record(), UnitLabels::shown));
  EXPECT_EQ(contacts_csv(parts.record(), UnitLabels::shown), contacts_csv(whole.record(), UnitLabels::shown));
  EXPECT_EQ(events_json(parts.record()), events_json(whole.record()));
  EXPECT_TRUE(parts.checkpoint() == whole.checkpoint());
}

INSTANTIATE_TEST_SUITE_P(
    Runs, ResumedRun,
    testing::Values(
        Case{"truss", {}, 1}, Case{"lee", {}, 5}, Case{"channel", {}, 3},
        // Contact at nodes: corners, several branches and their queue.
        Case{"channel", {"contact.points=\"nodes\"", "path.branches=\"all\"", "member.column.elements=20"}, 2},
        Case{"arch", {"path.branches=\"all\""}, 3}, Case{"foundation", {}, 1},
        Case{"foundation", {"contact.method=\"penalty\"", "contact.penalty=1e6"}, 2},
        Case{"foundation", {"contact.method=\"augmented\"", "contact.penalty=1e5"}, 2},
        Case{"foundation", {"path.method=\"incremental\"", "path.step=0.05", "path.output_at={lambda=[0.25, 0.5]}"}, 3},
        Case{"cylinder", {}, 2}, Case{"thick", {}, 10}, Case{"cantilever", {}, 4}),
    [](const auto& run) { return run.param.example + std::to_string(run.index); });

// Rows of shallow arches on posts, held at their ends: 5040 unknowns, so many that springs make K definite (core/
// modified_cholesky.hpp), which differ with what was factorized before in the same step.
std::string large_frame() {
  constexpr int side = 42;
  constexpr double rise = 0.08, bay = 1.0 / (side - 1), load = 1e4 * rise * rise * rise * bay;
  std::ostringstream joints, members, supports, loads;
  const auto name = [](int row, int column) { return "n" + std::to_string(row) + "_" + std::to_string(column); };
  const auto member = [&](const std::string& from, const std::string& to, const char* section) {
    members << "[member." << from << "-" << to << "]\nfrom = \"" << from << "\"\nto = \"" << to
            << "\"\ntheory = \"euler-bernoulli\"\nmaterial = \"one\"\nsection = \"" << section << "\"\nelements = 1\n";
  };
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const double x = column * bay, z = row * bay + rise * std::sin(pi * x);
      const std::string here = name(row, column);
      joints << here << " = [" << x << ", " << z << "]\n";
      if (column + 1 < side) member(here, name(row, column + 1), "row");
      if (row + 1 < side) member(here, name(row + 1, column), "post");
      if (column == 0 || column + 1 == side)
        supports << here << " = [\"x\", \"z\", \"rotation\"]\n";
      else
        loads << "[[load]]\nat = \"" << here << "\"\nforce = [0.0, " << -(1.0 + 0.1 * x) * load << "]\n";
    }
  return "title = \"frame\"\n[units]\nlength = \"m\"\nforce = \"kN\"\n[material.one]\nE = 1.0\n"
         "[section.row]\nshape = \"general\"\nA = 1e4\nI = 1.0\n"
         "[section.post]\nshape = \"general\"\nA = 1e4\nI = 5e-4\n[point]\n" +
         joints.str() + members.str() + "[support]\n" + supports.str() + loads.str() + "[path]\nstep = 0.05\n";
}

TEST(Checkpoint, ALargeFrameGoesOnToTheLastBitBeyondItsLimitPointSlow) {
  const RunDescription frame{.deck = "frame.toml", .deck_text = large_frame()};
  Session whole = make_session(frame), parts = make_session(frame);
  ASSERT_TRUE(whole.begin() && parts.begin()) << whole.problem();
  for (int points = 1; points <= 20; ++points) {
    ASSERT_TRUE(whole.next() != nullptr && parts.next() != nullptr);
    if (points % 3 == 0) parts = resume_session(parts.checkpoint(), "checkpoint", Resume::go_on);
  }
  const auto limit = [](const RecordEvent& event) { return event.kind == EventKind::limit_point; };
  EXPECT_TRUE(std::any_of(whole.record().events.begin(), whole.record().events.end(), limit));
  EXPECT_EQ(path_csv(parts.record(), UnitLabels::shown), path_csv(whole.record(), UnitLabels::shown));
  EXPECT_EQ(events_json(parts.record()), events_json(whole.record()));
  EXPECT_TRUE(parts.checkpoint() == whole.checkpoint());
}

TEST(Checkpoint, IsRefusedWithAnyBitChangedAndWhenCut) {
  Session run = begun("truss");
  run.next();
  const std::string bytes = run.checkpoint();
  ASSERT_NO_THROW(from_checkpoint(bytes, "checkpoint"));
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    std::string changed = bytes;
    changed[bit / 8] = static_cast<char>(changed[bit / 8] ^ (1 << (bit % 8)));
    EXPECT_THROW(from_checkpoint(changed, "checkpoint"), OutputError) << "bit " << bit;
  }
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(from_checkpoint(bytes.substr(0, size), "checkpoint"), OutputError) << size << " bytes";
  EXPECT_THROW(from_checkpoint(bytes + '\0', "checkpoint"), OutputError);
}

// What varies while a branch is traced differs from version to version: an old run is not taken for one of today.
TEST(Checkpoint, OfAnotherVersionIsRefusedWithASentence) {
  std::string bytes = begun("truss").checkpoint();
  const std::string now = "arcwall checkpoint 31\n";
  ASSERT_TRUE(bytes.starts_with(now));
  bytes.replace(0, now.size(), "arcwall checkpoint 3\n");
  try {
    from_checkpoint(bytes, "out/checkpoint");
    FAIL() << "taken";
  } catch (const OutputError& refusal) {
    EXPECT_STREQ(refusal.what(),
                 "out/checkpoint: is a checkpoint of another version of this program; run the deck again");
  }
}

// Bytes with a right sum that no run can have written.
TEST(Checkpoint, IsRefusedWhoseContentIsNotThatOfARun) {
  Session run = begun("channel", {"member.column.elements=8"});
  for (int i = 0; i < 20; ++i) run.next();
  const Json content = from_checkpoint(run.checkpoint(), "checkpoint");
  ASSERT_NO_THROW(resume_session(to_checkpoint(content), "checkpoint", Resume::go_on));
  const auto refused = [](const Json& changed) {
    EXPECT_THROW(resume_session(to_checkpoint(changed), "checkpoint", Resume::go_on), OutputError);
  };
  // Each entry in turn is taken away, or something else stands in its place.
  for (std::size_t entry = 0; entry < content.size(); ++entry) {
    Json without = content;
    without.erase(entry);
    refused(without);
    for (const Json& other : {Json(-7), Json("text"), Json::array(), Json::object()}) {
      if (content[entry].type() == other.type()) continue;
      Json changed = content;
      changed[entry] = other;
      refused(changed);
    }
  }
  Json longer = content;
  longer.push_back(0);
  refused(longer);
  refused(Json(nullptr));
}

// Sums and differences of counts are taken all along a path.
TEST(Checkpoint, IsRefusedWithACountBeyondReason) {
  Session run = begun("lee");
  for (int i = 0; i < 12; ++i) run.next();
  const Json content = from_checkpoint(run.checkpoint(), "checkpoint");
  int counts = 0;
  const Json flat = content.flatten();
  for (const auto& [pointer, value] : flat.items()) {
    if (!value.is_number_integer()) continue;
    for (const auto beyond : {std::numeric_limits<std::int64_t>::min(), std::int64_t{-1} << 31, std::int64_t{1} << 31,
                              std::numeric_limits<std::int64_t>::max()}) {
      Json changed = content;
      changed[Json::json_pointer(pointer)] = beyond;
      EXPECT_THROW(resume_session(to_checkpoint(changed), "checkpoint", Resume::go_on), OutputError) << pointer;
    }
    ++counts;
  }
  EXPECT_GT(counts, 100);
}

// Lists that belong together have lengths that do. What is taken all the same goes on, or ends with a reason.
TEST(Checkpoint, IsRefusedOrGoesOnWithAnyListEmptied) {
  for (const std::string example : {"lee", "channel"}) {
    Session run = begun(example);
    for (int i = 0; i < 12; ++i) run.next();
    const Json content = from_checkpoint(run.checkpoint(), "checkpoint");
    int refused = 0, emptied = 0;
    const Json flat = content.flatten();
    for (const auto& [pointer, value] : flat.items()) {
      const Json::json_pointer list = Json::json_pointer(pointer).parent_pointer();
      if (!pointer.ends_with("/0") || list.empty()) continue;
      Json changed = content;
      changed[list] = Json::array();
      ++emptied;
      try {
        Session other = resume_session(to_checkpoint(changed), "checkpoint", Resume::go_on);
        for (int i = 0; i < 3 && other.next() != nullptr; ++i) continue;
      } catch (const OutputError&) {
        ++refused;
      }
    }
    EXPECT_GT(emptied, 50);
    EXPECT_GT(refused, emptied / 2);
  }
}

TEST(Checkpoint, TakesNoContentThatNestsWithoutEnd) {
  EXPECT_THROW(from_cbor(std::string(1'000'000, '\x81')), BadArchive);
  EXPECT_THROW(from_cbor(std::string(1'000'000, '\x9f')), BadArchive);
  EXPECT_THROW(from_cbor(std::string(1'000'000, '\xc1')), BadArchive);
  EXPECT_THROW(from_cbor("\x9b\xff\xff\xff\xff\xff\xff\xff\xff"), BadArchive);
}

// An array and a map of more items than bytes are left, or than memory has.
TEST(Checkpoint, TakesNoListLongerThanItsBytes) {
  for (const char* list : {"\x9b", "\xbb"})
    for (const char* size : {"\x01\x02\x03\x04\x05\x06\x07\x08", "\x9f\xa0\xa1\xa2\xa3\xa4\xa5\xa6"})
      EXPECT_THROW(from_cbor(std::string(list) + size), BadArchive);
}

// Stopped from outside, a run shows that end until it goes on.
TEST(Checkpoint, KnowsAnEndFromOutsideOnlyForThoseWhoAsk) {
  Session run = begun("truss");
  for (int i = 0; i < 5; ++i) run.next();
  const std::string bytes = run.checkpoint(BranchEnd{.reason = EndReason::interrupted, .detail = "by a signal"});
  const Session ended = resume_session(bytes, "checkpoint", Resume::as_ended);
  ASSERT_TRUE(ended.record().branches.front().end);
  EXPECT_EQ(ended.record().branches.front().end->reason, EndReason::interrupted);
  EXPECT_EQ(ended.record().events.back().kind, EventKind::end);
  Session resumed = resume_session(bytes, "checkpoint", Resume::go_on);
  EXPECT_FALSE(resumed.record().branches.front().end);
  while (resumed.next() != nullptr) {
  }
  EXPECT_EQ(events_json(resumed.record()), events_json(traced("truss", {}, 0).record()));
}

}  // namespace
}  // namespace arcwall::checkpoint_test
