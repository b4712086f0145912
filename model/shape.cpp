#include "model/shape.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "model/build_contact.hpp"
#include "model/section_forces.hpp"

namespace arcwall {

namespace {

std::vector<double> sample_fractions(int elements);
std::vector<ShapePoint> points_on_nodes(const Model& model, const State& state, std::size_t member);
std::vector<ShapePoint> points_between_breakpoints(const Model& model, const State& state, std::size_t member);
std::vector<ContactMark> contact_marks(const ContactQuery& contacts, const State& state);

}  // namespace

Shape shape_of(const Model& model, const State& state) {
  Shape shape;
  for (std::size_t m = 0; m < model.deck().members.size(); ++m)
    shape.members.push_back({.member = model.deck().members[m].name,
                             .points = model.sliding() != nullptr ? points_between_breakpoints(model, state, m)
                                                                  : points_on_nodes(model, state, m)});
  if (model.contacts() != nullptr) shape.contacts = contact_marks(*model.contacts(), state);
  return shape;
}

namespace {

// --- members --------------------------------------------------------------------------------------------------------

// Equal parts, each node among them on meshes that are not too fine.
std::vector<double> sample_fractions(int elements) {
  constexpr int fewest = 40, most = 200;
  const int parts = std::min(elements * ((fewest + elements - 1) / elements), most);
  std::vector<double> fractions;
  for (int i = 0; i <= parts; ++i) fractions.push_back(double(i) / parts);
  return fractions;
}

// Of the elements only those are evaluated in which points are wanted.
std::vector<ShapePoint> points_on_nodes(const Model& model, const State& state, std::size_t member) {
  const TiedMember tied{
      .structure = model.structure(), .member = member, .theory = model.deck().members[member].theory};
  const int elements = tied.elements();
  const std::vector<double> fractions = sample_fractions(elements);
  std::set<int> wanted;
  for (const double fraction : fractions)
    for (const double side : {-1e-9, 1e-9})
      wanted.insert(std::clamp(static_cast<int>(std::floor(fraction * elements + side)), 0, elements - 1));
  std::vector<MemberStretch> stretches;
  for (const int k : wanted) add_stretches(tied, k, state, stretches);
  return sampled(stretches, fractions);
}

// --- members whose mesh slides --------------------------------------------------------------------------------------

// A member is one stretch of a strand, or several strands of its own where loads act inside it.
std::vector<ShapePoint> points_between_breakpoints(const Model& model, const State& state, std::size_t member) {
  const SlidingStructure& body = *model.sliding_structure();
  const SlidingMesh& mesh = mesh_of(state);
  const Vector s = mesh_state_of(state).s;
  const std::string& name = model.deck().members[member].name;
  const auto elements = static_cast<int>(model.structure().members()[member].nodes.size()) - 1;
  std::vector<double> fractions = sample_fractions(elements);
  std::vector<MemberStretch> stretches;
  for (const SlidingStructure::MemberPart& part : body.parts_of(name)) {
    const double rate = (part.last_fraction - part.first_fraction) / (part.to - part.from);
    const auto fraction = [&](double S) { return part.first_fraction + rate * (S - part.from); };
    for (Index position = 0; position + 1 < mesh.nodes(part.strand); ++position) {
      MemberStretch stretch = sliding_stretch(body, part.strand, position, state);
      if (stretch.to <= part.from || stretch.from >= part.to) continue;
      stretch.from = fraction(stretch.from);
      stretch.to = fraction(stretch.to);
      stretches.push_back(stretch);
    }
    for (Index k = 0; k < mesh.breakpoints(); ++k)
      if (const double S = s[k]; mesh.breakpoint(k).first == part.strand && S > part.from && S < part.to)
        fractions.push_back(fraction(S));
  }
  std::sort(fractions.begin(), fractions.end());
  return sampled(stretches, fractions);
}

// --- contacts -------------------------------------------------------------------------------------------------------

std::vector<ContactMark> contact_marks(const ContactQuery& contacts, const State& state) {
  std::vector<ContactMark> marks;
  const auto add = [&](const std::vector<ContactPoint>& points) {
    for (const ContactPoint& point : points)
      marks.push_back(
          {.label = point.label, .position = point.place, .force = point.force_vector, .pressure = point.pressure()});
  };
  add(contacts.closed_contacts(state));
  add(contacts.pressed_nodes(state));
  return marks;
}

// --- walls ----------------------------------------------------------------------------------------------------------

// Half as far again as the structure reaches at rest.
Eigen::AlignedBox2d reach(const Model& model) {
  Eigen::AlignedBox2d box;
  for (Index node = 0; node < model.structure().node_count(); ++node) box.extend(model.structure().position(node));
  const double margin = 0.5 * box.diagonal().norm();
  return {box.min() - Vec2::Constant(margin), box.max() + Vec2::Constant(margin)};
}

}  // namespace

// Of a wall that climbs out of the structure's reach only what lies between its first and last place within; all of one
// that is nowhere within.
std::vector<WallShape> wall_shapes(const Model& model) {
  const Eigen::AlignedBox2d box = reach(model);
  std::vector<WallShape> walls;
  for (const deck::Wall& wall : model.deck().walls) {
    const std::vector<Vec2> line = obstacle_of(wall)->outline(box.min().x(), box.max().x(), 0.0);
    const auto inside = [&](const Vec2& point) { return box.contains(point); };
    const auto first = std::find_if(line.begin(), line.end(), inside);
    const auto last = std::find_if(line.rbegin(), line.rend(), inside).base();
    walls.push_back({.name = wall.name,
                     .side = wall.side,
                     .line = first == line.end() || last - first < 2 ? line : std::vector<Vec2>(first, last)});
  }
  return walls;
}

}  // namespace arcwall
