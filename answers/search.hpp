#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "answers/mirror_images.hpp"
#include "continuation/trace_options.hpp"
#include "model/deck_mesh.hpp"
#include "model/model.hpp"
#include "model/record.hpp"

namespace arcwall {

/// Looks for equilibria that no traced branch passes, at the values of λ that the deck gives (docs/theory.md, section
/// 16). Each that is found is traced with λ growing and with λ falling, before the next one is looked for.
class Search {
 public:
  /// `model` and `record`, whose branches are known, must outlive this.
  Search(const Model& model, Record& record) : model_(model), record_(record) {}

  /// Where one more branch is to begin, once all branches of the record have ended: its state and the sign of the
  /// change of λ. Empty when there is nothing more to look for.
  std::optional<BranchStart> next();

  /// Visits all that changes but the record.
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(values_, done_, pending_);
    const Index found = record_.searches.empty() ? 0 : static_cast<Index>(record_.searches.back().found.size());
    for (const Pending& one : pending_) archive.require(one.found >= 0 && one.found < found);
    archive.require(done_ >= 0 && done_ <= (values_ ? static_cast<Index>(values_->size()) : 0));
  }

 private:
  struct Pending {
    State state{};
    int sense = 1;    // the sign of the change of λ
    Index found = 0;  // in the record's last search

    BranchStart start() const { return {.state = state, .sense = sense}; }

    template <typename Archive>
    void serialize(Archive& archive) {
      archive(state, sense, found);
    }
  };

  void search_at(double lambda);
  bool may_begin(const Pending& pending, RecordFound& found) const;

  const Model& model_;
  Record& record_;
  std::optional<std::vector<double>> values_{};  // of λ, once they are known
  Index done_ = 0;                               // of these
  std::deque<Pending> pending_;
};

/// Whether a branch was found, or bifurcates from one that was.
bool comes_of_search(const Record& record, const RecordBranch& branch);

/// The end of a branch that was found, or that bifurcates from one, where its last step in the record has passed a
/// state at the λ where it began that it, or another branch, has passed before: it has gone around a loop, or goes on
/// along that one; or where its last point is one that the mesh is too coarse for. Empty elsewhere. Where contact
/// slides, branches meet on different meshes, so that the tracer does not see it.
std::optional<BranchEnd> end_of_found_branch(const Model& model, const Record& record);

/// The end of a branch whose last point lies behind two changes of contact between which nothing moves, and is a state
/// that the branch has passed before: the way on from there was missed. Empty elsewhere.
std::optional<BranchEnd> end_where_it_walks_back(const Model& model, const Record& record);

}  // namespace arcwall
