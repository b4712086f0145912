// How members that continue each other become one strand.
#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

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

// The same under uniform loads, travelled the other way: what counts along it and across it has the other sign.
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
    const double from = part.from;
    part.from = L - part.to;
    part.to = L - from;
    std::swap(part.first_fraction, part.last_fraction);
  }
  std::reverse(out.joints.begin(), out.joints.end());
  for (InnerJoint& joint : out.joints) joint.s = L - joint.s;
  std::reverse(out.point_loads.begin(), out.point_loads.end());
  std::reverse(out.load_places.begin(), out.load_places.end());
  for (double& place : out.load_places) place = L - place;
  for (DrivenLineLoad& load : out.loads)
    if (load.load.frame == LoadFrame::member) load.load.first = -load.load.first;
  turn_over(out.pressure);
  turn_over(out.thermal.curvature);
  return out;
}

// Whether a strand may run from the end of one run into the beginning of another: both are perfect, of one section that
// does not taper and uniformly loaded alike, and lie on one line or on one circle.
bool SlidingStructure::passes(const Run& a, const Run& b, const std::vector<bool>& with_terms,
                              const CarriesForceAlone& carries_force_alone) const {
  const End &end = a.ends[1], &next = b.ends[0];
  const Index node = node_of(end);
  if (with_terms[static_cast<std::size_t>(node)] && !carries_force_alone(node, end.dof[2])) return false;
  const auto is_uniform = [](const DrivenLineLoad& load) { return load.load.is_uniform(); };
  const bool is_alike = a.theory == b.theory && a.order == b.order && a.section.E == b.section.E && !a.section.taper &&
                        !b.section.taper && a.section.A == b.section.A && a.section.I == b.section.I &&
                        a.section.height == b.section.height && a.loads == b.loads &&
                        std::all_of(a.loads.begin(), a.loads.end(), is_uniform) && a.foundation == b.foundation &&
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

// Joins runs where two of them meet. Each joint is asked once which runs end there, so that a chain takes time in
// proportion to its members.
class SlidingStructure::RunJoiner {
 public:
  RunJoiner(SlidingStructure& structure, const std::vector<bool>& with_terms,
            const CarriesForceAlone& carries_force_alone, const Alike& alike)
      : structure_(structure),
        with_terms_(with_terms),
        carries_force_alone_(carries_force_alone),
        alike_(alike),
        is_gone_(structure.runs_.size(), false) {
    for (std::size_t r = 0; r < runs().size(); ++r)
      for (const bool last : {false, true}) at_joint_[joint_of(runs()[r], last)].push_back({.run = r, .last = last});
  }

  // Those that continue each other come first, then those that meet head to head. A strand travels as that of its
  // members does which comes first.
  void join_all() {
    for (std::size_t r = 0; r < runs().size(); ++r)
      if (!is_gone_[r]) join_onward(r);
    for (std::size_t r = 0; r < runs().size(); ++r)
      if (!is_gone_[r]) join_all_at(r);
    std::vector<Run> left;
    for (std::size_t r = 0; r < runs().size(); ++r)
      if (!is_gone_[r]) left.push_back(std::move(runs()[r]));
    runs() = std::move(left);
  }

 private:
  struct RunEnd {
    std::size_t run;
    bool last;
    bool operator==(const RunEnd&) const = default;
  };

  std::vector<Run>& runs() const { return structure_.runs_; }
  static const End& end_of(const Run& run, bool last) { return run.ends[last ? 1 : 0]; }
  static Index joint_of(const Run& run, bool last) { return end_of(run, last).dof[1]; }

  // The end of another run that alone is at the joint where an end is.
  std::optional<RunEnd> met_by(const RunEnd& end) const {
    const auto found = at_joint_.find(joint_of(runs()[end.run], end.last));
    if (found == at_joint_.end() || found->second.size() != 2) return std::nullopt;
    const RunEnd& other = found->second[found->second[0] == end ? 1 : 0];
    return other.run == end.run ? std::nullopt : std::optional(other);
  }

  void join_onward(std::size_t run) {
    for (;;) {
      const auto next = met_by({.run = run, .last = true});
      if (!next || next->last || !join({.run = run, .last = true}, *next)) return;
    }
  }

  // Until nothing is joined at either end of the strand that this run becomes part of.
  void join_all_at(std::size_t run) {
    for (bool joined = true; joined;) {
      joined = false;
      for (const bool last : {true, false}) {
        const RunEnd here{.run = run, .last = last};
        const auto other = met_by(here);
        if (!other) continue;
        const bool head_on = other->last == last, keeps = head_on ? run < other->run : last;
        if (!(keeps ? join(here, *other) : join(*other, here))) continue;
        run = keeps ? run : other->run;
        joined = true;
      }
    }
  }

  // The run of the one end takes that of the other over and keeps its own direction, if a strand may pass there.
  bool join(const RunEnd& kept, const RunEnd& taken) {
    Run& first = runs()[kept.run];
    if (!may_meet(first, kept.last, runs()[taken.run], taken.last)) return false;
    Run second = kept.last == taken.last ? reversed(runs()[taken.run]) : runs()[taken.run];
    Run &from = kept.last ? first : second, &to = kept.last ? second : first;
    if (!structure_.passes(from, to, with_terms_, carries_force_alone_)) return false;
    const auto node = static_cast<std::size_t>(structure_.node_of(end_of(from, true)));
    at_joint_.erase(joint_of(from, true));
    for (RunEnd& far : at_joint_[joint_of(second, kept.last)])
      if (far == RunEnd{.run = taken.run, .last = !taken.last}) far = kept;
    Run whole = structure_.joined(std::move(from), to, with_terms_[node]);
    first = std::move(whole);
    is_gone_[taken.run] = true;
    return true;
  }

  // Whether nothing but what acts at the joint could keep a strand from passing.
  bool may_meet(const Run& a, bool a_last, const Run& b, bool b_last) const {
    const auto has_curve = [](const Run& run) { return run.perfect && curvature_of(*run.axis).has_value(); };
    const auto member = [](const Run& run, bool last) { return (last ? run.parts.back() : run.parts.front()).member; };
    if (end_of(a, a_last).dof != end_of(b, b_last).dof || !has_curve(a) || !has_curve(b)) return false;
    return !alike_ || alike_(member(a, a_last), member(b, b_last));
  }

  SlidingStructure& structure_;
  const std::vector<bool>& with_terms_;
  const CarriesForceAlone& carries_force_alone_;
  const Alike& alike_;
  std::vector<bool> is_gone_;
  std::unordered_map<Index, std::vector<RunEnd>> at_joint_{};  // by the joint's z
};

void SlidingStructure::join_runs(const std::vector<bool>& with_terms, const CarriesForceAlone& carries_force_alone,
                                 const Alike& alike) {
  RunJoiner(*this, with_terms, carries_force_alone, alike).join_all();
  for (Index strand = 0; strand < strands(); ++strand)
    for (const bool last : {false, true})
      ends_at_joint_[at(strand).ends[last ? 1 : 0].dof[1]].push_back({.strand = strand, .last = last});
}

}  // namespace arcwall
