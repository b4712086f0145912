#include "contact/sliding_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/passing.hpp"
#include "contact/sliding/bounds/edge_presses.hpp"
#include "contact/sliding/bounds/friction.hpp"
#include "contact/sliding/contact_points.hpp"
#include "contact/sliding/curvature_jumps.hpp"
#include "contact/sliding/equations.hpp"
#include "contact/sliding/inserted_contact.hpp"
#include "contact/sliding/least_gaps.hpp"
#include "contact/sliding/lying.hpp"
#include "contact/sliding/pinches.hpp"
#include "contact/sliding/remeshing.hpp"
#include "contact/sliding/rubbing.hpp"
#include "contact/sliding/spans.hpp"
#include "contact/sliding/tolerances.hpp"
#include "contact/sliding/touch.hpp"
#include "contact/sliding/validity_bound.hpp"

namespace arcwall {

namespace {

// Without a tracked point: all point loads have nodes.
std::shared_ptr<const SlidingContactLayout> plain_layout(const SlidingBody& body) {
  ElementsPerSegment elements;
  for (Index strand = 0; strand < body.strands(); ++strand) {
    const std::vector<double>& loads = body.point_loads(strand);
    double from = 0.0;
    elements.emplace_back();
    for (std::size_t i = 0; i < loads.size(); ++i) {
      elements.back().emplace_back(sliding::elements_asked(body, strand, from, loads[i], 1), static_cast<Index>(i));
      from = loads[i];
    }
    elements.back().emplace_back(sliding::elements_asked(body, strand, from, body.length(strand), 1));
  }
  return std::make_shared<SlidingContactLayout>(body, body.mesh(elements), std::vector<SlidingContactLayout::Point>{},
                                                Vector());
}

// The bound that a guard behind those of the contacts stands for.
const sliding::ValidityBound& bound_of(const SlidingState& at, Index guard) {
  return *at.layout.bounds()[static_cast<std::size_t>(guard) - at.contacts()];
}

bool is_bound(const SlidingState& at, Index guard) { return guard >= static_cast<Index>(at.contacts()); }

// Whether a bound watches the force of a closed contact: at an edge, or inside a zone across a plane of symmetry.
bool is_watched(const SlidingSetting& setting, const SlidingState& at, std::size_t contact) {
  return contact < at.layout.points().size() ? sliding::must_press(setting, at, contact)
                                             : sliding::is_inside_zone(setting, at.layout, contact);
}

double guard_of_contact(const SlidingSetting& setting, const SlidingState& at, Index j) {
  // Of a contact that faces no wall, that lies on it without force, at a pinch, or where a bound watches the force.
  const auto contact = static_cast<std::size_t>(j);
  if (at.layout.is_pinched(contact)) return sliding::no_guard;
  if (at.is_closed(contact))
    return is_watched(setting, at, contact) ? sliding::no_guard : at.force(contact) / setting.scales.force;
  if (sliding::lies_flat(setting, at.layout, contact)) return sliding::no_guard;
  const double gap = sliding::face_gap(setting, sliding::touch_of_contact(setting, at.layout, contact), at);
  return std::isfinite(gap) ? gap / setting.scales.length : sliding::no_guard;
}

double guard_of(const SlidingSetting& setting, const SlidingState& at, Index j) {
  return is_bound(at, j) ? bound_of(at, j).value(setting, at) : guard_of_contact(setting, at, j);
}

Vector guards_of(const SlidingSetting& setting, const SlidingState& at) {
  Vector guards(static_cast<Index>(at.contacts() + at.layout.bounds().size()));
  for (Index j = 0; j < guards.size(); ++j) guards[j] = guard_of(setting, at, j);
  return guards;
}

Row guard_gradient_of_contact(const SlidingSetting& setting, const SlidingState& at, Index j) {
  Row row = at.no_slope();
  if (at.layout.is_pinched(static_cast<std::size_t>(j))) return row;
  if (const auto p = at.index.force(static_cast<std::size_t>(j))) {
    if (is_watched(setting, at, static_cast<std::size_t>(j))) return row;
    row.dx[*p] = 1.0 / setting.scales.force;
    return row;
  }
  if (sliding::lies_flat(setting, at.layout, static_cast<std::size_t>(j))) return row;
  const sliding::Touch touch = sliding::touch_of_contact(setting, at.layout, static_cast<std::size_t>(j));
  if (!std::isfinite(sliding::face_gap(setting, touch, at))) return row;
  const sliding::NodeFunction gap = sliding::touch_gap(setting, touch, at).gap;
  sliding::add_at_node(at.mesh.node_unknowns(touch.strand, touch.position), gap.gradient / setting.scales.length,
                       row.dx);
  row.dlambda = gap.rate / setting.scales.length;
  return row;
}

std::string name_of(const SlidingSetting& setting, const FreeEnd& end) {
  const double s = end.last ? setting.body.length(end.strand) : 0.0;
  const auto [member, fraction] = setting.body.label({.strand = end.strand, .s = s});
  return words_of({.wall = setting.obstacles[end.obstacle].name, .member = member, .fraction = fraction});
}

// Of an end that supports hold.
double gap_of(const SlidingSetting& setting, const FreeEnd& end, const SlidingState& at) {
  return sliding::face_gap(setting, sliding::touch_of_end(setting, at.layout, end), at);
}

// The name of an end that supports hold and that an obstacle has reached on the way between two states.
std::optional<std::string> entered_held_end(const SlidingSetting& setting, const SlidingState& from,
                                            const SlidingState& to) {
  const double touching = sliding::touching_at_rest * setting.scales.length;
  for (const FreeEnd& end : setting.held_ends) {
    const double before = gap_of(setting, end, from);
    if (std::isfinite(before) && before >= -touching && gap_of(setting, end, to) < -touching)
      return name_of(setting, end);
  }
  return std::nullopt;
}

// The name of an end that supports hold, that an obstacle touches and that λ would press into it.
std::optional<std::string> pressed_held_end(const SlidingSetting& setting, const SlidingState& at, double dlambda) {
  for (const FreeEnd& end : setting.held_ends) {
    const double gap = gap_of(setting, end, at);
    if (!std::isfinite(gap) || std::abs(gap) > sliding::touching_at_rest * setting.scales.length) continue;
    const sliding::Touch touch = sliding::touch_of_end(setting, at.layout, end);
    if (sliding::touch_gap(setting, touch, at).gap.rate * dlambda < 0.0) return name_of(setting, end);
  }
  return std::nullopt;
}

}  // namespace

SlidingContact::SlidingContact(const SlidingBody& body, std::vector<SlidingObstacle> obstacles,
                               const ContactScales& scales, ContinuumChoice continuum) {
  const auto layout = plain_layout(body);
  const Vector x = body.rest(layout->mesh(), Vector()), s;
  BodyEnds ends = ends_beside_obstacles(body, obstacles, layout->mesh(), {.x = x, .s = s, .lambda = 0.0});
  const State rest{.x = x, .lambda = 0.0, .active_set = ActiveSet(ends.free.size(), 0, layout)};
  auto setting = std::make_unique<SlidingSetting>(SlidingSetting{.body = body,
                                                                 .obstacles = std::move(obstacles),
                                                                 .scales = scales,
                                                                 .free_ends = std::move(ends.free),
                                                                 .held_ends = std::move(ends.held),
                                                                 .continuum = continuum});
  setting->pinches = sliding::pinches_at_rest(*setting, SlidingState(rest));
  open_ = sliding::pinched_active_set(*setting, SlidingState(rest));
  setting_ = std::move(setting);
  for (const SlidingObstacle& obstacle : setting_->obstacles) {
    has_friction_ = has_friction_ || obstacle.is_rough();
    speed_of_walls_ = std::max(speed_of_walls_, obstacle.surface->greatest_speed(scales.length) / scales.length);
  }
}

SlidingContact::~SlidingContact() = default;

std::vector<SlidingContact::EndContact> SlidingContact::ends() const {
  std::vector<EndContact> ends;
  for (const FreeEnd& end : setting_->free_ends)
    ends.push_back({.strand = end.strand, .last = end.last, .obstacle = end.obstacle});
  return ends;
}

const ContactScales& SlidingContact::scales() const { return setting_->scales; }
const SlidingBody& SlidingContact::body() const { return setting_->body; }
const std::vector<SlidingObstacle>& SlidingContact::obstacles() const { return setting_->obstacles; }

// --- the equations --------------------------------------------------------------------------------------------------

Dimensions SlidingContact::dimensions(const ActiveSet& active_set) const {
  const SlidingUnknowns index(active_set);
  return {.unknowns = index.size(),
          .multipliers = index.multipliers(),
          .bounds = static_cast<Index>(sliding_layout(active_set).bounds().size())};
}

Enforcement SlidingContact::enforcement(const ActiveSet& active_set, Index j) const {
  const auto contact = static_cast<std::size_t>(j);
  return {.multiplier = SlidingUnknowns(active_set).force(contact),
          .force_scale = scales().force,
          .two_sided = sliding_layout(active_set).is_pinched(contact)};
}

// An obstacle counts as a structure that goes with it would.
StateMetric SlidingContact::metric(const ActiveSet& active_set) const {
  const SlidingUnknowns index(active_set);
  const StateMetric& of_mesh = sliding_layout(active_set).mesh().metric();
  StateMetric metric{.weights = Vector::Zero(index.size()),
                     .squared_motion_by_lambda = of_mesh.squared_motion_by_lambda + speed_of_walls_ * speed_of_walls_,
                     .turning_sets = of_mesh.turning_sets};
  metric.weights.head(index.nodes) = of_mesh.weights;
  return metric;
}

void SlidingContact::residual(const State& state, Eigen::Ref<Vector> F) const {
  sliding::residual(*setting_, SlidingState(state), F);
}

void SlidingContact::linearize(const State& state, Linearization& out) const {
  sliding::linearize(*setting_, SlidingState(state), out);
}

double SlidingContact::energy(const State& state) const { return mesh_of(state).energy(mesh_state_of(state)); }

// --- side conditions ------------------------------------------------------------------------------------------------

Vector SlidingContact::guards(const State& state) const { return guards_of(*setting_, SlidingState(state)); }

double SlidingContact::guard(const State& state, Index j) const { return guard_of(*setting_, SlidingState(state), j); }

Row SlidingContact::guard_gradient(const State& state, Index j) const {
  const SlidingState at(state);
  return is_bound(at, j) ? bound_of(at, j).gradient(*setting_, at) : guard_gradient_of_contact(*setting_, at, j);
}

GuardsAlong SlidingContact::guards_along(const State& state, const Direction& direction) const {
  const SlidingState at(state);  // what bounds share is found once for both
  const SlidingMotion motion{.at = at, .direction = direction};
  GuardsAlong along{.values = guards_of(*setting_, at)};
  Vector& rates = along.rates;
  rates.resize(along.values.size());
  for (Index j = 0; j < rates.size(); ++j)
    rates[j] = is_bound(at, j) ? bound_of(at, j).rate(*setting_, motion)
                               : apply(guard_gradient_of_contact(*setting_, at, j), direction);
  return along;
}

Vector SlidingContact::unit_force(const State& state, Index j) const {
  return guard_gradient(state, j).dx * scales().length * scales().force;
}

Vector SlidingContact::transfer(const Vector& x, const ActiveSet& from, const ActiveSet& to) const {
  return moved_unknowns(x, from, to);
}

CountedDirections SlidingContact::counted_directions(const ActiveSet& active_set) const {
  return sliding_layout(active_set).neutral_spans().empty() ? CountedDirections::all : CountedDirections::some;
}

// --- changing unknowns ----------------------------------------------------------------------------------------------

std::vector<Transition> SlidingContact::transitions(const State& state, const Direction& forward, Index bound,
                                                    double tolerance) const {
  const SlidingState at(state);
  if (auto place = pressed_held_end(*setting_, at, forward.dlambda))
    return {{.change = Transition::Change::blocked, .detail = std::move(*place)}};
  const sliding::ValidityBound& at_hand = bound_of(at, bound);
  const sliding::Arrival arrival{.forward = forward, .tolerance = tolerance, .at_hand = &at_hand};
  std::vector<Transition> transitions = at_hand.transitions(*setting_, at, arrival);
  if (!has_friction_) return transitions;
  std::string why;
  const auto is_unmodelled = [&](const Transition& transition) {
    if (transition.change == Transition::Change::unsupported) return false;
    const ActiveSet& ahead = transition.guess.get().active_set;
    if (ahead.layout() != nullptr) why = sliding::why_friction_is_not_modelled(*setting_, ahead);
    const auto is_without_force = [&](Index j) {
      return coefficient(state.active_set, j) > 0.0 &&
             at.force(static_cast<std::size_t>(j)) <= sliding::reached_surely * scales().force;
    };
    if (why.empty() && transition.change == Transition::Change::spreads &&
        std::any_of(transition.contacts.begin(), transition.contacts.end(), is_without_force))
      why = "a member touches a rough wall all along a part at once, which is not modelled with moving contact points";
    return !why.empty();
  };
  if (const auto first = std::find_if(transitions.begin(), transitions.end(), is_unmodelled);
      first != transitions.end()) {
    transitions.erase(first, transitions.end());
    transitions.push_back(sliding::unsupported(std::move(why)));
  }
  return transitions;
}

// --- friction -------------------------------------------------------------------------------------------------------

double SlidingContact::coefficient(const ActiveSet& active_set, Index j) const {
  return sliding::friction_coefficient(*setting_, sliding_layout(active_set), static_cast<std::size_t>(j));
}

std::string SlidingContact::why_not_modelled(const ActiveSet& active_set, Index j) const {
  return sliding::why_friction_is_not_modelled_at(*setting_, sliding_layout(active_set), static_cast<std::size_t>(j));
}

std::string SlidingContact::why_not_modelled(const ActiveSet& active_set) const {
  return sliding::why_friction_is_not_modelled(*setting_, active_set);
}

std::string SlidingContact::why_friction_is_not_modelled(double toward) const {
  return why_not_modelled(start(toward).active_set);
}

// Ends at hollow corners.
bool SlidingContact::share_point(const ActiveSet& active_set, Index j, Index k) const {
  const SlidingContactLayout& layout = sliding_layout(active_set);
  const auto points = static_cast<Index>(layout.points().size());
  if (j < points || k < points || !is_rough(active_set, j) || !is_rough(active_set, k)) return false;
  const sliding::Touch one = sliding::touch_of_contact(*setting_, layout, static_cast<std::size_t>(j));
  const sliding::Touch other = sliding::touch_of_contact(*setting_, layout, static_cast<std::size_t>(k));
  return one.strand == other.strand && one.position == other.position;
}

ContactMode SlidingContact::mode(const ActiveSet& active_set, Index j) const {
  const auto contact = static_cast<std::size_t>(j);
  if (!active_set[contact]) return ContactMode::open;
  return rubs(active_set, contact) ? sliding_layout(active_set).rubbing(contact).mode : ContactMode::closed;
}

std::vector<Index> SlidingContact::slipping(const ActiveSet& active_set) const {
  std::vector<Index> contacts;
  for (Index j = 0; j < static_cast<Index>(active_set.contacts()); ++j)
    if (slips(mode(active_set, j))) contacts.push_back(j);
  return contacts;
}

Row SlidingContact::slip_gradient(const State& state, Index j) const {
  const SlidingState at(state);
  if (!slips(mode(state.active_set, j))) return at.no_slope();
  return sliding::slip_gradient(*setting_, at, static_cast<std::size_t>(j));
}

double SlidingContact::slip_rate(const State& state, const Direction& direction, Index j) const {
  const ContactMode now = mode(state.active_set, j);
  return slips(now) ? slip_sense(now) * apply(slip_gradient(state, j), direction) / scales().length : 0.0;
}

double SlidingContact::slip(const State& state, Index j) const {
  return rubs(state.active_set, static_cast<std::size_t>(j))
             ? sliding::slip_of(*setting_, SlidingState(state), static_cast<std::size_t>(j))
             : 0.0;
}

double SlidingContact::round_length(const ActiveSet& active_set, Index j) const {
  const sliding::Touch touch =
      sliding::touch_of_contact(*setting_, sliding_layout(active_set), static_cast<std::size_t>(j));
  return obstacles()[touch.obstacle].surface->round_length();
}

double SlidingContact::slip_since(const State& event, const State& state, Index j) const {
  return sliding::slip_since(*setting_, SlidingState(event), SlidingState(state), static_cast<std::size_t>(j));
}

std::optional<Index> SlidingContact::counterpart(const State& state, Index j, const State& other) const {
  const SlidingState at(state), there(other);
  const bool has_same_mesh = at.mesh.elements_per_segment() == there.mesh.elements_per_segment();
  if (at.contacts() == there.contacts() && (has_same_mesh || sliding::has_same_contacts(at, there))) return j;
  return sliding::nearest_rubbing(*setting_, at, static_cast<std::size_t>(j), there);
}

bool SlidingContact::rolls(const ActiveSet& active_set, Index j) const {
  return j < static_cast<Index>(sliding_layout(active_set).points().size());
}

ContactPlace SlidingContact::place(const State& state, Index j) const {
  return sliding::place_of_rubbing(*setting_, SlidingState(state), static_cast<std::size_t>(j));
}

ContactPlace SlidingContact::place_rates(const State& state, const Direction& direction, Index j) const {
  return sliding::rates_of_rubbing(*setting_, SlidingState(state), direction, static_cast<std::size_t>(j));
}

std::optional<Index> SlidingContact::force_index(const ActiveSet& active_set, Index j) const {
  const auto contact = static_cast<std::size_t>(j);
  return rubs(active_set, contact) ? SlidingUnknowns(active_set).force(contact) : std::nullopt;
}

std::optional<Index> SlidingContact::friction_index(const ActiveSet& active_set, Index j) const {
  return SlidingUnknowns(active_set).friction(static_cast<std::size_t>(j));
}

FrictionalContact::HeldPlace SlidingContact::held_place(const ActiveSet& active_set, Index j) const {
  return {.equation = SlidingUnknowns(active_set).place(static_cast<std::size_t>(j)).value(), .by_slip = 1.0};
}

double SlidingContact::friction_force(const State& state, Index j) const {
  const auto T = friction_index(state.active_set, j);
  return T ? state.x[*T] : 0.0;
}

std::optional<ModeOfContact> SlidingContact::beyond_friction_bound(const ActiveSet& active_set, Index guard) const {
  const auto& bounds = sliding_layout(active_set).bounds();
  const Index bound = guard - static_cast<Index>(active_set.contacts());
  if (bound < 0 || bound >= static_cast<Index>(bounds.size())) return std::nullopt;
  const auto* friction = sliding::as<sliding::FrictionBound>(*bounds[static_cast<std::size_t>(bound)]);
  if (friction == nullptr) return std::nullopt;
  return ModeOfContact{.contact = static_cast<Index>(friction->contact()), .mode = friction->beyond()};
}

State SlidingContact::with_modes(const State& state, std::span<const ModeOfContact> modes) const {
  return sliding::with_modes(*setting_, SlidingState(state), modes);
}

// Whether a closed contact faces its wall no more.
StepVerdict SlidingContact::check_converged(const State& from, const State& to) const {
  using Fault = StepVerdict::Fault;
  const SlidingState at(to);
  for (std::size_t j = 0; j < at.contacts(); ++j) {
    const sliding::Touch touch = sliding::touch_of_contact(*setting_, at.layout, j);
    if (at.is_closed(j) && !std::isfinite(sliding::face_gap(*setting_, touch, at)))
      return {.fault = Fault::wall_left, .place = watched_place(to, static_cast<Index>(j))};
  }
  if (sliding::comes_behind_an_end(*setting_, SlidingState(from), at)) return {.fault = Fault::behind_end};
  return {};
}

StepVerdict SlidingContact::check(const CheckedStep& step) const {
  if (!step.located) return check_converged(step.from, step.to);
  const SlidingState from(step.from), to(step.to);
  const CheckedStep::LocatedEnd& end = *step.located;
  if (sliding::passes_through(*setting_, from, to)) return {.fault = StepVerdict::Fault::wall_crossed};
  if (auto place = entered_held_end(*setting_, from, to))
    return {.fault = StepVerdict::Fault::blocked, .place = std::move(*place)};
  StepVerdict verdict;
  const auto restart_with = [&](std::optional<Transition> layout) {
    if (layout) verdict.restarts.push_back(std::move(*layout));
  };
  if (!sliding::unwatched_gaps(*setting_, to, end.gap_seen).empty()) {
    if (end.from != nullptr) restart_with(sliding::with_inserted_contact(*setting_, from, *end.from, to, end.gap_seen));
    if (auto place = penetrated_place(step.to, -end.penetration)) {
      verdict.fault = StepVerdict::Fault::penetration;
      verdict.place = std::move(*place);
      return verdict;
    }
  }
  // An open point moves the mesh: where that moves its least gap by more than the point follows, its place turns back,
  // and takes the path of a structure that does not turn along. So λ turns without open points, or not at all. The one
  // that touches there is needed: a shorter step turns before, or is none.
  if (end.turns && end.from != nullptr) {
    const std::optional<Index> touching = end.guard && *end.guard < to.index.points ? end.guard : std::nullopt;
    restart_with(sliding::without_open_points(*setting_, from, *end.from, touching));
    if (verdict.restarts.empty() && touching && !to.is_closed(static_cast<std::size_t>(*touching)))
      return {.fault = StepVerdict::Fault::penetration, .place = watched_place(step.to, *touching)};
  }
  if (end.guard && end.from != nullptr)
    restart_with(sliding::with_mesh_for_touch(*setting_, from, *end.from, to, *end.guard));
  return verdict;
}

std::optional<std::string> SlidingContact::penetrated_place(const State& state, double margin) const {
  const auto gaps = sliding::unwatched_gaps(*setting_, SlidingState(state), margin);
  if (gaps.empty()) return std::nullopt;
  const auto [member, fraction] = setting_->body.label(gaps.front().at);
  return words_of({.wall = setting_->obstacles[gaps.front().obstacle].name, .member = member, .fraction = fraction});
}

// Each closed point, but those at the end of a zone that an earlier one begins; each zone from end to end of a strand;
// and each closed end, which is one with the zones that reach it. Beyond a plane of symmetry there are as many, but for
// what crosses it.
Index SlidingContact::separate_contacts(const ActiveSet& active_set) const {
  constexpr std::array<bool, 2> both_ends{false, true};
  const SlidingContactLayout& layout = sliding_layout(active_set);
  const std::size_t points = layout.points().size();
  const auto strand_of = [&](std::size_t k) { return layout.mesh().breakpoint(static_cast<Index>(k)).first; };
  const auto is_in_zone = [&](const StrandEnd& end, std::size_t obstacle) {
    if (const auto whole = layout.lies_on(end.strand)) return *whole == obstacle;
    const auto point = layout.point_at_end(end.strand, end.last);
    return point && layout.points()[*point].obstacle == obstacle &&
           layout.span_at_end(end.strand, end.last) != SlidingContactLayout::Span::free;
  };
  const auto is_mirrored = [&](const StrandEnd& end) {
    return body().is_on_plane(end.strand, end.last) &&
           std::any_of(setting_->free_ends.begin(), setting_->free_ends.end(),
                       [&](const FreeEnd& contact) { return contact.joined.empty() && contact.is_of(end); });
  };
  const auto copies = [&](Index strand) { return is_mirrored({strand, false}) || is_mirrored({strand, true}) ? 2 : 1; };
  const auto crosses_plane = [&](std::size_t k) {
    return std::any_of(both_ends.begin(), both_ends.end(), [&](bool last) {
      const StrandEnd end{.strand = strand_of(k), .last = last};
      return is_mirrored(end) && layout.point_at_end(end.strand, last) == k &&
             layout.span_at_end(end.strand, last) != SlidingContactLayout::Span::free;
    });
  };
  Index count = 0;
  for (std::size_t k = 0; k < points; ++k) {
    const bool ends_zone =
        k > 0 && strand_of(k) == strand_of(k - 1) && layout.points()[k - 1].behind != SlidingContactLayout::Span::free;
    if (active_set[k] != 0 && !ends_zone) count += crosses_plane(k) ? 1 : copies(strand_of(k));
  }
  for (Index strand = 0; strand < body().strands(); ++strand)
    if (layout.lies_on(strand)) ++count;
  for (std::size_t e = 0; e < setting_->free_ends.size(); ++e) {
    if (active_set[points + e] == 0) continue;
    const FreeEnd& end = setting_->free_ends[e];
    const bool is_at_plane = body().is_on_plane(end.strand, end.last);
    if (!is_in_zone({.strand = end.strand, .last = end.last}, end.obstacle))
      count += is_at_plane ? 1 : copies(end.strand);
    count -= std::count_if(end.joined.begin(), end.joined.end(),
                           [&](const StrandEnd& other) { return is_in_zone(other, end.obstacle); });
  }
  return count;
}

std::optional<PathKink> SlidingContact::kink_between(const State& from, const State& to) const {
  const SlidingState before(from), behind(to);
  std::optional<WallKink> first;
  std::size_t of = 0;
  for (std::size_t j = 0; j < before.contacts(); ++j) {
    if (!before.is_closed(j)) continue;
    const sliding::Touch touch = sliding::touch_of_contact(*setting_, before.layout, j);
    const Obstacle& wall = *setting_->obstacles[touch.obstacle].surface;
    if (!may_have_kinks(wall)) continue;
    const auto place = [&](const SlidingState& at) { return sliding::face(touch.offset, touch.axis(at)); };
    const auto kink = first_kink(wall, {.from = place(before), .to = place(behind)}, from.lambda, to.lambda);
    if (!kink || (first && first->part <= kink->part)) continue;
    first = kink;
    of = j;
  }
  if (!first) return std::nullopt;
  return PathKink{.past = std::make_shared<sliding::PastKink>(*setting_, of, *first)};
}

ActiveSet SlidingContact::canonical_active_set(const State& state) const {
  return sliding::canonical_active_set(*setting_, SlidingState(state));
}

State SlidingContact::rest() const {
  const SlidingContactLayout& on = sliding_layout(open_);
  const SlidingUnknowns index(open_);
  State rest{.x = Vector::Zero(index.size()), .lambda = 0.0, .active_set = open_};
  rest.x.head(index.nodes) = body().rest(on.mesh(), on.origin());
  rest.x.tail(index.points) = on.origin();
  return rest;
}

State SlidingContact::start(double toward) const {
  const State at_rest = rest();
  return sliding::with_strands_lying(*setting_, SlidingState(at_rest), toward);
}

bool SlidingContact::rests_on_part() const {
  const State at_rest = rest();
  return sliding::rests_on_part(*setting_, SlidingState(at_rest));
}

std::optional<State> SlidingContact::with_strands_come_to_lie(const State& state, double toward) const {
  auto lying = sliding::with_strands_come_to_lie(*setting_, SlidingState(state), toward);
  if (lying && !why_not_modelled(lying->active_set).empty()) lying.reset();
  return lying;
}

std::string SlidingContact::why_not_lying(const State& state) const {
  return sliding::why_not_lying(*setting_, SlidingState(state), state.lambda);
}

State SlidingContact::adopted(const State& state) const {
  const SlidingState at(state);
  const auto here =
      std::make_shared<SlidingContactLayout>(body(), body().mesh(at.mesh.elements_per_segment()), at.layout.points(),
                                             at.now.s, at.layout.lying(), at.layout.end_rubbings());
  return {.x = state.x, .lambda = state.lambda, .active_set = sliding::with_layout(state.active_set, here)};
}

State SlidingContact::gripped(const SlidingContact& free, const State& state) const {
  const SlidingState at(state);
  std::vector<std::size_t> number;  // of each contact, there
  for (std::size_t k = 0; k < at.layout.points().size(); ++k) number.push_back(k);
  for (const FreeEnd& end : setting_->free_ends) {
    const auto before = free.setting_->number_of_end({.strand = end.strand, .last = end.last}, end.obstacle);
    number.push_back(at.layout.points().size() + before.value());
  }
  const auto with_ends = [&](SlidingContactLayout::EndRubbings ends) {
    return std::make_shared<SlidingContactLayout>(body(), body().mesh(at.mesh.elements_per_segment()),
                                                  at.layout.points(), at.now.s, at.layout.lying(), std::move(ends));
  };
  // What holds an end along its wall from now on bears the friction.
  SlidingContactLayout::EndRubbings ends;
  const auto without_friction = with_ends({});
  for (std::size_t j = at.layout.points().size(); j < number.size(); ++j)
    ends.push_back(sliding::friction_coefficient(*setting_, *without_friction, j) > 0.0
                       ? at.layout.rubbing(number[j])
                       : SlidingContactLayout::Rubbing{});
  const auto here = with_ends(std::move(ends));
  ActiveSet active_set(number.size(), 0, here);
  for (std::size_t j = 0; j < number.size(); ++j) active_set[j] = state.active_set[number[j]];
  State result{.x = {}, .lambda = state.lambda, .active_set = active_set.with_kinks_of(state.active_set)};
  const SlidingUnknowns index(result.active_set);
  const Index middle = index.pressed + index.neutral + index.pinched;
  result.x = Vector::Zero(index.size());
  result.x.head(index.nodes) = at.mesh.transferred(at.now, here->mesh(), at.now.s);
  for (std::size_t j = 0; j < number.size(); ++j)
    if (const auto force = index.force(j)) result.x[*force] = at.force(number[j]);
  result.x.segment(index.pressed_force(0), middle) = state.x.segment(at.index.pressed_force(0), middle);
  const auto& tips = here->pressed_tips();
  const auto& before = at.layout.pressed_tips();
  for (std::size_t tip = 0; tip < tips.size(); ++tip)
    for (std::size_t i = 0; i < before.size(); ++i)
      if (before[i].strand == tips[tip].strand && before[i].position == tips[tip].position)
        result.x[index.tip_moment(tip)] = state.x[at.index.tip_moment(i)];
  result.x.segment(index.moment(0), index.points) = state.x.segment(at.index.moment(0), index.points);
  for (std::size_t j = 0; j < number.size(); ++j) {
    const auto T = index.friction(j);
    if (!T) continue;
    result.x[*T] = state.x[*at.index.friction(number[j])];
    result.x[*index.place(j)] = state.x[*at.index.place(number[j])];
  }
  result.x.tail(index.points) = state.x.tail(index.points);
  return result;
}

State SlidingContact::with_flat_parts_loaded(const State& state, double toward) const {
  return sliding::with_flat_parts_loaded(*setting_, SlidingState(state), toward);
}

std::optional<State> SlidingContact::taken_over(const State& state) const {
  const SlidingState at(state);
  if (at.contacts() - at.layout.points().size() != setting_->free_ends.size()) return std::nullopt;
  const auto here = layout_of(at.mesh.elements_per_segment(), at.layout.points(), at.layout.origin(), at.layout.lying(),
                              at.layout.end_rubbings());
  if (!here || here->mesh().unknowns() != at.mesh.unknowns() || here->mesh().breakpoints() != at.mesh.breakpoints() ||
      here->bounds().size() != at.layout.bounds().size())
    return std::nullopt;
  return State{.x = state.x, .lambda = state.lambda, .active_set = sliding::with_layout(state.active_set, here)};
}

State SlidingContact::with_given_contacts(const State& open, const std::vector<GivenContact>& contacts) const {
  return sliding::with_given_contacts(*setting_, SlidingState(open), contacts);
}

std::shared_ptr<const SlidingContactLayout> SlidingContact::layout_of(const ElementsPerSegment& elements,
                                                                      std::vector<SlidingContactLayout::Point> points,
                                                                      const Vector& origin,
                                                                      SlidingContactLayout::Lying lying,
                                                                      SlidingContactLayout::EndRubbings ends) const {
  return sliding::checked_layout(*setting_, elements, std::move(points), origin, std::move(lying), std::move(ends));
}

// --- what is told of contacts ---------------------------------------------------------------------------------------

ContactPoint SlidingContact::contact(const State& state, Index j) const {
  return sliding::contact_point(*setting_, SlidingState(state), static_cast<std::size_t>(j));
}

double SlidingContact::force(const State& state, Index j) const {
  const SlidingState at(state);
  const double force = at.force(static_cast<std::size_t>(j));
  return at.layout.is_pinched(static_cast<std::size_t>(j)) ? std::max(force, 0.0) : force;
}

std::vector<ContactPoint> SlidingContact::closed_contacts(const State& state) const {
  return sliding::closed_contacts(*setting_, SlidingState(state));
}

std::vector<ContactPoint> SlidingContact::pressed_nodes(const State& state) const {
  return sliding::pressed_nodes(*setting_, SlidingState(state));
}

WallAction SlidingContact::wall_action(const State& state, const ContactsOfWall& of, const Vec2& about) const {
  return sliding::wall_action(*setting_, SlidingState(state), of, about);
}

std::optional<SlidingContact::Entered> SlidingContact::entered(const State& state, double depth) const {
  const auto gaps = sliding::unwatched_gaps(*setting_, SlidingState(state), -depth / scales().length);
  if (gaps.empty()) return std::nullopt;
  const sliding::LeastGap& deepest = gaps.front();
  const auto [member, fraction] = body().label(deepest.at);
  return Entered{.label = {.wall = obstacles()[deepest.obstacle].name, .member = member, .fraction = fraction},
                 .depth = -deepest.gap};
}

std::vector<SlidingContact::PinchedPlace> SlidingContact::pinches() const {
  std::vector<PinchedPlace> places;
  for (const Pinch& pinch : setting_->pinches)
    places.push_back({.obstacle = obstacles()[pinch.obstacle].name,
                      .other = obstacles()[pinch.other].name,
                      .place = pinch.place,
                      .axis = {std::cos(pinch.angle), std::sin(pinch.angle)},
                      .normal = pinch.normal,
                      .knife_edges = !pinch.holds_direction()});
  return places;
}

double SlidingContact::least_gap(const State& state, int places) const {
  return sliding::sampled_least_gap(*setting_, SlidingState(state), places);
}

}  // namespace arcwall
