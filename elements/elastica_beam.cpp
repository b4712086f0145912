#include "elements/elastica_beam.hpp"

#include <Eigen/LU>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>

namespace arcwall {

namespace {

using Eigen::Vector4d;
using Vector5 = Eigen::Matrix<double, 5, 1>;
using Vector7 = Eigen::Matrix<double, 7, 1>;
using Matrix7 = Eigen::Matrix<double, 7, 7>;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// The angle against the chord is θ = p·φ with coefficients p = (a₄, b, σ, a₂, a₃), |x| ≤ ½:
//
//   φ = ((x² − ¼)(x² − 1/36), x, 1/6, x² − ¼, x³ − x/4)                                                (1)
//
// a₄ is zero but for the stress-free angle. Then ∫ θ′² = b² + a₂²/3 + a₃²/20.
Vector5 shape_functions(double x) {
  const double bubble = x * x - 0.25;
  return {bubble * (x * x - 1.0 / 36.0), x, 1.0 / 6.0, bubble, x * bubble};
}

const Vector5 bending_weights(0.0, 1.0, 0.0, 1.0 / 3.0, 1.0 / 20.0);

// φ′, but for a₄, which never changes.
Vector5 shape_slopes(double x) { return {0.0, 1.0, 0.0, 2.0 * x, 3.0 * x * x - 0.25}; }

// p of the cubic through four equally spaced angles, the first and the last of which are `slope1` and `slope2` against
// the chord.
Vector5 interpolated(double slope1, double slope2, const std::array<double, StretchReference::samples>& angles) {
  const double bend = slope2 - slope1;
  const double bump1 = angles[1] - angles[0] - bend / 3.0, bump2 = angles[2] - angles[0] - 2.0 * bend / 3.0;
  return {0.0, bend, 3.0 * (slope1 + slope2), -2.25 * (bump1 + bump2), -13.5 * (bump2 - bump1)};
}

// p − p⁰
Vector5 change_of(const ChordMotion& at, const Vector4d& inner) {
  return {0.0, at.d2 - at.d1, 3.0 * (at.d1 + at.d2), inner[0], inner[1]};
}

// Gauss's rule on |x| ≤ ½ and the shape functions at its points.
template <std::size_t count>
struct Rule {
  std::array<double, count> x{}, weight{};
  std::array<Vector5, count> phi{};

  Rule() {
    using Points = boost::math::quadrature::gauss<double, count>;
    std::size_t next = 0;
    const auto add = [&](double node, double w) {
      x[next] = 0.5 * node;
      weight[next] = 0.5 * w;
      phi[next++] = shape_functions(0.5 * node);
    };
    for (std::size_t i = 0; i < Points::abscissa().size(); ++i) {
      const double node = Points::abscissa()[i];
      add(node, Points::weights()[i]);
      if (node != 0.0) add(-node, Points::weights()[i]);
    }
  }
};

const Rule<7> rule;

// ∫ of a function of φ(x).
template <class Function>
double mean(const Function& function) {
  double sum = 0.0;
  for (std::size_t g = 0; g < rule.phi.size(); ++g) sum += rule.weight[g] * function(rule.phi[g]);
  return sum;
}

// Order of the variables of the potential: a₄ | b, σ | a₂, a₃, e, v.
constexpr Index a4_row = 0, a3_row = 4, e_row = 5, v_row = 6;

}  // namespace

// With the force n = EA (e, v) along the chord and across it, the energy is stationary in e, v and in a₂, a₃:
//
//   U/EA = EI/(2 EA h) (p − p⁰)ᵀ W (p − p⁰) + e (l − l₀) − h ∫ [e Δcos θ + v Δsin θ + ½ a ν²] dx
//   ν = N/EA = e cos θ + v sin θ                                                                       (2)
//
// EA and EI are those of one section of the member: a = EA/EA(S), W_kl = ∫ EI(S)/EI φ_k′ φ_l′ dx, and the strain is a
// ν. Where the section is the same all along, a = 1 and W = diag w.
//
// Δ is the change since the stress-free state: without it the integrals of θ⁰, whose chord differs from the true one by
// the error of its interpolation, would put the element under stress at rest. The angle of order 4 keeps a₃ = a₃⁰.
struct ElasticaBeam::Potential {
  Vector7 gradient = Vector7::Zero();
  Matrix7 hessian = Matrix7::Zero();
  Vector7 integrals = Vector7::Zero();  // their part of the gradient, over h
  double squared_strain = 0.0;          // ∫ a ν²

  // In a₂, a₃, e and v, and their coupling with l, b and σ; a₃ may be held.
  Vector4d inner_gradient(bool cubic) const {
    Vector4d y = gradient.tail<4>();
    if (!cubic) y[1] = 0.0;
    return y;
  }
  Eigen::Matrix4d inner_hessian(bool cubic) const {
    Eigen::Matrix4d yy = hessian.bottomRightCorner<4, 4>();
    if (cubic) return yy;
    yy.row(1).setZero();
    yy.col(1).setZero();
    yy(1, 1) = 1.0;
    return yy;
  }
  InnerGradient outer(bool cubic) const {
    InnerGradient yz;
    yz << Vector4d(0.0, 0.0, 1.0, 0.0), hessian.block<4, 2>(3, 1);
    if (!cubic) yz.row(1).setZero();
    return yz;
  }
};

// The energy with the inner unknowns y = (a₂ − a₂⁰, a₃ − a₃⁰, e, v) eliminated; z = (l, b, σ). NaN if there is none.
struct ElasticaBeam::Solution {
  Vector4d inner = Vector4d::Constant(not_a_number);
  InnerGradient inner_gradient = InnerGradient::Constant(not_a_number);  // ∂y/∂z
  Potential potential{};
  double energy = not_a_number;
  Eigen::Vector3d slopes = Eigen::Vector3d::Constant(not_a_number);
  Eigen::Matrix3d curvatures = Eigen::Matrix3d::Constant(not_a_number);

  ChordSlopes U() const { return {.l = slopes[0], .b = slopes[1], .s = slopes[2]}; }
  ChordCurvatures V() const {
    const Eigen::Matrix3d& W = curvatures;
    return {.ll = W(0, 0), .lb = W(0, 1), .ls = W(0, 2), .bb = W(1, 1), .bs = W(1, 2), .ss = W(2, 2)};
  }
};

// The fifth coefficient of the stress-free angle gives it the chord's direction: ∫ sin θ⁰ = 0 to the sixth order in h,
// since ∫ φ of a₄ is −1/270.
ElasticaBeam::ElasticaBeam(const StretchReference& stretch, double EA, double EI, ElasticaOrder order,
                           const std::optional<StretchTaper>& taper)
    : rest_(rest_chord(stretch)),
      length_(stretch.length),
      EA_(EA),
      EI_(EI),
      cubic_(order == ElasticaOrder::six),
      angle_(interpolated(rest_.slope1, rest_.slope2, stretch.angles)),
      taper_(taper),
      ends_(stretch.ends),
      bending_(bending_weights.asDiagonal()) {
  softness_.fill(1.0);
  const std::array<RestChord, 2> chords = rest_chord_rate(stretch);
  for (std::size_t i = 0; i < 2; ++i) {
    rates_[i] = {.length = stretch.length_rate[i],
                 .chord = chords[i].length,
                 .angle = interpolated(chords[i].slope1, chords[i].slope2, stretch.angle_rate[i])};
    rates_[i].angle[a4_row] =
        270.0 * mean([&](const Vector5& phi) { return std::cos(angle_.dot(phi)) * rates_[i].angle.dot(phi); });
  }
  angle_[a4_row] = 270.0 * mean([&](const Vector5& phi) { return std::sin(angle_.dot(phi)); });
  for (std::size_t g = 0; g < points; ++g) {
    cosine_[g] = std::cos(angle_.dot(rule.phi[g]));
    sine_[g] = std::sin(angle_.dot(rule.phi[g]));
  }
  for (Rate& rate : rates_) {
    rate.along = mean([&](const Vector5& phi) { return std::sin(angle_.dot(phi)) * rate.angle.dot(phi); });
    rate.across = mean([&](const Vector5& phi) { return std::cos(angle_.dot(phi)) * rate.angle.dot(phi); });
  }
  if (taper_) add_taper(stretch);
}

// W times a vector; W is a diagonal where the section is the same all along.
Eigen::Matrix<double, 5, 1> ElasticaBeam::weighted(const Vector5& p) const {
  if (!taper_) return bending_weights.cwiseProduct(p);
  return bending_ * p;
}

// S = S₁ + ξ (S₂ − S₁) at ξ = x + ½, which the ends take along.
void ElasticaBeam::add_taper(const StretchReference& stretch) {
  bending_.setZero();
  for (std::size_t g = 0; g < points; ++g) {
    const double xi = rule.x[g] + 0.5, S = (1.0 - xi) * ends_[0] + xi * ends_[1];
    const Vector5 slopes = shape_slopes(rule.x[g]);
    const Weights weight = rule.weight[g] * slopes * slopes.transpose();
    softness_[g] = taper_->softness(S);
    bending_ += taper_->stiffness(S) * weight;
    for (std::size_t i = 0; i < 2; ++i) {
      const double S_rate = (i == 0 ? 1.0 - xi : xi) * stretch.end_rate[i];
      rates_[i].softness[g] = taper_->softness_rate(S) * S_rate;
      rates_[i].bending += taper_->stiffness_rate(S) * S_rate * weight;
    }
  }
}

ElasticaBeam::Potential ElasticaBeam::potential(const ChordMotion& at, const Vector4d& inner) const {
  const double h = length_, bending = EI_ / (EA_ * h), e = inner[2], v = inner[3];
  const Vector5 change = change_of(at, inner);
  Potential out;
  for (std::size_t g = 0; g < points; ++g) {
    const Vector5& phi = rule.phi[g];
    const double half = 0.5 * change.dot(phi), s = std::sin(half);
    const double turn_s = 2.0 * s * std::cos(half), turn_c = -2.0 * s * s;  // sin Δθ, cos Δθ − 1
    const double d_cosine = cosine_[g] * turn_c - sine_[g] * turn_s, d_sine = sine_[g] * turn_c + cosine_[g] * turn_s;
    const double cosine = cosine_[g] + d_cosine, sine = sine_[g] + d_sine;
    const double nu = e * cosine + v * sine, nu_rate = v * cosine - e * sine;  // ν, ∂ν/∂θ
    const double a = softness_[g], stretch = 1.0 + a * nu;
    const Vector5 weighted = rule.weight[g] * phi;
    out.integrals.head<5>() -= stretch * nu_rate * weighted;
    out.integrals[e_row] -= rule.weight[g] * (d_cosine + a * nu * cosine);
    out.integrals[v_row] -= rule.weight[g] * (d_sine + a * nu * sine);
    out.squared_strain += rule.weight[g] * a * nu * nu;
    out.hessian.topLeftCorner<5, 5>() -= (a * nu_rate * nu_rate - stretch * nu) * weighted * phi.transpose();
    out.hessian.col(e_row).head<5>() -= (a * nu_rate * cosine - stretch * sine) * weighted;
    out.hessian.col(v_row).head<5>() -= (a * nu_rate * sine + stretch * cosine) * weighted;
    out.hessian(e_row, e_row) -= rule.weight[g] * a * cosine * cosine;
    out.hessian(e_row, v_row) -= rule.weight[g] * a * cosine * sine;
    out.hessian(v_row, v_row) -= rule.weight[g] * a * sine * sine;
  }
  out.hessian *= h;
  out.hessian.bottomLeftCorner<2, 5>() = out.hessian.topRightCorner<5, 2>().transpose();
  out.hessian(v_row, e_row) = out.hessian(e_row, v_row);
  if (taper_)
    out.hessian.topLeftCorner<5, 5>() += bending * bending_;
  else
    out.hessian.diagonal().head<5>() += bending * bending_weights;
  out.gradient = h * out.integrals;
  out.gradient.head<5>() += bending * weighted(change);
  out.gradient[e_row] += at.stretch;
  return out;
}

// A quadratic angle without force, its axial strain, and the force across that bends it: EI a₂/3 = −EA v (1 + e) h²/6.
// A section that tapers counts as in its middle.
Vector4d ElasticaBeam::first_guess(const ChordMotion& at) const {
  const double b_0 = angle_[1], s_0 = angle_[2], b = b_0 + at.d2 - at.d1, s = s_0 + 3.0 * (at.d1 + at.d2);
  const double p = shortening(b, s).value, p_0 = shortening(b_0, s_0).value;
  const double a2 = variation(b, s).value - variation(b_0, s_0).value;
  const double e = (at.stretch * (1.0 + p) + rest_.length * (p - p_0)) / length_;
  const double middle = softness_[0];  // the first of the points is x = 0
  return {a2, 0.0, e / middle, -2.0 * EI_ * bending_(1, 1) * a2 / (EA_ * length_ * length_ * (1.0 + e))};
}

// Newton's method on the inner unknowns; then, with P = U/EA of (2),
//
//   ∂y/∂z = −P_yy⁻¹ P_yz,     ∂²U/∂z² = EA (P_zz + P_zy ∂y/∂z)                                         (3)
ElasticaBeam::Solution ElasticaBeam::solve(const ChordMotion& at) const {
  constexpr int most_iterations = 40;
  constexpr double arrived = 1e-8;  // last correction: what it leaves is of the order of its square
  Vector4d y = first_guess(at);
  double correction = infinity;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const Potential P = potential(at, y);
    const Eigen::PartialPivLU<Eigen::Matrix4d> factors(P.inner_hessian(cubic_));
    if (correction <= arrived * (1.0 + y.cwiseAbs().maxCoeff()))
      return condensed(at, y, P, factors.solve(P.outer(cubic_)));
    const Vector4d step = factors.solve(P.inner_gradient(cubic_));
    y -= step;
    correction = step.cwiseAbs().maxCoeff();
  }
  return {};
}

// Where y is stationary, the terms with e and v of (2) are h ∫ ½ ν².
ElasticaBeam::Solution ElasticaBeam::condensed(const ChordMotion& at, const Vector4d& y, const Potential& P,
                                               const InnerGradient& minus_gradient) const {
  const Vector5 change = change_of(at, y);
  Solution out{.inner = y, .inner_gradient = -minus_gradient, .potential = P};
  out.energy = 0.5 * (EI_ / length_ * change.dot(weighted(change)) + EA_ * length_ * P.squared_strain);
  out.slopes << y[2], P.gradient.segment<2>(1);
  out.curvatures = P.outer(cubic_).transpose() * out.inner_gradient;
  out.curvatures.bottomRightCorner<2, 2>() += P.hessian.block<2, 2>(1, 1);
  out.slopes *= EA_;
  out.curvatures *= EA_;
  return out;
}

// (∂U/∂z)′ = EA (P_z′ + ∂y/∂zᵀ P_y′) at fixed z and y, where y means a₂ and a₃ themselves; a prime is the rate by a
// material coordinate:
//
//   P_k′ = EI/(EA h) {W [−(h′/h) (p − p⁰) − p⁰′]}_k − h′ ∫ …              k = b, …, a₃
//   P_e′ = −l₀′ − h′ ∫ (Δcos θ + ν cos θ) − h ∫ sin θ⁰ θ⁰′,     P_v′ = −h′ ∫ (Δsin θ + ν sin θ) + h ∫ cos θ⁰ θ⁰′   (4)
Eigen::Vector3d ElasticaBeam::slope_rate(const ChordMotion& at, const Solution& solution, const Rate& rest) const {
  const double h = length_, bending = EI_ / (EA_ * h);
  const Vector5 bend_rate = -rest.length / h * change_of(at, solution.inner) - rest.angle;
  Vector7 rate = rest.length * solution.potential.integrals;
  rate.head<5>() += bending * weighted(bend_rate);
  rate[e_row] -= rest.chord + h * rest.along;
  rate[v_row] += h * rest.across;
  // What stays at its stress-free value moves with it: a₄, and a₃ in an angle of order 4.
  rate += rest.angle[a4_row] * solution.potential.hessian.col(a4_row);
  if (!cubic_) rate += rest.angle[a3_row] * solution.potential.hessian.col(a3_row);
  if (taper_) rate += taper_rate(at, solution, rest);
  return EA_ * (Eigen::Vector3d(0.0, rate[1], rate[2]) + solution.inner_gradient.transpose() * rate.tail<4>());
}

// What the rates of a and W add: EI/(EA h) W′ (p − p⁰) and −h ∂(∫ ½ a′ ν²).
ElasticaBeam::Vector7 ElasticaBeam::taper_rate(const ChordMotion& at, const Solution& solution,
                                               const Rate& rest) const {
  const Vector5 change = change_of(at, solution.inner), p = angle_ + change;
  const double h = length_, e = solution.inner[2], v = solution.inner[3];
  Vector7 rate = Vector7::Zero();
  rate.head<5>() = EI_ / (EA_ * h) * (rest.bending * change);
  for (std::size_t g = 0; g < points; ++g) {
    const double angle = p.dot(rule.phi[g]), cosine = std::cos(angle), sine = std::sin(angle);
    const double nu = e * cosine + v * sine, weight = h * rule.weight[g] * rest.softness[g] * nu;
    rate.head<5>() -= weight * (v * cosine - e * sine) * rule.phi[g];
    rate[e_row] -= weight * cosine;
    rate[v_row] -= weight * sine;
  }
  return rate;
}

double ElasticaBeam::evaluate(const double* u, double* f, double* K) const {
  const ChordMotion at = motion_of(rest_, u);
  const Solution solution = solve(at);
  if (f != nullptr) nodal_forces(at, solution.U(), f);
  if (K != nullptr) nodal_stiffness(at, solution.U(), solution.V(), K);
  return solution.energy;
}

void ElasticaBeam::respond(const BeamEnds& ends, bool with_rates, BeamResponse& out) const {
  const ChordMotion at = motion_of(rest_, ends);
  const Solution solution = solve(at);
  out.energy = solution.energy;
  respond_along(at, solution.U(), solution.V(), out);
  if (!with_rates) return;
  for (std::size_t i = 0; i < 2; ++i)
    out.force_rate[i] = chord_gradient(at).transpose() * slope_rate(at, solution, rates_[i]);
}

// The angle and the force that the element found.
BeamPlace ElasticaBeam::place(const BeamEnds& ends, double xi) const {
  const ChordMotion at = motion_of(rest_, ends);
  const Solution solution = solve(at);
  const Vector5 p = angle_ + change_of(at, solution.inner);
  Eigen::Matrix<double, 5, 3> p_gradient;
  p_gradient << Eigen::Matrix3d::Zero(), solution.inner_gradient.topRows<2>();
  p_gradient(1, 1) = p_gradient(2, 2) = 1.0;
  Eigen::Matrix<double, BentAxis::terms, 5> powers;   // of x, in φ
  powers << 1.0 / 144.0, 0.0, 1.0 / 6.0, -0.25, 0.0,  //
      0.0, 1.0, 0.0, 0.0, -0.25,                      //
      -5.0 / 18.0, 0.0, 0.0, 1.0, 0.0,                //
      0.0, 0.0, 0.0, 0.0, 1.0,                        //
      1.0, 0.0, 0.0, 0.0, 0.0;
  return place_on({.length = length_,
                   .EA = EA_,
                   .taper = taper_ ? &*taper_ : nullptr,
                   .ends = ends_,
                   .angle = powers * p,
                   .angle_gradient = powers * p_gradient,
                   .force = EA_ * solution.inner.tail<2>(),
                   .force_gradient = EA_ * solution.inner_gradient.bottomRows<2>()},
                  at, ends.angle1, xi);
}

}  // namespace arcwall
