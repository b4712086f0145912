#pragma once

#include <string>
#include <utility>

#include "contact/contact_point.hpp"
#include "core/observable.hpp"

namespace arcwall {

/// What a wall exerts in sum on the structure, on a member or on a place of it, pressed parts included: a component of
/// the force, or the moment about a point.
class WallForce final : public Observable {
 public:
  enum class What { x, z, moment };

  /// `contacts` must outlive this.
  WallForce(const ContactQuery& contacts, ContactsOfWall of, What what, const Vec2& about = Vec2::Zero())
      : contacts_(contacts), of_(std::move(of)), what_(what), about_(about) {}

  double value(const State& state) const override { return action(state).value[component()]; }
  Row gradient(const State& state) const override { return action(state).gradient[component()]; }

 private:
  std::size_t component() const { return static_cast<std::size_t>(what_); }
  WallAction action(const State& state) const { return contacts_.wall_action(state, of_, about_); }

  const ContactQuery& contacts_;
  ContactsOfWall of_;
  What what_;
  Vec2 about_;
};

}  // namespace arcwall
