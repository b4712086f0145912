#include "apps/verify/plain_member.hpp"

#include <algorithm>
#include <cmath>

namespace arcwall::verify {

namespace {

Vec2 vec(const deck::Vector& v) { return {v.x, v.z}; }

std::unique_ptr<const Axis> axis_of(const deck::Member& member, const Vec2& from, const Vec2& to) {
  if (const auto* arc = std::get_if<deck::Arc>(&member.axis)) return arc_axis(from, vec(arc->via), to);
  if (const auto* sine = std::get_if<deck::SineAxis>(&member.axis)) return sine_axis(from, to, sine->rise, sine->waves);
  if (const auto* curve = std::get_if<deck::Curve>(&member.axis)) {
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < curve->x.size(); ++i) points.emplace_back(curve->x[i], curve->z[i]);
    return spline_axis(points);
  }
  return straight_axis(from, to);
}

std::vector<SineDeviation> deviations_of(const deck::Member& member) {
  std::vector<SineDeviation> deviations;
  for (const deck::Imperfection& wave : member.imperfections)
    deviations.push_back({.amplitude = wave.amplitude, .waves = wave.waves});
  return deviations;
}

// Cowper's factor on the shear area of rings and, without lateral contraction, of a rectangle; 1 is the whole area.
double shear_factor(const deck::Section& section) {
  const auto ring = [](double inner_over_outer) {
    const double m2 = inner_over_outer * inner_over_outer, square = (1.0 + m2) * (1.0 + m2);
    return 6.0 * square / (7.0 * square + 20.0 * m2);
  };
  if (section.shear_correction) return *section.shear_correction;
  if (std::holds_alternative<deck::Circle>(section.shape)) return ring(0.0);
  if (const auto* tube = std::get_if<deck::Tube>(&section.shape)) return ring(1.0 - tube->thickness / tube->radius);
  return 5.0 / 6.0;
}

// Gauss's rules over the height of a rectangle and, of the second kind of Chebyshev, of a disc.
std::vector<std::pair<double, double>> heights_of(const deck::Section& section) {
  std::vector<std::pair<double, double>> heights;
  const auto add_disc = [&](double radius, double sign) {
    for (int i = 1; i <= 5; ++i) {
      const double angle = pi * i / 6.0;
      heights.emplace_back(radius * std::cos(angle), sign * pi / 3.0 * std::pow(radius * std::sin(angle), 2));
    }
  };
  if (const auto* of = std::get_if<deck::Rectangle>(&section.shape)) {
    for (const auto& [at, weight] : gauss_rule_of(5))
      heights.emplace_back((at - 0.5) * of->height, weight * of->width * of->height);
  } else if (const auto* disc = std::get_if<deck::Circle>(&section.shape)) {
    add_disc(disc->radius, 1.0);
  } else if (const auto* tube = std::get_if<deck::Tube>(&section.shape)) {
    add_disc(tube->radius, 1.0);
    add_disc(tube->radius - tube->thickness, -1.0);
  }
  return heights;
}

Driven driven(const deck::Load& load, double value) {
  return load.constant ? Driven{.constant = value} : Driven{.proportional = value};
}

}  // namespace

PlainMember::PlainMember(const deck::Deck& deck, const deck::Member& member, const SectionTaper* taper)
    : member_(member),
      section_(*deck::find(deck.sections, member.section)),
      material_(*deck::find(deck.materials, member.material)),
      taper_(taper),
      from_(vec(deck::find(deck.points, member.from)->at)),
      to_(vec(deck::find(deck.points, member.to)->at)),
      axis_(axis_of(member, from_, to_)),
      shape_(std::make_unique<const ImperfectAxis>(*axis_, deviations_of(member))) {
  for (const deck::Load& load : deck.loads) {
    if (const auto* heat = std::get_if<deck::Heat>(&load.action); heat != nullptr && heat->member == name()) {
      strain_ += driven(load, material_.expansion.value() * heat->temperature);
      curvature_ += driven(load, -material_.expansion.value() * heat->gradient);
    } else if (const auto* line = std::get_if<deck::MemberLoad>(&load.action);
               line != nullptr && line->member == name()) {
      loads_.push_back({.load = line->along(length()), .factor = driven(load, 1.0)});
    } else if (const auto* pressure = std::get_if<deck::Pressure>(&load.action);
               pressure != nullptr && pressure->member == name()) {
      pressure_ += driven(load, pressure->pressure);
    }
  }
  for (const deck::Spring& spring : deck.springs)
    if (const auto* foundation = std::get_if<deck::Foundation>(&spring.kind);
        foundation != nullptr && foundation->member == name())
      foundations_.push_back(foundation);
}

PlainStiffness PlainMember::stiffness(double fraction) const {
  const deck::SectionProperties of = deck::properties(section_, fraction);
  PlainStiffness out{.EA = material_.E * of.A, .EI = material_.E * of.I};
  if (!material_.nu) return out;
  const double shear_area = of.shear_area ? *of.shear_area : shear_factor(section_) * of.A;
  const bool interpolated = taper_ != nullptr && std::holds_alternative<deck::Tube>(section_.shape);
  out.GA = material_.E / (2.0 * (1.0 + *material_.nu)) * (interpolated ? taper_->at(fraction).shear_area : shear_area);
  return out;
}

SectionAlong PlainMember::section_between(double first, double last) const {
  if (taper_ == nullptr) return [uniform = stiffness(0.5)](double) { return uniform; };
  return [=, this](double inside) { return stiffness((1.0 - inside) * first + inside * last); };
}

// A member of theory "euler-bernoulli" that tapers is the mixed element of order 4.
AxisAngle PlainMember::axis_angle() const {
  if (member_.theory == Theory::elastica && member_.order == 6) return AxisAngle::cubic;
  return member_.theory == Theory::elastica || taper_ != nullptr ? AxisAngle::quadratic : AxisAngle::expanded;
}

EssenburgMaterial PlainMember::essenburg_material() const {
  return {.E = material_.E,
          .nu = material_.nu.value(),
          .shear_correction = section_.shear_correction.value_or(1.0),
          .heights = heights_of(section_),
          .quadratic = member_.along};
}

Vec2 PlainMember::place(double fraction) const {
  if (fraction == 0.0) return from_;
  if (fraction == 1.0) return to_;
  return shape_->at(fraction * length()).position;
}

Stretch PlainMember::stretch(std::size_t element) const {
  const double first = fraction(element, 0.0), last = fraction(element, 1.0);
  const DividedPart part = shape_->divided(first * length(), last * length());
  Stretch out{.length = part.length, .chord = place(last) - place(first)};
  if (shape_->is_straight() && shape_->deviations().empty()) out.chord = (to_ - from_) / double(member_.elements);
  for (std::size_t k = 0; k < out.angles.size(); ++k) out.angles[k] = part.at[k].angle;
  return out;
}

NodesAlong PlainMember::nodes(std::size_t element) const {
  NodesAlong out;
  const double first = fraction(element, 0.0);
  for (int i = 0; i <= order(); ++i) {
    const double here = fraction(element, double(i) / order());
    out.places.push_back(place(here) - place(first));
    out.arcs.push_back(shape_->length(first * length(), here * length()));
  }
  return out;
}

std::vector<PlainDirector> PlainMember::directors(std::size_t element) const {
  std::vector<PlainDirector> out;
  for (int i = 0; i <= order(); ++i) {
    const double here = fraction(element, double(i) / order());
    out.push_back({.director = axis_normal(angle(here)), .normal = axis_normal(axis_->at(here * length()).angle)});
  }
  return out;
}

PlainMembers::PlainMembers(const Model& model) {
  const deck::Deck& deck = model.deck();
  for (std::size_t m = 0; m < deck.members.size(); ++m) {
    members_.emplace_back(deck, deck.members[m], model.structure().members()[m].taper.get());
    const PlainMember& member = members_.back();
    std::vector<Stretch>& stretches = stretches_.emplace_back();
    std::vector<NodesAlong>& nodes = nodes_.emplace_back();
    std::vector<std::vector<PlainDirector>>& directors = directors_.emplace_back();
    if (model.sliding() != nullptr) continue;
    const Theory theory = member.in_deck().theory;
    for (std::size_t k = 0; k < static_cast<std::size_t>(member.in_deck().elements); ++k) {
      if (theory == Theory::reissner || theory == Theory::essenburg)
        nodes.push_back(member.nodes(k));
      else
        stretches.push_back(member.stretch(k));
      if (theory == Theory::essenburg) directors.push_back(member.directors(k));
    }
  }
}

const PlainMember& PlainMembers::named(const std::string& name) const {
  return *std::find_if(members_.begin(), members_.end(), [&](const PlainMember& one) { return one.name() == name; });
}

}  // namespace arcwall::verify
