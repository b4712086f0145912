#include "elements/structure.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

namespace arcwall {

namespace {

template <class Entries>
void scatter_entries(const ShiftedIndices& unknowns, double factor, double* F, const Entries& f) {
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    if (unknowns[i] >= 0) F[unknowns[i]] += factor * f(i);
}

void scatter(const ShiftedIndices& unknowns, const double* f, double factor, double* F) {
  scatter_entries(unknowns, factor, F, [f](std::size_t i) { return f[i]; });
}

}  // namespace

// Local unknowns, forces and derivatives of one element, on the stack.
struct Structure::Local {
  double u[Element::max_unknowns];
  double f[Element::max_unknowns];
  double K[Element::max_unknowns * Element::max_unknowns];  // the lower triangle, column-major
  double f_lambda[Element::max_unknowns];

  double stiffness(std::size_t i, std::size_t j, std::size_t n) const { return K[std::max(i, j) + n * std::min(i, j)]; }
};

EssenburgNode MemberSection::kinematics() const {
  return {.D = axis_normal(shape.angle), .n = axis_normal(axis.angle), .quadratic = quadratic};
}

MemberSection MemberMesh::section(std::size_t k) const {
  MemberSection at{.node = nodes[k],
                   .rotation = rotations[k],
                   .axis = axis[k],
                   .shape = shape[k],
                   .quadratic = quadratic,
                   .fraction = fraction(k)};
  if (!thickness.empty()) at.thickness = thickness[k];
  return at;
}

// ∫ N ds of each node's shape function: what a constant pressure gives it.
std::vector<MemberSection> MemberMesh::contact_sections() const {
  const std::size_t elements = nodes.size() - 1;
  const double h = length / double(elements);
  const bool middles = !middle_thickness.empty();
  std::vector<MemberSection> sections;
  for (std::size_t k = 0; k <= elements; ++k) {
    sections.push_back(section(k));
    sections.back().tributary = (k == 0 || k == elements ? 0.5 : 1.0) * h / (middles ? 3.0 : 1.0);
    if (!middles || k == elements) continue;
    sections.push_back({.node = middle_nodes[k],
                        .rotation = middle_rotations[k],
                        .thickness = middle_thickness[k],
                        .axis = middle_axis[k],
                        .shape = middle_shape[k],
                        .quadratic = quadratic,
                        .fraction = (double(k) + 0.5) / double(elements),
                        .tributary = 2.0 * h / 3.0});
  }
  return sections;
}

void Structure::gather(Index block, const Vector& x, double* u) const {
  const ShiftedIndices unknowns = assembly_.unknowns(block);
  for (std::size_t i = 0; i < unknowns.size(); ++i) u[i] = unknowns[i] >= 0 ? x[unknowns[i]] : 0.0;
}

void Structure::arrange() {
  const bool any_displaced = nodal_.has_displaced_supports();
  const auto is_displaced = [this](Index dof) { return nodal_.is_displaced(dof); };
  order_ =
      element_order(elements_, assembly_, [&](Index e) { return any_displaced && element_dofs(e).any(is_displaced); });
}

void Structure::gather(Index block, const State& state, double* u) const {
  const ShiftedIndices unknowns = assembly_.unknowns(block), dofs = element_dofs(block);
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    u[i] = unknowns[i] >= 0 ? state.x[unknowns[i]] : nodal_.support(dofs[i]).at(state.lambda);
}

void Structure::evaluate(const Element& element, Index block, const State& state, Local& out,
                         bool with_derivatives) const {
  gather(block, state, out.u);
  const ShiftedIndices unknowns = assembly_.unknowns(block), dofs = element_dofs(block);
  const std::size_t n = unknowns.size();
  element.evaluate_at(out.u, state.lambda, out.f, with_derivatives ? out.K : nullptr,
                      with_derivatives ? out.f_lambda : nullptr);
  for (std::size_t h = 0; h < n && with_derivatives; ++h) {
    if (unknowns[h] >= 0) continue;
    const double rate = held_rate(dofs[h]);
    for (std::size_t i = 0; i < n; ++i) out.f_lambda[i] += out.stiffness(i, h, n) * rate;
  }
}

void Structure::add_driven(const Element& element, Index block, const State& state, double* F, double* K,
                           double* F_lambda) const {
  Local local;
  evaluate(element, block, state, local, K != nullptr);
  const ShiftedIndices unknowns = assembly_.unknowns(block);
  scatter(unknowns, local.f, 1.0, F);
  if (K == nullptr) return;
  assembly_.add(block, local.K, 1.0, K);
  scatter(unknowns, local.f_lambda, 1.0, F_lambda);
}

// Entry by entry: what goes to one place from one beam and from the next is far apart.
void Structure::add(const ElementOrder::Four& four, const ClassicBeamLanes& beams, const Vector& x, double* F,
                    double* K) const {
  constexpr int n = 6;
  Lanes u[n], f[n], k[n * n];
  const std::array unknowns{assembly_.unknowns(four.elements[0]), assembly_.unknowns(four.elements[1]),
                            assembly_.unknowns(four.elements[2]), assembly_.unknowns(four.elements[3])};
  if (four.shifted) {
    const std::int32_t* offset = unknowns[0].offsets();
    const auto from = [&](std::size_t lane) { return x.data() + unknowns[lane].first(); };
    const std::array at{from(0), from(1), from(2), from(3)};
    for (int i = 0; i < n; ++i) u[i] = Lanes(at[0][offset[i]], at[1][offset[i]], at[2][offset[i]], at[3][offset[i]]);
  } else {
    const auto value = [&](std::size_t lane, std::size_t i) {
      const Index unknown = unknowns[lane][i];
      return unknown >= 0 ? x[unknown] : 0.0;
    };
    for (std::size_t i = 0; i < n; ++i) u[i] = Lanes(value(0, i), value(1, i), value(2, i), value(3, i));
  }
  beams.evaluate(u, f, K != nullptr ? k : nullptr);
  if (four.shifted) {
    const std::int32_t* offset = unknowns[0].offsets();
    const auto to = [&](std::size_t lane) { return F + unknowns[lane].first(); };
    const std::array at{to(0), to(1), to(2), to(3)};
    for (int i = 0; i < n; ++i)
      for (std::size_t lane = 0; lane < at.size(); ++lane) at[lane][offset[i]] += f[i][static_cast<int>(lane)];
  } else {
    for (std::size_t lane = 0; lane < unknowns.size(); ++lane)
      scatter_entries(unknowns[lane], 1.0, F, [&](std::size_t i) { return f[i][static_cast<int>(lane)]; });
  }
  if (K == nullptr) return;
  assembly_.add_entries<n>(four.elements, four.shifted, K,
                           [&](Index entry, std::size_t lane) { return k[entry][static_cast<int>(lane)]; });
}

void Structure::add_elements(const Vector& x, double* F, double* K) const {
  for (const ElementOrder::Four& four : order_.fours) add(four, order_.beams[four.beams], x, F, K);
  Local local;
  for (const Index e : order_.others) {
    gather(e, x, local.u);
    elements_[e].evaluate(local.u, local.f, K != nullptr ? local.K : nullptr);
    scatter(assembly_.unknowns(e), local.f, 1.0, F);
    if (K != nullptr) assembly_.add(e, local.K, 1.0, K);
  }
}

void Structure::residual(const State& state, Eigen::Ref<Vector> F) const {
  F.setZero();
  nodal_.add_forces(
      state.lambda, [this](Index dof) { return unknown_or_held(dof); }, [&](Index dof) { return value(state, dof); },
      F.data());
  add_elements(state.x, F.data(), nullptr);
  for (const Index e : order_.driven) add_driven(elements_[e], e, state, F.data(), nullptr, nullptr);
  for (const ElementLoad& load : element_loads_)
    if (load.acts_on(state)) add_driven(*load.potential, load.element, state, F.data(), nullptr, nullptr);
}

// Elements of members know differences of displacements alone, and loads are dead: nodes that share no element with a
// support that holds a displacement, nor with a foundation, are translation-free, but for stiffnesses to ground. Of
// added elements nothing is known.
std::vector<bool> Structure::translation_free() const {
  std::vector<bool> held(positions_.size());
  const auto meaning_of = [&](Index dof) { return meaning_of_dof_[static_cast<std::size_t>(dof)]; };
  const auto node_of = [&](Index dof) { return static_cast<std::size_t>(meaning_of(dof).node); };
  for (Index e = 0; e < element_count(); ++e) {
    const auto dofs = element_dofs(e);
    const auto is_held = [&](Index dof) {
      const Dof which = meaning_of(dof).dof;
      return (which == Dof::x || which == Dof::z) && !unknown(dof);
    };
    const auto loads = loads_of_element(e);
    const auto is_grounded = [this](std::uint32_t load) { return element_loads_[load].is_grounded; };
    if (e >= first_added_ || dofs.any(is_held) || std::any_of(loads.begin(), loads.end(), is_grounded))
      for (std::size_t i = 0; i < dofs.size(); ++i) held[node_of(dofs[i])] = true;
  }
  std::vector<bool> result(static_cast<std::size_t>(assembly_.unknown_count()));
  for (std::size_t node = 0; node < held.size(); ++node) {
    const auto x = unknown(dof(static_cast<Index>(node), Dof::x));
    const auto z = unknown(dof(static_cast<Index>(node), Dof::z));
    if (!held[node] && x && z == *x + 1) result[static_cast<std::size_t>(*x)] = true;
  }
  return result;
}

void Structure::linearize(const State& state, Linearization& out) const {
  const Index n = assembly_.unknown_count();
  if (!out.pattern_of || out.K.cols() != n) {
    out.K = assembly_.pattern();
    out.translation_free = translation_free();
    out.pattern_of = state.active_set;
  }
  out.F.setZero(n);
  out.F_lambda.setZero(n);
  double* values = out.K.valuePtr();
  std::fill(values, values + out.K.nonZeros(), 0.0);
  nodal_.linearize(
      state.lambda, [this](Index dof) { return unknown_or_held(dof); }, [&](Index dof) { return value(state, dof); },
      out);
  add_elements(state.x, out.F.data(), values);
  const auto add = [&](const Element& element, Index block) {
    add_driven(element, block, state, out.F.data(), values, out.F_lambda.data());
  };
  for (const Index e : order_.driven) add(elements_[e], e);
  for (const ElementLoad& load : element_loads_)
    if (load.acts_on(state)) add(*load.potential, load.element);
}

double Structure::energy(const State& state) const {
  double u[Element::max_unknowns], energy = 0.0;
  const auto add = [&](const Element& element, Index block) {
    gather(block, state, u);
    energy += element.evaluate_at(u, state.lambda, nullptr, nullptr, nullptr);
  };
  for (Index e = 0; e < element_count(); ++e) add(elements_[e], e);
  for (const ElementLoad& load : element_loads_)
    if (load.acts_on(state)) add(*load.potential, load.element);
  return energy + nodal_.energy(state.lambda, [&](Index dof) { return value(state, dof); });
}

double Structure::force_roundoff() const {
  Linearization rest;
  linearize({.x = Vector::Zero(size({}))}, rest);
  double stiffness = 0.0;
  for (Index i = 0; i < rest.K.cols(); ++i)
    if (meaning(i).dof == Dof::x || meaning(i).dof == Dof::z) stiffness = std::max(stiffness, rest.K.coeff(i, i));
  return 0.1 * std::numeric_limits<double>::epsilon() * length_scale_ * stiffness;
}

// Means over all nodes and all rotations, held ones included: they count as zeros.
double Structure::weight(Dof kind) const {
  switch (kind) {
    case Dof::x:
    case Dof::z:
      return 1.0 / (double(positions_.size()) * length_scale_ * length_scale_);
    case Dof::rotation:
      return 1.0 / rotations_;
    case Dof::thickness:
    case Dof::thickness2:
      return 0.0;
  }
  return 0.0;
}

StateMetric Structure::made_metric(const std::vector<std::int32_t>& set_of_dof) const {
  StateMetric metric{.weights = Vector(size({}))};
  for (Index i = 0; i < metric.weights.size(); ++i) metric.weights[i] = weight(meaning(i).dof);
  nodal_.for_each_moved_support([&](Index dof, double rate) {
    metric.squared_motion_by_lambda += weight(meaning_of_dof(dof).dof) * rate * rate;
  });
  metric.squared_motion_by_lambda += heat_rate_ * heat_rate_;
  metric.turning_sets.reserve(dof_of_unknown_.size());
  for (const std::int32_t dof : dof_of_unknown_)
    metric.turning_sets.push_back(set_of_dof[static_cast<std::size_t>(dof)]);
  return metric;
}

std::optional<Index> Structure::unknown(Index dof) const {
  const Index i = unknown_of_dof_[static_cast<std::size_t>(dof)];
  return i < 0 ? std::nullopt : std::optional(i);
}

double Structure::value(const State& state, Index dof) const {
  const Index i = unknown_of_dof_[static_cast<std::size_t>(dof)];
  return i < 0 ? nodal_.support(dof).at(state.lambda) : state.x[i];
}

Vec2 Structure::current(const State& state, Index node) const {
  return position(node) + Vec2(value(state, dof(node, Dof::x)), value(state, dof(node, Dof::z)));
}

Structure::Meaning Structure::meaning(Index unknown) const {
  return meaning_of_dof_[static_cast<std::size_t>(dof_of_unknown_[static_cast<std::size_t>(unknown)])];
}

template <class ValueOf>
std::unique_ptr<Structure> Structure::updated_at(const ValueOf& value_of) const {
  auto moved = std::unique_ptr<Structure>(new Structure(*this));
  Local local;
  moved->elements_ = {};
  for (Index e = 0; e < element_count(); ++e) {
    const ShiftedIndices dofs = element_dofs(e);
    for (std::size_t i = 0; i < dofs.size(); ++i) local.u[i] = value_of(dofs[i]);
    moved->elements_.add(elements_[e].updated(local.u));
  }
  moved->arrange();
  return moved;
}

std::unique_ptr<Structure> Structure::updated() const {
  return updated_at([](Index) { return 0.0; });
}

std::unique_ptr<Structure> Structure::updated(const State& state) const {
  return updated_at([&](Index dof) { return value(state, dof); });
}

bool Structure::can_be_updated() const {
  const Local rest{};
  for (Index e = 0; e < element_count(); ++e)
    if (elements_[e].updated(rest.u) == nullptr) return false;
  return true;
}

template <class Visit>
void Structure::for_each_with(Index dof, const State& state, const Visit& visit) const {
  const auto has = [&](Index e) { return element_dofs(e).place_of(dof) < element_dofs(e).size(); };
  for (Index e = 0; e < element_count(); ++e)
    if (has(e)) visit(elements_[e], e);
  for (const ElementLoad& load : element_loads_)
    if (load.acts_on(state) && has(load.element)) visit(*load.potential, load.element);
}

double Structure::reaction(const State& state, Index dof) const {
  if (unknown(dof)) return 0.0;
  Local local;
  double force = nodal_.support_force(dof, state.lambda, [&](Index of) { return value(state, of); });
  for_each_with(dof, state, [&](const Element& element, Index block) {
    evaluate(element, block, state, local, false);
    force += local.f[element_dofs(block).place_of(dof)];
  });
  return force;
}

Row Structure::reaction_gradient(const State& state, Index dof) const {
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  if (unknown(dof)) return row;
  Local local;
  nodal_.add_support_force_gradient(
      dof, state.lambda, [this](Index of) { return unknown_or_held(of); }, [&](Index of) { return value(state, of); },
      row.dx, row.dlambda);
  for_each_with(dof, state, [&](const Element& element, Index block) {
    evaluate(element, block, state, local, true);
    const std::size_t n = element_dofs(block).size(), i = element_dofs(block).place_of(dof);
    const ShiftedIndices unknowns = assembly_.unknowns(block);
    for (std::size_t j = 0; j < n; ++j)
      if (unknowns[j] >= 0) row.dx[unknowns[j]] += local.stiffness(i, j, n);
    row.dlambda += local.f_lambda[i];
  });
  return row;
}

}  // namespace arcwall
