#pragma once

#include <string>
#include <utility>
#include <vector>

#include "contact/contact_point.hpp"
#include "core/frictional_contact.hpp"
#include "core/observable.hpp"
#include "model/compliant_contact.hpp"

namespace arcwall {

/// What friction does at the contacts of a wall, of a member on it or of a place of that.
class FrictionAtWall final : public Observable {
 public:
  enum class What {
    force,  ///< sum of the forces on the structure along the wall's tangent, with the structure to its left [force]
    slip,   ///< how far such a place has slipped since it touched [length]
    greatest_use  ///< the greatest |T|/(μ p); not a number where no contact is closed [-]
  };

  /// `contacts` and their `friction` must outlive this.
  FrictionAtWall(const ContactQuery& contacts, const FrictionalContact& friction, ContactsOfWall of, What what)
      : contacts_(contacts), friction_(friction), of_(std::move(of)), what_(what) {}

  double value(const State& state) const override;
  Row gradient(const State& state) const override;

 private:
  template <typename Visit>
  void for_each(const State& state, const Visit& visit) const;

  double use_of(const State& state, Index j) const;

  const ContactQuery& contacts_;
  const FrictionalContact& friction_;
  ContactsOfWall of_;
  What what_;
};

/// The power −Σ T v of friction at the contacts of a wall, or of all walls: its gradient along a path is the rate of
/// what friction has dissipated. That itself is no function of the state: value() is 0, and a Recorder integrates.
class FrictionPower final : public Observable {
 public:
  /// `contacts` and their `friction` must outlive this. `wall`: empty for all.
  FrictionPower(const ContactQuery& contacts, const FrictionalContact& friction, std::string wall)
      : contacts_(contacts), friction_(friction), wall_(std::move(wall)) {}

  double value(const State&) const override { return 0.0; }
  Row gradient(const State& state) const override;

 private:
  const ContactQuery& contacts_;
  const FrictionalContact& friction_;
  std::string wall_;
};

/// The same of compliant walls: their material points, of which that nearest to a place tells its slip.
class ElasticFrictionAtWall final : public Observable {
 public:
  /// `contact` must outlive this, and has friction.
  ElasticFrictionAtWall(const CompliantContact& contact, ContactsOfWall of, FrictionAtWall::What what)
      : contact_(contact), of_(std::move(of)), what_(what) {}

  double value(const State& state) const override;
  Row gradient(const State& state) const override;

 private:
  std::vector<CompliantFriction::Point> points(const State& state) const;

  const CompliantContact& contact_;
  ContactsOfWall of_;
  FrictionAtWall::What what_;
};

/// As FrictionPower.
class ElasticFrictionPower final : public Observable {
 public:
  /// `contact` must outlive this, and has friction. `wall`: empty for all.
  ElasticFrictionPower(const CompliantContact& contact, std::string wall) : contact_(contact), wall_(std::move(wall)) {}

  double value(const State&) const override { return 0.0; }
  Row gradient(const State& state) const override;

 private:
  const CompliantContact& contact_;
  std::string wall_;
};

}  // namespace arcwall
