#pragma once

#include "elements/essenburg_beam.hpp"

// Sums over the quadrature points of an Essenburg element; included by the sources of its forms alone.
namespace arcwall::essenburg {

constexpr int unknowns_a_node = EssenburgBeam::unknowns_a_node;
constexpr int vectors_a_node = EssenburgElement::vectors_a_node;
constexpr int components = 2 * vectors_a_node;  // of the vectors of a node

template <int nodes>
using Sections = std::array<EssenburgNode::Vectors, nodes>;

// T = ∂v/∂u of one node.
inline Eigen::Matrix<double, components, unknowns_a_node> transform(const EssenburgNode::Vectors& section) {
  Eigen::Matrix<double, components, unknowns_a_node> T;
  T.setZero();
  T.block<2, 2>(0, 0).setIdentity();
  T.block<2, 1>(2, 2) = section.d_phi;
  T.block<2, 1>(4, 2) = section.q_phi;
  T.block<2, 1>(2, 3) = section.d_e;
  T.block<2, 1>(4, 4) = section.q_xi;
  return T;
}

// f = Tᵀ g
template <int nodes>
void forces_of_unknowns(const Sections<nodes>& sections, const Eigen::Matrix<double, 2, vectors_a_node * nodes>& g,
                        double* f) {
  const Eigen::Map<const Eigen::Matrix<double, components * nodes, 1>> forces(g.data());
  Eigen::Map<Eigen::Matrix<double, unknowns_a_node * nodes, 1>> out(f);
  for (int a = 0; a < nodes; ++a)
    out.template segment<unknowns_a_node>(unknowns_a_node * a) =
        transform(sections[static_cast<std::size_t>(a)]).transpose() *
        forces.template segment<components>(components * a);
}

// K = Tᵀ H T + Σ g·∂²v; the lower triangle of H is enough.
template <int nodes>
void stiffness_of_unknowns(const Sections<nodes>& sections, const Eigen::Matrix<double, 2, vectors_a_node * nodes>& g,
                           Eigen::Matrix<double, components * nodes, components * nodes>& H, double* K) {
  H.template triangularView<Eigen::StrictlyUpper>() = H.transpose();
  Eigen::Map<Eigen::Matrix<double, unknowns_a_node * nodes, unknowns_a_node * nodes>> out(K);
  for (int b = 0; b < nodes; ++b) {
    const EssenburgNode::Vectors& at = sections[static_cast<std::size_t>(b)];
    const auto T = transform(at);
    for (int a = b; a < nodes; ++a)
      out.template block<unknowns_a_node, unknowns_a_node>(unknowns_a_node * a, unknowns_a_node * b).noalias() =
          transform(sections[static_cast<std::size_t>(a)]).transpose() *
          (H.template block<components, components>(components * a, components * b) * T).eval();
    const Vec2 of_d = g.col(vectors_a_node * b + 1), of_q = g.col(vectors_a_node * b + 2);
    const int phi = unknowns_a_node * b + 2, e = phi + 1, xi = phi + 2;
    out(phi, phi) += of_d.dot(at.d_phi_phi) + of_q.dot(at.q_phi_phi);
    out(e, phi) += of_d.dot(at.d_phi_e);
    out(xi, phi) += of_q.dot(at.q_phi_xi);
  }
}

// Energy at u, and where they are not null forces f and stiffness K: `respond(i, h1, h3, tangent)` is the Response of
// point i to the changes h1 = f1 − e1, h3 = f3 − e3. By c1 and c3 gradient g and Hessian H are those in the nodal
// vectors v.
template <int nodes, class Respond>
double assemble_nodes(const EssenburgElement& element, const Respond& respond, const double* u, double* f, double* K) {
  constexpr int vectors = vectors_a_node * nodes;
  Sections<nodes> sections;
  Eigen::Matrix<double, 2, vectors> v, g = Eigen::Matrix<double, 2, vectors>::Zero();
  for (int a = 0; a < nodes; ++a) {
    const double* at = u + unknowns_a_node * a;
    EssenburgNode::Vectors& section = sections[static_cast<std::size_t>(a)];
    section = element.sections[static_cast<std::size_t>(a)].vectors(at[2], at[3], at[4]);
    v.col(vectors_a_node * a) = Vec2(at[0], at[1]);
    v.col(vectors_a_node * a + 1) = section.d_change;
    v.col(vectors_a_node * a + 2) = section.q;
  }
  Eigen::Matrix<double, 2 * vectors, 2 * vectors> H;
  if (K != nullptr) H.setZero();

  double U = 0.0;
  for (std::size_t i = 0; i < element.points.size(); ++i) {
    const EssenburgElement::Point& at = element.points[i];
    const Eigen::Map<const Eigen::Matrix<double, vectors, 1>> c1(at.c1.data()), c3(at.c3.data());
    const EssenburgElement::Response response = respond(i, v * c1, v * c3, K != nullptr);
    U += response.U;
    g.noalias() += response.P1 * c1.transpose();
    g.noalias() += response.P3 * c3.transpose();
    if (K == nullptr) continue;
    for (int j = 0; j < vectors; ++j) {
      const Eigen::Matrix2d B1 = c1[j] * response.A11 + c3[j] * response.A13;
      const Eigen::Matrix2d B3 = c1[j] * response.A13.transpose() + c3[j] * response.A33;
      for (int k = j; k < vectors; ++k) H.template block<2, 2>(2 * k, 2 * j) += c1[k] * B1 + c3[k] * B3;
    }
  }
  if (f != nullptr) forces_of_unknowns<nodes>(sections, g, f);
  if (K != nullptr) stiffness_of_unknowns<nodes>(sections, g, H, K);
  return U;
}

template <class Respond>
double assemble(const EssenburgElement& element, const Respond& respond, const double* u, double* f, double* K) {
  return element.sections.size() == 2 ? assemble_nodes<2>(element, respond, u, f, K)
                                      : assemble_nodes<3>(element, respond, u, f, K);
}

}  // namespace arcwall::essenburg
