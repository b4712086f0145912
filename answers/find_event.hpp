#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "continuation/explorer.hpp"
#include "continuation/path_point.hpp"
#include "model/model.hpp"

namespace arcwall {

/// An event with the arc of the path that ends at it.
struct FoundEvent {
  Arc arc;
  Event event;
};

/// Traces a model's paths until an event, no farther than need be.
class EventHunt {
 public:
  /// The `number`-th event of a kind, the first being number 1. `model` must outlive this.
  EventHunt(const Model& model, EventKind kind, int number) : model_(model), kind_(kind), number_(number) {}

  /// One more point. False once the event is found, or cannot be.
  bool advance();

  /// The event; empty while there is none.
  const std::optional<FoundEvent>& found() const { return found_; }

  /// Why there is none; empty while it is looked for.
  const std::string& problem() const { return problem_; }

  /// Visits all that changes until the event is found.
  template <typename Archive>
  void serialize(Archive& archive) {
    bool begun = explorer_ != nullptr;
    archive(met_, begun);
    if (!begun) return;
    archive(start_);
    if constexpr (Archive::reads) explore();
    explorer_->serialize(archive);
  }

 private:
  void explore();

  const Model& model_;
  EventKind kind_;
  int number_;
  State start_{};
  std::unique_ptr<Explorer> explorer_{};
  int met_ = 0;  // events of the kind
  std::optional<FoundEvent> found_{};
  std::string problem_{};
};

/// The event that a hunt finds. Empty, with the reason in `problem`, where there is none. `stopped` is asked at each
/// point; true ends the search.
std::optional<FoundEvent> find_event(const Model& model, EventKind kind, int number,
                                     const std::function<bool()>& stopped, std::string& problem);

}  // namespace arcwall
