#include "elements/essenburg_beam.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/lanes.hpp"
#include "elements/essenburg_assembly.hpp"
#include "elements/shape_functions.hpp"
#include "elements/updated_essenburg_beam.hpp"

namespace arcwall {

// With p = t turned by +90°: ∂t/∂φ = p, ∂p/∂φ = −t. d − D = (cos φ − 1) D + sin φ D⊥ + e t, with cos φ − 1 =
// −2 sin²(φ/2) for the digits of small rotations.
EssenburgNode::Vectors EssenburgNode::vectors(double phi, double e, double xi) const {
  const auto half = cosine_and_sine(0.5 * phi);
  const double less = 2.0 * half.sine * half.sine, sine = 2.0 * half.sine * half.cosine;  // 1 − cos φ and sin φ
  const Vec2 turned = sine * perp(D) - less * D;                                          // t − D
  const Vec2 t = D + turned, p = perp(t);
  Vectors v{.d_change = turned + e * t,
            .d_phi = (1.0 + e) * p,
            .d_e = t,
            .d_phi_phi = -(1.0 + e) * t,
            .d_phi_e = p,
            .q_phi = Vec2::Zero(),
            .q_phi_phi = Vec2::Zero(),
            .q_phi_xi = Vec2::Zero()};
  switch (quadratic) {
    case QuadraticTerm::fixed:
      v.q = xi * n;
      v.q_xi = n;
      break;
    case QuadraticTerm::director:
      v.q = xi * t;
      v.q_phi = xi * p;
      v.q_xi = t;
      v.q_phi_phi = -xi * t;
      v.q_phi_xi = p;
      break;
  }
  return v;
}

// Plane stress across the width: C11 = C33 = E/(1 − ν²), C13 = ν C11.
EssenburgElement::EssenburgElement(const EssenburgReference& reference, const EssenburgStiffness& stiffness,
                                   int axial_points)
    : C11(stiffness.E / (1.0 - stiffness.nu * stiffness.nu)),
      C13(stiffness.nu * C11),
      G(stiffness.shear_correction * stiffness.E / (2.0 * (1.0 + stiffness.nu))),
      sections(reference.sections) {
  assert(reference.nodes.size() == reference.sections.size());
  const GaussRule rule = gauss_rule(axial_points);
  for (std::size_t g = 0; g < static_cast<std::size_t>(axial_points); ++g)
    add_points(reference, rule.xi[g], rule.weight[g], stiffness.points);
}

// Stress-free, x = X + z D: A1 = ∂x/∂ξ, A3 = D. With e3 along A3, e1 across it, J = A1·e1, and m = |A3|:
//
//   f1 = F e1 = [a1 − (A1·e3/m) a3]/J,    f3 = F e3 = a3/m,    dV = J m dξ dA                            (1)
//   a1 = ∂/∂ξ (r + z d + z² q),           a3 = d + 2 z q                                                 (2)
void EssenburgElement::add_points(const EssenburgReference& reference, double xi, double weight,
                                  const std::vector<SectionPoint>& heights) {
  const ShapeFunctions shape = shape_functions(reference.order(), xi);
  Vec2 X_xi = Vec2::Zero(), D = Vec2::Zero(), D_xi = Vec2::Zero();
  for (std::size_t a = 0; a < reference.nodes.size(); ++a) {
    X_xi += shape.dN[a] * reference.nodes[a];
    D += shape.N[a] * reference.sections[a].D;
    D_xi += shape.dN[a] * reference.sections[a].D;
  }
  const double m = D.norm();
  for (const auto& [z, area] : heights) {
    Point point{.e3 = D / m};
    point.e1 = -perp(point.e3);
    const Vec2 A1 = X_xi + z * D_xi;
    const double J = A1.dot(point.e1), skew = A1.dot(point.e3) / m;
    assert(J > 0.0);
    point.volume = weight * area * J * m;
    for (std::size_t a = 0; a < reference.nodes.size(); ++a) {
      const double N = shape.N[a], dN = shape.dN[a];
      double *c1 = &point.c1[static_cast<std::size_t>(vectors_a_node) * a],
             *c3 = &point.c3[static_cast<std::size_t>(vectors_a_node) * a];
      c1[0] = dN / J;
      c1[1] = (z * dN - skew * N) / J;
      c1[2] = (z * z * dN - 2.0 * z * skew * N) / J;
      c3[1] = N / m;
      c3[2] = 2.0 * z * N / m;
    }
    points.push_back(point);
  }
}

// With h1 = f1 − e1, h3 = f3 − e3 Green's strains on the section's axes are
//
//   E11 = e1·h1 + ½ h1²,   E33 = e3·h3 + ½ h3²,   γ = e1·h3 + e3·h1 + h1·h3                               (3)
//
// and the energy density ½ (C11 (E11² + E33²) + 2 C13 E11 E33 + G γ²), with stresses S, has the derivatives
//
//   P1 = S11 f1 + S13 f3,   P3 = S13 f1 + S33 f3                                                          (4)
//
//   ∂P = [ S11 1 + C11 f1 f1ᵀ + G f3 f3ᵀ    S13 1 + C13 f1 f3ᵀ + G f3 f1ᵀ ]
//        [              ·                   S33 1 + C11 f3 f3ᵀ + G f1 f1ᵀ ]                               (5)
//
// in (f1, f3).
EssenburgElement::Response EssenburgBeam::respond(const EssenburgElement::Point& at, const Vec2& h1, const Vec2& h3,
                                                  bool tangent) const {
  const double C11 = at.volume * element_->C11, C13 = at.volume * element_->C13, G = at.volume * element_->G;
  const double E11 = at.e1.dot(h1) + 0.5 * h1.squaredNorm(), E33 = at.e3.dot(h3) + 0.5 * h3.squaredNorm();
  const double gamma = at.e1.dot(h3) + at.e3.dot(h1) + h1.dot(h3);
  const double S11 = C11 * E11 + C13 * E33, S33 = C13 * E11 + C11 * E33, S13 = G * gamma;
  const Vec2 f1 = at.e1 + h1, f3 = at.e3 + h3;
  EssenburgElement::Response response{
      .U = 0.5 * (S11 * E11 + S33 * E33 + S13 * gamma), .P1 = S11 * f1 + S13 * f3, .P3 = S13 * f1 + S33 * f3};
  if (!tangent) return response;
  const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();
  response.A11 = S11 * I + C11 * f1 * f1.transpose() + G * f3 * f3.transpose();
  response.A13 = S13 * I + C13 * f1 * f3.transpose() + G * f3 * f1.transpose();
  response.A33 = S33 * I + C11 * f3 * f3.transpose() + G * f1 * f1.transpose();
  return response;
}

double EssenburgBeam::evaluate(const double* u, double* f, double* K) const {
  const auto response = [this](std::size_t i, const Vec2& h1, const Vec2& h3, bool tangent) {
    return respond(element_->points[i], h1, h3, tangent);
  };
  return essenburg::assemble(*element_, response, u, f, K);
}

std::unique_ptr<Element> EssenburgBeam::updated(const double* u) const {
  return std::make_unique<UpdatedEssenburgBeam>(u, element_);
}

}  // namespace arcwall
