#include "model/deck/deck.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "contact/outline.hpp"
#include "core/text.hpp"
#include "model/deck/value.hpp"
#include "model/deck/words.hpp"

namespace arcwall::deck {

namespace {

constexpr double pi = std::numbers::pi;

double linear(double from, const std::optional<double>& to, double t) { return to ? from + t * (*to - from) : from; }

SectionProperties properties_of(const Rectangle& shape, double t) {
  const double b = linear(shape.width, shape.width_to, t), h = linear(shape.height, shape.height_to, t);
  return {.A = b * h, .I = b * h * h * h / 12.0, .height = h};
}

SectionProperties properties_of(const Circle& shape, double t) {
  const double r = linear(shape.radius, shape.radius_to, t);
  return {.A = pi * r * r, .I = pi * r * r * r * r / 4.0, .height = 2.0 * r};
}

// With R and r the outer and the inner radius, t = R − r: R² − r² = t (R + r), which does not cancel for thin walls.
SectionProperties properties_of(const Tube& shape, double t) {
  const double R = linear(shape.radius, shape.radius_to, t);
  const double wall = linear(shape.thickness, shape.thickness_to, t), r = R - wall;
  const double A = pi * wall * (R + r);
  return {.A = A, .I = A * (R * R + r * r) / 4.0, .height = 2.0 * R};
}

SectionProperties properties_of(const General& shape, double) {
  return {.A = shape.A, .I = shape.I, .height = shape.height, .shear_area = shape.shear_area};
}

SectionProperties properties_of(const SectionTable& shape, double t) {
  const auto behind = std::upper_bound(shape.at.begin() + 1, shape.at.end() - 1, t);
  const auto k = static_cast<std::size_t>(behind - shape.at.begin());
  const double part = (t - shape.at[k - 1]) / (shape.at[k] - shape.at[k - 1]);
  const auto value = [&](const std::vector<double>& of) { return of[k - 1] + part * (of[k] - of[k - 1]); };
  const auto optional_value = [&](const std::vector<double>& of) {
    return of.empty() ? std::nullopt : std::optional(value(of));
  };
  return {.A = value(shape.A),
          .I = value(shape.I),
          .height = optional_value(shape.height),
          .shear_area = optional_value(shape.shear_area)};
}

}  // namespace

SectionProperties properties(const Section& section, double fraction) {
  return std::visit([&](const auto& shape) { return properties_of(shape, fraction); }, section.shape);
}

bool tapers(const Section& section) {
  struct Tapers {
    bool operator()(const Rectangle& shape) const { return shape.width_to || shape.height_to; }
    bool operator()(const Circle& shape) const { return shape.radius_to.has_value(); }
    bool operator()(const Tube& shape) const { return shape.radius_to || shape.thickness_to; }
    bool operator()(const General&) const { return false; }
    bool operator()(const SectionTable&) const { return true; }
  };
  return std::visit(Tapers{}, section.shape);
}

bool height_tapers(const Section& section) {
  struct Tapers {
    bool operator()(const Rectangle& shape) const { return shape.height_to.has_value(); }
    bool operator()(const Circle& shape) const { return shape.radius_to.has_value(); }
    bool operator()(const Tube& shape) const { return shape.radius_to.has_value(); }
    bool operator()(const General&) const { return false; }
    bool operator()(const SectionTable& shape) const { return !shape.height.empty(); }
  };
  return std::visit(Tapers{}, section.shape);
}

bool has_faces(const Section& section) {
  if (const auto* general = std::get_if<General>(&section.shape)) return general->height.has_value();
  const auto* table = std::get_if<SectionTable>(&section.shape);
  return table == nullptr || !table->height.empty();
}

namespace {

// Whether a closed outline is given in the order in which the body is to the right.
bool runs_the_other_way(const OutlinePoints& outline) {
  return outline.closed && (doubled_area(outline.points()) > 0.0) == (outline.keep == Keep::outside);
}

}  // namespace

std::vector<PolylineOutline::Corner> PolylineOutline::corners() const {
  const std::vector<Vec2> all = points();
  const std::size_t count = all.size(), margin = closed ? 0 : 1;
  const double left = runs_the_other_way(*this) ? -1.0 : 1.0;
  std::vector<Corner> corners;
  for (std::size_t i = margin; i + margin < count; ++i) {
    const Vec2 before = all[i] - all[(i + count - 1) % count], behind = all[(i + 1) % count] - all[i];
    corners.push_back(
        {.point = i, .turn = left * turn_between(before, behind), .before = before.norm(), .behind = behind.norm()});
  }
  return corners;
}

PressureLaw WallLaw::law() const {
  if (stiffness) return PressureLaw(*stiffness, depth);
  return {std::make_shared<const SpringLaw>(penetration, pressure, interpolation),
          {penetration.begin() + 1, penetration.end()}};
}

std::vector<double> Wall::radii() const {
  const auto& line = std::get<PolylineOutline>(*outline);
  std::vector<double> radii(line.x.size(), 0.0);
  const std::vector<PolylineOutline::Corner> corners = line.corners();
  for (std::size_t i = 0; i < corners.size(); ++i)
    radii[corners[i].point] = corner_radii.empty() ? corner_radius : corner_radii[i];
  return radii;
}

std::vector<PolylineOutline::Part> PolylineOutline::without_sharp_hollows(const std::vector<double>& radii) const {
  constexpr double beyond = 1e-3;  // of the line that ends in a hollow
  const std::vector<Vec2> all = points();
  std::vector<std::size_t> cuts;
  for (const Corner& corner : corners())
    if (corner.is_hollow() && radii[corner.point] == 0.0) cuts.push_back(corner.point);
  if (cuts.size() < (closed ? 2U : 1U)) return {{*this, radii}};
  const std::size_t count = all.size();
  if (closed) {
    cuts.push_back(cuts.front() + count);
  } else {
    cuts.insert(cuts.begin(), 0);
    cuts.push_back(count - 1);
  }
  std::vector<Part> parts;
  for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
    std::vector<Vec2> line;
    Part& part = parts.emplace_back();
    for (std::size_t i = cuts[c]; i <= cuts[c + 1]; ++i) {
      line.push_back(all[i % count]);
      part.radii.push_back(radii[i % count]);
    }
    const auto lengthen = [&](Vec2& end, const Vec2& inner) { end += beyond * (end - inner); };
    const Vec2 second = line[1], last_but_one = line[line.size() - 2];
    if (closed || c > 0) lengthen(line.front(), second);
    if (closed || c + 2 < cuts.size()) lengthen(line.back(), last_but_one);
    if (runs_the_other_way(*this)) {
      std::reverse(line.begin(), line.end());
      std::reverse(part.radii.begin(), part.radii.end());
    }
    for (const Vec2& point : line) {
      part.outline.x.push_back(point.x());
      part.outline.z.push_back(point.y());
    }
  }
  return parts;
}

std::vector<Vec2> OutlinePoints::points() const {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < x.size(); ++i) points.emplace_back(x[i], z[i]);
  return points;
}

std::string to_text(const Place& place) {
  return place.fraction ? place.name + ":" + round_trip(*place.fraction) : place.name;
}

namespace {

// z and slope of a wall that is straight.
std::optional<LineProfile> line_of(const Wall& wall) {
  if (wall.outline) return std::nullopt;
  if (const auto* const flat = std::get_if<FlatProfile>(&wall.profile)) return LineProfile{.z = flat->z};
  if (const auto* const line = std::get_if<LineProfile>(&wall.profile)) return *line;
  return std::nullopt;
}

// The diagonal of the box round the deck's points.
double size_of(const Deck& deck) {
  if (deck.points.empty()) return 0.0;
  Vector low = deck.points.front().at, high = low;
  for (const Point& point : deck.points) {
    low = {std::min(low.x, point.at.x), std::min(low.z, point.at.z)};
    high = {std::max(high.x, point.at.x), std::max(high.z, point.at.z)};
  }
  return std::hypot(high.x - low.x, high.z - low.z);
}

bool have_a_member_in_common(const Wall& a, const Wall& b) {
  return a.members.empty() || b.members.empty() ||
         std::any_of(a.members.begin(), a.members.end(), [&](const std::string& name) {
           return std::find(b.members.begin(), b.members.end(), name) != b.members.end();
         });
}

}  // namespace

namespace {

constexpr double no_clearance = 1e-12;  // of the structure's size, as where it touches at the start

}  // namespace

std::optional<LineProfile> line_without_clearance(const Deck& deck, const Wall& a, const Wall& b) {
  const auto line = line_of(a), other = line_of(b);
  if (!line || !other || a.side == b.side || a.contact_surface != ContactSurface::axis ||
      b.contact_surface != ContactSurface::axis)
    return std::nullopt;
  const bool meet = std::abs(line->z - other->z) <= no_clearance * size_of(deck) &&
                    std::abs(line->slope - other->slope) <= no_clearance;
  return meet ? line : std::nullopt;
}

WallsWithoutClearance::WallsWithoutClearance(const Deck& deck) : deck_(deck), reach_(no_clearance * size_of(deck)) {
  for (std::size_t i = 0; i < deck.walls.size(); ++i) {
    const Wall& wall = deck.walls[i];
    const auto line = line_of(wall);
    if (line && wall.contact_surface == ContactSurface::axis)
      (wall.side == Side::below ? below_ : above_).push_back({.z = line->z, .slope = line->slope, .wall = i});
  }
  for (auto* of_side : {&below_, &above_}) std::stable_sort(of_side->begin(), of_side->end(), is_lower);
}

std::vector<std::size_t> WallsWithoutClearance::beside(std::size_t wall) const {
  std::vector<std::size_t> found;
  const Wall& one = deck_.walls[wall];
  const auto line = line_of(one);
  if (!line || one.contact_surface != ContactSurface::axis) return found;
  const std::vector<Line>& others = one.side == Side::below ? above_ : below_;
  // Wider by far more than the rounding of a difference, which is what decides.
  const double wide = 2.0 * reach_ + 4.0 * std::numeric_limits<double>::epsilon() * std::abs(line->z);
  auto at = std::lower_bound(others.begin(), others.end(), Line{.z = line->z - wide}, is_lower);
  for (; at != others.end() && at->z <= line->z + wide; ++at)
    if (std::abs(line->z - at->z) <= reach_ && std::abs(line->slope - at->slope) <= no_clearance)
      found.push_back(at->wall);
  std::sort(found.begin(), found.end());
  return found;
}

std::string driven_thing(const std::string& kind, std::size_t which) { return kind + "." + std::to_string(which); }

std::vector<std::string> driven_things(const Deck& deck) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& kind, const auto& things) {
    for (std::size_t i = 0; i < things.size(); ++i)
      if (!things[i].constant) names.push_back(driven_thing(kind, i));
  };
  add("load", deck.loads);
  add("prescribed", deck.prescribed);
  for (const Wall& wall : deck.walls)
    if (wall.motion) names.push_back("wall." + wall.name);
  return names;
}

bool drives(const Stage& stage, const std::string& thing) {
  return std::find(stage.drives.begin(), stage.drives.end(), thing) != stage.drives.end();
}

namespace {

void add_visits(const Stage& stage, double step, const std::vector<double>& visit, std::vector<Stage>& to) {
  double from = 0.0;
  for (std::size_t i = 0; i < visit.size(); ++i) {
    Stage leg = stage;
    leg.name += "-" + std::to_string(i + 1);
    leg.visit.clear();
    leg.goes_on = i > 0;
    const double there = std::exchange(from, visit[i]);
    leg.step = std::copysign(step, visit[i] - there);
    StopBounds bounds{.name = "lambda", .position = stage.position, .low = -infinity, .high = infinity};
    (visit[i] < there ? bounds.low : bounds.high) = visit[i];
    leg.stop = Stop{.bounds = {bounds}};
    to.push_back(std::move(leg));
  }
}

}  // namespace

Deck with_visits_as_stages(Deck deck) {
  std::vector<Stage> stages;
  if (deck.stages.empty() && !deck.path.visit.empty())
    add_visits({.name = "visit", .position = deck.path.position, .drives = driven_things(deck)}, deck.path.step,
               deck.path.visit, stages);
  for (const Stage& stage : deck.stages)
    if (stage.visit.empty())
      stages.push_back(stage);
    else
      add_visits(stage, stage.step.value_or(deck.path.step), stage.visit, stages);
  deck.path.visit.clear();
  deck.stages = std::move(stages);
  return deck;
}

std::optional<std::size_t> gripping_stage(const Deck& deck, std::size_t prescribed) {
  if (deck.prescribed[prescribed].from == MovedFrom::rest) return std::nullopt;
  const std::string name = driven_thing("prescribed", prescribed);
  const auto first =
      std::find_if(deck.stages.begin(), deck.stages.end(), [&](const Stage& stage) { return drives(stage, name); });
  if (first == deck.stages.end()) return std::nullopt;
  return static_cast<std::size_t>(first - deck.stages.begin());
}

// Sliding where contact forces are point forces. Springs, increments and walls without clearance act at nodes.
bool acts_in(const Spring& spring, Dof direction) {
  struct Acts {
    Dof direction;
    bool by(const Stiffness& stiffness, const std::optional<TableLaw>& law) const {
      if (law) return law->direction == direction;
      if (direction == Dof::rotation) return stiffness.rotation > 0.0;
      return (direction == Dof::x ? stiffness.x : stiffness.z) > 0.0;
    }
    bool operator()(const GroundSpring& spring) const { return by(spring.stiffness, spring.law); }
    bool operator()(const PointToPointSpring& spring) const { return by(spring.stiffness, spring.law); }
    bool operator()(const Foundation& soil) const { return by({.x = soil.x, .z = soil.z, .rotation = 0.0}, soil.law); }
  };
  return std::visit(Acts{direction}, spring.kind);
}

double friction_of(const Deck& deck, const Wall& wall, const std::string& member, double fraction) {
  if (deck.frictions.empty()) return wall.friction;
  const Member* const of = find(deck.members, member);
  const std::string point = of == nullptr ? "" : fraction == 0.0 ? of->from : fraction == 1.0 ? of->to : "";
  const auto fits = [](const std::string& asked, const std::string& is) { return asked.empty() || asked == is; };
  double coefficient = wall.friction;
  for (const FrictionPair& pair : deck.frictions)
    if (fits(pair.wall, wall.name) && fits(pair.member, member) && fits(pair.point, point))
      coefficient = pair.coefficient;
  return coefficient;
}

bool concerns(const Wall& wall, const std::string& member) {
  return wall.members.empty() || std::find(wall.members.begin(), wall.members.end(), member) != wall.members.end();
}

bool has_friction(const Deck& deck) {
  if (deck.frictions.empty())
    return std::any_of(deck.walls.begin(), deck.walls.end(), [](const Wall& wall) { return wall.friction > 0.0; });
  return std::any_of(deck.walls.begin(), deck.walls.end(), [&](const Wall& wall) {
    return std::any_of(deck.members.begin(), deck.members.end(), [&](const Member& member) {
      const auto is_rough_at = [&](double fraction) { return friction_of(deck, wall, member.name, fraction) > 0.0; };
      return concerns(wall, member.name) && (is_rough_at(0.0) || is_rough_at(0.5) || is_rough_at(1.0));
    });
  });
}

// The sections of a table have kinks, and faces that taper are not parallel to their axis.
std::string why_tapers_hold_contact(const Deck& deck) {
  for (const Member& member : deck.members) {
    const Section* section = find(deck.sections, member.section);
    if (section == nullptr || !tapers(*section)) continue;
    for (const Wall& wall : deck.walls) {
      if (!concerns(wall, member.name)) continue;
      if (std::holds_alternative<SectionTable>(section->shape))
        return "contact points do not move along member " + member.name + ", whose section " + section->name +
               " is a table";
      if (wall.contact_surface == ContactSurface::face && height_tapers(*section))
        return "wall " + wall.name + " touches the faces of member " + member.name +
               ", along which contact points do "
               "not move, since its height tapers";
    }
  }
  return {};
}

namespace {

// The centre of the circle through three points; far away or nowhere where they lie in a line.
Vector centre_through(const Vector& a, const Vector& b, const Vector& c) {
  const double bx = b.x - a.x, bz = b.z - a.z, cx = c.x - a.x, cz = c.z - a.z;
  const double area = 2.0 * (bx * cz - bz * cx), of_b = bx * bx + bz * bz, of_c = cx * cx + cz * cz;
  return {.x = a.x + (cz * of_b - bz * of_c) / area, .z = a.z + (bx * of_c - cx * of_b) / area};
}

}  // namespace

bool is_enclosed(const Deck& deck, const Wall& wall) {
  const auto* circle = wall.outline ? std::get_if<CircleOutline>(&*wall.outline) : nullptr;
  if (circle == nullptr || circle->keep != Keep::outside || !(wall.interference < circle->radius)) return false;
  return std::any_of(deck.members.begin(), deck.members.end(), [&](const Member& member) {
    const auto* arc = std::get_if<Arc>(&member.axis);
    const Point *const from = find(deck.points, member.from), *const to = find(deck.points, member.to);
    if (!concerns(wall, member.name) || arc == nullptr || from == nullptr || to == nullptr) return false;
    const Vector centre = centre_through(from->at, arc->via, to->at);
    return std::hypot(centre.x - circle->centre.x, centre.z - circle->centre.z) <= wall.interference;
  });
}

PointsOfContact points_of_contact(const Deck& deck) {
  if (deck.contact.points) return {.points = *deck.contact.points, .why = "as contact.points says"};
  if (deck.contact.is_compliant())
    return {.points = ContactPoints::nodes, .why = "walls are compliant: their pressure is integrated along members"};
  if (deck.contact.method != ContactLaw::Method::rigid)
    return {.points = ContactPoints::nodes,
            .why = "method " + text_of(contact_method_words, deck.contact.method) + " puts springs at nodes"};
  if (has_friction(deck)) return {.points = ContactPoints::nodes, .why = "walls have friction"};
  if (deck.path.method == PathMethod::incremental)
    return {.points = ContactPoints::nodes, .why = "path.method incremental has contact at nodes"};
  for (const Member& member : deck.members)
    if (member.theory != Theory::euler_bernoulli && member.theory != Theory::elastica)
      return {.points = ContactPoints::nodes,
              .why = "contact points move along members of theory euler-bernoulli or elastica, and member " +
                     member.name + " is of theory " + text_of(theory_words, member.theory)};
  if (std::string why = why_tapers_hold_contact(deck); !why.empty())
    return {.points = ContactPoints::nodes, .why = std::move(why)};
  for (const Wall& wall : deck.walls)
    if (wall.interference > 0.0 && is_enclosed(deck, wall))
      return {.points = ContactPoints::nodes,
              .why = "a member lies around wall " + wall.name + ", which grows into place"};
  const WallsWithoutClearance without_clearance(deck);
  for (std::size_t i = 0; i < deck.walls.size(); ++i)
    for (const std::size_t k : without_clearance.beside(i))
      if (const Wall& a = deck.walls[i], &b = deck.walls[k]; have_a_member_in_common(a, b))
        return {.points = ContactPoints::nodes,
                .why = "walls " + a.name + " and " + b.name + " leave no clearance between them"};
  return {.points = ContactPoints::moving,
          .why = "the default where all members are of theory euler-bernoulli or elastica"};
}

LineLoad MemberLoad::along(double length) const {
  const Vector to = distributed_to.value_or(distributed);
  return {.first = {distributed.x, distributed.z},
          .slope = Vec2(to.x - distributed.x, to.z - distributed.z) / length,
          .frame = frame,
          .measure = per};
}

// Load increments end at the last value of output_at.lambda.
Deck without_answers(Deck deck) {
  deck.path.sensitivity.clear();
  deck.path.jumps = false;
  deck.path.search = false;
  deck.path.search_at.clear();
  deck.curve.reset();
  return deck;
}

bool is_unbounded(const Path& path) {
  const Stop& stop = path.stop;
  return stop.bounds.empty() && !stop.contacts && stop.events.empty() && !path.max_points_given.in_deck &&
         path.method != PathMethod::incremental;
}

std::string origin_of(const std::string& assignment) {
  constexpr std::size_t most_shown = 200;
  std::string text = assignment.size() > most_shown ? assignment.substr(0, most_shown) + "…" : assignment;
  return "--set " + on_one_line(text);
}

Diagnostic diagnostic_at(const Source& source, const Position& position, std::string key, std::string message,
                         std::string cure) {
  Diagnostic diagnostic{.file = source.file,
                        .line = position.line,
                        .column = position.column,
                        .key = std::move(key),
                        .message = std::move(message),
                        .cure = std::move(cure)};
  if (position.assignment > 0) {
    diagnostic.file = origin_of(source.assignments.at(static_cast<std::size_t>(position.assignment) - 1));
    diagnostic.line = 0;
    diagnostic.column = 0;
  }
  return diagnostic;
}

}  // namespace arcwall::deck
