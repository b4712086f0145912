#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "core/types.hpp"
#include "elements/spring_law.hpp"

namespace arcwall {

/// Models a foundation by length of a member's stress-free axis: linear springs in x and z, springs with laws, and sums
/// of these.
class FoundationLaw {
 public:
  FoundationLaw() = default;
  FoundationLaw(const Vec2& stiffness) : stiffness_(stiffness) {}  ///< ≥ 0 [force/length²]

  void add(const Vec2& stiffness) { stiffness_ += stiffness; }

  /// Adds a law in x (0) or z (1); its forces are by length [force/length].
  void add(Index direction, std::shared_ptr<const SpringLaw> law) { laws_.push_back({direction, std::move(law)}); }

  bool is_zero() const { return stiffness_.isZero(0.0) && laws_.empty(); }

  struct Response {
    double energy = 0.0;
    Vec2 force = Vec2::Zero(), stiffness = Vec2::Zero();  ///< in x and in z, uncoupled
  };
  Response at(const Vec2& displacement) const {
    Response out{.force = stiffness_.cwiseProduct(displacement), .stiffness = stiffness_};
    out.energy = 0.5 * out.force.dot(displacement);
    if (!laws_.empty()) add_laws(displacement, out);
    return out;
  }

  friend bool operator==(const FoundationLaw& a, const FoundationLaw& b);

 private:
  void add_laws(const Vec2& displacement, Response& out) const;

  struct Part {
    Index direction;
    std::shared_ptr<const SpringLaw> law;
  };

  Vec2 stiffness_ = Vec2::Zero();
  std::vector<Part> laws_;
};

}  // namespace arcwall
