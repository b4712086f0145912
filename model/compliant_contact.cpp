#include "model/compliant_contact.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact/passing.hpp"
#include "elements/wall_pressure.hpp"

namespace arcwall {

namespace {

// Guard of a member that faces no wall: as far as the structure is large.
constexpr double out_of_reach = 1.0;

// Gaps that are none [scale of gaps].
constexpr double touching = 1e-11;

WallGap::Response response_of(const QuadraticField& f, double sign) {
  WallGap::Response out{.value = sign * f.value,
                        .rate = sign * f.rate,
                        .slope = sign * Vec2(f.x, f.z),
                        .slope_rate = sign * Vec2(f.x_rate, f.z_rate)};
  out.second << sign * f.xx, sign * f.xz, sign * f.xz, sign * f.zz;
  return out;
}

class GapToObstacle final : public WallGap {
 public:
  explicit GapToObstacle(std::shared_ptr<const Obstacle> obstacle) : obstacle_(std::move(obstacle)) {}

  Slope slope(const Vec2& place, double lambda) const override {
    const LinearField g = obstacle_->gap_slope(place, lambda);
    return {.value = g.value, .slope = {g.x, g.z}};
  }
  Response at(const Vec2& place, double lambda) const override {
    return response_of(obstacle_->gap(place, lambda), 1.0);
  }
  Response along(const Vec2& place, double lambda) const override {
    return response_of(obstacle_->arc_length(place, lambda), sign_of(obstacle_->side()));
  }

 private:
  std::shared_ptr<const Obstacle> obstacle_;
};

// How far a state has gone from another towards a third.
class WayFrom final : public Observable {
 public:
  WayFrom(const State& from, const State& to) : from_(from), along_(to.x - from.x), rate_(to.lambda - from.lambda) {}
  double value(const State& state) const override {
    return along_.dot(state.x - from_.x) + rate_ * (state.lambda - from_.lambda);
  }
  Row gradient(const State&) const override { return {.dx = along_, .dlambda = rate_}; }

 private:
  State from_;
  Vector along_;
  double rate_;
};

}  // namespace

std::shared_ptr<const WallGap> gap_to(std::shared_ptr<const Obstacle> obstacle) {
  return std::make_shared<GapToObstacle>(std::move(obstacle));
}

CompliantContact::CompliantContact(const Structure& structure, std::vector<Wall> walls, double length)
    : structure_(structure), walls_(std::move(walls)), pressed_(walls_.size()), length_(length) {
  std::vector<Index> first_element;
  Index elements = 0;
  for (const MemberMesh& mesh : structure.members()) {
    first_element.push_back(elements);
    elements += static_cast<Index>(mesh.nodes.size()) - 1;
  }
  for (const Structure::ElementLoad& load : structure.element_loads()) {
    if (!load.wall) continue;
    const auto member = static_cast<std::size_t>(walls_[*load.wall].member);
    const auto k = static_cast<std::size_t>(load.element - first_element[member]);
    const MemberMesh& mesh = structure.members()[member];
    pressed_[*load.wall].push_back({.pressure = static_cast<const WallPressure*>(load.potential.get()),
                                    .element = load.element,
                                    .from = mesh.fraction(k),
                                    .to = mesh.fraction(k + 1)});
  }
  add_friction();
}

void CompliantContact::add_friction() {
  std::vector<CompliantFriction::Pressed> rough;
  for (std::size_t j = 0; j < walls_.size(); ++j) {
    if (!(walls_[j].friction > 0.0)) continue;
    for (const Pressed& pressed : pressed_[j])
      rough.push_back({.pressure = pressed.pressure,
                       .element = pressed.element,
                       .contact = j,
                       .from = pressed.from,
                       .to = pressed.to,
                       .coefficient = walls_[j].friction,
                       .stiffness = walls_[j].tangential_stiffness,
                       .round = walls_[j].obstacle->round_length()});
  }
  if (!rough.empty()) friction_ = std::make_unique<CompliantFriction>(structure_, std::move(rough), walls_.size());
}

CompliantContact::Local CompliantContact::local(const State& state, const Pressed& pressed) const {
  Local at;
  const ShiftedIndices dofs = structure_.element_dofs(pressed.element);
  for (std::size_t i = 0; i < dofs.size(); ++i) at.u[i] = structure_.value(state, dofs[i]);
  return at;
}

CompliantContact::Least CompliantContact::least(const State& state, std::size_t j) const {
  Least least;
  for (const Pressed& pressed : pressed_[j]) {
    const auto gap = pressed.pressure->least_gap(local(state, pressed).u, state.lambda);
    if (gap.value < least.gap) least = {.at = &pressed, .gap = gap.value, .fraction = gap.fraction};
  }
  return least;
}

ActiveSet CompliantContact::touched_at(const State& state) const {
  ActiveSet active_set = open_active_set();
  for (std::size_t j = 0; j < walls_.size(); ++j)
    if (least_gap(state, j) <= touching * length_) active_set[j] = 1;
  return active_set;
}

double CompliantContact::guard_of(const State& state, std::size_t j, double gap) const {
  const double sign = state.active_set[j] != 0 ? -1.0 : 1.0;
  return std::isfinite(gap) ? sign * gap / length_ : sign * out_of_reach;
}

// A wall counts as a structure that goes with it would.
StateMetric CompliantContact::metric(const ActiveSet&) const {
  double speed = 0.0;
  for (const Wall& wall : walls_) speed = std::max(speed, wall.obstacle->greatest_speed(length_) / length_);
  StateMetric metric = structure_.metric({});
  metric.squared_motion_by_lambda += speed * speed;
  return metric;
}

Vector CompliantContact::guards(const State& state) const {
  Vector guards(contact_count());
  for (Index j = 0; j < contact_count(); ++j) guards[j] = guard(state, j);
  return guards;
}

double CompliantContact::guard(const State& state, Index j) const {
  const auto wall = static_cast<std::size_t>(j);
  return guard_of(state, wall, least(state, wall).gap);
}

double CompliantContact::least_gap(const State& state, std::size_t j) const { return least(state, j).gap; }

Row CompliantContact::least_gap_gradient(const State& state, std::size_t j) const {
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  const Least nearest = least(state, j);
  if (nearest.at == nullptr) return row;
  const auto gradient = nearest.at->pressure->gap_gradient(local(state, *nearest.at).u, state.lambda, nearest.fraction);
  add(*nearest.at, gradient.by_unknowns.data(), 1.0, row);
  row.dlambda += gradient.rate;
  return row;
}

Row CompliantContact::guard_gradient(const State& state, Index j) const {
  const auto wall = static_cast<std::size_t>(j);
  Row row = least_gap_gradient(state, wall);
  const double factor = guard_of(state, wall, 1.0);
  row.dx *= factor;
  row.dlambda *= factor;
  return row;
}

void CompliantContact::add(const Pressed& pressed, const double* by_unknowns, double factor, Row& row) const {
  const ShiftedIndices dofs = structure_.element_dofs(pressed.element);
  for (std::size_t i = 0; i < dofs.size(); ++i)
    if (const auto unknown = structure_.unknown(dofs[i])) {
      row.dx[*unknown] += factor * by_unknowns[i];
    } else {
      row.dlambda += factor * by_unknowns[i] * structure_.held_rate(dofs[i]);
    }
}

const std::string& CompliantContact::member_of(Index j) const {
  return structure_.members()[static_cast<std::size_t>(wall(j).member)].name;
}

CompliantContact::Nearest CompliantContact::nearest(const State& state, Index j) const {
  const Least found = least(state, static_cast<std::size_t>(j));
  if (found.at == nullptr) return {};
  const ContactPoint at = at_fraction(state, static_cast<std::size_t>(j), *found.at, found.fraction);
  return {.gap = found.gap, .fraction = at.label.fraction, .place = at.place};
}

std::string CompliantContact::watched_place(const State& state, Index j) const {
  return words_of(contact(state, j).label);
}

ContactPoint CompliantContact::at_fraction(const State& state, std::size_t j, const Pressed& pressed,
                                           double fraction) const {
  const Local at = local(state, pressed);
  const Obstacle& obstacle = *walls_[j].obstacle;
  ContactPoint point{.label = {.wall = walls_[j].name,
                               .member = member_name(j),
                               .fraction = std::lerp(pressed.from, pressed.to, fraction)},
                     .place = pressed.pressure->place(at.u, fraction)};
  if (!obstacle.faces(point.place, state.lambda)) return point;
  const double off =
      obstacle.gap(point.place, state.lambda).value - pressed.pressure->gap(at.u, state.lambda, fraction);
  point.place -= off * obstacle.normal(point.place, state.lambda);
  return point;
}

ContactPoint CompliantContact::contact(const State& state, Index j) const {
  const auto wall = static_cast<std::size_t>(j);
  const Least found = least(state, wall);
  if (found.at == nullptr) return {.label = {.wall = walls_[wall].name, .member = member_of(j)}};
  ContactPoint point = at_fraction(state, wall, *found.at, found.fraction);
  point.force = force(state, j);
  const auto action = wall_action(state, {.wall = walls_[wall].name, .member = member_of(j)}, Vec2::Zero());
  point.force_vector = {action.value[0], action.value[1]};
  return point;
}

double CompliantContact::force(const State& state, Index j) const {
  double sum = 0.0;
  if (!acts(state, static_cast<std::size_t>(j))) return sum;
  for (const Pressed& pressed : pressed_[static_cast<std::size_t>(j)]) {
    const Local at = local(state, pressed);
    for (const PressedPart& part : pressed.pressure->pressed(at.u, state.lambda))
      sum += pressed.pressure->force_of(at.u, state.lambda, part).force;
  }
  return sum;
}

namespace {

// What friction does on a pressed part of an element: the sum of its material points. A point between two parts has as
// much of its friction on each as of the force across the wall. Where points differ in what they do the part sticks.
std::optional<FrictionOfContact> friction_on(const PressedPart& part, const std::vector<PressedPart>& parts,
                                             const CompliantFriction& friction, const State& state,
                                             const std::vector<CompliantFriction::Point>& points,
                                             const WallPressure& pressure, const double* u, double coefficient) {
  FrictionOfContact sum{.coefficient = coefficient};
  std::optional<int> sense;
  double most = 0.0;
  bool alike = true;
  for (const CompliantFriction::Point& point : points) {
    const PressedPart whole = WallPressure::nearest_to(point.number);
    const PressedPart here{.from = std::max(part.from, whole.from), .to = std::min(part.to, whole.to)};
    if (point.pressed->pressure != &pressure || !(here.to > here.from)) continue;
    const double share =
        parts.size() == 1 ? 1.0 : coefficient * pressure.force_of(u, state.lambda, here).force / point.most;
    alike = alike && sense.value_or(point.sense) == point.sense;
    sense = point.sense;
    sum.force += share * point.force;
    sum.slip += share * point.most * point.slip;
    most += share * point.most;
    sum.tangent = friction.tangent(state, point);
  }
  if (!sense) return std::nullopt;
  if (most > 0.0) sum.slip /= most;
  const bool slips = alike && *sense != 0;
  sum.mode = !slips ? ContactMode::sticks : *sense > 0 ? ContactMode::slips_forward : ContactMode::slips_backward;
  return sum;
}

}  // namespace

std::vector<ContactPoint> CompliantContact::closed_contacts(const State& state) const {
  std::vector<ContactPoint> contacts;
  const auto points = friction_ ? friction_->points(state) : std::vector<CompliantFriction::Point>();
  for (std::size_t j = 0; j < walls_.size(); ++j) {
    if (!acts(state, j)) continue;
    double reached = -1.0;  // the end of the last part, as a fraction of the member
    const auto add_edge = [&](const Pressed& pressed, double fraction) {
      contacts.push_back(at_fraction(state, j, pressed, fraction));
    };
    const Pressed* last = nullptr;
    double last_fraction = 0.0;
    for (const Pressed& pressed : pressed_[j]) {
      const Local at = local(state, pressed);
      const std::vector<PressedPart> parts = pressed.pressure->pressed(at.u, state.lambda);
      for (const PressedPart& part : parts) {
        const auto borne = pressed.pressure->force_of(at.u, state.lambda, part);
        if (borne.force <= 0.0) continue;
        const double begin = std::lerp(pressed.from, pressed.to, part.from);
        if (begin != reached) {
          if (last != nullptr) add_edge(*last, last_fraction);
          add_edge(pressed, part.from);
        }
        ContactPoint middle = at_fraction(state, j, pressed, borne.centre);
        middle.force = borne.force;
        middle.force_vector = borne.vector;
        middle.label.tributary = borne.length;
        if (walls_[j].friction > 0.0)
          middle.friction =
              friction_on(part, parts, *friction_, state, points, *pressed.pressure, at.u, walls_[j].friction);
        if (middle.friction) middle.force_vector += middle.friction->force * middle.friction->tangent;
        contacts.push_back(std::move(middle));
        reached = std::lerp(pressed.from, pressed.to, part.to);
        last = &pressed;
        last_fraction = part.to;
      }
    }
    if (last != nullptr) add_edge(*last, last_fraction);
  }
  return contacts;
}

WallAction CompliantContact::wall_action(const State& state, const ContactsOfWall& of, const Vec2& about) const {
  WallAction action(state.x.size());
  for (std::size_t j = 0; j < walls_.size(); ++j) {
    if (!acts(state, j) || !of.includes_wall(walls_[j].name) || (!of.member.empty() && of.member != member_name(j)))
      continue;
    for (const Pressed& pressed : pressed_[j]) {
      const auto resultant = pressed.pressure->resultant(local(state, pressed).u, state.lambda, about);
      for (std::size_t i = 0; i < action.value.size(); ++i) {
        action.value[i] += resultant.value[i];
        add(pressed, resultant.by_unknowns[i].data(), 1.0, action.gradient[i]);
        action.gradient[i].dlambda += resultant.rate[i];
      }
    }
  }
  if (friction_)
    for (const CompliantFriction::Point& point : friction_->points(state)) {
      const std::size_t j = point.pressed->contact;
      if (of.includes_wall(walls_[j].name) && (of.member.empty() || of.member == member_name(j)))
        friction_->add_action(state, point, about, action);
    }
  return action;
}

std::vector<CompliantContact::Place> CompliantContact::places(const State& state, Index j, int parts) const {
  std::vector<Place> places;
  for (const Pressed& pressed : pressed_[static_cast<std::size_t>(j)]) {
    const Local at = local(state, pressed);
    for (int i = 0; i < parts; ++i) {
      const double t = (i + 0.5) / parts;
      places.push_back({.fraction = std::lerp(pressed.from, pressed.to, t),
                        .at = pressed.pressure->place(at.u, t),
                        .length = pressed.pressure->length_rate(t) / parts});
    }
  }
  return places;
}

// A pressed part that reaches the end of the wall's surface: there forces jump, which no tangent knows.
StepVerdict CompliantContact::check(const CheckedStep& step) const {
  for (std::size_t j = 0; j < walls_.size(); ++j) {
    if (!walls_[j].obstacle->core()) continue;
    for (const Pressed& pressed : pressed_[j]) {
      const Local from = local(step.from, pressed), to = local(step.to, pressed);
      const auto in_step = [&](double t) {
        return PlaceInStep{.from = pressed.pressure->place(from.u, t), .to = pressed.pressure->place(to.u, t)};
      };
      if (line_passes_core(*walls_[j].obstacle, in_step(0.0), in_step(1.0), step.from.lambda, step.to.lambda,
                           1e-6 * length_))
        return {.fault = StepVerdict::Fault::wall_crossed,
                .place = words_of({.wall = walls_[j].name, .member = member_name(j), .fraction = pressed.from})};
    }
  }
  for (std::size_t j = 0; j < walls_.size(); ++j)
    for (const Pressed& pressed : pressed_[j])
      if (acts(step.to, j) && pressed.pressure->leaves_surface(local(step.to, pressed).u, step.to.lambda))
        return {.fault = StepVerdict::Fault::wall_left,
                .place = words_of({.wall = walls_[j].name, .member = member_name(j), .fraction = pressed.from})};
  return {};
}

// Whether an element lies on the wall from end to end, without pressure.
bool CompliantContact::lies_along(const State& state, std::size_t j) const {
  return std::any_of(pressed_[j].begin(), pressed_[j].end(), [&](const Pressed& pressed) {
    const Local at = local(state, pressed);
    const auto touches = [&](double t) {
      return std::abs(pressed.pressure->gap(at.u, state.lambda, t)) <= touching * length_;
    };
    return touches(0.0) && touches(0.5) && touches(1.0);
  });
}

// How far a wall is penetrated beyond a depth, or its negative.
class CompliantContact::Penetrated final : public Observable {
 public:
  Penetrated(const CompliantContact& of, std::size_t j, double sign, double depth)
      : of_(of), j_(j), sign_(sign), depth_(depth) {}
  double value(const State& state) const override { return sign_ * (-of_.least_gap(state, j_) - depth_); }
  Row gradient(const State& state) const override {
    Row row = of_.least_gap_gradient(state, j_);
    row.dx *= -sign_;
    row.dlambda *= -sign_;
    return row;
  }

 private:
  const CompliantContact& of_;
  std::size_t j_;
  double sign_, depth_;
};

// What lies on a wall without pressure has its stiffness on the one side alone. A wall that is just touched is stepped
// into up to a depth, and one that a step leaves is left.
std::optional<PathKink> CompliantContact::kink_between(const State& from, const State& to) const {
  constexpr double depth = 1e-10;  // scale of gaps
  for (std::size_t j = 0; j < walls_.size(); ++j) {
    if (lies_along(from, j)) return PathKink{.past = std::make_shared<WayFrom>(from, to)};
    if (!acts(from, j)) continue;
    const Least deepest = least(from, j);
    if (deepest.at == nullptr) continue;
    const double before = -deepest.gap;
    const double after = -deepest.at->pressure->gap(local(to, *deepest.at).u, to.lambda, deepest.fraction);
    if (before < depth * length_ && after > before)
      return PathKink{.past = std::make_shared<Penetrated>(*this, j, 1.0, depth * length_)};
    if (before > 0.0 && after < 0.0) return PathKink{.past = std::make_shared<Penetrated>(*this, j, -1.0, 0.0)};
  }
  return friction_ ? friction_->kink_between(from, to) : std::nullopt;
}

}  // namespace arcwall
