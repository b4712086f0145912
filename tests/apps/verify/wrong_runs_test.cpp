// Runs that are wrong, kept as decks: the first lines of each say what is altered in its record and files, as if it had
// been computed so, and which check refuses that.
//
//   # wrong: CHANGE WHERE [BY] => CHECK
//
// A point is the `last` one, or the `middle` one, which is the last without an event in the first half of the path.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "apps/verify/potentials.hpp"
#include "apps/verify/verify.hpp"
#include "model/event_names.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/stored_files_of.hpp"

namespace arcwall::verify::wrong_runs_test {

namespace {

using test::TracedDeck;

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

struct Wrong {
  std::vector<std::string> words{};  // what, where, by how much
  std::string check{};

  double by() const { return words.size() > 2 ? std::stod(words[2]) : 0.0; }
};

std::vector<Wrong> wrongs_of(const std::string& deck) {
  const std::string mark = "# wrong: ", arrow = " => ";
  std::vector<Wrong> wrongs;
  std::istringstream lines(deck);
  for (std::string line; std::getline(lines, line) && line.starts_with(mark);) {
    const std::size_t at = line.find(arrow);
    Wrong wrong{.check = line.substr(at + arrow.size())};
    std::istringstream words(line.substr(mark.size(), at - mark.size()));
    for (std::string word; words >> word;) wrong.words.push_back(word);
    wrongs.push_back(wrong);
  }
  return wrongs;
}

std::size_t number_of(const Record& record, const std::string& where) {
  std::size_t number = record.points.size() - 1;
  if (where == "middle")
    for (number /= 2; record.points[number].event; --number) {
    }
  return number;
}

std::vector<RecordEvent>::iterator first_event(Record& record, const std::string& kind) {
  return std::find_if(record.events.begin(), record.events.end(),
                      [&](const RecordEvent& event) { return to_text(event.kind) == kind; });
}

// What a point says of its events.
void mark_points(Record& record) {
  for (RecordPoint& point : record.points) {
    point.event.reset();
    for (const RecordEvent& event : record.events)
      if (event.branch == point.branch && event.step == point.step &&
          (!point.event || changes_contact(*point.event) || !changes_contact(event.kind)))
        point.event = event.kind;
  }
}

using Change = std::function<void(const Model&, Record&, const Wrong&)>;

void change_point(const std::function<void(const Model&, Record&, std::size_t, double)>& change, const Model& model,
                  Record& record, const Wrong& wrong) {
  change(model, record, number_of(record, wrong.words[1]), wrong.by());
}

Change of_point(const std::function<void(const Model&, Record&, std::size_t, double)>& change) {
  return [=](const Model& model, Record& record, const Wrong& wrong) { change_point(change, model, record, wrong); };
}

const std::map<std::string, Change> changes{
    {"lambda", of_point([](const Model&, Record& record, std::size_t i, double by) {
       RecordPoint& point = record.points[i];
       point.lambda = point.state.lambda *= 1.0 + by;
       for (RecordEvent& event : record.events)
         if (event.branch == point.branch && event.step == point.step) event.lambda = point.lambda;
     })},
    {"displacement", of_point([](const Model& model, Record& record, std::size_t i, double by) {
       RecordPoint& point = record.points[i];
       const Index unknowns = structure_unknowns(model, point.state);
       point.state.x[unknowns / 2] += by * model.structure().length_scale();
     })},
    {"state", of_point([](const Model&, Record& record, std::size_t i, double) {  // of the point before it
       const double lambda = record.points[i].lambda;
       record.points[i].state = record.points[i - 1].state;
       record.points[i].state.lambda = lambda;
     })},
    {"force", of_point([](const Model& model, Record& record, std::size_t i, double by) {
       RecordPoint& point = record.points[i];
       point.state.x.segment(structure_unknowns(model, point.state), static_cast<Index>(point.forces.size())) *= by;
       for (RecordForce& force : point.forces) force.force *= by;
     })},
    {"contact", of_point([](const Model&, Record& record, std::size_t i, double) {  // left out
       record.points[i].forces.pop_back();
       --record.points[i].contacts;
     })},
    {"count", of_point([](const Model&, Record& record, std::size_t i, double by) {
       *record.points[i].count.unstable += static_cast<Index>(by);
     })},
    {"energy",
     of_point([](const Model&, Record& record, std::size_t i, double by) { record.points[i].energy *= 1.0 + by; })},
    {"monitor", of_point([](const Model&, Record& record, std::size_t i, double by) {
       record.points[i].monitors.front() *= 1.0 + by;
     })},
    {"lost", [](const Model&, Record& record,
                const Wrong& wrong) { record.events.erase(first_event(record, wrong.words[1])); }},
    {"displaced",
     [](const Model&, Record& record, const Wrong& wrong) {  // to the point before it
       RecordEvent& event = *first_event(record, wrong.words[1]);
       const auto point = std::find_if(record.points.begin(), record.points.end(), [&](const RecordPoint& one) {
         return one.branch == event.branch && one.step == event.step - 1;
       });
       event.step = point->step;
       event.arc = point->arc;
       event.lambda = point->lambda;
       event.monitors = point->monitors;
     }},
    {"renamed",
     [](const Model&, Record& record, const Wrong& wrong) {
       first_event(record, wrong.words[1])->kind = event_kind(wrong.words[2]).value();
     }},
};

}  // namespace

TEST(WrongRuns, AreRefused) {
  int decks = 0;
  for (const auto& entry : std::filesystem::directory_iterator(WRONG_RUNS)) {
    const std::string text = text_of(entry.path());
    SCOPED_TRACE(entry.path().filename().string());
    const TracedDeck traced(text);
    const Verdict right = verify(traced.model(), traced.record(), stored_files_of(traced.record()), "checkpoint");
    ASSERT_FALSE(right.findings.first().has_value()) << to_text(*right.findings.first());
    const std::vector<Wrong> wrongs = wrongs_of(text);
    EXPECT_FALSE(wrongs.empty());
    for (const Wrong& wrong : wrongs) {
      SCOPED_TRACE(fmt::format("{}", fmt::join(wrong.words, " ")));
      Record record = traced.record();
      changes.at(wrong.words[0])(traced.model(), record, wrong);
      for (std::size_t i = 0; i < record.events.size(); ++i) record.events[i].id = static_cast<Index>(i);
      mark_points(record);
      const Verdict verdict = verify(traced.model(), record, stored_files_of(record), "checkpoint");
      std::vector<std::string> refusals;
      for (const CheckSummary& check : verdict.findings.checks())
        if (check.failures > 0) refusals.push_back(check.name);
      const auto first = verdict.findings.first();
      ASSERT_TRUE(first.has_value()) << "not refused";
      EXPECT_TRUE(first->what.starts_with(wrong.check) ||
                  std::find(refusals.begin(), refusals.end(), wrong.check) != refusals.end())
          << to_text(*first);
    }
    ++decks;
  }
  EXPECT_GE(decks, 5);
}

}  // namespace arcwall::verify::wrong_runs_test
