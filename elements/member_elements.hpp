#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "elements/heated_beam.hpp"
#include "elements/structure.hpp"

namespace arcwall {

/// Element k of a member and what its stress-free shape is made of.
struct MemberElement {
  const MemberDescription& member;
  const ImperfectAxis& shape;
  const MemberMesh& mesh;
  std::size_t k;

  // Arc length of the axis without imperfection at a fraction of the element.
  double arc(double fraction) const { return (double(k) + fraction) / count() * member.axis->length(); }
  double count() const { return double(mesh.nodes.size() - 1); }

  bool is_like_all_others() const { return shape.is_straight() && shape.deviations().empty(); }

  // Between the nodes as they are: joints may differ from the axis' ends by its round-off. Elements that are alike are
  // so to the last digit.
  Vec2 chord() const {
    if (is_like_all_others()) return (mesh.shape.back().position - mesh.shape.front().position) / count();
    return mesh.shape[k + 1].position - mesh.shape[k].position;
  }
};

/// The section of a slender member whose axis is so long.
SlenderSection slender_section(const Section& section, Theory theory, int order, double length);

/// Adds the elements of a member, in turn. Those that are alike are one object, where it knows no more of its place
/// than the chord. Without a thermal strain they have no λ.
void add_elements(const MemberDescription& member, const MemberMesh& mesh, const ThermalStrain& thermal,
                  ElementList& elements);

/// A dead load along an element.
std::unique_ptr<Element> make_load(const MemberElement& at, const LineLoad& load);

/// A foundation along an element; bars have none.
std::unique_ptr<Element> make_foundation(const MemberElement& at, const FoundationLaw& law);

/// The pressures of a compliant wall on an element: one, or one on each face of sections that stand across the wall.
std::vector<std::unique_ptr<Element>> make_wall_pressures(const MemberElement& at, const CompliantWall& wall,
                                                          bool ramp);

/// A pressure of 1 on the deformed axis of an element, whose potential counts places from `origin`; bars have none.
std::unique_ptr<Element> make_pressure(const MemberElement& at, const Vec2& origin);

}  // namespace arcwall
