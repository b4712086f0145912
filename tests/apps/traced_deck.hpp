#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "apps/build_path.hpp"
#include "apps/deck/reader.hpp"
#include "apps/output/recorder.hpp"

namespace arcwall::test {

/// A deck and the record of its run, in memory.
class TracedDeck {
 public:
  explicit TracedDeck(std::string_view text, const std::vector<std::string>& assignments = {})
      : study_(deck::read_deck_text(text, "deck.toml", assignments)), record_(empty_record(study_)) {
    std::string reason;
    auto start = study_.start(reason);
    EXPECT_TRUE(start.has_value()) << reason;
    if (!start) return;
    if (study_.in_increments())
      trace_increments(std::move(*start));
    else
      trace(std::move(*start));
  }

  const Study& study() const { return study_; }
  const Record& record() const { return record_; }
  Record& record() { return record_; }
  const State& state(std::size_t point) const { return record_.points.at(point).state; }
  const State& last() const { return record_.points.back().state; }

 private:
  void trace(State start) {
    Explorer explorer(study_.system(), std::move(start), study_.options(), study_.watched(), study_.explore());
    std::optional<Recorder> recorder;
    int branch = -1;
    const auto end = [&] {
      if (recorder) recorder->end(explorer.branches()[static_cast<std::size_t>(branch)].end.value());
    };
    while (const auto step = explorer.next()) {
      if (step->branch != branch) {
        end();
        branch = step->branch;
        recorder.emplace(study_, record_, explorer.branches()[static_cast<std::size_t>(branch)]);
      }
      recorder->add(step->arc);
    }
    end();
  }

  void trace_increments(State start) {
    LoadIncrements increments = study_.increments(std::move(start));
    Recorder recorder(study_, record_);
    recorder.add(increments.start());
    for (const double level : load_levels(study_.deck().path)) {
      const auto arc = increments.to(level);
      if (!arc) break;
      recorder.add(*arc);
    }
    recorder.end(increments.end().value_or(BranchEnd{.reason = EndReason::stop, .detail = "lambda"}));
  }

  Study study_;
  Record record_;
};

}  // namespace arcwall::test
