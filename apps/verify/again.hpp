#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/record.hpp"
#include "model/session.hpp"

/// A run against another run of its deck with shorter steps: what a run says must not depend on its steps.
namespace arcwall::verify {

/// The events of two runs, side by side.
struct Comparison {
  Index same = 0;                           ///< events that both have
  double worst = 0.0;                       ///< greatest difference in λ of those
  double worst_allowed = 0.0;               ///< and what is allowed for it
  std::vector<std::string> differences{};   ///< one sentence each: what does not hold
  std::vector<std::string> reservations{};  ///< one sentence each: what cannot be told
};

/// The session of a run traced anew with a quarter of its first and of its greatest step; branches that a search has
/// found begin where they began. It has at most four times the points of the run, and a hundred; nothing where it finds
/// no start.
std::optional<Session> traced_again(const Session& run);

/// Events of branches with the same number, of those that were found in the order in which they were, in their order:
/// kinds, contacts and monitors, λ, and how branches end.
///
/// λ may differ by what both events say is uncertain (`lambda_uncertainty`), and by `discretisation` times the range of
/// λ. Events that are unconfirmed in either run are reservations; so is all that follows where a run was stopped by a
/// limit.
Comparison compare(const Record& stored, const Record& again, double discretisation);

/// What `compare` may take for its last argument: 10⁻⁶ where the mesh moves with the contacts, and is divided anew
/// along the path, else 10⁻⁸, which correctors leave.
double step_discretisation(const Model& model);

/// `how`: the other run, as `with a quarter of the step`.
std::string to_text(const Comparison& comparison, const std::string& how);

}  // namespace arcwall::verify
