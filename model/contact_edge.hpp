#pragma once

#include <utility>

#include "contact/contact_point.hpp"
#include "model/body.hpp"
#include "model/central_differences.hpp"

namespace arcwall {

/// Where contact of a wall with a member begins or ends along it: its arc length from the member's first end, or its x
/// [length]. Infinite where there is none. With contact at nodes it is that of a node.
///
/// It moves continuously while the contacts are the same ones. Gradients are central differences.
class ContactEdge final : public DifferencedObservable {
 public:
  enum class Which { first, last };
  enum class What { arc_length, x };

  /// `of` names a member, whose length is given. `contacts` and `body` must outlive this.
  ContactEdge(const ContactQuery& contacts, const Body& body, ContactsOfWall of, double length, Which which, What what)
      : contacts_(contacts), body_(body), of_(std::move(of)), length_(length), which_(which), what_(what) {}

  double value(const State& state) const override;

 private:
  Differences differences_at(const State& state) const override;

  const ContactQuery& contacts_;
  const Body& body_;
  ContactsOfWall of_;
  double length_;
  Which which_;
  What what_;
};

}  // namespace arcwall
