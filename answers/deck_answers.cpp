#include "answers/deck_answers.hpp"

#include <utility>

#include "answers/jumps.hpp"
#include "answers/search.hpp"
#include "answers/sensitivities.hpp"
#include "model/checkpoint/archive.hpp"
#include "model/checkpoint/parts.hpp"

namespace arcwall {

namespace {

class DeckPathAnswers final : public PathAnswers {
 public:
  DeckPathAnswers(const Model& model, Record& record, std::vector<StageEnd> ended_stages)
      : model_(model), record_(record), sensitivities_(model, std::move(ended_stages)), search_(model, record) {}

  Fall fall(const Event& lost, const PathPoint& behind) override { return fall_beyond(model_, lost, behind); }

  std::vector<RecordSensitivity> sensitivities(const Arc& arc, const Event& event) override {
    return sensitivities_.of(arc, event);
  }

  std::optional<BranchEnd> end_of_branch() override {
    if (auto end = end_of_found_branch(model_, record_)) return end;
    return end_where_it_walks_back(model_, record_);
  }

  std::optional<BranchStart> next_start() override { return search_.next(); }

  void serialize(ArchiveWriter& archive) override { archive(search_); }
  void serialize(ArchiveReader& archive) override { archive(search_); }

 private:
  const Model& model_;
  Record& record_;
  Sensitivities sensitivities_;
  Search search_;
};

class DeckAnswers final : public Answers {
 public:
  std::unique_ptr<PathAnswers> of_paths(const Model& model, Record& record,
                                        std::vector<StageEnd> ended_stages) const override {
    return std::make_unique<DeckPathAnswers>(model, record, std::move(ended_stages));
  }

  void complete(const Model& model, Record& record) const override { add_jumps(model, record); }
};

}  // namespace

const Answers& deck_answers() {
  static const DeckAnswers answers;
  return answers;
}

}  // namespace arcwall
