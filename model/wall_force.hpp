#pragma once

#include <string>

#include "contact/contact_point.hpp"
#include "core/observable.hpp"
#include "core/unilateral_system.hpp"

namespace arcwall {

/// The resultant of the forces that a wall exerts on the structure, pressed parts included: a component, or the moment
/// about a point.
///
/// Gradients are central differences; in the contact forces it is linear.
class WallForce final : public Observable {
 public:
  enum class What { x, z, moment };

  /// `contacts` and `system`, which are the same object, must outlive this.
  WallForce(const ContactQuery& contacts, const UnilateralSystem& system, std::string wall, What what,
            const Vec2& about = Vec2::Zero())
      : contacts_(contacts), system_(system), wall_(std::move(wall)), what_(what), about_(about) {}

  double value(const State& state) const override;
  Row gradient(const State& state) const override;

 private:
  double of(const ContactPoint& contact) const;

  const ContactQuery& contacts_;
  const UnilateralSystem& system_;
  std::string wall_;
  What what_;
  Vec2 about_;
};

}  // namespace arcwall
