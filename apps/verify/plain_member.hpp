#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/verify/strain_energy.hpp"
#include "elements/axis.hpp"
#include "elements/line_load.hpp"
#include "model/model.hpp"

namespace arcwall::verify {

/// A member as the deck has it: its stress-free shape, its sections, and what acts along it.
class PlainMember {
 public:
  /// `taper`: of the model; used for the shear area of a tube that tapers alone, which the theory interpolates. All
  /// must outlive this.
  PlainMember(const deck::Deck& deck, const deck::Member& member, const SectionTaper* taper);

  const std::string& name() const { return member_.name; }
  const deck::Member& in_deck() const { return member_; }
  double length() const { return axis_->length(); }  ///< of the axis without imperfection
  const ImperfectAxis& shape() const { return *shape_; }

  /// Of the section at a fraction of the length.
  PlainStiffness stiffness(double fraction) const;
  /// The same along a part of the member.
  SectionAlong section_between(double first, double last) const;

  /// What temperatures make at λ.
  FreeDeformation free(double lambda) const {
    return {.strain = strain_.at(lambda), .curvature = curvature_.at(lambda)};
  }

  AxisAngle axis_angle() const;
  EssenburgMaterial essenburg_material() const;

  const std::vector<DrivenLineLoad>& loads() const { return loads_; }
  const Driven& pressure() const { return pressure_; }
  const std::vector<const deck::Foundation*>& foundations() const { return foundations_; }

  /// Places of the stress-free shape at fractions of the axis without imperfection, those of both joints as they are.
  Vec2 place(double fraction) const;
  double angle(double fraction) const { return shape_->at(fraction * length()).angle; }

  /// Elements between nodes at equal arc lengths of the axis: of slender beams, and of others.
  Stretch stretch(std::size_t element) const;
  NodesAlong nodes(std::size_t element) const;
  std::vector<PlainDirector> directors(std::size_t element) const;

 private:
  double fraction(std::size_t element, double inside) const {
    return (double(element) + inside) / double(member_.elements);
  }
  int order() const { return member_.order.value_or(2); }

  const deck::Member& member_;
  const deck::Section& section_;
  const deck::Material& material_;
  const SectionTaper* taper_;
  Vec2 from_, to_;
  std::shared_ptr<const Axis> axis_;
  std::unique_ptr<const ImperfectAxis> shape_;
  Driven strain_{}, curvature_{}, pressure_{};
  std::vector<DrivenLineLoad> loads_{};
  std::vector<const deck::Foundation*> foundations_{};
};

/// The members of a model in the order of its deck, with what their elements are at rest: made once for all states.
class PlainMembers {
 public:
  /// `model` must outlive this.
  explicit PlainMembers(const Model& model);

  const PlainMember& operator[](std::size_t m) const { return members_[m]; }
  const PlainMember& named(const std::string& name) const;

  /// Of the elements between fixed nodes, by member and element; empty where the theory has no such.
  const std::vector<Stretch>& stretches(std::size_t m) const { return stretches_[m]; }
  const std::vector<NodesAlong>& nodes(std::size_t m) const { return nodes_[m]; }
  const std::vector<std::vector<PlainDirector>>& directors(std::size_t m) const { return directors_[m]; }

 private:
  std::vector<PlainMember> members_{};
  std::vector<std::vector<Stretch>> stretches_{};
  std::vector<std::vector<NodesAlong>> nodes_{};
  std::vector<std::vector<std::vector<PlainDirector>>> directors_{};
};

}  // namespace arcwall::verify
