#pragma once

#include <utility>

#include "contact/multiplier_contact.hpp"
#include "core/observable.hpp"

namespace arcwall {

/// The sum of the friction forces of a wall on the structure, on a member or on a place of it, along the wall's tangent
/// with the structure to its left [force]; or how far such a place has slipped since it touched [length].
class FrictionAtWall final : public Observable {
 public:
  enum class What { force, slip };

  /// `contacts` must outlive this.
  FrictionAtWall(const MultiplierContact& contacts, ContactsOfWall of, What what)
      : contacts_(contacts), of_(std::move(of)), what_(what) {}

  double value(const State& state) const override {
    double sum = 0.0;
    for_each(state, [&](Index j) {
      sum += what_ == What::force ? contacts_.friction_force(state, j) : contacts_.slip(state, j);
    });
    return sum;
  }

  Row gradient(const State& state) const override {
    Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
    for_each(state, [&](Index j) {
      if (what_ == What::force)
        row.dx[*contacts_.friction_index(state.active_set, j)] = 1.0;
      else
        row.dx += contacts_.slip_gradient(state, j).dx;
    });
    return row;
  }

 private:
  template <typename Visit>
  void for_each(const State& state, const Visit& visit) const {
    for (Index j = 0; j < contacts_.contact_count(); ++j) {
      const ContactLabel& label = contacts_.candidate(j).label();
      if (label.wall == of_.wall && of_.includes(label.member, label.fraction) &&
          contacts_.friction_index(state.active_set, j))
        visit(j);
    }
  }

  const MultiplierContact& contacts_;
  ContactsOfWall of_;
  What what_;
};

}  // namespace arcwall
