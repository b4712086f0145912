#include "continuation/event_curves/event_condition.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "continuation/step/corrector.hpp"

namespace arcwall {

namespace {

constexpr double null_vectors_beside =
    1e-7;  // of λ₀: where K is singular to the last digit null vectors come from beside

// [J F_λ]ᵀ w
Row transposed_product(const Linearization& equations, const Vector& w) {
  const Index n = equations.K.cols(), m = equations.B.cols();
  Row row{.dx = Vector(n + m), .dlambda = equations.F_lambda.dot(w)};
  row.dx.head(n).noalias() = equations.K.selfadjointView<Eigen::Lower>() * w.head(n);
  if (m > 0) {
    row.dx.head(n).noalias() += equations.C.leftCols(n).transpose() * w.tail(m);
    row.dx.tail(m) = equations.B.transpose() * w.head(n) + equations.C.rightCols(m).transpose() * w.tail(m);
  }
  return row;
}

// J d_x + F_λ d_λ
Vector applied(const Linearization& equations, const Direction& d) {
  return product(equations, d.dx).col(0) + d.dlambda * equations.F_lambda;
}

Row& add(Row& sum, double factor, const Row& row) {
  sum.dx += factor * row.dx;
  sum.dlambda += factor * row.dlambda;
  return sum;
}

// How good derivatives of an event's equation are: good enough for Newton's method, or such that the tangent of the
// curve is, which those of a crossing make alone.
enum class Differences { simple, fine };

struct Place {
  double offset, weight;  // in steps
};
constexpr Place fourth_order[] = {{1.0, 2.0 / 3.0}, {-1.0, -2.0 / 3.0}, {2.0, -1.0 / 12.0}, {-2.0, 1.0 / 12.0}};

// The derivative along d of a function that gives rows. Over h a difference of second order would be off by EA h²
// beside EI, which makes Newton's method slow for slender members.
template <typename Function>
Row rows_differenced_along(const Metric& metric, const State& state, const Direction& d, Differences how,
                           const Function& f) {
  constexpr double simple_step = 1e-4, fine_step = 1e-3;  // [path metric]
  const double length = metric.norm(d), greatest = d.dx.size() > 0 ? d.dx.cwiseAbs().maxCoeff() : 0.0;
  Row sum{.dx = Vector::Zero(state.x.size()), .dlambda = 0.0};
  if (length == 0.0 && greatest == 0.0) return sum;
  // Forces alone have no length, and equations are linear in them.
  const double h = length > 0.0 ? (how == Differences::fine ? fine_step : simple_step) / length : 1.0 / greatest;
  for (const Place& place : fourth_order) add(sum, place.weight / h, f(moved(state, d, place.offset * h)));
  return sum;
}

// The matrix A with a factorization of K, and its transpose, for which the border of the equations changes places.
class BorderedMatrix {
 public:
  BorderedMatrix(const SystemFamily::Member& at, Linearization& equations, Vector f, Row r,
                 const MakeFactorization& make)
      : equations_(equations),
        f_(std::move(f)),
        r_(std::move(r)),
        multipliers_(at.system->multiplier_count(at.state.active_set)),
        solver_(make),
        transposed_solver_(make) {
    solver_.factorize(equations_, multipliers_);
  }

  // A X = (top, last)
  std::optional<Direction> solve(const Vector& top, double last) {
    return with_column(f_, [&] { return solver_.solve(r_, top, last); });
  }

  // Aᵀ P = (top, last)
  std::optional<Direction> solve_transposed(const Vector& top, double last) {
    const Row row{.dx = f_, .dlambda = r_.dlambda};
    if (equations_.B.cols() == 0) return with_column(r_.dx, [&] { return solver_.solve(row, top, last); });
    if (transposed_.B.cols() == 0) transpose();
    return transposed_solver_.solve(row, top, last);
  }

 private:
  void transpose() {
    const Index n = equations_.K.cols(), m = equations_.B.cols();
    transposed_.K = equations_.K;
    transposed_.F = equations_.F;
    transposed_.B = equations_.C.leftCols(n).transpose();
    transposed_.C.resize(m, n + m);
    transposed_.C << equations_.B.transpose(), equations_.C.rightCols(m).transpose();
    transposed_.holding = equations_.holding;
    transposed_.border_rates = equations_.border_rates;
    transposed_.translation_free = equations_.translation_free;
    transposed_.ground = equations_.ground;
    transposed_.F_lambda = r_.dx;
    transposed_solver_.factorize(transposed_, multipliers_);
  }

  template <typename Solve>
  std::optional<Direction> with_column(const Vector& column, const Solve& solve) {
    Vector F_lambda = std::exchange(equations_.F_lambda, column);
    std::optional<Direction> solution = solve();
    equations_.F_lambda = std::move(F_lambda);
    if (solution && !(solution->dx.allFinite() && std::isfinite(solution->dlambda))) solution.reset();
    return solution;
  }

  Linearization& equations_;
  Vector f_;
  Row r_;
  Index multipliers_;
  BorderedSolver solver_;
  Linearization transposed_;  // where the equations have a border, once it is asked for
  BorderedSolver transposed_solver_;
};

// Whether the border is that of J's null vectors.
bool is_of_mode(const EventBorder& border) { return border.column.size() > 0; }

BorderedMatrix matrix_of(const SystemFamily::Member& at, const EventBorder& border, Linearization& equations,
                         const MakeFactorization& make) {
  return {at, equations, is_of_mode(border) ? border.column : equations.F_lambda, border.row, make};
}

// A scalar σ of A with  dσ = −wᵀ (dJ d_x + dF_λ d_λ).
struct BorderedScalar {
  double value = 0.0;
  Vector w{};
  Direction d{};
};

// The equations of a sample, and what they count in the derivative by κ.
struct WeightedEquations {
  double weight = 0.0;
  Linearization equations{};
};

std::vector<WeightedEquations> equations_of(std::vector<WeightedMember>& samples, Differences how) {
  std::vector<WeightedEquations> list;
  for (WeightedMember& sample : samples) {
    const double weight = how == Differences::fine ? sample.weight : sample.few;
    if (weight == 0.0) continue;
    WeightedEquations& one = list.emplace_back();
    one.weight = weight;
    sample.member.system->linearize(sample.member.state, one.equations);
    sample.F = one.equations.F;
  }
  return list;
}

// The derivative of F in two directions is symmetric in them: −∂σ/∂z is the derivative of [J F_λ]ᵀ w along d.
EventEquation equation_of(const BorderedScalar& scalar, const SystemFamily::Member& at,
                          const std::vector<WeightedEquations>& samples, const Metric& metric, Differences how) {
  Linearization workspace;
  EventEquation equation{.value = scalar.value};
  equation.row = rows_differenced_along(metric, at.state, scalar.d, how, [&](const State& state) {
    at.system->linearize(state, workspace);
    return transposed_product(workspace, scalar.w);
  });
  equation.row.dx = -equation.row.dx;
  equation.row.dlambda = -equation.row.dlambda;
  for (const WeightedEquations& sample : samples)
    equation.by_kappa -= sample.weight * scalar.w.dot(applied(sample.equations, scalar.d));
  return equation;
}

// What turns: m′ = ∇m · t with A t = (0, 1), Aᵀ P = ∇m; λ itself has ∇m = (0, 1).
std::optional<std::vector<EventEquation>> turning_equation(const SystemFamily::Member& at, const EventBorder& border,
                                                           BorderedMatrix& A, std::vector<WeightedMember>& samples,
                                                           const Metric& metric) {
  Row gradient{.dx = Vector::Zero(at.state.x.size()), .dlambda = 1.0};
  if (at.watched) gradient = at.watched->gradient(at.state);
  auto t = A.solve(Vector::Zero(at.state.x.size()), 1.0);
  const auto P = A.solve_transposed(border.scale * gradient.dx, border.scale * gradient.dlambda);
  if (!t || !P) return std::nullopt;
  EventEquation equation = equation_of({.value = border.scale * apply(gradient, *t), .w = P->dx, .d = *t}, at,
                                       equations_of(samples, Differences::simple), metric, Differences::simple);
  if (at.watched) {
    add(equation.row, border.scale,
        rows_differenced_along(metric, at.state, *t, Differences::simple,
                               [&](const State& state) { return at.watched->gradient(state); }));
    for (const WeightedMember& sample : samples)
      equation.by_kappa += border.scale * sample.weight * sample.member.watched->rate(sample.member.state, *t);
  }
  return std::vector{std::move(equation)};
}

// A limit point that is, or nearly is, an asymmetric branch point: σ vanishes in A (v, σ) = (0, 1); Aᵀ (w, σ) = (0, 1).
// That says no more than that J is singular, and is regular there, where the path has two directions.
std::optional<std::vector<EventEquation>> limit_equation(const SystemFamily::Member& at, BorderedMatrix& A,
                                                         std::vector<WeightedMember>& samples, const Metric& metric) {
  const Vector zero = Vector::Zero(at.state.x.size());
  const auto right = A.solve(zero, 1.0), left = A.solve_transposed(zero, 1.0);
  if (!right || !left) return std::nullopt;
  return std::vector{equation_of({.value = right->dlambda, .w = left->dx, .d = {.dx = right->dx, .dlambda = 0.0}}, at,
                                 equations_of(samples, Differences::simple), metric, Differences::simple)};
}

// A crossing: both σ₁ and σ₂ vanish in A (v₁, σ₁) = (0, 1) and A (v₂, σ₂) = (−F_λ, 0); Aᵀ (w, σ₁) = (0, 1).
std::optional<std::vector<EventEquation>> crossing_equations(const SystemFamily::Member& at, BorderedMatrix& A,
                                                             const Vector& F_lambda,
                                                             std::vector<WeightedMember>& samples,
                                                             const Metric& metric) {
  const Vector zero = Vector::Zero(at.state.x.size());
  const auto first = A.solve(zero, 1.0), second = A.solve(-F_lambda, 0.0), left = A.solve_transposed(zero, 1.0);
  if (!first || !second || !left) return std::nullopt;
  const std::vector<WeightedEquations> of_samples = equations_of(samples, Differences::fine);
  const auto of = [&](const Direction& solution, double dlambda) {
    return equation_of({.value = solution.dlambda, .w = left->dx, .d = {.dx = solution.dx, .dlambda = dlambda}}, at,
                       of_samples, metric, Differences::fine);
  };
  return std::vector{of(*first, 0.0), of(*second, 1.0)};
}

// The null vector of K nearest zero and what goes with it; the corrector is at the state beside.
std::optional<NearNull> critical_pair(Corrector& corrector, const SystemFamily::Member& at, const Metric& metric) {
  const Direction across{.dx = Vector::Zero(at.state.x.size()), .dlambda = 1.0};
  for (const double beside : {0.0, null_vectors_beside, -null_vectors_beside}) {
    const State here = moved(at.state, across, beside * metric.lambda_scale());
    corrector.inspect(here, metric, across);
    auto pairs = corrector.near_null(here, metric.weights(), 1);
    if (pairs && pairs->vectors->cols() > 0) return pairs;
  }
  return std::nullopt;
}

Direction in_x(Vector dx) { return {.dx = std::move(dx), .dlambda = 0.0}; }

std::optional<EventBorder> border_of_mode(const SystemFamily::Member& at, const Metric& metric, Corrector& corrector,
                                          const Vector& mode) {
  const Vector left = corrector.left_null(mode);
  auto right = corrector.right_null(left);
  if (!right) return std::nullopt;
  const Direction phi = in_x(std::move(*right)), psi = in_x(left);
  const Linearization& equations = corrector.factorized().equations();
  const double load = metric.dual_norm(equations.F_lambda) * metric.lambda_scale();
  EventBorder border{.row = metric.row(unit(metric, phi))};
  border.column = load / metric.norm(psi) * metric.weights().cwiseProduct(psi.dx);
  if (!(metric.norm(phi) > 0.0) || !border.column.allFinite() || at.state.x.size() != border.column.size())
    return std::nullopt;
  return border;
}

// Whether F_λ does next to no work along the left null vector: where it does none branches cross.
bool load_does_no_work(Corrector& corrector, const Metric& metric, const Vector& mode) {
  constexpr double next_to_none = 1e-4;  // of the most that it could do
  const Vector left = corrector.left_null(mode), &F_lambda = corrector.factorized().equations().F_lambda;
  return std::abs(left.dot(F_lambda)) <= next_to_none * metric.norm(in_x(left)) * metric.dual_norm(F_lambda);
}

// The direction of the path at a limit point is r, which keeps its sense.
void keep_sense(const Direction& before, EventBorder& border) {
  if (!(apply(border.row, before) < 0.0)) return;
  border.row.dx = -border.row.dx;
  border.row.dlambda = -border.row.dlambda;
}

}  // namespace

std::optional<EventBorder> event_border(Criterion criterion, const SystemFamily::Member& at, const Metric& metric,
                                        const MakeFactorization& make, const Direction* before) {
  Corrector corrector(*at.system, {}, metric.lambda_scale(), make);
  Direction along{.dx = Vector::Zero(at.state.x.size()), .dlambda = 1.0};
  if (before != nullptr) along = *before;
  if (criterion == Criterion::crossing || (criterion == Criterion::turning && !at.watched)) {
    const auto pair = critical_pair(corrector, at, metric);
    if (!pair) return std::nullopt;
    const bool crosses = criterion == Criterion::crossing;
    const Vector mode = pair->vectors->col(0);
    if (crosses || load_does_no_work(corrector, metric, mode)) {
      auto border = border_of_mode(at, metric, corrector, mode);
      if (border && before != nullptr && !crosses) keep_sense(*before, *border);
      return border;
    }
    if (before == nullptr) {
      along = in_x(Vector::Zero(at.state.x.size()));
      along.dx.head(mode.size()) = mode;
    }
  }
  const CorrectorResult here = corrector.inspect(at.state, metric, along);
  if (!here.converged()) return std::nullopt;
  EventBorder border{.row = metric.row(here.tangent), .scale = 1.0 / metric.lambda_scale()};
  if (at.watched) border.scale = 1.0 / std::max(metric.dual_norm(at.watched->gradient(at.state)), 1e-300);
  return border;
}

EventEquation passed_value(const SystemFamily::Member& at, double value, const EventBorder& border,
                           const std::vector<WeightedMember>& samples) {
  EventEquation equation{.value = border.scale * (at.watched->value(at.state) - value),
                         .row = at.watched->gradient(at.state)};
  equation.row.dx *= border.scale;
  equation.row.dlambda *= border.scale;
  for (const WeightedMember& sample : samples)
    equation.by_kappa += border.scale * sample.weight * sample.member.watched->value(sample.member.state);
  return equation;
}

std::optional<std::vector<EventEquation>> singular_equations(Criterion criterion, const SystemFamily::Member& at,
                                                             const EventBorder& border, Linearization& equations,
                                                             std::vector<WeightedMember>& samples, const Metric& metric,
                                                             const MakeFactorization& make) {
  BorderedMatrix A = matrix_of(at, border, equations, make);
  if (criterion == Criterion::turning)
    return is_of_mode(border) ? limit_equation(at, A, samples, metric)
                              : turning_equation(at, border, A, samples, metric);
  return crossing_equations(at, A, equations.F_lambda, samples, metric);
}

std::optional<Direction> path_direction(Criterion criterion, const SystemFamily::Member& at, const EventBorder& border,
                                        const Metric& metric, const MakeFactorization& make) {
  Linearization equations;
  at.system->linearize(at.state, equations);
  BorderedMatrix A = matrix_of(at, border, equations, make);
  const bool crosses = criterion == Criterion::crossing;
  auto t = crosses ? A.solve(-equations.F_lambda, 0.0) : A.solve(Vector::Zero(at.state.x.size()), 1.0);
  if (!t) return std::nullopt;
  if (is_of_mode(border)) t->dlambda = crosses ? 1.0 : 0.0;
  return unit(metric, std::move(*t));
}

double border_fits(const SystemFamily::Member& at, const EventBorder& border, const Metric& metric,
                   const MakeFactorization& make) {
  Linearization equations;
  at.system->linearize(at.state, equations);
  BorderedMatrix A = matrix_of(at, border, equations, make);
  const Vector zero = Vector::Zero(at.state.x.size());
  const auto right = A.solve(zero, 1.0);
  if (!right) return 0.0;
  if (!is_of_mode(border)) return 1.0 / metric.norm(*right);
  const auto left = A.solve_transposed(zero, 1.0);
  if (!left) return 0.0;
  const double column = metric.dual_norm(border.column);  // wᵀ f = 1 where A is regular
  return std::min(1.0 / metric.norm(in_x(right->dx)), 1.0 / (metric.norm(in_x(left->dx)) * column));
}

}  // namespace arcwall
