#pragma once

#include <array>

#include "elements/essenburg_beam.hpp"

// From the nodal vectors v = (u, d − D, q) of an Essenburg beam to its unknowns.
namespace arcwall::essenburg {

inline constexpr int unknowns_a_node = EssenburgBeam::unknowns_a_node;
inline constexpr int vectors_a_node = 3;               // u, d − D, q
inline constexpr int components = 2 * vectors_a_node;  // of the vectors of a node

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

}  // namespace arcwall::essenburg
