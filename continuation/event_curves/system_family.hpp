#pragma once

#include <memory>
#include <optional>

#include "core/observable.hpp"
#include "core/system.hpp"

namespace arcwall {

/// Systems that differ by a number κ of the model alone, so that a state means the same in all of them.
class SystemFamily {
 public:
  /// One of them, with a state in its own terms: layouts belong to the system that made them.
  struct Member {
    std::shared_ptr<const System> system{};
    State state{};
    std::shared_ptr<const Observable>
        watched{};  ///< what turns or passes a value at the event, of this system; else null
  };

  virtual ~SystemFamily() = default;

  /// The system for a value of κ with a state in the family's terms; empty where there is no such system, or where its
  /// unknowns are others.
  virtual std::optional<Member> at(double kappa, const State& state) const = 0;

  /// A state of any of them in the family's terms.
  virtual std::optional<State> in_common_terms(const State& state) const = 0;

  /// The distance of the values at which derivatives by κ take their samples [κ]. Samples are taken at whole multiples
  /// of it, so that neighbouring values share them.
  virtual double spacing() const = 0;
};

}  // namespace arcwall
