#include <algorithm>

#include "contact/multiplier_contact.hpp"

namespace arcwall {

// T ∇σ, and that the place is where it is held.
void MultiplierContact::add_friction(const State& state, Eigen::Ref<Vector> F) const {
  Gap place;
  for (const Friction& friction : frictions(state.active_set)) {
    const double held = friction.held(state.x);
    candidates_[friction.contact].place(state, held, place);
    add_force(friction_force(state, friction), place, F);
    F[friction.T] = held - place.value;
    if (friction.w) F[*friction.w] = law_of_slip(state, friction);
  }
}

// ∂F/∂x = [K B; C]: B has the held places w in the rows of σ, C the laws of slip.
void MultiplierContact::add_friction(const State& state, Linearization& out) const {
  const Index border = state.x.size() - out.K.cols();
  out.B = Matrix::Zero(out.K.cols(), border);
  out.C = LongRows::Zero(border, state.x.size());
  out.border_rates = Vector::Zero(border);  // T truly holds
  out.holding.clear();
  out.slip_senses.resize(border);
  Gap place;
  for (const Friction& friction : frictions(state.active_set)) {
    const double held = friction.held(state.x);
    candidates_[friction.contact].place(state, held, place);
    add_force(friction_force(state, friction), place, held - place.value, out);
    if (!friction.w) continue;
    const Index k = *friction.w - out.K.cols();
    out.F[*friction.w] = law_of_slip(state, friction);
    out.B(friction.T, k) = 1.0;
    out.C(k, friction.T) = 1.0;
    out.C(k, friction.p) = slip_sense(friction.history.mode) * candidates_[friction.contact].friction();
    out.holding.push_back(friction.T);
    out.slip_senses[k] = slip_sense(friction.history.mode);
  }
}

ConstraintForce MultiplierContact::friction_force(const State& state, const Friction& friction) const {
  return {.unknowns = candidates_[friction.contact].rubbing_point().unknowns(),
          .row = friction.T,
          .t = state.x[friction.T]};
}

// T + ε μ p.
double MultiplierContact::law_of_slip(const State& state, const Friction& friction) const {
  return state.x[friction.T] +
         slip_sense(friction.history.mode) * candidates_[friction.contact].friction() * state.x[friction.p];
}

const FrictionLayout& MultiplierContact::anchors(const ActiveSet& active_set) const {
  const auto* layout = dynamic_cast<const FrictionLayout*>(active_set.layout().get());
  return layout != nullptr ? *layout : *rest_friction_;
}

std::vector<MultiplierContact::Friction> MultiplierContact::frictions(const ActiveSet& active_set) const {
  std::vector<Friction> found;
  if (!has_friction()) return found;
  const FrictionLayout& layout = anchors(active_set);
  const Index n = inner_.size({});
  for_each_force(active_set, [&](std::size_t j, Index k) {
    if (candidates_[j].friction() > 0.0) found.push_back({.contact = j, .p = n + k, .history = layout[j]});
  });
  Index T = n + force_count(active_set), w = T + static_cast<Index>(found.size());
  for (Friction& friction : found) {
    friction.T = T++;
    if (slips(friction.history.mode)) friction.w = w++;
  }
  return found;
}

ContactMode MultiplierContact::mode(const ActiveSet& active_set, Index j) const {
  if (!active_set[static_cast<std::size_t>(j)]) return ContactMode::open;
  return is_rough(j) ? anchors(active_set)[static_cast<std::size_t>(j)].mode : ContactMode::closed;
}

std::vector<Index> MultiplierContact::slipping(const ActiveSet& active_set) const {
  std::vector<Index> contacts;
  for (const Friction& friction : frictions(active_set))
    if (friction.w) contacts.push_back(static_cast<Index>(friction.contact));
  return contacts;
}

std::vector<Index> MultiplierContact::sticking(const ActiveSet& active_set) const {
  std::vector<Index> contacts;
  for (const Friction& friction : frictions(active_set))
    if (!friction.w) contacts.push_back(static_cast<Index>(friction.contact));
  return contacts;
}

std::optional<Index> MultiplierContact::friction_index(const ActiveSet& active_set, Index j) const {
  for (const Friction& friction : frictions(active_set))
    if (static_cast<Index>(friction.contact) == j) return friction.T;
  return std::nullopt;
}

double MultiplierContact::friction_force(const State& state, Index j) const {
  const auto T = friction_index(state.active_set, j);
  return T ? state.x[*T] : 0.0;
}

double MultiplierContact::slip_rate(const State& state, const Direction& direction, Index j) const {
  for (const Friction& friction : frictions(state.active_set))
    if (static_cast<Index>(friction.contact) == j && friction.w)
      return slip_sense(friction.history.mode) * direction.dx[*friction.w] / scales_.length;
  return 0.0;
}

double MultiplierContact::slip(const State& state, Index j) const {
  for (const Friction& friction : frictions(state.active_set))
    if (static_cast<Index>(friction.contact) == j) return friction.held(state.x) - friction.history.touched;
  return 0.0;
}

Row MultiplierContact::slip_gradient(const State& state, Index j) const {
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  for (const Friction& friction : frictions(state.active_set))
    if (static_cast<Index>(friction.contact) == j && friction.w) row.dx[*friction.w] = 1.0;
  return row;
}

ContactPlace MultiplierContact::place(const State& state, Index j) const {
  for (const Friction& friction : frictions(state.active_set))
    if (static_cast<Index>(friction.contact) == j) return {.w = friction.held(state.x)};
  return {};
}

ContactPlace MultiplierContact::place_rates(const State& state, const Direction& direction, Index j) const {
  return {.w = apply(slip_gradient(state, j), direction)};
}

std::optional<Index> MultiplierContact::force_index(const ActiveSet& active_set, Index j) const {
  return is_rough(j) ? multiplier_index(active_set, j) : std::nullopt;
}

std::optional<ModeOfContact> MultiplierContact::beyond_friction_bound(const ActiveSet& active_set, Index guard) const {
  const Index bound = guard - contact_count();
  if (bound < 0 || !has_friction()) return std::nullopt;
  const std::vector<Index> contacts = sticking(active_set);
  if (bound >= 2 * static_cast<Index>(contacts.size())) return std::nullopt;
  return ModeOfContact{.contact = contacts[static_cast<std::size_t>(bound / 2)],
                       .mode = bound % 2 == 0 ? ContactMode::slips_backward : ContactMode::slips_forward};
}

State MultiplierContact::with_modes(const State& state, std::span<const ModeOfContact> modes) const {
  std::vector<FrictionLayout::Contact> contacts = anchors(state.active_set).contacts();
  std::vector<std::uint8_t> closed(state.active_set.begin(), state.active_set.end());
  for (std::size_t j = 0; j < contacts.size(); ++j)
    if (!closed[j]) contacts[j] = {};
  const std::vector<Friction> before = frictions(state.active_set);
  std::vector<double> places(contacts.size(), 0.0);
  for (const auto& [contact, mode] : modes) {
    const auto j = static_cast<std::size_t>(contact);
    FrictionLayout::Contact& history = contacts[j];
    closed[j] = mode == ContactMode::open ? 0 : 1;
    if (mode == ContactMode::open || !is_rough(contact)) {
      history = {};
      continue;
    }
    const auto known = std::find_if(before.begin(), before.end(), [&](const Friction& f) { return f.contact == j; });
    Gap place;
    candidates_[j].place(state, known != before.end() ? known->held(state.x) : 0.0, place);
    places[j] = place.value;
    if (history.mode == ContactMode::open) history.touched = place.value;
    if (mode == ContactMode::sticks && history.mode != ContactMode::sticks) history.anchor = place.value;
    history.mode = mode;
  }
  ActiveSet changed(closed.size(), 0, std::make_shared<const FrictionLayout>(std::move(contacts)));
  for (std::size_t j = 0; j < closed.size(); ++j) changed[j] = closed[j];
  State next{.x = transfer(state.x, state.active_set, changed), .lambda = state.lambda, .active_set = changed};
  for (const Friction& friction : frictions(changed)) {
    const bool slipped = std::any_of(before.begin(), before.end(), [&](const Friction& other) {
      return other.contact == friction.contact && other.w.has_value();
    });
    if (friction.w && !slipped) next.x[*friction.w] = places[friction.contact];
  }
  return next;
}

}  // namespace arcwall
