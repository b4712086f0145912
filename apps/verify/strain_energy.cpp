// Bars, and beams between whose nodes places and rotations are interpolated.
#include "apps/verify/strain_energy.hpp"

#include <Eigen/LU>

namespace arcwall::verify {

// --- bars -----------------------------------------------------------------------------------------------------------

namespace {

// l² − L² is given apart, so that small strains keep their digits.
template <int N>
Jet<N> bar_strain(TrussStrain measure, const Jet<N>& growth, double L) {
  switch (measure) {
    case TrussStrain::green:
      return 0.5 / (L * L) * growth;
    case TrussStrain::engineering:
      return growth / (L * (sqrt(growth + L * L) + L));
    case TrussStrain::log:
      return 0.5 * log1p(1.0 / (L * L) * growth);
  }
  return {};
}

}  // namespace

LocalEnergy bar_energy(const Vec2& chord, double EA, TrussStrain measure, double free_strain, const Vector& u) {
  const auto unknown = [&](std::size_t i) { return Jet<4>::variable(i, u[static_cast<Index>(i)]); };
  const Jet<4> du = unknown(2) - unknown(0), dw = unknown(3) - unknown(1);
  const Jet<4> growth = du * (du + 2.0 * chord.x()) + dw * (dw + 2.0 * chord.y());
  const double L = chord.norm();
  const Jet<4> strain = bar_strain(measure, growth, L) - free_strain;
  return LocalEnergy(0.5 * EA * L * strain * strain);
}
// --- beams with interpolated fields ---------------------------------------------------------------------------------

namespace {

double arc_speed(const NodesAlong& nodes, const NodeShapes& shapes) {
  double speed = 0.0;
  for (std::size_t a = 0; a < nodes.arcs.size(); ++a) speed += shapes.dN[a] * nodes.arcs[a];
  return speed;
}

}  // namespace

NodeShapes node_shapes(int order, double fraction) {
  const double xi = 2.0 * fraction - 1.0;
  if (order == 1) return {.N = {1.0 - fraction, fraction}, .dN = {-0.5, 0.5}};
  return {.N = {0.5 * xi * (xi - 1.0), (1.0 - xi) * (1.0 + xi), 0.5 * xi * (xi + 1.0)},
          .dN = {xi - 0.5, -2.0 * xi, xi + 0.5}};
}

// As many points as the order: one more would lock. Of u′, w′, θ and θ′, which are linear in the unknowns. With the
// frame of the interpolated axis r₀ turned by θ,
//
//   ε = t·u′ − (1 − t·t⁰) |r₀′|,   γ = n·u′ + n·t⁰ |r₀′|
LocalEnergy reissner_energy(const NodesAlong& nodes, const SectionAlong& section, const FreeDeformation& free,
                            const Vector& u) {
  const auto count = static_cast<Index>(nodes.places.size());
  LocalEnergy sum(3 * count);
  for (const auto& [at, weight] : gauss_rule_of(nodes.order())) {
    const NodeShapes shapes = node_shapes(nodes.order(), at);
    const double speed = arc_speed(nodes, shapes);
    Eigen::Matrix<double, 4, Eigen::Dynamic, Eigen::ColMajor, 4, 9> rows =
        Eigen::Matrix<double, 4, Eigen::Dynamic>::Zero(4, 3 * count);
    Vec2 tangent = Vec2::Zero();
    for (Index a = 0; a < count; ++a) {
      const auto node = static_cast<std::size_t>(a);
      const double slope = shapes.dN[node] / speed;
      tangent += slope * nodes.places[node];
      rows(0, 3 * a) = rows(1, 3 * a + 1) = rows(3, 3 * a + 2) = slope;
      rows(2, 3 * a + 2) = shapes.N[node];
    }
    const Eigen::Vector4d values = rows * u;
    std::array<Jet<4>, 4> field;
    for (std::size_t i = 0; i < field.size(); ++i) field[i] = Jet<4>::variable(i, values[static_cast<Index>(i)]);
    const auto& [du, dw, theta, kappa] = field;
    const double length = tangent.norm(), c = tangent.x() / length, s = tangent.y() / length;
    const Jet<4> along = c * du + s * dw, across = c * dw - s * du;                       // on the stress-free frame
    const Jet<4> sine = sin(theta), half = sin(0.5 * theta), less = 2.0 * (half * half);  // 1 − cos θ
    const Jet<4> strain = along + sine * across - less * (along + length);
    const Jet<4> shear = across - less * across - sine * (along + length);
    const Jet<4> stretch = strain - free.strain, bend = kappa - free.curvature;
    const PlainStiffness here = section(at);
    sum.add(0.5 * weight * 2.0 * speed *
                (here.EA * (stretch * stretch) + here.GA * (shear * shear) + here.EI * (bend * bend)),
            rows);
  }
  return sum;
}

namespace {

// The change of a director d − D, and the bulge q, of a node by its unknowns φ, e and ξ.
struct NodeVectors {
  std::array<Jet<3>, 2> director, bulge;
};

NodeVectors node_vectors(const PlainDirector& of, QuadraticTerm quadratic, const Eigen::Vector3d& unknowns) {
  const Jet<3> phi = Jet<3>::variable(0, unknowns[0]), e = Jet<3>::variable(1, unknowns[1]),
               xi = Jet<3>::variable(2, unknowns[2]);
  const Jet<3> sine = sin(phi), half = sin(0.5 * phi), less = 2.0 * (half * half);
  const Vec2 &D = of.director, across = perp(D);
  NodeVectors out;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto k = static_cast<Index>(i);
    const Jet<3> turned = sine * across[k] - less * D[k];  // t − D
    out.director[i] = turned + e * (turned + D[k]);
    out.bulge[i] = quadratic == QuadraticTerm::fixed ? xi * of.normal[k] : xi * (turned + D[k]);
  }
  return out;
}

// ½ [C (E₁₁² + E₃₃² + 2 ν E₁₁ E₃₃) + k G γ²] by the columns f₁ − e₁ and f₃ − e₃ of the displacement gradient.
Jet<4> density(const EssenburgMaterial& material, const Vec2& e1, const Vec2& e3, const Eigen::Vector4d& columns) {
  std::array<Jet<4>, 4> h;
  for (std::size_t i = 0; i < h.size(); ++i) h[i] = Jet<4>::variable(i, columns[static_cast<Index>(i)]);
  const Jet<4> E11 = e1.x() * h[0] + e1.y() * h[1] + 0.5 * (h[0] * h[0] + h[1] * h[1]);
  const Jet<4> E33 = e3.x() * h[2] + e3.y() * h[3] + 0.5 * (h[2] * h[2] + h[3] * h[3]);
  const Jet<4> gamma = e1.x() * h[2] + e1.y() * h[3] + e3.x() * h[0] + e3.y() * h[1] + h[0] * h[2] + h[1] * h[3];
  const double nu = material.nu, C = material.E / (1.0 - nu * nu), G = material.E / (2.0 * (1.0 + nu));
  return 0.5 * (C * (E11 * E11 + E33 * E33 + 2.0 * nu * (E11 * E33)) + material.shear_correction * G * (gamma * gamma));
}

// The displacement U(ξ, z) = u + z (d − D) + z² q of the body X = R + z D at a place of an element: its gradient
// [U_ξ U_z] [X_ξ X_z]⁻¹ on the section's axes e₁ and e₃, which is linear in the nodes' u, d − D and q.
class EssenburgPoint {
 public:
  EssenburgPoint(const std::vector<Vec2>& places, const std::vector<PlainDirector>& directors, const NodeShapes& shapes,
                 double z)
      : nodes_(places.size()) {
    Eigen::Matrix2d X = Eigen::Matrix2d::Zero();
    Vec2 D_xi = Vec2::Zero();
    for (std::size_t a = 0; a < nodes_; ++a) {
      X.col(0) += shapes.dN[a] * places[a];
      X.col(1) += shapes.N[a] * directors[a].director;
      D_xi += shapes.dN[a] * directors[a].director;
    }
    X.col(0) += z * D_xi;
    axes_.col(1) = X.col(1).normalized();
    axes_.col(0) = -perp(Vec2(axes_.col(1)));
    volume_ = X.determinant();
    const Eigen::Matrix2d to_axes = X.inverse() * axes_;
    for (std::size_t a = 0; a < nodes_; ++a)
      for (std::size_t column = 0; column < 2; ++column) {
        const double by_xi = shapes.dN[a] * to_axes(0, static_cast<Index>(column));
        const double by_z = shapes.N[a] * to_axes(1, static_cast<Index>(column));
        factors_[a][column] = {by_xi, z * by_xi + by_z, z * z * by_xi + 2.0 * z * by_z};
      }
  }

  // Adds the energy of a volume times this area about the place.
  void add(double area, const EssenburgMaterial& material, const std::vector<NodeVectors>& vectors, const Vector& u,
           LocalEnergy& sum) const {
    Eigen::Vector4d gradient = Eigen::Vector4d::Zero();  // f₁ − e₁ and f₃ − e₃
    Eigen::Matrix<double, 4, Eigen::Dynamic, Eigen::ColMajor, 4, 15> rows =
        Eigen::Matrix<double, 4, Eigen::Dynamic>::Zero(4, u.size());
    for_each_row([&](std::size_t a, std::size_t i, Index row, const Factors& of) {
      const Index first = 5 * static_cast<Index>(a);
      const Jet<3> turned = of[1] * vectors[a].director[i] + of[2] * vectors[a].bulge[i];
      gradient[row] += of[0] * u[first + static_cast<Index>(i)] + turned.value;
      rows(row, first + static_cast<Index>(i)) = of[0];
      for (std::size_t k = 0; k < 3; ++k) rows(row, first + 2 + static_cast<Index>(k)) = turned.slope[k];
    });
    const Jet<4> here = area * volume_ * density(material, axes_.col(0), axes_.col(1), gradient);
    sum.add(here, rows);
    // What the second derivatives of directors and bulges add.
    for_each_row([&](std::size_t a, std::size_t i, Index row, const Factors& of) {
      const Jet<3> bent =
          here.slope[static_cast<std::size_t>(row)] * (of[1] * vectors[a].director[i] + of[2] * vectors[a].bulge[i]);
      const Index first = 5 * static_cast<Index>(a) + 2;
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 0; l < 3; ++l)
          sum.stiffness(first + static_cast<Index>(k), first + static_cast<Index>(l)) += bent.second(k, l);
    });
  }

 private:
  using Factors = std::array<double, 3>;  // of u, d − D and q

  // visit(node, x or z, row of the gradient, factors of the node's vectors in it)
  template <class Visit>
  void for_each_row(const Visit& visit) const {
    for (std::size_t a = 0; a < nodes_; ++a)
      for (std::size_t column = 0; column < 2; ++column)
        for (std::size_t i = 0; i < 2; ++i) visit(a, i, static_cast<Index>(2 * column + i), factors_[a][column]);
  }

  std::size_t nodes_;
  Eigen::Matrix2d axes_ = Eigen::Matrix2d::Zero();  // e₁, e₃
  double volume_ = 0.0;                             // by ξ and area
  std::array<std::array<Factors, 2>, 3> factors_{};
};

}  // namespace

LocalEnergy essenburg_energy(const std::vector<Vec2>& places, const std::vector<PlainDirector>& directors,
                             const EssenburgMaterial& material, const Vector& u) {
  const int order = static_cast<int>(places.size()) - 1;
  std::vector<NodeVectors> vectors;
  for (std::size_t a = 0; a < places.size(); ++a)
    vectors.push_back(node_vectors(directors[a], material.quadratic, u.segment<3>(5 * static_cast<Index>(a) + 2)));
  LocalEnergy sum(u.size());
  for (const auto& [at, weight] : gauss_rule_of(order)) {
    const NodeShapes shapes = node_shapes(order, at);
    for (const auto& [z, area] : material.heights)
      EssenburgPoint(places, directors, shapes, z).add(2.0 * weight * area, material, vectors, u, sum);
  }
  return sum;
}

}  // namespace arcwall::verify
