#include "answers/mirror_images.hpp"

#include <algorithm>
#include <numeric>

namespace arcwall {

namespace {

// The factor of a degree of freedom's value in an image.
double factor(Dof kind, const Vec2& factors) {
  switch (kind) {
    case Dof::x:
      return factors.x();
    case Dof::z:
    case Dof::thickness2:
      return factors.y();
    case Dof::rotation:
      return factors.x() * factors.y();
    case Dof::thickness:
      return 1.0;
  }
  return 1.0;
}

}  // namespace

MirrorImages::MirrorImages(const Structure& structure)
    : structure_(structure), dofs_(static_cast<std::size_t>(structure.node_count())) {
  Vec2 low = structure.position(0), high = low;
  for (Index node = 0; node < structure.node_count(); ++node) {
    low = low.cwiseMin(structure.position(node));
    high = high.cwiseMax(structure.position(node));
    for (const Dof kind : {Dof::x, Dof::z})
      dofs_[static_cast<std::size_t>(node)].push_back({structure.dof(node, kind), kind});
  }
  middle_ = 0.5 * (low + high);
  const auto add = [&](Index node, Index dof, Dof kind) {
    auto& list = dofs_[static_cast<std::size_t>(node)];
    if (std::none_of(list.begin(), list.end(), [&](const NodeDof& one) { return one.dof == dof; }))
      list.push_back({dof, kind});
  };
  const auto add_thickness = [&](Index node, const ThicknessDofs& thickness) {
    add(node, thickness.e, Dof::thickness);
    add(node, thickness.xi, Dof::thickness2);
  };
  for (const MemberMesh& member : structure.members()) {
    for (std::size_t k = 0; k < member.nodes.size(); ++k) {
      if (member.rotations[k]) add(member.nodes[k], *member.rotations[k], Dof::rotation);
      if (k < member.thickness.size()) add_thickness(member.nodes[k], member.thickness[k]);
    }
    for (std::size_t k = 0; k < member.middle_nodes.size(); ++k) {
      add(member.middle_nodes[k], member.middle_rotations[k], Dof::rotation);
      if (k < member.middle_thickness.size()) add_thickness(member.middle_nodes[k], member.middle_thickness[k]);
    }
  }
  for (const Vec2& factors : {Vec2(1.0, -1.0), Vec2(-1.0, 1.0), Vec2(-1.0, -1.0)})
    if (auto partner = partners(factors); !partner.empty()) mirrors_.push_back({factors, std::move(partner)});
}

std::vector<Vector> MirrorImages::of(const State& state) const {
  std::vector<Vector> images;
  for (const Mirror& mirror : mirrors_) images.push_back(image(mirror, state));
  return images;
}

// Whose image each node is, but for imperfections; empty if that cannot be told.
std::vector<Index> MirrorImages::partners(const Vec2& factors) const {
  const double near = 0.02 * structure_.length_scale();
  const Mirror mirror{.factors = factors};
  std::vector<Index> by_x(static_cast<std::size_t>(structure_.node_count()));
  std::iota(by_x.begin(), by_x.end(), Index{0});
  const auto x_of = [&](Index node) { return structure_.position(node).x(); };
  std::stable_sort(by_x.begin(), by_x.end(), [&](Index a, Index b) { return x_of(a) < x_of(b); });
  std::vector<Index> partner(by_x.size(), -1);
  std::vector<bool> taken(by_x.size(), false);
  for (std::size_t node = 0; node < partner.size(); ++node) {
    const Vec2 place = mirrored(mirror, structure_.position(static_cast<Index>(node)));
    double least = near;
    for (auto other = std::lower_bound(by_x.begin(), by_x.end(), place.x() - near,
                                       [&](Index a, double x) { return x_of(a) < x; });
         other != by_x.end() && x_of(*other) <= place.x() + near; ++other) {
      const double apart = (structure_.position(*other) - place).norm();
      if (apart >= least || taken[static_cast<std::size_t>(*other)]) continue;
      least = apart;
      partner[node] = *other;
    }
    if (partner[node] < 0) return {};
    taken[static_cast<std::size_t>(partner[node])] = true;
  }
  return partner;
}

Vec2 MirrorImages::mirrored(const Mirror& mirror, const Vec2& place) const {
  return middle_ + mirror.factors.cwiseProduct(place - middle_);
}

// By how much an image is to be moved so that it stands where supports hold the structure, in the mean.
Vec2 MirrorImages::shift_to_supports(const Mirror& mirror, const State& state) const {
  Vec2 sum = Vec2::Zero(), count = Vec2::Zero();
  for (Index node = 0; node < structure_.node_count(); ++node) {
    const Vec2 off = structure_.current(state, node) -
                     mirrored(mirror, structure_.current(state, mirror.partner[static_cast<std::size_t>(node)]));
    for (const Dof kind : {Dof::x, Dof::z}) {
      if (structure_.unknown(structure_.dof(node, kind))) continue;
      const int i = kind == Dof::z ? 1 : 0;
      sum[i] += off[i];
      count[i] += 1.0;
    }
  }
  return sum.cwiseQuotient(count.cwiseMax(1.0));
}

Vector MirrorImages::image(const Mirror& mirror, const State& state) const {
  Vector x = Vector::Zero(structure_.size({}));
  const Vec2 shift = shift_to_supports(mirror, state);
  for (std::size_t node = 0; node < dofs_.size(); ++node) {
    const Index partner = mirror.partner[node];
    const auto &here = dofs_[node], &there = dofs_[static_cast<std::size_t>(partner)];
    const Vec2 moved =
        mirrored(mirror, structure_.current(state, partner)) + shift - structure_.position(static_cast<Index>(node));
    for (std::size_t k = 0; k < here.size(); ++k) {
      const auto unknown = structure_.unknown(here[k].dof);
      if (!unknown) continue;
      if (here[k].kind == Dof::x || here[k].kind == Dof::z)
        x[*unknown] = here[k].kind == Dof::x ? moved.x() : moved.y();
      else if (k < there.size() && there[k].kind == here[k].kind)
        x[*unknown] = factor(here[k].kind, mirror.factors) * structure_.value(state, there[k].dof);
    }
  }
  return x;
}

}  // namespace arcwall
