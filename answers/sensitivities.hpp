#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "continuation/event_curves/event_derivative.hpp"
#include "continuation/path_point.hpp"
#include "model/deck/numbers.hpp"
#include "model/model.hpp"
#include "model/record.hpp"

namespace arcwall {

/// The step by which a number is varied for derivatives: a part of its value, greater where it is measured in forces,
/// in which equations are linear, and no less than a part of what it is measured in, so that round-off does not hide
/// what a small imperfection does.
double natural_step(const deck::DeckNumber& number, const Model& model);

/// How events of a run depend on the numbers that the deck's `path.sensitivity` names (docs/theory.md, section 12).
///
/// The equations are derived by a number from models of decks with values beside its own, which are built when they
/// are needed first.
class Sensitivities {
 public:
  /// Of events of a model, which must outlive this; `ended_stages`: how the stages before it have ended.
  Sensitivities(const Model& model, std::vector<StageEnd> ended_stages);
  ~Sensitivities();

  /// By each number, of an event at the end of an arc; none of the ends of branches and of events of a program.
  std::vector<RecordSensitivity> of(const Arc& arc, const Event& event);

 private:
  struct Beside;

  const Beside& beside(std::size_t number, std::size_t step);
  std::optional<std::vector<SystemSample>> samples_of(const Beside& beside, const Event& event) const;
  EventDerivative by(std::size_t number, EventDerivatives& derivatives, const Event& event);
  EventDerivative by_steps_from(std::size_t first, std::size_t number, EventDerivatives& derivatives,
                                const Event& event);

  const Model& model_;
  std::vector<StageEnd> ended_stages_;
  std::vector<deck::DeckNumber> numbers_;
  std::vector<std::vector<std::unique_ptr<Beside>>> beside_;  // of each number, for each of the steps
};

}  // namespace arcwall
