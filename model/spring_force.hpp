#pragma once

#include <memory>
#include <variant>

#include "core/observable.hpp"
#include "elements/spring_law.hpp"

namespace arcwall {

/// The force in a spring in one direction, k s or that of a law, by its stretch s: the displacement or rotation of its
/// place, or that of its second place less that of its first. It is what the structure exerts on the spring there
/// [force, force·length].
class SpringForce final : public Observable {
 public:
  using Law = std::variant<double, std::shared_ptr<const SpringLaw>>;  // a stiffness k, or a law

  /// `first` is null of a spring to the ground.
  SpringForce(Law law, std::shared_ptr<const Observable> first, std::shared_ptr<const Observable> second)
      : law_(std::move(law)), first_(std::move(first)), second_(std::move(second)) {}

  double value(const State& state) const override;
  Row gradient(const State& state) const override;

 private:
  SpringLaw::Response at(double stretch) const;
  double stretch(const State& state) const;

  Law law_;
  std::shared_ptr<const Observable> first_, second_;
};

}  // namespace arcwall
