#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "tests/support/toys.hpp"

/// Small systems whose singular points are known in closed form, or nearly so.
namespace arcwall::test {

/// A system of one unknown from F, ∂F/∂x and ∂F/∂λ as functions of (x, λ).
template <class F, class FX, class FL>
SmoothToy scalar_function(F f, FX f_x, FL f_lambda) {
  SmoothToy toy;
  toy.F = [f](const Vector& x, double lambda) { return scalar(f(x[0], lambda)); };
  toy.K = [f_x](const Vector& x, double lambda) { return scalar_matrix(f_x(x[0], lambda)); };
  toy.F_lambda = [f_lambda](const Vector& x, double lambda) { return scalar(f_lambda(x[0], lambda)); };
  return toy;
}

/// F = x² − λ x + e. e = 0: x = 0 and x = λ cross at 0. e > 0: folds at x = ±√e, λ = ±2√e. e < 0: none.
inline SmoothToy transcritical(double e = 0.0) {
  return scalar_function([e](double x, double l) { return x * x - l * x + e; },
                         [](double x, double l) { return 2.0 * x - l; }, [](double x, double) { return -x; });
}

/// F = x (x − x²/2e − λ): x = 0 and λ = x − x²/2e cross at 0; the latter has a fold at x = e, λ = e/2.
inline SmoothToy transcritical_beside_fold(double e) {
  return scalar_function([e](double x, double l) { return x * (x - x * x / (2.0 * e) - l); },
                         [e](double x, double l) { return 2.0 * x - 1.5 * x * x / e - l; },
                         [](double x, double) { return -x; });
}

/// F = x³ − λ x − e. e = 0: x = 0, and λ = x² from λ = 0 on. Else a fold at x = −(e/2)^⅓, λ = 3 (e/2)^⅔.
inline SmoothToy pitchfork(double e = 0.0) {
  return scalar_function([e](double x, double l) { return x * x * x - l * x - e; },
                         [](double x, double l) { return 3.0 * x * x - l; }, [](double x, double) { return -x; });
}

/// F = x² + λ² − r²: a closed path with folds at x = 0, λ = ±r, which shrinks to a point with r.
inline SmoothToy isola(double r) {
  return scalar_function([r](double x, double l) { return x * x + l * l - r * r; },
                         [](double x, double) { return 2.0 * x; }, [](double, double l) { return 2.0 * l; });
}

/// F = (x² + λ²)² − λ² + x² (Bernoulli's lemniscate): crosses itself at 0; folds at x = 0, λ = ±1.
inline SmoothToy lemniscate() {
  return scalar_function([](double x, double l) { return std::pow(x * x + l * l, 2) - l * l + x * x; },
                         [](double x, double l) { return 4.0 * x * (x * x + l * l) + 2.0 * x; },
                         [](double x, double l) { return 4.0 * l * (x * x + l * l) - 2.0 * l; });
}

/// u″ + λ eᵘ = 0 on (0, 1), u = 0 at the ends (Bratu 1914), by central differences at `points` inner points.
struct Bratu : System {
  explicit Bratu(Index points) : n(points) {}
  Index n;

  Dimensions dimensions(const ActiveSet&) const override { return {.unknowns = n}; }
  void residual(const State& s, Eigen::Ref<Vector> F) const override {
    for (Index i = 0; i < n; ++i) {
      const double left = i > 0 ? s.x[i - 1] : 0.0, right = i + 1 < n ? s.x[i + 1] : 0.0;
      F[i] = (2.0 * s.x[i] - left - right) * spacings() - s.lambda * std::exp(s.x[i]);
    }
  }
  void linearize(const State& s, Linearization& out) const override {
    std::vector<Eigen::Triplet<double, Index>> entries;
    out.F.resize(n);
    residual(s, out.F);
    out.F_lambda = -s.x.array().exp();
    for (Index i = 0; i < n; ++i) {
      entries.emplace_back(i, i, 2.0 * spacings() - s.lambda * std::exp(s.x[i]));
      if (i + 1 < n) entries.emplace_back(i + 1, i, -spacings());
    }
    out.K.resize(n, n);
    out.K.setFromTriplets(entries.begin(), entries.end());
    out.pattern_of = s.active_set;
  }
  double energy(const State& s) const override {
    Vector gradient(n);
    residual({.x = s.x, .lambda = 0.0}, gradient);
    return 0.5 * s.x.dot(gradient) - s.lambda * s.x.array().exp().sum();
  }

  double spacings() const { return double((n + 1) * (n + 1)); }  ///< 1/h²
};

/// A pinned shallow arch y₀ = h sin under a load q₀ sin (Fung & Kaplan 1952), in sines: amplitudes b_n, n = 1 … modes,
/// over 2 √(I/A), e that of the rise, R = λ that of the load. With S = e² − Σ n² b_n²,
///
///     V = ½ Σ n⁴ (b_n − e δ_n1)² + ¼ S² + R b₁:     R = e − b₁ + S b₁,   b_n (n² − S) = 0
///
/// x holds b₁ − e and b_n. Limit points at b₁ = ±√((e² − 1)/3), R = e + 2 b₁³; a branch in n half waves leaves at b₁ =
/// ±√(e² − n²), is R = e + (n² − 1) b₁, n² b_n² = e² − n² − b₁², and joins both of these points.
inline SmoothToy sine_arch(double e, Index modes) {
  struct Amplitudes {
    Vector n2, b;
    double S;
  };
  const auto amplitudes = [e, modes](const Vector& x) {
    Amplitudes now{.n2 = Vector::LinSpaced(modes, 1.0, double(modes)).array().square(), .b = x, .S = e * e};
    now.b[0] += e;
    now.S -= now.n2.dot(now.b.cwiseAbs2());
    return now;
  };
  SmoothToy toy;
  toy.unknowns = modes;
  toy.potential = [amplitudes](const Vector& x, double R) {
    const Amplitudes now = amplitudes(x);
    return 0.5 * now.n2.cwiseAbs2().dot(x.cwiseAbs2()) + 0.25 * now.S * now.S + R * now.b[0];
  };
  toy.F = [amplitudes](const Vector& x, double R) {
    const Amplitudes now = amplitudes(x);
    Vector F = now.n2.cwiseAbs2().cwiseProduct(x) - now.S * now.n2.cwiseProduct(now.b);
    F[0] += R;
    return F;
  };
  toy.K = [amplitudes](const Vector& x, double) {
    const Amplitudes now = amplitudes(x);
    const Vector nb = now.n2.cwiseProduct(now.b), diagonal = now.n2.cwiseAbs2() - now.S * now.n2;
    return Matrix(2.0 * nb * nb.transpose() + Matrix(diagonal.asDiagonal()));
  };
  toy.F_lambda = [modes](const Vector&, double) { return Vector(Vector::Unit(modes, 0)); };
  return toy;
}

}  // namespace arcwall::test
