#include "elements/updated_essenburg_beam.hpp"

#include <Eigen/LU>

#include "elements/essenburg_assembly.hpp"

namespace arcwall {

namespace {

using Square = Eigen::Matrix2d;

// (f1, f3): deformation gradient from the section's stress-free axes.
Square gradient(const EssenburgElement::Point& at, const Vec2& h1, const Vec2& h3) {
  Square F;
  F << at.e1 + h1, at.e3 + h3;
  return F;
}

std::vector<Square> gradients(const EssenburgElement& element, const double* u) {
  std::vector<Square> all(element.points.size());
  essenburg::assemble(
      element,
      [&](std::size_t i, const Vec2& h1, const Vec2& h3, bool) {
        all[i] = gradient(element.points[i], h1, h3);
        return EssenburgElement::Response{};
      },
      u, nullptr, nullptr);
  return all;
}

// Present axes of a section: across it along f3, along it at a right angle.
struct Axes {
  Vec2 t1, t3;
};

Axes axes(const Square& F) {
  const Vec2 t3 = F.col(1).normalized();
  return {.t1 = -perp(t3), .t3 = t3};
}

}  // namespace

UpdatedEssenburgBeam::UpdatedEssenburgBeam(const double* u, std::shared_ptr<const EssenburgElement> element)
    : UpdatedEssenburgBeam(u, element, std::vector<Square>(element->points.size(), Square::Zero()), 0.0) {}

UpdatedEssenburgBeam::UpdatedEssenburgBeam(const double* u, std::shared_ptr<const EssenburgElement> element,
                                           std::vector<Square> stresses, double energy)
    : UpdatedElement(essenburg::unknowns_a_node * static_cast<int>(element->sections.size()), u, energy),
      element_(std::move(element)),
      stresses_(std::move(stresses)) {
  Vector f(unknown_count());
  Matrix K(unknown_count(), unknown_count());
  essenburg::assemble(
      *element_,
      [this](std::size_t i, const Vec2& h1, const Vec2& h3, bool) {
        return respond(i, gradient(element_->points[i], h1, h3));
      },
      u, f.data(), K.data());
  set_response(std::move(f), Matrix(K.selfadjointView<Eigen::Lower>()));
}

// With J = det F and the dual vectors g_α of f_α (rows of F⁻¹) the stresses of Cauchy σ are those of Piola and
// Kirchhoff P_α = J σ g_α, S_αβ = g_α·P_β, and the strain increment on the present axes t1, t3 is, by δf_α,
//
//   ε11 = Σ (g_α·t1) t1·δf_α,   ε33 = Σ (g_α·t3) t3·δf_α,   γ = Σ [(g_α·t3) t1 + (g_α·t1) t3]·δf_α        (1)
//
// K_L has J C on these, K_σ has S_αβ.
EssenburgElement::Response UpdatedEssenburgBeam::respond(std::size_t i, const Square& F) const {
  const double J = F.determinant(), weight = element_->points[i].volume * J;
  const Square dual = F.inverse().transpose();  // columns g1, g3
  const Square P = weight * stresses_[i] * dual, S = dual.transpose() * P;
  const auto [t1, t3] = axes(F);
  const auto strains = [&, t1 = t1, t3 = t3](const Vec2& g) {
    Eigen::Matrix<double, 3, 2> rows;
    rows << g.dot(t1) * t1.transpose(), g.dot(t3) * t3.transpose(), (g.dot(t3) * t1 + g.dot(t1) * t3).transpose();
    return rows;
  };
  const Eigen::Matrix<double, 3, 2> B1 = strains(dual.col(0)), B3 = strains(dual.col(1));
  Eigen::Matrix3d C;
  C << element_->C11, element_->C13, 0.0, element_->C13, element_->C11, 0.0, 0.0, 0.0, element_->G;
  C *= weight;
  return {.P1 = P.col(0),
          .P3 = P.col(1),
          .A11 = S(0, 0) * Square::Identity() + B1.transpose() * C * B1,
          .A13 = S(0, 1) * Square::Identity() + B1.transpose() * C * B3,
          .A33 = S(1, 1) * Square::Identity() + B3.transpose() * C * B3};
}

// ΔF leads from the old configuration to the new one. ΔS = C : ΔE on the axes of the old one, and
// σ_new = ΔF (σ + ΔS) ΔFᵀ/det ΔF.
std::unique_ptr<Element> UpdatedEssenburgBeam::updated(const double* u) const {
  const std::vector<Square> before = gradients(*element_, reference().data()), after = gradients(*element_, u);
  std::vector<Square> stresses(stresses_.size());
  double work = 0.0;
  for (std::size_t i = 0; i < stresses.size(); ++i) {
    const Square change = after[i] * before[i].inverse();
    const Square E = 0.5 * (change.transpose() * change - Square::Identity());
    const auto [t1, t3] = axes(before[i]);
    const double E11 = t1.dot(E * t1), E33 = t3.dot(E * t3), E13 = t1.dot(E * t3);
    const double S11 = element_->C11 * E11 + element_->C13 * E33, S33 = element_->C13 * E11 + element_->C11 * E33;
    const Square dS = S11 * t1 * t1.transpose() + S33 * t3 * t3.transpose() +
                      2.0 * element_->G * E13 * (t1 * t3.transpose() + t3 * t1.transpose());
    stresses[i] = change * (stresses_[i] + dS) * change.transpose() / change.determinant();
    work += element_->points[i].volume * before[i].determinant() * (stresses_[i] + 0.5 * dS).cwiseProduct(E).sum();
  }
  return std::make_unique<UpdatedEssenburgBeam>(u, element_, std::move(stresses), energy() + work);
}

}  // namespace arcwall
