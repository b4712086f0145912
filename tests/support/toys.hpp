#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "core/system.hpp"
#include "tests/support/dense.hpp"

namespace arcwall::test {

/// A smooth system from functions of (x, λ): energy, gradient in x, Hessian, and the gradient's derivative in λ.
struct SmoothToy : System {
  Index unknowns = 1;
  std::function<double(const Vector&, double)> potential{};
  std::function<Vector(const Vector&, double)> F{};
  std::function<Matrix(const Vector&, double)> K{};
  std::function<Vector(const Vector&, double)> F_lambda{};

  Dimensions dimensions(const ActiveSet&) const override { return {.unknowns = unknowns}; }
  void residual(const State& s, Eigen::Ref<Vector> out) const override { out = F(s.x, s.lambda); }
  void linearize(const State& s, Linearization& out) const override {
    out.F = F(s.x, s.lambda);
    out.F_lambda = F_lambda(s.x, s.lambda);
    out.K = lower_triangle(K(s.x, s.lambda), -1.0);
    out.pattern_of = s.active_set;
  }
  double energy(const State& s) const override { return potential ? potential(s.x, s.lambda) : 0.0; }
};

inline Vector scalar(double v) { return Vector::Constant(1, v); }
inline Matrix scalar_matrix(double v) { return Matrix::Constant(1, 1, v); }

/// F = x² + λ: one fold, at x = 0, λ = 0. Equilibria x = ±√−λ; K = 2x.
inline SmoothToy fold() {
  SmoothToy toy;
  toy.potential = [](const Vector& x, double lambda) { return x[0] * x[0] * x[0] / 3.0 + lambda * x[0]; };
  toy.F = [](const Vector& x, double lambda) { return scalar(x[0] * x[0] + lambda); };
  toy.K = [](const Vector& x, double) { return scalar_matrix(2.0 * x[0]); };
  toy.F_lambda = [](const Vector&, double) { return scalar(1.0); };
  return toy;
}

/// F = x³ − a x + λ: two folds at x = ±√(a/3), λ = a x − x³ = ±(2/3) a √(a/3). For a = 0 a cubic inflection.
inline SmoothToy cusp(double a) {
  SmoothToy toy;
  toy.potential = [a](const Vector& x, double lambda) {
    return std::pow(x[0], 4) / 4.0 - a * x[0] * x[0] / 2.0 + lambda * x[0];
  };
  toy.F = [a](const Vector& x, double lambda) { return scalar(std::pow(x[0], 3) - a * x[0] + lambda); };
  toy.K = [a](const Vector& x, double) { return scalar_matrix(3.0 * x[0] * x[0] - a); };
  toy.F_lambda = [](const Vector&, double) { return scalar(1.0); };
  return toy;
}

/// F = ½ (x² + λ² − 1): a closed path, with folds at (0, ±1).
inline SmoothToy unit_circle() {
  SmoothToy toy;
  toy.F = [](const Vector& x, double lambda) { return scalar(0.5 * (x[0] * x[0] + lambda * lambda - 1.0)); };
  toy.K = [](const Vector& x, double) { return scalar_matrix(x[0]); };
  toy.F_lambda = [](const Vector&, double lambda) { return scalar(lambda); };
  return toy;
}

/// F = k x − λ: a straight path.
inline SmoothToy spring(double k) {
  SmoothToy toy;
  toy.potential = [k](const Vector& x, double lambda) { return 0.5 * k * x[0] * x[0] - lambda * x[0]; };
  toy.F = [k](const Vector& x, double lambda) { return scalar(k * x[0] - lambda); };
  toy.K = [k](const Vector&, double) { return scalar_matrix(k); };
  toy.F_lambda = [](const Vector&, double) { return scalar(-1.0); };
  return toy;
}

/// A quadratic a + b (x − at) + c (x − at)².
struct Quadratic {
  double at = 0.0, a = 0.0, b = 0.0, c = 0.0;

  double operator()(double x) const { return a + (x - at) * (b + c * (x - at)); }
  double slope(double x) const { return b + 2.0 * c * (x - at); }
};

/// The rotation between the unknowns of `modes_beside` and (x, y₁, …): each equation has all unknowns.
inline Matrix mixing(Index n) { return Eigen::HouseholderQR<Matrix>(Numbers(31).matrix(n, n)).householderQ(); }

/// Modes y_i beside a path of x alone, with stiffnesses k_i(x): each simple zero of one of them is a pitchfork.
///
///     (x-equation of `path`) + ½ Σ k_i′(x) y_i² = 0,     k_i(x) y_i + y_i³ = 0
///
/// The unknowns are mixing(n) · (x, y₁, …).
inline SmoothToy modes_beside(const SmoothToy& path, const std::vector<Quadratic>& modes) {
  const auto n = static_cast<Index>(modes.size()) + 1;
  const Matrix R = mixing(n);
  SmoothToy toy;
  toy.unknowns = n;
  toy.F = [=](const Vector& z, double lambda) -> Vector {
    const Vector q = R.transpose() * z;
    Vector F(n);
    F[0] = path.F(q.head(1), lambda)[0];
    for (Index i = 1; i < n; ++i) {
      const Quadratic& k = modes[static_cast<std::size_t>(i - 1)];
      F[0] += 0.5 * k.slope(q[0]) * q[i] * q[i];
      F[i] = k(q[0]) * q[i] + q[i] * q[i] * q[i];
    }
    return R * F;
  };
  toy.K = [=](const Vector& z, double lambda) -> Matrix {
    const Vector q = R.transpose() * z;
    Matrix K = Matrix::Zero(n, n);
    K(0, 0) = path.K(q.head(1), lambda)(0, 0);
    for (Index i = 1; i < n; ++i) {
      const Quadratic& k = modes[static_cast<std::size_t>(i - 1)];
      K(0, 0) += k.c * q[i] * q[i];
      K(0, i) = K(i, 0) = k.slope(q[0]) * q[i];
      K(i, i) = k(q[0]) + 3.0 * q[i] * q[i];
    }
    return R * K * R.transpose();
  };
  toy.F_lambda = [=](const Vector& z, double lambda) -> Vector {
    return R.col(0) * path.F_lambda((R.transpose() * z).head(1), lambda)[0];
  };
  return toy;
}

/// A state of that system on its path, all y_i = 0, and x of a state.
inline State state_beside(const SmoothToy& system, double x, double lambda) {
  return {.x = mixing(system.unknowns).col(0) * x, .lambda = lambda};
}
inline double place_of(const State& state) { return mixing(state.x.size()).col(0).dot(state.x); }

/// Two bars of Green's strain from (±b, 0) to an apex at (u, h − w), held sideways by a spring k and pushed down by λ,
/// in units of EA/L³; unknowns (u, w). With q = l² − L² of each bar:
///
///     V = ⅛ Σ q² + ½ k u² − λ w
inline SmoothToy swaying_truss(double h, double b, double k) {
  SmoothToy toy;
  toy.unknowns = 2;
  const auto bar = [h, b](const Vector& x, double side) {  // the way from the foot to the apex
    return Eigen::Vector2d(x[0] - side * b, h - x[1]);
  };
  const auto stretch = [h, b](const Eigen::Vector2d& r) { return r.squaredNorm() - h * h - b * b; };
  toy.potential = [=](const Vector& x, double lambda) {
    double sum = 0.5 * k * x[0] * x[0] - lambda * x[1];
    for (const double side : {1.0, -1.0}) sum += std::pow(stretch(bar(x, side)), 2) / 8.0;
    return sum;
  };
  toy.F = [=](const Vector& x, double lambda) -> Vector {
    Vector F{{k * x[0], -lambda}};
    for (const double side : {1.0, -1.0}) {
      const Eigen::Vector2d r = bar(x, side);
      F += 0.5 * stretch(r) * Eigen::Vector2d(r[0], -r[1]);
    }
    return F;
  };
  toy.K = [=](const Vector& x, double) -> Matrix {
    Matrix K = Matrix::Zero(2, 2);
    K(0, 0) = k;
    for (const double side : {1.0, -1.0}) {
      const Eigen::Vector2d r = bar(x, side), d(r[0], -r[1]);
      K += d * d.transpose() + 0.5 * stretch(r) * Matrix::Identity(2, 2);
    }
    return K;
  };
  toy.F_lambda = [](const Vector&, double) { return Vector(-Vector::Unit(2, 1)); };
  return toy;
}

/// A linear system with linear gaps, hand-made for corners:
///
///     A x − λ f − Gᵀ p = 0,   g = G x + g₀ ≥ 0,   p ≥ 0,   p g = 0
///
/// One contact a row of G. Guards are gaps and forces as they are (scales 1).
struct LinearContactToy : System {
  Matrix A{};
  Vector f{};
  Matrix G{};
  Vector gap0{};

  std::vector<Index> closed(const ActiveSet& active_set) const {
    std::vector<Index> found;
    for (std::size_t j = 0; j < active_set.size(); ++j)
      if (active_set[j]) found.push_back(static_cast<Index>(j));
    return found;
  }

  Dimensions dimensions(const ActiveSet& active_set) const override {
    const auto forces = static_cast<Index>(closed(active_set).size());
    return {.unknowns = A.rows() + forces, .multipliers = forces};
  }
  void residual(const State& s, Eigen::Ref<Vector> F) const override {
    const Index n = A.rows();
    F.head(n) = A * s.x.head(n) - s.lambda * f;
    Index k = n;
    for (const Index j : closed(s.active_set)) {
      F.head(n) -= s.x[k] * G.row(j).transpose();
      F[k++] = -(G.row(j).dot(s.x.head(n)) + gap0[j]);
    }
  }
  void linearize(const State& s, Linearization& out) const override {
    const Index n = A.rows(), total = size(s.active_set);
    Matrix K = Matrix::Zero(total, total);
    K.topLeftCorner(n, n) = A;
    Index k = n;
    for (const Index j : closed(s.active_set)) K.row(k++).head(n) = -G.row(j);
    out.K = lower_triangle(K);
    out.F.resize(total);
    residual(s, out.F);
    out.F_lambda = Vector::Zero(total);
    out.F_lambda.head(n) = -f;
    out.pattern_of = s.active_set;
  }
  double energy(const State& s) const override {
    const Vector x = s.x.head(A.rows());
    return 0.5 * x.dot(A * x) - s.lambda * f.dot(x);
  }
  StateMetric metric(const ActiveSet& active_set) const override {
    Vector w = Vector::Zero(size(active_set));
    w.head(A.rows()).setConstant(1.0 / double(A.rows()));
    return {.weights = std::move(w)};
  }

  ActiveSet open_active_set() const override { return ActiveSet(static_cast<std::size_t>(G.rows()), 0); }
  Index contact_count() const { return G.rows(); }
  Vector guards(const State& s) const override {
    Vector values(G.rows());
    for (Index j = 0; j < values.size(); ++j) {
      const auto k = multiplier_index(s.active_set, j);
      values[j] = k ? s.x[*k] : G.row(j).dot(s.x.head(A.rows())) + gap0[j];
    }
    return values;
  }
  Row guard_gradient(const State& s, Index j) const override {
    Row row{.dx = Vector::Zero(s.x.size()), .dlambda = 0.0};
    if (const auto k = multiplier_index(s.active_set, j))
      row.dx[*k] = 1.0;
    else
      row.dx.head(A.rows()) = G.row(j).transpose();
    return row;
  }
  Vector unit_force(const State& s, Index j) const override {
    Vector force = Vector::Zero(s.x.size());
    force.head(A.rows()) = G.row(j).transpose();
    return force;
  }
  Enforcement enforcement(const ActiveSet& active_set, Index j) const override {
    return {.multiplier = multiplier_index(active_set, j)};
  }
  std::optional<Index> multiplier_index(const ActiveSet& active_set, Index j) const {
    if (!active_set[static_cast<std::size_t>(j)]) return std::nullopt;
    Index k = A.rows();
    for (Index i = 0; i < j; ++i) k += active_set[static_cast<std::size_t>(i)] ? 1 : 0;
    return k;
  }
  Vector transfer(const Vector& x, const ActiveSet& from, const ActiveSet& to) const override {
    Vector moved = Vector::Zero(size(to));
    moved.head(A.rows()) = x.head(A.rows());
    for (Index j = 0; j < G.rows(); ++j) {
      const auto source = multiplier_index(from, j), target = multiplier_index(to, j);
      if (source && target) moved[*target] = x[*source];
    }
    return moved;
  }
};

/// Two springs in a row, 1 and `k`, pushed by λ; the end of the first meets a stop at 1.
///
///     x₁ + k (x₁ − x₂) + p = 0,   k (x₂ − x₁) = λ,   g = 1 − x₁
///
/// Free: x₁ = λ, x₂ = λ (1 + 1/k). Behind the stop (λ > 1): x₁ = 1, x₂ = 1 + λ/k, p = λ − 1.
inline LinearContactToy stopped_springs(double k) {
  LinearContactToy toy;
  toy.A = Matrix{{1.0 + k, -k}, {-k, k}};
  toy.f = Vector::Unit(2, 1);
  toy.G = Matrix{{-1.0, 0.0}};
  toy.gap0 = Vector::Ones(1);
  return toy;
}

}  // namespace arcwall::test
