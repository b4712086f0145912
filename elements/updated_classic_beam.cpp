#include "elements/updated_classic_beam.hpp"

#include <cmath>

namespace arcwall {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

// Rows of the chord's length change e and of the end rotations t1, t2 against the chord, all of first order in the
// increments: t_i = θ_i − ψ, ψ = n·(u2 − u1)/l the chord's rotation.
struct Rows {
  Vector6 e, psi, t1, t2;
};

Rows rows_of(const Vec2& chord) {
  const double l = chord.norm();
  const Vec2 t = chord / l, n = perp(t);
  Rows rows;
  rows.e << -t, 0.0, t, 0.0;
  rows.psi << -n / l, 0.0, n / l, 0.0;
  rows.t1 = Vector6::Unit(2) - rows.psi;
  rows.t2 = Vector6::Unit(5) - rows.psi;
  return rows;
}

// ½ ∫ w′² dx/l of the cubic with end slopes t1, t2 between ends that stay; its second derivatives are (4, −1; −1,
// 4)/30.
double shortening(double t1, double t2) { return (2.0 * t1 * t1 - t1 * t2 + 2.0 * t2 * t2) / 30.0; }

}  // namespace

// With ε = u′ − z w″ and σ of the resultants, ∫ (C Δε δε + σ Δu_k,x δu_k,x) of eq. (13) is, by the rows,
//
//   K_L:  EA/l e eᵀ + EI/l [4 2; 2 4]                                                                    (1)
//   K_σ:  N/l e eᵀ + (N EI/EA)/l [4 2; 2 4] + (e (M1 t1 + M2 t2)ᵀ + transposed)/l
//         + N l (ψ ψᵀ + [4 −1; −1 4]/30)                                                                 (2)
UpdatedClassicBeam::UpdatedClassicBeam(const double* u, const Vec2& chord, const Resultants& stresses, double EA,
                                       double EI, double energy)
    : UpdatedElement(6, u, energy), chord_(chord), stresses_(stresses), EA_(EA), EI_(EI) {
  const auto& [N, M1, M2] = stresses_;
  const double l = chord_.norm();
  const Rows rows = rows_of(chord_);
  const Vector6 bend = M1 * rows.t1 + M2 * rows.t2;
  const auto quadratic = [&](double same, double mixed) {
    return Matrix(same * (rows.t1 * rows.t1.transpose() + rows.t2 * rows.t2.transpose()) +
                  mixed * (rows.t1 * rows.t2.transpose() + rows.t2 * rows.t1.transpose()));
  };
  Matrix K = (EA_ + N) / l * rows.e * rows.e.transpose() + quadratic(4.0, 2.0) * (EI_ * (1.0 + N / EA_) / l) +
             N * l * (rows.psi * rows.psi.transpose() + quadratic(4.0, -1.0) / 30.0);
  K += (rows.e * bend.transpose() + bend * rows.e.transpose()) / l;
  set_response(N * rows.e + bend, std::move(K));
}

// The increment of strain is Green's in the old configuration, that of stress C times it; the axial force then belongs
// to the new one (Cauchy).
std::unique_ptr<Element> UpdatedClassicBeam::updated(const double* u) const {
  const Eigen::Map<const Vector6> at(u);
  const Vector6 du = at - reference();
  const Vec2 chord = chord_ + du.segment<2>(3) - du.head<2>();
  const double l = chord_.norm(), stretch = chord.norm() / l;
  const double turned = turn_between(chord_, chord);
  const double t1 = du[2] - turned, t2 = du[5] - turned;
  const double strain = 0.5 * (stretch * stretch - 1.0) + shortening(t1, t2);
  const Resultants change{
      .N = EA_ * strain, .M1 = EI_ / l * (4.0 * t1 + 2.0 * t2), .M2 = EI_ / l * (2.0 * t1 + 4.0 * t2)};
  const auto& [N, M1, M2] = stresses_;
  const double work = (N + 0.5 * change.N) * strain * l + (M1 + 0.5 * change.M1) * t1 + (M2 + 0.5 * change.M2) * t2;
  const Resultants stresses{.N = (N + change.N) * stretch, .M1 = M1 + change.M1, .M2 = M2 + change.M2};
  return std::make_unique<UpdatedClassicBeam>(u, chord, stresses, EA_, EI_, energy() + work);
}

}  // namespace arcwall
