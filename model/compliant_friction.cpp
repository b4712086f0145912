#include "model/compliant_friction.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/hermite_integral.hpp"

namespace arcwall {

namespace {

constexpr std::size_t points_each = WallPressure::rubbing_points;

// Of a force to its bound below which they are one, as where points reach their bounds together but for round-off.
constexpr double at_bound = 1e-9;

double within_a_round(double difference, double round) {
  return round > 0.0 ? difference - round * std::round(difference / round) : difference;
}

// ∫ μ P |dw| over a step of that length, with Hermite's cubics of μ P and of the slip.
double dissipated_over(const SlipLayout::Point& from, const SlipLayout::Point& to, double slip, double length) {
  const HermiteCubic most{
      .from = from.most, .from_rate = length * from.most_rate, .to = to.most, .to_rate = length * to.most_rate};
  const HermiteCubic way{
      .from = 0.0, .from_rate = length * from.slip_rate, .to = slip, .to_rate = length * to.slip_rate};
  return std::abs(integral(most, way));
}

}  // namespace

// The unknowns of an element at a state.
struct CompliantFriction::Local {
  ShiftedIndices dofs;
  double u[Element::max_unknowns];
};

// What holds a point.
struct CompliantFriction::Held {
  double stiffness = 0.0;  // k
  double most = 0.0;
  double trial = 0.0;  // e
  double force = 0.0;
  int sense = 0;  // of its slip; 0: it sticks

  double energy() const { return 0.5 * trial * trial / stiffness; }               // at a fixed slip
  double slip() const { return sense == 0 ? 0.0 : (force - trial) / stiffness; }  // since it was committed
};

CompliantFriction::CompliantFriction(const Structure& structure, std::vector<Pressed> pressed, std::size_t contacts)
    : structure_(structure), pressed_(std::move(pressed)) {
  rest_ = std::make_shared<const SlipLayout>(std::vector<SlipLayout::Point>(points_each * pressed_.size()),
                                             std::vector<double>(contacts, 0.0));
}

const SlipLayout& CompliantFriction::history(const State& state) const {
  const auto* layout = dynamic_cast<const SlipLayout*>(state.active_set.layout().get());
  return layout != nullptr ? *layout : *rest_;
}

bool CompliantFriction::acts(const State& state, const Pressed& pressed) const {
  return pressed.contact >= state.active_set.contacts() || state.active_set[pressed.contact] != 0;
}

std::size_t CompliantFriction::first_point(const Pressed& pressed) const {
  return points_each * static_cast<std::size_t>(&pressed - pressed_.data());
}

CompliantFriction::Local CompliantFriction::local(const State& state, const Pressed& pressed) const {
  Local at{.dofs = structure_.element_dofs(pressed.element), .u = {}};
  for (std::size_t i = 0; i < at.dofs.size(); ++i) at.u[i] = structure_.value(state, at.dofs[i]);
  return at;
}

CompliantFriction::Held CompliantFriction::held(const Pressed& pressed, const WallPressure::Rubbed& at,
                                                const SlipLayout::Point& before) const {
  Held held{.stiffness = pressed.stiffness * at.length, .most = pressed.coefficient * at.force};
  if (before.is_known && at.faces_wall)
    held.trial = before.force - held.stiffness * within_a_round(at.place - before.place, pressed.round);
  const double size = std::abs(held.trial);
  if (size > held.most || (size == held.most && before.sense != 0)) held.sense = held.trial < 0.0 ? 1 : -1;
  held.force = held.sense == 0 ? held.trial : -held.sense * held.most;
  return held;
}

// Calls visit(pressed, local, rubbed, numbers of the first point) for each element that a closed wall presses.
template <class Visit>
void CompliantFriction::for_each_pressed(const State& state, const Visit& visit) const {
  for (const Pressed& pressed : pressed_) {
    if (!acts(state, pressed)) continue;
    const Local at = local(state, pressed);
    const auto rubbed = pressed.pressure->rubbed(at.u, state.lambda);
    if (std::any_of(rubbed.begin(), rubbed.end(), [](const auto& point) { return point.force > 0.0; }))
      visit(pressed, at, rubbed);
  }
}

void CompliantFriction::add(const State& state, Eigen::Ref<Vector> F) const {
  const std::vector<SlipLayout::Point>& before = history(state).points();
  for_each_pressed(state, [&](const Pressed& pressed, const Local& at, const auto& rubbed) {
    for (std::size_t p = 0; p < points_each; ++p) {
      if (!(rubbed[p].force > 0.0)) continue;
      const double T = held(pressed, rubbed[p], before[first_point(pressed) + p]).force;
      for (std::size_t i = 0; i < at.dofs.size(); ++i)
        if (const auto unknown = structure_.unknown(at.dofs[i])) F[*unknown] -= T * rubbed[p].place_by[i];
    }
  });
}

// With ∇ by the unknowns: F has −T ∇σ. While points stick it has the derivative k ∇σ ∇σᵀ − T ∇∇σ, which goes to K; the
// rest of what slips, where T = −s μ P, is ∇σ (s μ ∇P − k ∇σ)ᵀ. Of a motion in which a point sticks in part, the work
// −Ṫ σ̇ is no less than s μ σ̇ Ṗ − (μ Ṗ)²/4k (Raniecki and Bruhns 1981).
void CompliantFriction::add(const State& state, Linearization& out) const {
  using Local_square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, Element::max_unknowns,
                                     Element::max_unknowns>;
  using Local_vector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, Element::max_unknowns, 1>;
  const std::vector<SlipLayout::Point>& before = history(state).points();
  std::vector<Eigen::Triplet<double, SparseIndex>> slipping, lost;
  for_each_pressed(state, [&](const Pressed& pressed, const Local& at, const auto& rubbed) {
    const auto n = static_cast<Index>(at.dofs.size());
    Local_square K = Local_square::Zero(n, n), N = K, W = K;
    Local_vector F = Local_vector::Zero(n), F_lambda = F;
    bool slips = false;
    for (std::size_t p = 0; p < points_each; ++p) {
      const WallPressure::Rubbed& point = rubbed[p];
      if (!(point.force > 0.0)) continue;
      const Held now = held(pressed, point, before[first_point(pressed) + p]);
      const Local_vector place = Eigen::Map<const Vector>(point.place_by.data(), n);
      const double k = now.stiffness;
      F -= now.force * place;
      pressed.pressure->add_second_of_place(at.u, state.lambda, p, -now.force, K.data(), F_lambda.data());
      K += k * place * place.transpose();
      if (now.sense == 0) {
        F_lambda += k * point.place_rate * place;
        continue;
      }
      slips = true;
      const Local_vector bound = pressed.coefficient * Eigen::Map<const Vector>(point.force_by.data(), n);
      N += place * (now.sense * bound - k * place).transpose();
      W += 0.25 / k * bound * bound.transpose();
      F_lambda += now.sense * pressed.coefficient * point.force_rate * place;
    }
    const Local_square symmetric = K.template selfadjointView<Eigen::Lower>();
    for (Index a = 0; a < n; ++a) {
      const auto row = structure_.unknown(at.dofs[static_cast<std::size_t>(a)]);
      if (!row) continue;
      out.F[*row] += F[a];
      out.F_lambda[*row] += F_lambda[a];
      for (Index b = 0; b < n; ++b) {
        const Index dof = at.dofs[static_cast<std::size_t>(b)];
        const auto column = structure_.unknown(dof);
        if (!column) {
          out.F_lambda[*row] += (symmetric(a, b) + N(a, b)) * structure_.held_rate(dof);
          continue;
        }
        if (*row >= *column) out.K.coeffRef(*row, *column) += symmetric(a, b);
        if (!slips) continue;
        const auto i = static_cast<SparseIndex>(*row), j = static_cast<SparseIndex>(*column);
        slipping.emplace_back(i, j, N(a, b));
        if (i >= j) lost.emplace_back(i, j, W(a, b));
      }
    }
  });
  const Index size = slipping.empty() ? 0 : out.K.cols();
  for (auto [matrix, entries] : {std::pair(&out.N, &slipping), std::pair(&out.work_lost, &lost)}) {
    matrix->resize(size, size);
    matrix->setFromTriplets(entries->begin(), entries->end());
  }
}

double CompliantFriction::energy(const State& state) const {
  const std::vector<SlipLayout::Point>& before = history(state).points();
  double energy = 0.0;
  for_each_pressed(state, [&](const Pressed& pressed, const Local&, const auto& rubbed) {
    for (std::size_t p = 0; p < points_each; ++p) {
      if (!(rubbed[p].force > 0.0)) continue;
      energy += held(pressed, rubbed[p], before[first_point(pressed) + p]).energy();
    }
  });
  return energy;
}

State CompliantFriction::with(const State& state, std::vector<SlipLayout::Point> points,
                              std::vector<double> dissipated) const {
  const ActiveSet& old = state.active_set;
  ActiveSet active_set(old.size(), 0, std::make_shared<const SlipLayout>(std::move(points), std::move(dissipated)));
  for (std::size_t j = 0; j < old.size(); ++j) active_set[j] = old[j];
  return {.x = state.x, .lambda = state.lambda, .active_set = std::move(active_set)};
}

// μ Ṗ and the rate of slip of a point that slips, along a direction.
CompliantFriction::Rates CompliantFriction::rates(const Pressed& pressed, const WallPressure::Rubbed& at, int sense,
                                                  const Direction& direction) const {
  Rates rates{.place = along(pressed, at.place_by.data(), at.place_rate, direction),
              .most = pressed.coefficient * along(pressed, at.force_by.data(), at.force_rate, direction)};
  if (sense != 0) rates.slip = rates.place - sense * rates.most / (pressed.stiffness * at.length);
  return rates;
}

// A slip dissipates ∫ μ P |dw|.
State CompliantFriction::committed(const State& state, const Direction& arrives, double length) const {
  const SlipLayout& old = history(state);
  std::vector<SlipLayout::Point> points = old.points();
  std::vector<double> dissipated = old.dissipated();
  for (const Pressed& pressed : pressed_) {
    const Local at = local(state, pressed);
    auto rubbed = pressed.pressure->rubbed(at.u, state.lambda);
    for (std::size_t p = 0; p < points_each; ++p) {
      if (!acts(state, pressed)) rubbed[p].force = 0.0;
      SlipLayout::Point& point = points[first_point(pressed) + p];
      const SlipLayout::Point before = point;
      const Held now = held(pressed, rubbed[p], point);
      const double slip = now.slip();
      if (before.most > 0.0 || now.most > 0.0) {
        const Rates here = rates(pressed, rubbed[p], now.sense, arrives);
        dissipated[pressed.contact] +=
            dissipated_over(before, {.most = now.most, .most_rate = here.most, .slip_rate = here.slip}, slip, length);
      }
      point = {.place = rubbed[p].place,
               .force = now.force,
               .most = now.most,
               .slip = (before.most > 0.0 ? before.slip : 0.0) + (before.most > 0.0 || now.most > 0.0 ? slip : 0.0),
               .is_known = rubbed[p].faces_wall};
      if (!(now.most > 0.0) || std::abs(now.force) < (1.0 - at_bound) * now.most) continue;
      point.sense = now.sense;  // that the tangent at hand knows
      point.force = now.force < 0.0 ? -now.most : now.most;
    }
  }
  return with(state, std::move(points), std::move(dissipated));
}

// |e| grows by s k σ̇ where s is the sense in which the point may slip, its bound by μ Ṗ.
PathHistory::Leaving CompliantFriction::leaving(const State& state, const Direction& direction, bool one) const {
  constexpr double noise = 1e-9;  // of the two
  const SlipLayout& old = history(state);
  std::vector<SlipLayout::Point> points = old.points();
  bool has_changed = false;
  for (const Pressed& pressed : pressed_) {
    const auto is_pressed = [&](std::size_t p) { return points[first_point(pressed) + p].most > 0.0; };
    bool any = false;
    for (std::size_t p = 0; p < points_each; ++p) any = any || is_pressed(p);
    if (!any) continue;
    const auto rubbed = pressed.pressure->rubbed(local(state, pressed).u, state.lambda);
    for (std::size_t p = 0; p < points_each; ++p) {
      if (!is_pressed(p)) continue;
      SlipLayout::Point& point = points[first_point(pressed) + p];
      const double k = pressed.stiffness * rubbed[p].length;
      if (std::abs(point.force) == point.most && !(one && has_changed)) {
        const int sense = point.force < 0.0 ? 1 : -1;
        const Rates rate = rates(pressed, rubbed[p], sense, direction);
        const double driven = sense * k * rate.place, over = driven - rate.most;
        const bool is_sure = std::abs(over) > noise * (std::abs(driven) + std::abs(rate.most));
        const int next = !is_sure ? point.sense : over > 0.0 ? sense : 0;
        has_changed = has_changed || next != point.sense;
        point.sense = next;
      }
      const Rates rate = rates(pressed, rubbed[p], point.sense, direction);
      point.most_rate = rate.most;
      point.slip_rate = rate.slip;
    }
  }
  return {.state = with(state, std::move(points), old.dissipated()), .has_changed = has_changed};
}

double CompliantFriction::along(const Pressed& pressed, const double* by_unknowns, double rate,
                                const Direction& direction) const {
  const ShiftedIndices dofs = structure_.element_dofs(pressed.element);
  double sum = rate * direction.dlambda;
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    const auto unknown = structure_.unknown(dofs[i]);
    sum += by_unknowns[i] * (unknown ? direction.dx[*unknown] : structure_.held_rate(dofs[i]) * direction.dlambda);
  }
  return sum;
}

Row CompliantFriction::row(const State& state, const Pressed& pressed, const double* by_unknowns, double rate) const {
  Row row{.dx = Vector::Zero(state.x.size()), .dlambda = rate};
  const ShiftedIndices dofs = structure_.element_dofs(pressed.element);
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    if (const auto unknown = structure_.unknown(dofs[i]))
      row.dx[*unknown] += by_unknowns[i];
    else
      row.dlambda += by_unknowns[i] * structure_.held_rate(dofs[i]);
  }
  return row;
}

std::vector<CompliantFriction::Point> CompliantFriction::points(const State& state) const {
  const std::vector<SlipLayout::Point>& before = history(state).points();
  std::vector<Point> points;
  for_each_pressed(state, [&](const Pressed& pressed, const Local&, const auto& rubbed) {
    for (std::size_t p = 0; p < points_each; ++p) {
      if (!(rubbed[p].force > 0.0)) continue;
      const SlipLayout::Point& of = before[first_point(pressed) + p];
      const Held now = held(pressed, rubbed[p], of);
      points.push_back({.pressed = &pressed,
                        .number = p,
                        .fraction = std::lerp(pressed.from, pressed.to, WallPressure::rubbing_point(p)),
                        .force = now.force,
                        .most = now.most,
                        .slip = (of.most > 0.0 ? of.slip : 0.0) + now.slip(),
                        .place = rubbed[p].place,
                        .sense = now.sense});
    }
  });
  return points;
}

CompliantFriction::Rows CompliantFriction::rows(const State& state, const Point& point) const {
  const Pressed& pressed = *point.pressed;
  const auto rubbed = pressed.pressure->rubbed(local(state, pressed).u, state.lambda)[point.number];
  const double k = pressed.stiffness * rubbed.length;
  const Row place = row(state, pressed, rubbed.place_by.data(), rubbed.place_rate);
  Rows rows{.most = row(state, pressed, rubbed.force_by.data(), rubbed.force_rate)};
  rows.most.dx *= pressed.coefficient;
  rows.most.dlambda *= pressed.coefficient;
  const Vector none = Vector::Zero(state.x.size());
  if (point.sense == 0) {
    rows.force = {.dx = -k * place.dx, .dlambda = -k * place.dlambda};
    rows.slip = {.dx = none, .dlambda = 0.0};
  } else {
    rows.force = {.dx = -point.sense * rows.most.dx, .dlambda = -point.sense * rows.most.dlambda};
    rows.slip = {.dx = place.dx + rows.force.dx / k, .dlambda = place.dlambda + rows.force.dlambda / k};
  }
  return rows;
}

void CompliantFriction::add_action(const State& state, const Point& point, const Vec2& about, WallAction& to) const {
  const Pressed& pressed = *point.pressed;
  const Local at = local(state, pressed);
  const auto rubbed = pressed.pressure->rubbed(at.u, state.lambda)[point.number];
  const double k = pressed.stiffness * rubbed.length;
  WallPressure::ForceAlong T{.value = point.force};
  const bool slips = point.sense != 0;
  const double by_force = -point.sense * pressed.coefficient;
  T.rate = slips ? by_force * rubbed.force_rate : -k * rubbed.place_rate;
  for (std::size_t i = 0; i < at.dofs.size(); ++i)
    T.by_unknowns[i] = slips ? by_force * rubbed.force_by[i] : -k * rubbed.place_by[i];
  const auto resultant = pressed.pressure->friction_resultant(at.u, state.lambda, point.number, T, about);
  for (std::size_t i = 0; i < to.value.size(); ++i) {
    to.value[i] += resultant.value[i];
    const Row added = row(state, pressed, resultant.by_unknowns[i].data(), resultant.rate[i]);
    to.gradient[i].dx += added.dx;
    to.gradient[i].dlambda += added.dlambda;
  }
}

std::vector<CompliantFriction::OnElement> CompliantFriction::on_elements(const State& state) const {
  const std::vector<SlipLayout::Point>& before = history(state).points();
  std::vector<OnElement> elements;
  for_each_pressed(state, [&](const Pressed& pressed, const Local& at, const auto& rubbed) {
    const auto n = static_cast<Index>(at.dofs.size());
    OnElement on{.element = pressed.element, .gradient = Vector::Zero(n), .stiffness = Matrix::Zero(n, n)};
    Vector by_lambda = Vector::Zero(n);
    for (std::size_t p = 0; p < points_each; ++p) {
      if (!(rubbed[p].force > 0.0)) continue;
      const Held now = held(pressed, rubbed[p], before[first_point(pressed) + p]);
      const Vector place = Eigen::Map<const Vector>(rubbed[p].place_by.data(), n);
      on.energy += now.energy();
      on.gradient -= now.trial * place;
      pressed.pressure->add_second_of_place(at.u, state.lambda, p, -now.trial, on.stiffness.data(), by_lambda.data());
      on.stiffness += now.stiffness * place * place.transpose();
    }
    on.stiffness = Matrix(on.stiffness.selfadjointView<Eigen::Lower>());
    elements.push_back(std::move(on));
  });
  return elements;
}

double CompliantFriction::force_on(const State& state, Index dof) const {
  const std::vector<SlipLayout::Point>& before = history(state).points();
  double sum = 0.0;
  for_each_pressed(state, [&](const Pressed& pressed, const Local& at, const auto& rubbed) {
    for (std::size_t i = 0; i < at.dofs.size(); ++i)
      for (std::size_t p = 0; p < points_each && at.dofs[i] == dof; ++p)
        if (rubbed[p].force > 0.0)
          sum += held(pressed, rubbed[p], before[first_point(pressed) + p]).force * rubbed[p].place_by[i];
  });
  return sum;
}

Row CompliantFriction::force_on_gradient(const State& state, Index dof) const {
  Row sum{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  for (const Point& point : points(state)) {
    const Local at = local(state, *point.pressed);
    const std::size_t n = at.dofs.size();
    std::size_t i = 0;
    while (i < n && at.dofs[i] != dof) ++i;
    if (i == n) continue;
    std::array<double, Element::max_unknowns * Element::max_unknowns> K{};
    std::array<double, Element::max_unknowns> by_lambda{}, by_unknowns{};
    point.pressed->pressure->add_second_of_place(at.u, state.lambda, point.number, point.force, K.data(),
                                                 by_lambda.data());
    for (std::size_t k = 0; k < n; ++k) by_unknowns[k] = K[std::max(i, k) + n * std::min(i, k)];
    const Row turned = row(state, *point.pressed, by_unknowns.data(), by_lambda[i]);
    const Row T = rows(state, point).force;
    const double along = point.pressed->pressure->rubbed(at.u, state.lambda)[point.number].place_by[i];
    sum.dx += turned.dx + along * T.dx;
    sum.dlambda += turned.dlambda + along * T.dlambda;
  }
  return sum;
}

Vec2 CompliantFriction::tangent(const State& state, const Point& point) const {
  return point.pressed->pressure->tangent(local(state, *point.pressed).u, state.lambda, point.number);
}

State CompliantFriction::without_dissipation(const State& state) const {
  const SlipLayout& before = history(state);
  return with(state, before.points(), std::vector<double>(before.dissipated().size(), 0.0));
}

double CompliantFriction::dissipated(const State& state, std::size_t contact) const {
  return history(state).dissipated()[contact];
}

// By how much a point's elastic force exceeds its bound.
class CompliantFriction::PastBound final : public Observable {
 public:
  PastBound(const CompliantFriction& of, const Pressed& pressed, std::size_t point)
      : of_(of), pressed_(pressed), point_(point) {}
  double value(const State& state) const override {
    const Held now = held(state, rubbed(state));
    return std::abs(now.trial) - now.most;
  }
  Row gradient(const State& state) const override {
    const WallPressure::Rubbed at = rubbed(state);
    const Held now = held(state, at);
    const double by_place = (now.trial < 0.0 ? 1.0 : -1.0) * now.stiffness;
    std::array<double, Element::max_unknowns> by_unknowns{};
    for (std::size_t i = 0; i < by_unknowns.size(); ++i)
      by_unknowns[i] = by_place * at.place_by[i] - pressed_.coefficient * at.force_by[i];
    return of_.row(state, pressed_, by_unknowns.data(),
                   by_place * at.place_rate - pressed_.coefficient * at.force_rate);
  }

 private:
  WallPressure::Rubbed rubbed(const State& state) const {
    return pressed_.pressure->rubbed(of_.local(state, pressed_).u, state.lambda)[point_];
  }
  Held held(const State& state, const WallPressure::Rubbed& at) const {
    return of_.held(pressed_, at, of_.history(state).points()[of_.first_point(pressed_) + point_]);
  }

  const CompliantFriction& of_;
  const Pressed& pressed_;
  std::size_t point_;
};

std::optional<PathKink> CompliantFriction::kink_between(const State& from, const State& to) const {
  const std::vector<SlipLayout::Point>& before = history(from).points();
  double first = infinity;
  std::optional<PathKink> kink;
  for_each_pressed(to, [&](const Pressed& pressed, const Local&, const auto& rubbed) {
    for (std::size_t p = 0; p < points_each; ++p) {
      const SlipLayout::Point& point = before[first_point(pressed) + p];
      if (!(point.most > 0.0) || point.sense != 0 || !(rubbed[p].force > 0.0)) continue;
      const Held now = held(pressed, rubbed[p], point);
      if (now.sense == 0) continue;
      const double left = point.most - std::abs(point.force), over = std::abs(now.trial) - now.most;
      const double at = left / (left + over);
      if (at >= first) continue;
      first = at;
      kink = PathKink{.past = std::make_shared<PastBound>(*this, pressed, p), .is_slight = true};
    }
  });
  return kink;
}

}  // namespace arcwall
