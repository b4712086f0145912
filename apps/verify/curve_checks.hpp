#pragma once

#include <string>
#include <vector>

#include "answers/curve_session.hpp"
#include "apps/verify/again.hpp"
#include "apps/verify/verify.hpp"

/// Checks a curve of events again: each point against the deck with the number's value there, by plain formulas.
namespace arcwall::verify {

/// The files of a curve as texts.
struct StoredCurve {
  std::string curve_csv{}, curve_json{};
};

/// The states of the session's curve, and its files against them.
Verdict verify_curve(const CurveSession& session, const StoredCurve& files);

/// λ of the event at some places of the curve against runs of the deck with the number's value there. An event that
/// such a run does not meet may be on a branch that it does not trace: a reservation.
Comparison compare_with_runs(const CurveSession& session);

}  // namespace arcwall::verify
