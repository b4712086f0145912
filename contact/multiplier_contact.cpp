#include "contact/multiplier_contact.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "contact/passing.hpp"
#include "contact/wall_kink.hpp"
#include "core/algebra/assembly.hpp"

namespace arcwall {

namespace {

// Guard of a point that faces no wall, or that two walls hold: as far as the structure is large.
constexpr double out_of_reach = 1.0;

// How far a candidate's point is past a kink of its wall [length].
class PastKink final : public Observable {
 public:
  PastKink(const Candidate& candidate, const WallKink& kink) : candidate_(candidate), kink_(kink) {}
  double value(const State& state) const override {
    return past_kink(candidate_.obstacle(), kink_, candidate_.point().position(state), state.lambda).value;
  }
  Row gradient(const State& state) const override {
    PointKinematics at;
    candidate_.point().kinematics(state, at);
    const LinearField past = past_kink(candidate_.obstacle(), kink_, at.position, state.lambda);
    Row row{.dx = Vector::Zero(state.x.size()), .dlambda = past.rate + past.x * at.rate.x() + past.z * at.rate.y()};
    const std::vector<Index>& unknowns = candidate_.point().unknowns();
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
      const auto local = static_cast<Index>(i);
      row.dx[unknowns[i]] += past.x * at.jacobian(0, local) + past.z * at.jacobian(1, local);
    }
    return row;
  }

 private:
  const Candidate& candidate_;
  WallKink kink_;
};

using Neighbours = std::vector<std::pair<const Candidate*, const Candidate*>>;

// Points of a wall that follow each other along a member, face by face.
Neighbours neighbours_along_members(const std::vector<Candidate>& candidates, const std::vector<Candidate>& held) {
  std::map<std::tuple<std::string, std::string, double>, std::vector<const Candidate*>> sections;
  for (const auto* const all : {&candidates, &held})
    for (const Candidate& candidate : *all)
      if (candidate.obstacle().core())
        sections[{candidate.label().wall, candidate.label().member, candidate.label().fraction}].push_back(&candidate);
  Neighbours neighbours;
  const std::vector<const Candidate*>* before = nullptr;
  for (const auto& [section, points] : sections) {
    if (before != nullptr && before->front()->label().wall == std::get<0>(section) &&
        before->front()->label().member == std::get<1>(section))
      for (std::size_t face = 0; face < std::min(before->size(), points.size()); ++face)
        neighbours.emplace_back((*before)[face], points[face]);
    before = &points;
  }
  return neighbours;
}

}  // namespace

MultiplierContact::MultiplierContact(const Equations& inner, std::vector<Candidate> candidates,
                                     const ContactScales& scales, const ContactLaw& law)
    : inner_(inner), scales_(scales) {
  for (Candidate& candidate : candidates)
    (candidate.point().unknowns().empty() ? held_ : candidates_).push_back(std::move(candidate));
  for (const Candidate& candidate : candidates_) {
    const double k = law.stiffness * candidate.label().tributary;
    Springs springs;
    if (law.method == ContactLaw::Method::penalty) springs.c = 1.0 / k;
    if (law.method == ContactLaw::Method::augmented) springs.r = k;
    springs_.push_back(springs);
    speed_of_walls_ = std::max(speed_of_walls_, candidate.obstacle().greatest_speed(scales_.length) / scales_.length);
  }
  neighbours_ = neighbours_along_members(candidates_, held_);
  const auto rough = [](const Candidate& candidate) { return candidate.friction() > 0.0; };
  if (std::any_of(candidates_.begin(), candidates_.end(), rough))
    rest_friction_ = std::make_shared<const FrictionLayout>(std::vector<FrictionLayout::Contact>(candidates_.size()));
}

// What a grip leaves of the candidates has their order. A wall that can no longer be moved against bears nothing: the
// grip does.
State MultiplierContact::gripped(const MultiplierContact& free, const State& state, const Vector& inner) const {
  std::vector<std::size_t> number;  // of each candidate, there
  for (std::size_t before = 0; const Candidate& here : candidates_) {
    while (!(free.candidates_[before].label() == here.label())) ++before;
    number.push_back(before++);
  }
  std::vector<FrictionLayout::Contact> histories;
  for (std::size_t j = 0; j < number.size() && has_friction(); ++j)
    histories.push_back(free.anchors(state.active_set)[number[j]]);
  ActiveSet active_set(number.size(), 0,
                       has_friction() ? std::make_shared<const FrictionLayout>(std::move(histories)) : nullptr);
  const auto can_move = [&](const Candidate& candidate) {
    constexpr double least = 1e-9;  // of the motion
    Gap gap;
    candidate.gap({.x = inner, .lambda = 0.0}, gap);
    return gap.gradient.norm() > least;
  };
  for (std::size_t j = 0; j < number.size(); ++j)
    active_set[j] = static_cast<std::uint8_t>(state.active_set[number[j]] != 0 && can_move(candidates_[j]));
  State result{.x = {}, .lambda = state.lambda, .active_set = active_set.with_kinks_of(state.active_set)};
  result.x = Vector::Zero(size(result.active_set));
  result.x.head(inner.size()) = inner;
  for_each_force(result.active_set, [&](std::size_t j, Index k) {
    result.x[inner.size() + k] = state.x[*free.multiplier_index(state.active_set, static_cast<Index>(number[j]))];
  });
  const std::vector<Friction> rubbed = free.frictions(state.active_set);
  for (const Friction& friction : frictions(result.active_set))
    for (const Friction& before : rubbed) {
      if (before.contact != number[friction.contact]) continue;
      result.x[friction.T] = state.x[before.T];
      if (friction.w) result.x[*friction.w] = state.x[*before.w];
    }
  return result;
}

// Whether candidate j is closed and its force an unknown: of two that are opposite the first has that of both.
bool MultiplierContact::has_force(const ActiveSet& active_set, std::size_t j) const {
  const std::optional<Index> opposite = candidates_[j].opposite();
  return active_set[j] != 0 && !(opposite && *opposite < static_cast<Index>(j));
}

Index MultiplierContact::force_count(const ActiveSet& active_set) const {
  Index count = 0;
  for_each_force(active_set, [&](std::size_t, Index) { ++count; });
  return count;
}

Dimensions MultiplierContact::dimensions(const ActiveSet& active_set) const {
  const std::vector<Friction> rubbing = frictions(active_set);
  const Index slips =
      std::count_if(rubbing.begin(), rubbing.end(), [](const Friction& at) { return at.w.has_value(); });
  const auto frictional = static_cast<Index>(rubbing.size());
  const Index multipliers = force_count(active_set) + frictional;
  return {.unknowns = inner_.size({}) + multipliers + slips,
          .multipliers = multipliers,
          .bounds = 2 * (frictional - slips)};
}

ActiveSet MultiplierContact::open_active_set() const {
  ActiveSet active_set(candidates_.size(), 0, rest_friction_);
  for (std::size_t j = 0; j < candidates_.size(); ++j)
    if (candidates_[j].opposite()) active_set[j] = 1;
  return active_set;
}

// Its unknown is number `row` of x.
ConstraintForce MultiplierContact::contact_force(const State& state, std::size_t j, Index row, const Gap& gap) const {
  const auto [c, r] = springs_[j];
  return {.unknowns = candidates_[j].point().unknowns(),
          .row = row,
          .t = state.x[row] - r * gap.value,
          .stiffness = r,
          .compliance = c};
}

void MultiplierContact::residual(const State& state, Eigen::Ref<Vector> F) const {
  const State inner = inner_state(state);
  const Index n = inner.x.size();
  inner_.residual(inner, F.head(n));
  Gap gap;
  for_each_force(state.active_set, [&](std::size_t j, Index k) {
    candidates_[j].gap(state, gap);
    add_force(contact_force(state, j, n + k, gap), gap, F);
    F[n + k] = -gap.value - springs_[j].c * state.x[n + k];
  });
  add_friction(state, F);
}

void MultiplierContact::linearize(const State& state, Linearization& out) const {
  if (!out.inner) out.inner = std::make_unique<Linearization>();
  Linearization& inner = *out.inner;
  const State inner_at = inner_state(state);
  inner_.linearize(inner_at, inner);
  if (!out.pattern_of || *out.pattern_of != state.active_set) lay_out(state, out);

  const Index n = inner_at.x.size(), m = state.x.size() - n;
  out.F.resize(n + m);
  out.F_lambda.resize(n + m);
  out.F.head(n) = inner.F;
  out.F_lambda << inner.F_lambda, Vector::Zero(m);
  copy_values(inner.K, out.K);
  out.ground = inner.ground;
  Gap gap;
  for_each_force(state.active_set, [&](std::size_t j, Index k) {
    candidates_[j].gap(state, gap);
    add_force(contact_force(state, j, n + k, gap), gap, -gap.value - springs_[j].c * state.x[n + k], out);
  });
  if (has_friction()) add_friction(state, out);
}

void MultiplierContact::lay_out(const State& state, Linearization& out) const {
  std::vector<RowEntry> entries;
  for_each_force(state.active_set, [&](std::size_t j, Index k) {
    for (const Index unknown : candidates_[j].point().unknowns()) entries.push_back({.row = k, .column = unknown});
  });
  const Index n = inner_.size({});
  for (const Friction& friction : frictions(state.active_set))
    for (const Index unknown : candidates_[friction.contact].rubbing_point().unknowns())
      entries.push_back({.row = friction.T - n, .column = unknown});
  out.K = with_rows_behind(out.inner->K, entries, multiplier_count(state.active_set));
  out.translation_free = out.inner->translation_free;
  if (!out.translation_free.empty()) out.translation_free.resize(static_cast<std::size_t>(out.K.cols()), false);
  out.pattern_of = state.active_set;
}

double MultiplierContact::energy(const State& state) const {
  const State inner = inner_state(state);
  double springs = 0.0;
  for_each_force(state.active_set, [&](std::size_t j, Index k) {
    const double p = state.x[inner.x.size() + k];
    springs += 0.5 * springs_[j].c * p * p;
  });
  return inner_.energy(inner) + springs;
}

// An obstacle counts as a structure that goes with it would.
StateMetric MultiplierContact::metric(const ActiveSet& active_set) const {
  StateMetric metric = inner_.metric({});
  metric.squared_motion_by_lambda += speed_of_walls_ * speed_of_walls_;
  const Index n = metric.weights.size(), contacts = size(active_set) - n;
  metric.weights.conservativeResize(n + contacts);
  metric.weights.tail(contacts).setZero();
  return metric;
}

Vector MultiplierContact::guards(const State& state) const {
  Vector guards = Vector::Constant(contact_count() + dimensions(state.active_set).bounds, out_of_reach);
  const Index n = inner_.size({});
  for (Index j = 0; j < contact_count(); ++j)
    if (!state.active_set[static_cast<std::size_t>(j)] && !has_opposite(j)) guards[j] = open_guard(j, state);
  for_each_force(state.active_set, [&](std::size_t j, Index k) {
    if (const auto contact = static_cast<Index>(j); !has_opposite(contact))
      guards[contact] = state.x[n + k] / scales_.force;
  });
  Index bound = contact_count();
  for (const Friction& friction : frictions(state.active_set)) {
    if (friction.w) continue;
    const double most = candidates_[friction.contact].friction() * state.x[friction.p], T = state.x[friction.T];
    guards[bound++] = (most - T) / scales_.force;
    guards[bound++] = (most + T) / scales_.force;
  }
  return guards;
}

double MultiplierContact::guard(const State& state, Index j) const {
  if (j >= contact_count()) return guards(state)[j];
  if (has_opposite(j)) return out_of_reach;
  const auto k = multiplier_index(state.active_set, j);
  return k ? state.x[*k] / scales_.force : open_guard(j, state);
}

double MultiplierContact::open_guard(Index j, const State& state) const {
  const double gap = candidate(j).gap(state);
  return std::isfinite(gap) ? gap / scales_.length : out_of_reach;
}

Row MultiplierContact::guard_gradient(const State& state, Index j) const {
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  if (j >= contact_count()) {
    Index bound = contact_count();
    for (const Friction& friction : frictions(state.active_set)) {
      if (friction.w) continue;
      if (j == bound || j == bound + 1) {
        row.dx[friction.p] = candidates_[friction.contact].friction() / scales_.force;
        row.dx[friction.T] = (j == bound ? -1.0 : 1.0) / scales_.force;
      }
      bound += 2;
    }
    return row;
  }
  if (has_opposite(j)) return row;
  if (const auto k = multiplier_index(state.active_set, j)) {
    row.dx[*k] = 1.0 / scales_.force;
  } else if (candidate(j).faces_wall(state)) {
    Gap gap;
    candidate(j).gap(state, gap);
    const auto& unknowns = candidate(j).point().unknowns();
    for (std::size_t i = 0; i < unknowns.size(); ++i)
      row.dx[unknowns[i]] = gap.gradient[static_cast<Index>(i)] / scales_.length;
    row.dlambda = gap.rate / scales_.length;
  }
  return row;
}

GuardsAlong MultiplierContact::guards_along(const State& state, const Direction& direction) const {
  GuardsAlong along{.values = guards(state), .rates = Vector::Zero(guard_count(state.active_set))};
  Vector& rates = along.rates;
  const Index n = inner_.size({});
  for (Index j = contact_count(); j < rates.size(); ++j) rates[j] = apply(guard_gradient(state, j), direction);
  for (Index j = 0; j < contact_count(); ++j)
    if (!state.active_set[static_cast<std::size_t>(j)] && !has_opposite(j))
      rates[j] = candidate(j).gap_rate(state, direction) / scales_.length;
  for_each_force(state.active_set, [&](std::size_t j, Index k) {
    if (const auto contact = static_cast<Index>(j); !has_opposite(contact))
      rates[contact] = direction.dx[n + k] / scales_.force;
  });
  return along;
}

Vector MultiplierContact::unit_force(const State& state, Index j) const {
  assert(!state.active_set[static_cast<std::size_t>(j)]);
  return guard_gradient(state, j).dx * scales_.length * scales_.force;
}

std::optional<Index> MultiplierContact::multiplier_index(const ActiveSet& active_set, Index j) const {
  if (!has_force(active_set, static_cast<std::size_t>(j))) return std::nullopt;
  Index k = inner_.size({});
  for (std::size_t i = 0; i < static_cast<std::size_t>(j); ++i) k += has_force(active_set, i) ? 1 : 0;
  return k;
}

Vector MultiplierContact::transfer(const Vector& x, const ActiveSet& from, const ActiveSet& to) const {
  const Index n = inner_.size({});
  Vector moved = Vector::Zero(size(to));
  moved.head(n) = x.head(n);
  Index source = n, target = n;
  for (std::size_t j = 0; j < to.contacts(); ++j) {
    const bool before = has_force(from, j), behind = has_force(to, j);
    if (before && behind) moved[target] = x[source];
    source += before ? 1 : 0;
    target += behind ? 1 : 0;
  }
  if (!has_friction()) return moved;
  const std::vector<Friction> old = frictions(from);
  for (const Friction& friction : frictions(to)) {
    const auto before =
        std::find_if(old.begin(), old.end(), [&](const Friction& other) { return other.contact == friction.contact; });
    if (before == old.end()) continue;
    moved[friction.T] = x[before->T];
    if (friction.w && before->w) moved[*friction.w] = x[*before->w];
  }
  return moved;
}

std::string MultiplierContact::watched_place(const State& state, Index j) const {
  const auto bound = beyond_friction_bound(state.active_set, j);
  return words_of(contact(state, bound ? bound->contact : j).label);
}

StepVerdict MultiplierContact::check(const CheckedStep& step) const {
  using Fault = StepVerdict::Fault;
  if (step.located) {
    if (const Candidate* const passed = passing(step.from, step.to))
      return {.fault = Fault::wall_crossed, .place = words_of(passed->label())};
    for (const Candidate& held : held_)
      if (enters(held, step.from, step.to)) return {.fault = Fault::blocked, .place = words_of(held.label())};
    return {};
  }
  for (std::size_t j = 0; j < candidates_.size(); ++j)
    if (step.to.active_set[j] && !candidates_[j].faces_wall(step.to))
      return {.fault = Fault::wall_left, .place = words_of(candidates_[j].label())};
  return {.fault = comes_behind_an_end(step.from, step.to) ? Fault::behind_end : Fault::none};
}

// Whether a point that supports hold, which no contact force moves, and its wall are pressed into each other.
bool MultiplierContact::enters(const Candidate& held, const State& from, const State& to) const {
  const double touching = 1e-9 * scales_.length, before = held.gap(from);
  return std::isfinite(before) && before >= -touching && held.gap(to) < -touching;
}

const Candidate* MultiplierContact::passing(const State& from, const State& to) const {
  const double touching = 1e-6 * scales_.length;
  for (std::size_t j = 0; j < candidates_.size(); ++j) {
    const Obstacle& obstacle = candidates_[j].obstacle();
    if (!obstacle.has_other_sides() || from.active_set[j]) continue;
    const TrackedPoint& point = candidates_[j].point();
    const PlaceInStep step{.from = point.position(from), .to = point.position(to)};
    if (point_passes_through(obstacle, step, from.lambda, to.lambda, touching)) return &candidates_[j];
  }
  const auto in_step = [&](const Candidate& candidate) {
    return PlaceInStep{.from = candidate.point().position(from), .to = candidate.point().position(to)};
  };
  for (const auto& [first, last] : neighbours_)
    if (line_passes_core(first->obstacle(), in_step(*first), in_step(*last), from.lambda, to.lambda, touching))
      return first;
  return nullptr;
}

std::optional<PathKink> MultiplierContact::kink_between(const State& from, const State& to) const {
  std::optional<WallKink> first;
  const Candidate* of = nullptr;
  for (std::size_t j = 0; j < candidates_.size(); ++j) {
    if (!from.active_set[j] || !may_have_kinks(candidates_[j].obstacle())) continue;
    const TrackedPoint& point = candidates_[j].point();
    const auto kink = first_kink(candidates_[j].obstacle(), {.from = point.position(from), .to = point.position(to)},
                                 from.lambda, to.lambda);
    if (!kink || (first && first->part <= kink->part)) continue;
    first = kink;
    of = &candidates_[j];
  }
  if (!first) return std::nullopt;
  return PathKink{.past = std::make_shared<PastKink>(*of, *first)};
}

bool MultiplierContact::comes_behind_an_end(const State& from, const State& to) const {
  const double touching = 1e-6 * scales_.length;
  return std::any_of(candidates_.begin(), candidates_.end(), [&](const Candidate& candidate) {
    return !candidate.faces_wall(from) && candidate.faces_wall(to) && candidate.gap(to) < -touching;
  });
}

double MultiplierContact::force(const State& state, Index j) const {
  if (const auto k = multiplier_index(state.active_set, j))
    return has_opposite(j) ? std::max(state.x[*k], 0.0) : state.x[*k];
  const auto k = has_opposite(j) ? multiplier_index(state.active_set, *candidate(j).opposite()) : std::nullopt;
  return k ? std::max(-state.x[*k], 0.0) : 0.0;
}

ContactPoint MultiplierContact::told(const State& state, std::size_t j, double force) const {
  const Candidate& candidate = candidates_[j];
  ContactPoint contact{.label = candidate.label(), .place = candidate.point().position(state), .force = force};
  if (!candidate.faces_wall(state)) return contact;
  const Vec2 normal = candidate.normal(state);
  contact.place -= candidate.obstacle().half_height() * normal;
  contact.force_vector = force * normal;
  if (!has_friction()) return contact;
  const std::vector<Friction> all = frictions(state.active_set);
  const auto friction = std::find_if(all.begin(), all.end(), [j](const Friction& other) { return other.contact == j; });
  if (friction == all.end()) return contact;
  contact.friction = FrictionOfContact{.mode = friction->history.mode,
                                       .force = state.x[friction->T],
                                       .coefficient = candidate.friction(),
                                       .slip = friction->held(state.x) - friction->history.touched,
                                       .tangent = candidate.tangent(state)};
  contact.force_vector += contact.friction->force * contact.friction->tangent;
  if (!friction->w) contact.friction->anchor = contact.place.x();
  return contact;
}

ContactPoint MultiplierContact::contact(const State& state, Index j) const {
  return told(state, static_cast<std::size_t>(j), force(state, j));
}

std::vector<ContactPoint> MultiplierContact::closed_contacts(const State& state) const {
  std::vector<ContactPoint> contacts;
  Vector forces = Vector::Zero(contact_count());
  const Index n = inner_.size({});
  for_each_force(state.active_set, [&](std::size_t j, Index k) {
    const double p = state.x[n + k];
    const std::optional<Index> opposite = candidates_[j].opposite();
    forces[static_cast<Index>(j)] = opposite ? std::max(p, 0.0) : p;
    if (opposite) forces[*opposite] = std::max(-p, 0.0);
  });
  for (std::size_t j = 0; j < candidates_.size(); ++j)
    if (state.active_set[j]) contacts.push_back(told(state, j, forces[static_cast<Index>(j)]));
  return contacts;
}

namespace {

// What a force t along the gradient of a field of the obstacle, at the point that touches, adds to an action. It
// changes as t ∇f, of which t changes by `of_t`, and the place by `velocity`.
struct ForceAlong {
  const QuadraticField& f;
  double t;
  Vec2 arm;

  void add_rate(double of_t, const Vec2& velocity, const Vec2& of_gradient, WallAction& action,
                const std::function<double&(Row&)>& to) const {
    const Vec2 along(f.x, f.z);
    const Eigen::Matrix2d bent{{f.xx, f.xz}, {f.xz, f.zz}};
    const Vec2 rate = of_t * along + t * (bent * velocity + of_gradient);
    to(action.gradient[0]) += rate.x();
    to(action.gradient[1]) += rate.y();
    to(action.gradient[2]) += cross(arm, rate) + cross(velocity, t * along);
  }

  void add_value(WallAction& action) const {
    const Vec2 force = t * Vec2(f.x, f.z);
    action.value[0] += force.x();
    action.value[1] += force.y();
    action.value[2] += cross(arm, force);
  }
};

}  // namespace

// Of one contact t ∇g at the point that touches, and T ∇σ at that which friction acts on.
WallAction MultiplierContact::wall_action(const State& state, const ContactsOfWall& of, const Vec2& about) const {
  WallAction action(state.x.size());
  const Index n = inner_.size({});
  const std::vector<Friction> all = frictions(state.active_set);
  for_each_force(state.active_set, [&](std::size_t j, Index k) {
    const Candidate& contact = candidates_[j];
    const double p = state.x[n + k], r = springs_[j].r;
    const bool of_opposite = contact.opposite() && p < 0.0;
    const ContactLabel& label = (of_opposite ? candidate(*contact.opposite()) : contact).label();
    if (!of.includes(label)) return;
    // `stiffness`: by which t falls with the field's own value; `number` of t among the unknowns.
    const auto add = [&](const TrackedPoint& point, const PointKinematics& at, const QuadraticField& f, double t,
                         double stiffness, Index number) {
      const ForceAlong force{.f = f, .t = t, .arm = at.position - about};
      const std::vector<Index>& unknowns = point.unknowns();
      const Vec2 along(f.x, f.z);
      force.add_value(action);
      force.add_rate(1.0, Vec2::Zero(), Vec2::Zero(), action, [&](Row& row) -> double& { return row.dx[number]; });
      for (std::size_t i = 0; i < unknowns.size(); ++i) {
        const Vec2 velocity = at.jacobian.col(static_cast<Index>(i));
        force.add_rate(-stiffness * along.dot(velocity), velocity, Vec2::Zero(), action,
                       [&](Row& row) -> double& { return row.dx[unknowns[i]]; });
      }
      force.add_rate(-stiffness * (f.rate + along.dot(at.rate)), at.rate, Vec2(f.x_rate, f.z_rate), action,
                     [](Row& row) -> double& { return row.dlambda; });
    };
    PointKinematics at;
    contact.point().kinematics(state, at);
    const QuadraticField g = contact.obstacle().gap(at.position, state.lambda);
    add(contact.point(), at, g, p - r * g.value, r, n + k);
    for (const Friction& friction : all) {
      if (friction.contact != j) continue;
      contact.rubbing_point().kinematics(state, at);
      add(contact.rubbing_point(), at, contact.place_field(at.position, state.lambda), state.x[friction.T], 0.0,
          friction.T);
    }
  });
  return action;
}

}  // namespace arcwall
