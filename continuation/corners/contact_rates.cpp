#include "continuation/corners/contact_rates.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>

namespace arcwall {

namespace {

// A rate as a linear function of λ̇ and z, while all contacts do the same.
using Linear = Eigen::Vector2d;
using LinearRates = Eigen::MatrixX2d;

constexpr double roundoff = 1e-12;  // of z: conditions that are relaxed by less are not

// What must not be negative: of one that is open its gap; of others their force if they touch; of slips their rate; of
// sticks what is left up to slip in a sense.
struct Condition {
  enum class Of { gap, force, slip, margin } of;
  std::size_t contact;
  double sense;  // of a slip and of a margin
  Linear value;
};

Condition::Of excluded_by(Condition::Of of) {
  using enum Condition::Of;
  return of == gap ? force : of == force ? gap : of == slip ? margin : slip;
}

ContactMode slip_in(double sense) { return sense > 0.0 ? ContactMode::slips_forward : ContactMode::slips_backward; }

// Contacts whose conditions are relaxed: the law holds for g + δg z, p + δp z, y + δy z and T + δT z.
class RelaxedContacts {
 public:
  explicit RelaxedContacts(const ContactRates& rates)
      : rates_(rates), k_(static_cast<Index>(rates.contacts.size())), motion_(Vector::Zero(2 * k_)), force_(motion_) {
    for (const ContactAtBound& contact : rates.contacts) modes_.push_back(contact.mode);
  }

  const std::vector<ContactMode>& modes() const { return modes_; }

  // Relaxes a condition by so much for z = 1.
  void relax(const Condition& condition, double by) {
    const auto i = static_cast<Index>(condition.contact);
    const ContactAtBound& contact = rates_.contacts[condition.contact];
    if (condition.of == Condition::Of::gap) motion_[i] = by;
    if (condition.of == Condition::Of::slip) motion_[k_ + i] = condition.sense * by;
    if (condition.of == Condition::Of::force) {
      force_[i] = by;
      force_[k_ + i] = -slip_sense(modes_[condition.contact]) * contact.friction * by;  // its law of slip stays
    }
    if (condition.of == Condition::Of::margin && contact.touches) force_[i] = by / contact.friction;
    if (condition.of == Condition::Of::margin && !contact.touches) force_[k_ + i] = condition.sense * by;
  }

  // All conditions; none where the equations are singular.
  std::vector<Condition> conditions() {
    if (!solve()) return {};
    std::vector<Condition> all;
    for (std::size_t i = 0; i < modes_.size(); ++i) add_conditions(i, all);
    return all;
  }

  // Behind a condition that has come to zero at λ̇ and z the contact does something else.
  void change(const Condition& at, const Linear& ray) {
    ContactMode& mode = modes_[at.contact];
    switch (at.of) {
      case Condition::Of::gap:
        mode = rates_.contacts[at.contact].friction > 0.0 ? slip_in(slip(at.contact).dot(ray)) : ContactMode::closed;
        break;
      case Condition::Of::force:
        mode = ContactMode::open;
        break;
      case Condition::Of::slip:
        mode = ContactMode::sticks;
        break;
      case Condition::Of::margin:
        mode = slip_in(at.sense);
        break;
    }
  }

 private:
  Linear gap(std::size_t i) const { return moved_.row(static_cast<Index>(i)); }
  Linear slip(std::size_t i) const { return moved_.row(k_ + static_cast<Index>(i)); }
  Linear force(std::size_t i) const { return forced_.row(static_cast<Index>(i)); }
  Linear friction(std::size_t i) const { return forced_.row(k_ + static_cast<Index>(i)); }

  // Two equations a contact: g = 0 or p = 0; y = 0, T = 0 or T + ε μ p = 0.
  bool solve() {
    Matrix equations = Matrix::Zero(2 * k_, 2 * k_);
    LinearRates rest = LinearRates::Zero(2 * k_, 2);
    const auto add_motion = [&](Index row, Index of) {
      equations(row, of) += 1.0;
      rest(row, 1) += motion_[of];
    };
    const auto add_force = [&](Index row, double factor, Index of) {
      equations.row(row) += factor * rates_.A.row(of);
      rest.row(row) += factor * Linear(rates_.b[of], force_[of]).transpose();
    };
    for (Index i = 0; i < k_; ++i) {
      const double friction = rates_.contacts[static_cast<std::size_t>(i)].friction;
      const ContactMode mode = modes_[static_cast<std::size_t>(i)];
      const bool is_open = mode == ContactMode::open;
      if (is_open)
        add_force(i, 1.0, i);
      else
        add_motion(i, i);
      const bool slides = friction > 0.0 && mode != ContactMode::sticks;
      if (slides)
        add_force(k_ + i, 1.0, k_ + i);
      else
        add_motion(k_ + i, k_ + i);
      if (slides && !is_open) add_force(k_ + i, slip_sense(mode) * friction, i);
    }
    moved_ = -Eigen::PartialPivLU<Matrix>(equations).solve(Matrix(rest));
    forced_ = rates_.A * moved_;
    forced_.col(0) += rates_.b;
    forced_.col(1) += force_;
    moved_.col(1) += motion_;
    return moved_.allFinite();
  }

  void add_conditions(std::size_t i, std::vector<Condition>& all) const {
    const ContactAtBound& contact = rates_.contacts[i];
    const ContactMode mode = modes_[i];
    const auto add = [&](Condition::Of of, double sense, const Linear& value) {
      all.push_back({.of = of, .contact = i, .sense = sense, .value = value});
    };
    if (mode == ContactMode::open) return add(Condition::Of::gap, 0.0, gap(i));
    if (mode == ContactMode::sticks) {
      for (const double sense : {1.0, -1.0})
        if (contact.touches || contact.slip_sense == sense)
          add(Condition::Of::margin, sense, contact.friction * force(i) + sense * friction(i));
      return;
    }
    if (contact.touches) add(Condition::Of::force, 0.0, force(i));
    if (const double sense = slip_sense(mode); sense != 0.0) add(Condition::Of::slip, sense, sense * slip(i));
  }

  const ContactRates& rates_;
  Index k_;
  Vector motion_, force_;  // δg and δy, δp and δT
  std::vector<ContactMode> modes_;
  LinearRates moved_, forced_;  // g and y, p and T, relaxed
};

// The condition that is last to hold as z grows where λ̇ = 1, and that z; empty where one never holds.
std::optional<std::pair<Condition, double>> last_to_hold(const std::vector<Condition>& conditions) {
  std::optional<std::pair<Condition, double>> last;
  for (const Condition& condition : conditions) {
    const auto [by_lambda, by_z] = std::pair(condition.value[0], condition.value[1]);
    if (by_lambda >= 0.0) continue;
    if (by_z <= 0.0) return std::nullopt;
    if (!last || -by_lambda / by_z > last->second) last = {condition, -by_lambda / by_z};
  }
  return last;
}

// Relaxes all conditions, no two by the same: those of contacts that move as one would come to zero together. Motions
// are relaxed by what forces may make, at least.
void relax_all(const ContactRates& rates, const std::vector<Condition>& conditions, RelaxedContacts& contacts) {
  const auto is_motion = [](const Condition& condition) {
    return condition.of == Condition::Of::gap || condition.of == Condition::Of::slip;
  };
  double most_motion = 0.0, most_force = 0.0;
  for (const Condition& condition : conditions) {
    double& most = is_motion(condition) ? most_motion : most_force;
    most = std::max(most, std::abs(condition.value[0]));
  }
  most_motion = std::max(most_motion, most_force / rates.A.cwiseAbs().maxCoeff());
  double factor = 1.0;
  for (const Condition& condition : conditions) {
    contacts.relax(condition, factor * (is_motion(condition) ? most_motion : most_force));
    factor += 1.0 / double(conditions.size());
  }
}

// Whether a condition is the one that a change has put in the place of another: of each two that exclude each other one
// is zero.
bool replaces(const Condition& condition, const Condition& other) {
  const bool is_of_touch = other.of == Condition::Of::gap || other.of == Condition::Of::force;
  return condition.contact == other.contact && condition.of == excluded_by(other.of) &&
         (is_of_touch || condition.sense == other.sense);
}

// From the ray at which a condition came to zero to that at which the next one does, or z: then there is no next one.
struct Turn {
  Linear ray;
  std::optional<Condition> next{};
};

Turn turned(const Linear& ray, const Condition& at, const std::vector<Condition>& conditions) {
  Linear across(-ray[1], ray[0]);
  for (const Condition& condition : conditions)
    if (replaces(condition, at) && condition.value.dot(across) < 0.0) across = -across;
  const auto angle_to_zero = [&](const Linear& value) {
    return std::atan2(std::max(0.0, value.dot(ray)), -value.dot(across));
  };
  Turn turn{.ray = ray};
  double least = angle_to_zero(Linear::UnitY());
  for (const Condition& condition : conditions) {
    if (replaces(condition, at)) continue;
    if (const double angle = angle_to_zero(condition.value); angle < least) {
      least = angle;
      turn.next = condition;
    }
  }
  turn.ray = (std::cos(least) * ray + std::sin(least) * across).normalized();
  if (turn.ray[1] <= roundoff) turn.next.reset();
  return turn;
}

}  // namespace

std::optional<std::vector<ContactMode>> pivoted_modes(const ContactRates& rates) {
  RelaxedContacts contacts(rates);
  const std::vector<Condition> first = contacts.conditions();
  if (first.empty()) return std::nullopt;
  const auto is_violated = [](const Condition& condition) { return condition.value[0] < 0.0; };
  if (std::none_of(first.begin(), first.end(), is_violated)) return contacts.modes();
  relax_all(rates, first, contacts);
  const auto begin = last_to_hold(contacts.conditions());
  if (!begin) return std::nullopt;
  Turn turn{.ray = Linear(1.0, begin->second).normalized(), .next = begin->first};
  std::set<std::vector<ContactMode>> seen{contacts.modes()};
  while (turn.next) {
    contacts.change(*turn.next, turn.ray);
    if (!seen.insert(contacts.modes()).second) return std::nullopt;
    const std::vector<Condition> conditions = contacts.conditions();
    if (conditions.empty()) return std::nullopt;
    turn = turned(turn.ray, *turn.next, conditions);
  }
  return contacts.modes();
}

}  // namespace arcwall
