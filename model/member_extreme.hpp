#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "model/central_differences.hpp"
#include "model/member_stretch.hpp"

namespace arcwall {

/// A member from end to end in a state, element by element.
class ElementsOfMember {
 public:
  virtual ~ElementsOfMember() = default;

  virtual Index elements(const State& state) const = 0;

  /// Adds the stretches of an element, by fractions of the member, in any order. Those that reach beyond its ends,
  /// below 0 or above 1, belong to it up to there.
  virtual void add_stretches(const State& state, Index element, std::vector<MemberStretch>& to) const = 0;

  /// The unknowns on which an element depends, and by how much each is moved for a difference.
  struct Step {
    Index unknown = 0;
    double size = 0.0;
  };
  virtual std::vector<Step> steps(const State& state, Index element) const = 0;
};

/// What a section carries, at ξ ∈ [0, 1] of a stretch.
using SectionQuantity = std::function<double(const MemberStretch& stretch, double xi)>;

/// Quantities of a member's sections.
struct SectionQuantities {
  std::vector<SectionQuantity> quantities{};
  std::vector<double> kinks{};  ///< fractions of the member at which they may have kinks, ascending
  double negligible = 0.0;      ///< up to this their absolute values are round-off
};

/// The greatest or least absolute value of some quantities along a whole member, between nodes too, or the fraction of
/// the member at which it is: the first of those that have it within 10⁻¹⁰. The least is 0 where one changes its sign.
///
/// The value is continuous along a path, the place may jump. Gradients are central differences within the element that
/// has it: what moves the place within it does not change the value. Of a node they are those of the element before it,
/// with which the one behind it agrees in directions that keep the equilibrium.
class MemberExtreme final : public DifferencedObservable {
 public:
  enum class Which { greatest, least };
  enum class What { value, place };

  /// The place of what is negligible is 0.
  MemberExtreme(std::shared_ptr<const ElementsOfMember> member, SectionQuantities of, Which which, What what)
      : member_(std::move(member)), of_(std::move(of)), which_(which), what_(what) {}

  double value(const State& state) const override;

 private:
  struct Found {
    std::optional<double> value{};  // absolute
    double sign = 1.0;              // of what it is the absolute value of
    double fraction = 0.0;
    std::size_t quantity = 0;
    Index element = 0;
    std::size_t stretch = 0;                                    // of the element
    double xi = 0.0;                                            // of the stretch
    enum class Kind { node, inside, fixed } kind = Kind::node;  // of the stretch; an end of the member, or a kink
  };
  Found extreme(const State& state) const;
  void look_in(const MemberStretch& stretch, Found& extreme, Index element, std::size_t number) const;
  Differences differences_at(const State& state) const override;
  double again(const State& state, const Found& found) const;

  std::shared_ptr<const ElementsOfMember> member_;
  SectionQuantities of_;
  Which which_;
  What what_;
};

/// The mean absolute value of a quantity along a whole member.
class MemberMean final : public Observable {
 public:
  MemberMean(std::shared_ptr<const ElementsOfMember> member, SectionQuantity quantity)
      : member_(std::move(member)), quantity_(std::move(quantity)) {}

  double value(const State& state) const override;
  Row gradient(const State& state) const override;
  double rate(const State& state, const Direction& direction) const override;

 private:
  double part_of(const State& state, Index element) const;

  std::shared_ptr<const ElementsOfMember> member_;
  SectionQuantity quantity_;
};

/// A number that no state changes.
class ConstantValue final : public Observable {
 public:
  explicit ConstantValue(double value) : value_(value) {}
  double value(const State&) const override { return value_; }
  Row gradient(const State& state) const override { return {.dx = Vector::Zero(state.x.size()), .dlambda = 0.0}; }

 private:
  double value_;
};

/// The greatest of several members' values, or what goes with it: the number of the member that has it, the first of
/// those within 10⁻¹⁰, or the place there.
class GreatestOfMembers final : public Observable {
 public:
  /// `values`, one of each member, and `shown`, what is shown of it.
  GreatestOfMembers(std::vector<std::shared_ptr<const Observable>> values,
                    std::vector<std::shared_ptr<const Observable>> shown)
      : values_(std::move(values)), shown_(std::move(shown)) {}

  double value(const State& state) const override { return shown_[greatest(state)]->value(state); }
  Row gradient(const State& state) const override { return shown_[greatest(state)]->gradient(state); }
  double rate(const State& state, const Direction& direction) const override {
    return shown_[greatest(state)]->rate(state, direction);
  }

 private:
  std::size_t greatest(const State& state) const;

  std::vector<std::shared_ptr<const Observable>> values_, shown_;
};

}  // namespace arcwall
