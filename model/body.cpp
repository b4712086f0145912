#include "model/body.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "model/elements_of_member.hpp"
#include "model/member_force.hpp"
#include "model/section_forces.hpp"

namespace arcwall {

namespace {

// The fractions of a member's length that are drawn: equal parts, with each node of meshes that are not too fine.
std::vector<double> sample_fractions(const MemberMesh& mesh) {
  constexpr int fewest = 40, most = 200;
  const int elements = static_cast<int>(mesh.nodes.size()) - 1;
  const int parts = std::min(elements * ((fewest + elements - 1) / elements), most);
  std::vector<double> fractions;
  for (int i = 0; i <= parts; ++i) fractions.push_back(double(i) / parts);
  return fractions;
}

MemberObservable::Component component_of(Dof dof) {
  using Component = MemberObservable::Component;
  switch (dof) {
    case Dof::x:
      return Component::x;
    case Dof::z:
      return Component::z;
    case Dof::rotation:
    case Dof::thickness:
    case Dof::thickness2:
      break;
  }
  return Component::rotation;
}

class FixedBody final : public Body {
 public:
  FixedBody(const Structure& structure, std::vector<Theory> theories, const IncrementalStructure* increments)
      : structure_(structure), theories_(std::move(theories)), increments_(increments) {}

  std::shared_ptr<const Observable> motion(Index dof) const override {
    return std::make_shared<DofObservable>(structure_, dof);
  }
  std::shared_ptr<const Observable> motion(std::size_t member, std::size_t node,
                                           MemberObservable::Component component) const override {
    return std::make_shared<MemberObservable>(structure_, structure_.members()[member], node, component);
  }
  std::shared_ptr<const Observable> reaction(Index dof) const override {
    if (increments_ != nullptr) return std::make_shared<IncrementalReaction>(*increments_, dof);
    return std::make_shared<ReactionObservable>(structure_, dof);
  }
  std::shared_ptr<const Observable> section_force(std::size_t member, double fraction,
                                                  SectionForce what) const override {
    if (increments_ != nullptr) return nullptr;
    return std::make_shared<TiedMemberForce>(tied(member), fraction, what);
  }
  std::shared_ptr<const Observable> gap(std::size_t member, std::size_t node,
                                        const FacedObstacle& obstacle) const override;
  std::shared_ptr<const ElementsOfMember> elements(std::size_t member) const override {
    return increments_ != nullptr ? nullptr : std::make_shared<TiedElements>(tied(member));
  }
  Vector steps(const State& state) const override {
    Vector steps = Vector::Zero(state.x.size());
    const Vector alike = moves_alike(structure_.weights({}));
    steps.head(alike.size()) = alike;
    return steps;
  }
  std::vector<ShapePoint> shape(std::size_t member, const State& state) const override;

 private:
  TiedMember tied(std::size_t member) const {
    return {.structure = structure_, .member = member, .theory = theories_[member]};
  }

  const Structure& structure_;
  std::vector<Theory> theories_;
  const IncrementalStructure* increments_;
};

std::shared_ptr<const Observable> FixedBody::gap(std::size_t member, std::size_t node,
                                                 const FacedObstacle& obstacle) const {
  const MemberSection section = structure_.members()[member].section(node);
  std::vector<Candidate> points;
  for (const double offset : obstacle.offsets(section.shape.angle))
    points.emplace_back(std::make_unique<MemberPoint>(structure_, section, offset), obstacle.obstacle, ContactLabel{});
  return std::make_shared<NodeGap>(std::move(points));
}

// Only those elements are evaluated in which points are wanted.
std::vector<ShapePoint> FixedBody::shape(std::size_t member, const State& state) const {
  const TiedMember on_nodes = tied(member);
  const int elements = on_nodes.elements();
  const std::vector<double> fractions = sample_fractions(structure_.members()[member]);
  std::set<int> wanted;
  for (const double fraction : fractions)
    for (const double side : {-1e-9, 1e-9})
      wanted.insert(std::clamp(static_cast<int>(std::floor(fraction * elements + side)), 0, elements - 1));
  std::vector<MemberStretch> stretches;
  for (const int k : wanted) add_stretches(on_nodes, k, state, stretches);
  return sampled(stretches, fractions);
}

class SlidingMeshBody final : public Body {
 public:
  SlidingMeshBody(const Structure& structure, const SlidingStructure& sliding)
      : structure_(structure), sliding_(sliding) {}

  std::shared_ptr<const Observable> motion(Index dof) const override;
  std::shared_ptr<const Observable> motion(std::size_t member, std::size_t node,
                                           MemberObservable::Component component) const override;
  std::shared_ptr<const Observable> reaction(Index dof) const override {
    return std::make_shared<JointObservable>(sliding_, dof, JointObservable::What::reaction);
  }
  std::shared_ptr<const Observable> section_force(std::size_t member, double fraction,
                                                  SectionForce what) const override {
    return std::make_shared<SlidingMemberForce>(sliding_, name(member), fraction, what);
  }
  std::shared_ptr<const Observable> gap(std::size_t member, std::size_t node,
                                        const FacedObstacle& obstacle) const override {
    const double fraction = structure_.members()[member].fraction(node);
    return std::make_shared<StrandGap>(sliding_, sliding_.find(name(member), fraction), obstacle);
  }
  std::shared_ptr<const ElementsOfMember> elements(std::size_t member) const override {
    return std::make_shared<SlidingElements>(sliding_, name(member));
  }
  Vector steps(const State& state) const override { return moves_alike(sliding_, state); }
  std::vector<ShapePoint> shape(std::size_t member, const State& state) const override;

 private:
  const std::string& name(std::size_t member) const { return structure_.members()[member].name; }

  const Structure& structure_;
  const SlidingStructure& sliding_;
};

// A joint that a strand passes has no unknowns of its own.
std::shared_ptr<const Observable> SlidingMeshBody::motion(Index dof) const {
  if (const auto inside = sliding_.inside(dof))
    return std::make_shared<PlaceObservable>(sliding_, *inside, component_of(sliding_.kind(dof)));
  return std::make_shared<JointObservable>(sliding_, dof, JointObservable::What::motion);
}

// Above the axis is to the left of the member, whichever way its strand travels.
std::shared_ptr<const Observable> SlidingMeshBody::motion(std::size_t member, std::size_t node,
                                                          MemberObservable::Component component) const {
  using Component = MemberObservable::Component;
  const double fraction = structure_.members()[member].fraction(node);
  const SlidingStructure::MemberPart part = sliding_.part_at(name(member), fraction);
  if (part.is_reversed() && component == Component::face_above_z) {
    component = Component::face_below_z;
  } else if (part.is_reversed() && component == Component::face_below_z) {
    component = Component::face_above_z;
  }
  return std::make_shared<PlaceObservable>(sliding_, part.at(fraction), component);
}

// A member is one stretch of a strand, or several strands of its own where loads act inside it.
std::vector<ShapePoint> SlidingMeshBody::shape(std::size_t member, const State& state) const {
  const SlidingMesh& mesh = mesh_of(state);
  const MeshState now = mesh_state_of(state);
  std::vector<double> fractions = sample_fractions(structure_.members()[member]);
  std::vector<MemberStretch> stretches, of_element;
  for (const SlidingStructure::MemberPart& part : sliding_.parts_of(name(member))) {
    const double rate = (part.last_fraction - part.first_fraction) / (part.to - part.from);
    const auto fraction = [&](double S) { return part.first_fraction + rate * (S - part.from); };
    const auto first = static_cast<std::ptrdiff_t>(stretches.size());
    for (Index position = 0; position + 1 < mesh.nodes(part.strand); ++position) {
      of_element.clear();
      add_sliding_stretches(sliding_, part.strand, position, state, of_element);
      for (MemberStretch& stretch : of_element) {
        if (stretch.to <= part.from || stretch.from >= part.to) continue;
        stretch.from = fraction(stretch.from);
        stretch.to = fraction(stretch.to);
        stretches.push_back(part.is_reversed() ? stretch.reversed() : stretch);
      }
    }
    if (part.is_reversed()) std::reverse(stretches.begin() + first, stretches.end());
    for (Index k = 0; k < mesh.breakpoints(); ++k)
      if (const double S = now.s[k]; mesh.breakpoint(k).first == part.strand && S > part.from && S < part.to)
        fractions.push_back(fraction(S));
  }
  std::sort(fractions.begin(), fractions.end());
  return sampled(stretches, fractions);
}

}  // namespace

std::unique_ptr<Body> body_of(const Structure& structure, std::vector<Theory> theories,
                              const IncrementalStructure* increments) {
  return std::make_unique<FixedBody>(structure, std::move(theories), increments);
}

std::unique_ptr<Body> body_of(const Structure& structure, const SlidingStructure& sliding) {
  return std::make_unique<SlidingMeshBody>(structure, sliding);
}

}  // namespace arcwall
