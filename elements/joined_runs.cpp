// How members that continue each other become one strand.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "elements/sliding_structure.hpp"

namespace arcwall {

namespace {

constexpr double in_line = 1e-12;     // angle between straight members [rad]
constexpr double on_a_circle = 1e-8;  // the same of arcs, and how much their curvatures differ

// The curvature of an axis that has the same all along: 0 of a straight one.
std::optional<double> curvature_of(const Axis& axis) {
  const double L = axis.length();
  if (std::abs((axis.at(L).position - axis.at(0.0).position).norm() - L) <= in_line * L) return 0.0;
  return axis.constant_curvature();
}

// The curve through three places, the first and the last of which may be the same: a line, a circle or an arc.
std::shared_ptr<const Axis> curve_through(const Vec2& first, const Vec2& inner, const Vec2& other_inner,
                                          const Vec2& last, double curvature) {
  if (curvature == 0.0) return straight_axis(first, last);
  const bool is_closed = (last - first).norm() * std::abs(curvature) <= on_a_circle;
  return is_closed ? circle_axis(first, inner, other_inner) : arc_axis(first, inner, last);
}

void turn_over(Driven& driven) { driven = {.constant = -driven.constant, .proportional = -driven.proportional}; }

}  // namespace

// The same, travelled the other way: what counts along it and across it has the other sign.
SlidingStructure::Run SlidingStructure::reversed(const Run& run) {
  const auto at = [&](double s) { return run.axis->at(run.offset + s).position; };
  const double L = run.length;
  Run out = run;
  out.axis = curve_through(at(L), at(0.5 * L), at(0.25 * L), at(0.0), curvature_of(*run.axis).value());
  out.shape = std::make_shared<ImperfectAxis>(*out.axis, std::vector<SineDeviation>{});
  out.offset = 0.0;
  std::swap(out.ends[0], out.ends[1]);
  out.ends[0].angle = out.axis->at(0.0).angle;
  out.ends[1].angle = out.axis->at(out.axis->length()).angle;
  std::reverse(out.parts.begin(), out.parts.end());
  for (Part& part : out.parts) {
    part.from = std::exchange(part.to, L - part.from);
    part.from = L - part.from;
    std::swap(part.first_fraction, part.last_fraction);
  }
  std::reverse(out.joints.begin(), out.joints.end());
  for (InnerJoint& joint : out.joints) joint.s = L - joint.s;
  std::reverse(out.point_loads.begin(), out.point_loads.end());
  std::reverse(out.load_places.begin(), out.load_places.end());
  for (double& place : out.load_places) place = L - place;
  out.axis_load = -run.axis_load;
  out.constant_axis_load = -run.constant_axis_load;
  turn_over(out.pressure);
  turn_over(out.thermal.curvature);
  return out;
}

// Whether a strand may run from the end of one run into the beginning of another: both are perfect, of one section and
// loaded alike, and lie on one line or on one circle.
bool SlidingStructure::passes(const Run& a, const Run& b, const std::vector<bool>& with_terms,
                              const CarriesForceAlone& carries_force_alone) const {
  const End &end = a.ends[1], &next = b.ends[0];
  const Index node = node_of(end);
  if (with_terms[static_cast<std::size_t>(node)] && !carries_force_alone(node, end.freedom[2])) return false;
  const bool is_alike = a.theory == b.theory && a.order == b.order && a.section.E == b.section.E &&
                        a.section.A == b.section.A && a.section.I == b.section.I &&
                        a.section.height == b.section.height && a.load == b.load &&
                        a.constant_load == b.constant_load && a.axis_load == b.axis_load &&
                        a.constant_axis_load == b.constant_axis_load && a.foundation == b.foundation &&
                        a.pressure == b.pressure && a.thermal == b.thermal;
  if (!is_alike) return false;
  const std::optional<double> first = curvature_of(*a.axis), second = curvature_of(*b.axis);
  const double turn = std::abs(std::remainder(end.angle - next.angle, 2.0 * pi));
  if (*first == 0.0 || *second == 0.0) return *first == *second && turn <= in_line;
  const bool is_once_round = (a.length + b.length) * std::abs(*first) <= 2.0 * pi + on_a_circle;
  return std::abs(*first - *second) <= on_a_circle * std::abs(*first) && turn <= on_a_circle && is_once_round;
}

// The strand of one run and of another that begins where it ends; `carries_force`: there.
SlidingStructure::Run SlidingStructure::joined(Run a, const Run& b, bool carries_force) const {
  const auto at = [](const Run& run, double s) { return run.axis->at(run.offset + s).position; };
  a.joints.push_back({.node = node_of(a.ends[1]), .s = a.length});
  if (carries_force) {
    a.point_loads.push_back(point_load(node_of(a.ends[1])));
    a.load_places.push_back(a.length);
  }
  for (const auto& [node, s] : b.joints) a.joints.push_back({.node = node, .s = a.length + s});
  a.point_loads.insert(a.point_loads.end(), b.point_loads.begin(), b.point_loads.end());
  for (const double place : b.load_places) a.load_places.push_back(a.length + place);
  for (Part part : b.parts) {
    part.from += a.length;
    part.to += a.length;
    a.parts.push_back(part);
  }
  const auto axis =
      curve_through(at(a, 0.0), at(a, a.length), at(b, 0.5 * b.length), at(b, b.length), curvature_of(*a.axis).value());
  a.axis = axis;
  a.shape = std::make_shared<ImperfectAxis>(*a.axis, std::vector<SineDeviation>{});
  a.offset = 0.0;
  a.length = a.axis->length();
  a.ends[1] = b.ends[1];
  a.ends[0].angle = a.axis->at(0.0).angle;
  a.ends[1].angle = a.axis->at(a.length).angle;
  return a;
}

// A strand travels as that of its members does which comes first.
void SlidingStructure::join_runs(const std::vector<bool>& with_terms, const CarriesForceAlone& carries_force_alone,
                                 const Alike& alike) {
  const auto has_curve = [](const Run& run) { return run.perfect && curvature_of(*run.axis).has_value(); };
  const auto meet = [&](const Run& a, bool a_last, const Run& b, bool b_last) {
    const End &end = a.ends[a_last ? 1 : 0], &other = b.ends[b_last ? 1 : 0];
    if (end.freedom != other.freedom || !has_curve(a) || !has_curve(b) || ends_at(end.freedom[1]).size() != 2)
      return false;
    const auto member = [](const Run& run, bool last) { return (last ? run.parts.back() : run.parts.front()).member; };
    return !alike || alike(member(a, a_last), member(b, b_last));
  };
  const auto try_to_join = [&](std::size_t a, std::size_t b, bool a_last, bool b_last) {
    if (!meet(runs_[a], a_last, runs_[b], b_last)) return false;
    const Run first = runs_[a], second = a_last == b_last ? reversed(runs_[b]) : runs_[b];
    const Run &from = a_last ? first : second, &to = a_last ? second : first;
    if (!passes(from, to, with_terms, carries_force_alone)) return false;
    const Index joint = node_of(from.ends[1]);
    runs_[a] = joined(from, to, with_terms[static_cast<std::size_t>(joint)]);
    runs_.erase(runs_.begin() + static_cast<std::ptrdiff_t>(b));
    return true;
  };
  const auto join_one = [&](const auto& joins) {
    for (std::size_t a = 0; a < runs_.size(); ++a)
      for (std::size_t b = 0; b < runs_.size(); ++b)
        if (a != b && joins(a, b)) return true;
    return false;
  };
  const auto onward = [&](std::size_t a, std::size_t b) { return try_to_join(a, b, true, false); };
  const auto head_on = [&](std::size_t a, std::size_t b) {
    return a < b && (try_to_join(a, b, true, true) || try_to_join(a, b, false, false));
  };
  while (join_one(onward) || join_one(head_on)) {
  }
}

}  // namespace arcwall
