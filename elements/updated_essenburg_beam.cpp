#include "elements/updated_essenburg_beam.hpp"

#include <Eigen/LU>

#include "elements/essenburg_vectors.hpp"

namespace arcwall {

using essenburg::unknowns_a_node;
using essenburg::vectors_a_node;

namespace {

// The nodal vectors v = (u, d − D, q) at the unknowns.
Matrix vectors_at(const std::vector<EssenburgNode>& sections, const double* u) {
  Matrix v(2, vectors_a_node * static_cast<Index>(sections.size()));
  for (std::size_t a = 0; a < sections.size(); ++a) {
    const double* at = u + unknowns_a_node * static_cast<std::ptrdiff_t>(a);
    const EssenburgNode::Vectors section = sections[a].vectors(at[2], at[3], at[4]);
    const Index first = vectors_a_node * static_cast<Index>(a);
    v.col(first) = Vec2(at[0], at[1]);
    v.col(first + 1) = section.d_change;
    v.col(first + 2) = section.q;
  }
  return v;
}

// A quadrature point in the present configuration: increments Δv of the nodal vectors have the gradient
// h = Σ_j Δv_j β_jᵀ.
struct Present {
  double volume;
  Matrix beta;           // 2 × vectors
  Eigen::Matrix2d axes;  // of the section: e1 across its director, e3 along

  Present(const EssenburgPoint& point, const Matrix& v) {
    const auto n = v.cols();
    Matrix c(2, n);
    c.row(0) = Eigen::Map<const Vector>(point.c1.data(), n).transpose();
    c.row(1) = Eigen::Map<const Vector>(point.c3.data(), n).transpose();
    Eigen::Matrix2d F = v * c.transpose();
    F.col(0) += point.e1;
    F.col(1) += point.e3;
    const double J = F.determinant();
    Eigen::Matrix2d cofactor;
    cofactor << F(1, 1), -F(1, 0), -F(0, 1), F(0, 0);
    volume = point.volume * J;
    beta = cofactor / J * c;
    axes.col(1) = F.col(1).normalized();
    axes.col(0) = -perp(axes.col(1));
  }
};

// C : E on the section's axes, with E and the result on the global ones.
Eigen::Matrix2d stress_of(const EssenburgLaw& law, const Eigen::Matrix2d& axes, const Eigen::Matrix2d& strain) {
  const Eigen::Matrix2d E = axes.transpose() * strain * axes;
  Eigen::Matrix2d S;
  S(0, 0) = law.C11 * E(0, 0) + law.C13 * E(1, 1);
  S(1, 1) = law.C13 * E(0, 0) + law.C11 * E(1, 1);
  S(0, 1) = S(1, 0) = 2.0 * law.G * E(0, 1);
  return axes * S * axes.transpose();
}

}  // namespace

UpdatedEssenburgBeam::UpdatedEssenburgBeam(std::shared_ptr<const Material> material, const double* u)
    : UpdatedEssenburgBeam(material, u, Stresses(material->points.size(), Eigen::Matrix2d::Zero()), 0.0) {}

UpdatedEssenburgBeam::UpdatedEssenburgBeam(std::shared_ptr<const Material> material, const double* u, Stresses stresses,
                                           double energy)
    : UpdatedElement(unknowns_a_node * static_cast<int>(material->sections.size()), u, energy),
      material_(std::move(material)),
      stresses_(std::move(stresses)) {
  if (material_->sections.size() == 2)
    respond<2>();
  else
    respond<3>();
}

// Eq. (13) in the nodal vectors, with the strains B_j Δv_j = (h11, h33, h13 + h31) on the section's axes:
//
//   g_j = ∫ σ β_j dV,    H_ij = ∫ (B_iᵀ C B_j + (β_i·σ β_j) 1) dV                                        (1)
template <int nodes>
void UpdatedEssenburgBeam::respond() {
  constexpr int vectors = vectors_a_node * nodes;
  const EssenburgLaw& law = material_->law;
  Eigen::Matrix3d C;
  C << law.C11, law.C13, 0.0, law.C13, law.C11, 0.0, 0.0, 0.0, law.G;
  essenburg::Sections<nodes> sections;
  for (int a = 0; a < nodes; ++a) {
    const double* at = reference().data() + unknowns_a_node * a;
    sections[static_cast<std::size_t>(a)] =
        material_->sections[static_cast<std::size_t>(a)].vectors(at[2], at[3], at[4]);
  }
  const Matrix v = vectors_at(material_->sections, reference().data());
  Eigen::Matrix<double, 2, vectors> g = Eigen::Matrix<double, 2, vectors>::Zero();
  Eigen::Matrix<double, 2 * vectors, 2 * vectors> H;
  H.setZero();
  for (std::size_t p = 0; p < material_->points.size(); ++p) {
    const Present present(material_->points[p], v);
    const Eigen::Matrix2d& sigma = stresses_[p];
    g += present.volume * sigma * present.beta;
    const Vec2 e1 = present.axes.col(0), e3 = present.axes.col(1);
    Eigen::Matrix<double, 3, 2 * vectors> B;
    for (int j = 0; j < vectors; ++j) {
      const double along = e1.dot(present.beta.col(j)), across = e3.dot(present.beta.col(j));
      B.template block<3, 2>(0, 2 * j) << along * e1.transpose(), across * e3.transpose(),
          across * e1.transpose() + along * e3.transpose();
    }
    H += present.volume * B.transpose() * C * B;
    const Matrix initial = present.volume * present.beta.transpose() * sigma * present.beta;
    for (int i = 0; i < vectors; ++i)
      for (int j = 0; j < vectors; ++j) H.template block<2, 2>(2 * i, 2 * j).diagonal().array() += initial(i, j);
  }
  constexpr int unknowns = unknowns_a_node * nodes;
  Vector f(unknowns);
  Matrix K = Matrix::Zero(unknowns, unknowns);
  essenburg::forces_of_unknowns<nodes>(sections, g, f.data());
  essenburg::stiffness_of_unknowns<nodes>(sections, g, H, K.data());
  K.triangularView<Eigen::StrictlyUpper>() = K.transpose();
  set_response(std::move(f), std::move(K));
}

// σ := (1 + h)(σ + C : E)(1 + h)ᵀ / det(1 + h),    E = ½ (h + hᵀ + hᵀ h)
std::unique_ptr<Element> UpdatedEssenburgBeam::updated(const double* u) const {
  const Matrix v = vectors_at(material_->sections, reference().data());
  const Matrix change = vectors_at(material_->sections, u) - v;
  Stresses stresses;
  double work = 0.0;
  for (std::size_t p = 0; p < material_->points.size(); ++p) {
    const Present present(material_->points[p], v);
    const Eigen::Matrix2d h = change * present.beta.transpose(), f = Eigen::Matrix2d::Identity() + h;
    const Eigen::Matrix2d E = 0.5 * (h + h.transpose() + h.transpose() * h);
    const Eigen::Matrix2d S = stress_of(material_->law, present.axes, E);
    work += present.volume * (stresses_[p] + 0.5 * S).cwiseProduct(E).sum();
    stresses.push_back(f * (stresses_[p] + S) * f.transpose() / f.determinant());
  }
  return std::make_unique<UpdatedEssenburgBeam>(material_, u, std::move(stresses), energy() + work);
}

}  // namespace arcwall
