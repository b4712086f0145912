#include "elements/reissner_beam.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace arcwall {

// Positions and the arc length are interpolated alike, ds/dξ = Σ N_a′ s_a: the whole length is exact, and the nodes
// need not be equally far apart.
ReissnerBeam::ReissnerBeam(const ExactBeamReference& reference, const ExactBeamStiffness& stiffness)
    : ReissnerBeam(reference, [&](double) { return stiffness; }) {}

ReissnerBeam::ReissnerBeam(const ExactBeamReference& reference,
                           const std::function<ExactBeamStiffness(double)>& stiffness)
    : order_(reference.order()) {
  assert((order_ == 1 || order_ == 2) && reference.arcs.size() == reference.nodes.size());
  // As many points as the order: one fewer than for the whole polynomial, which would lock.
  const GaussRule rule = gauss_rule(order_);
  for (std::size_t g = 0; g < static_cast<std::size_t>(order_); ++g) {
    const ShapeFunctions shape = shape_functions(order_, rule.xi[g]);
    const double speed = arc_speed(reference, shape);
    GaussPoint& point = points_[g];
    point.ds = rule.weight[g] * speed;
    point.N = shape.N;
    point.stiffness = stiffness(0.5 * (1.0 + rule.xi[g]));
    Vec2 tangent = Vec2::Zero();
    for (std::size_t a = 0; a < reference.nodes.size(); ++a) {
      point.D[a] = shape.dN[a] / speed;
      tangent += point.D[a] * reference.nodes[a];
    }
    point.stretch0 = tangent.norm();
    point.cos0 = tangent.x() / point.stretch0;
    point.sin0 = tangent.y() / point.stretch0;
  }
}

// The section stands across r₀′ when stress-free and turns by θ: tangent t, normal n. With r′ = r₀′ + u′,
//
//   ε = t·r′ − |r₀′|,   γ = n·r′,   κ = θ′,     U = ½ ∫ (EA ε² + GA γ² + EI κ²) ds                        (1)
//
// With ∂t/∂θ = n, ∂n/∂θ = −t, N = EA ε, Q = GA γ and p = t·r′, the derivatives in (u′, θ, θ′) are
//
//   ∂U = (N t + Q n,  N γ − Q p,  EI κ)                                                                   (2)
//
//         [ EA t tᵀ + GA n nᵀ   (EA γ − Q) t + (N − GA p) n    0  ]
//   ∂²U = [         ·           (EA γ − Q) γ − (N − GA p) p    0  ]                                       (3)
//         [         ·                        ·                 EI ]
double ReissnerBeam::evaluate(const double* u, const Deformation& e, double* f, double* K, const Deformation& e_rate,
                              double* f_rate) const {
  const auto nodes = static_cast<std::size_t>(order_ + 1), n = 3 * nodes;
  if (f != nullptr) std::fill(f, f + n, 0.0);
  if (K != nullptr) std::fill(K, K + n * n, 0.0);
  if (f_rate != nullptr) std::fill(f_rate, f_rate + n, 0.0);
  double U = 0.0;
  for (std::size_t g = 0; g < nodes - 1; ++g) {
    const GaussPoint& at = points_[g];
    const auto [EA, GA, EI] = at.stiffness;
    double du = 0.0, dw = 0.0, theta = 0.0, kappa = 0.0;  // u′, w′, θ, θ′
    for (std::size_t a = 0; a < nodes; ++a) {
      du += at.D[a] * u[3 * a];
      dw += at.D[a] * u[3 * a + 1];
      theta += at.N[a] * u[3 * a + 2];
      kappa += at.D[a] * u[3 * a + 2];
    }
    // On the stress-free frame, then turned by θ; 1 − cos θ = 2 sin²(θ/2) keeps the digits of small strains.
    const double along = at.cos0 * du + at.sin0 * dw, across = at.cos0 * dw - at.sin0 * du;
    const double sin = std::sin(theta), half = std::sin(0.5 * theta), less = 2.0 * half * half, cos = 1.0 - less;
    const double strain = cos * along + sin * across - less * at.stretch0;
    const double shear = cos * across - sin * (along + at.stretch0);
    const double N = EA * (strain - e.strain), Q = GA * shear, M = EI * (kappa - e.curvature);
    U += 0.5 * at.ds * (N * (strain - e.strain) + Q * shear + M * (kappa - e.curvature));
    if (f == nullptr && K == nullptr && f_rate == nullptr) continue;

    const double p = at.stretch0 + strain;
    const double tx = cos * at.cos0 - sin * at.sin0, tz = sin * at.cos0 + cos * at.sin0;  // n = (−tz, tx)
    if (f != nullptr)
      add_forces(at, nodes, {.x = N * tx - Q * tz, .z = N * tz + Q * tx, .theta = N * shear - Q * p, .kappa = M}, f);
    if (f_rate != nullptr) {
      const double N_rate = -EA * e_rate.strain;
      add_forces(at, nodes,
                 {.x = N_rate * tx, .z = N_rate * tz, .theta = N_rate * shear, .kappa = -EI * e_rate.curvature},
                 f_rate);
    }
    if (K == nullptr) continue;
    const double t = EA * shear - Q, m = N - GA * p;  // of t and n in (3)
    add_stiffness(at, nodes,
                  {.xx = EA * tx * tx + GA * tz * tz,
                   .xz = (EA - GA) * tx * tz,
                   .zz = EA * tz * tz + GA * tx * tx,
                   .xt = t * tx - m * tz,
                   .zt = t * tz + m * tx,
                   .tt = t * shear - m * p,
                   .kk = EI},
                  K);
  }
  return U;
}

void ReissnerBeam::add_forces(const GaussPoint& at, std::size_t nodes, const First& U, double* f) {
  for (std::size_t a = 0; a < nodes; ++a) {
    const double D = at.ds * at.D[a], N = at.ds * at.N[a];
    f[3 * a] += D * U.x;
    f[3 * a + 1] += D * U.z;
    f[3 * a + 2] += N * U.theta + D * U.kappa;
  }
}

void ReissnerBeam::add_stiffness(const GaussPoint& at, std::size_t nodes, const Second& U, double* K) {
  const std::size_t n = 3 * nodes;
  for (std::size_t b = 0; b < nodes; ++b)
    for (std::size_t a = b; a < nodes; ++a) {
      const double DD = at.ds * at.D[a] * at.D[b], ND = at.ds * at.N[a] * at.D[b];
      const double DN = at.ds * at.D[a] * at.N[b], NN = at.ds * at.N[a] * at.N[b];
      double* block = K + 3 * a + 3 * b * n;
      block[0] += DD * U.xx;
      block[1] += DD * U.xz;
      block[2] += ND * U.xt;
      block[n] += DD * U.xz;
      block[n + 1] += DD * U.zz;
      block[n + 2] += ND * U.zt;
      block[2 * n] += DN * U.xt;
      block[2 * n + 1] += DN * U.zt;
      block[2 * n + 2] += NN * U.tt + DD * U.kk;
    }
}

ExactDistributedLoad::ExactDistributedLoad(const ExactBeamReference& reference,
                                           const std::function<Vec2(double)>& load_at, int unknowns_a_node,
                                           const SmoothPieces& pieces)
    : forces_(reference.nodes.size(), Vec2::Zero()), stride_(unknowns_a_node) {
  const GaussRule rule = gauss_rule(reference.order() + 1);  // exact for a load that is linear along a straight axis
  for (std::size_t i = 0; i < forces_.size() * pieces.count(); ++i) {
    const std::size_t piece = i / forces_.size(), g = i % forces_.size();
    const double along = pieces.begin(piece) + 0.5 * (1.0 + rule.xi[g]) * pieces.length(piece);
    const ShapeFunctions shape = shape_functions(reference.order(), 2.0 * along - 1.0);
    const double ds = rule.weight[g] * pieces.length(piece) * arc_speed(reference, shape);
    const Vec2 load = load_at(along);
    for (std::size_t a = 0; a < forces_.size(); ++a) forces_[a] += ds * shape.N[a] * load;
  }
}

double ExactDistributedLoad::evaluate(const double* u, double* f, double* K) const {
  const auto n = static_cast<std::size_t>(unknown_count()), stride = static_cast<std::size_t>(stride_);
  if (f != nullptr) std::fill(f, f + n, 0.0);
  if (K != nullptr) std::fill(K, K + n * n, 0.0);
  double V = 0.0;
  for (std::size_t a = 0; a < forces_.size(); ++a) {
    V -= forces_[a].x() * u[stride * a] + forces_[a].y() * u[stride * a + 1];
    if (f == nullptr) continue;
    f[stride * a] = -forces_[a].x();
    f[stride * a + 1] = -forces_[a].y();
  }
  return V;
}

}  // namespace arcwall
