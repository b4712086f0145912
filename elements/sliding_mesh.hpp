#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "core/algebra/assembly.hpp"
#include "elements/distributed_load.hpp"
#include "elements/heated_beam.hpp"
#include "elements/sliding_beam_lanes.hpp"
#include "elements/sliding_structure.hpp"

namespace arcwall {

/// The mesh of one cut. Elements are numbered along the strands; each lies between two places that are fixed or move
/// with breakpoints. A point load without a node is inside one element or another, as the breakpoints move.
class SlidingStructureMesh final : public SlidingMesh {
 public:
  SlidingStructureMesh(const SlidingStructure& structure, ElementsPerSegment cut);

  const ElementsPerSegment& elements_per_segment() const override { return cut_; }
  Index unknowns() const override { return assembly_.unknown_count(); }
  Index axial_forces() const override { return static_cast<Index>(straights_.size()); }
  std::optional<Index> axial_force(Index strand, Index position) const override;
  Index breakpoints() const override { return static_cast<Index>(breakpoints_.size()); }
  const StateMetric& metric() const override { return metric_; }
  void residual(const MeshState& now, Eigen::Ref<Vector> F) const override;
  void linearize(const MeshState& now, Linearization& out) const override;
  double energy(const MeshState& now) const override;

  Index nodes(Index strand) const override { return mesh_of(strand).elements + 1; }
  double coordinate(Index strand, Index position, const Eigen::Ref<const Vector>& s) const override;
  NodeUnknowns node_unknowns(Index strand, Index position) const override;
  AxisPlace node(Index strand, Index position, const MeshState& now) const override;
  Eigen::Vector3d node_rate(Index strand, Index position) const override;
  std::pair<Index, Index> breakpoint(Index k) const override { return breakpoints_[static_cast<std::size_t>(k)]; }
  AxisStrain node_strain(Index strand, Index position, At side, const MeshState& now) const override;
  AxisStrainGradient node_strain_gradient(Index strand, Index position, At side, const MeshState& now) const override;
  AxisStrainGradient strain_gradient(Index k, At side, const MeshState& now) const override;
  double element_energy(Index strand, Index position, const MeshState& now) const override {
    return respond(strand, position, now, false).energy;
  }
  EndForces end_forces(Index strand, Index position, const MeshState& now) const override;
  std::vector<PointLoad> point_loads_in(Index strand, Index position, const MeshState& now) const override;
  EndLoad load_on_end(Index strand, bool last, const MeshState& now) const override;
  AxisPlace place(const MaterialPoint& point, const MeshState& now) const override;
  PlaceGradient place_gradient(const MaterialPoint& point, const MeshState& now) const override;
  AxisPlace inside(Index strand, Index position, double fraction, const MeshState& now) const override;
  Vector transferred(const MeshState& now, const SlidingMesh& to, const Vector& s_to) const override;

  Index unknown(Index dof) const { return unknown_of_dof_[static_cast<std::size_t>(dof)]; }

  SlidingStructure::Reaction reaction(const MeshState& now, Index dof) const;

 private:
  double squared_motion_by_lambda() const;
  std::vector<Index> turning_sets() const;

  static constexpr Index held = -1;  // in place of an unknown, or of a breakpoint

  // An end of a segment: a breakpoint, or a fixed place.
  struct SegmentEnd {
    Index breakpoint = held;
    double fixed = 0.0;
  };

  // A place that is fixed, or moves: S = constant + Σ weight_j s_j over two breakpoints at most.
  struct Coordinate {
    double constant = 0.0;
    std::array<Index, 2> breakpoint{held, held};
    std::array<double, 2> weight{};

    double at(const Eigen::Ref<const Vector>& s) const {
      double S = constant;
      for (std::size_t j = 0; j < 2; ++j)
        if (breakpoint[j] != held) S += weight[j] * s[breakpoint[j]];
      return S;
    }
  };
  struct MeshedRun {
    Index first_element = 0, elements = 0;
    Index first_inner = 0;  // unknown of the first inner node
    std::vector<Coordinate> nodes{};
    std::vector<bool> pressed{};  // of the elements
  };
  // Where the ends of an element are, and the load that it carries with them.
  struct Ends {
    Vec2 first, second;
    double angle1, angle2;
    BeamEnds between() const { return {.chord = second - first, .angle1 = angle1, .angle2 = angle2}; }
  };

  const MeshedRun& mesh_of(Index strand) const { return runs_[static_cast<std::size_t>(strand)]; }
  static Coordinate interpolated(const SegmentEnd& a, const SegmentEnd& b, double r);
  Ends ends(Index strand, Index position, const MeshState& now) const;
  double anchor(Index dof, const MeshState& now) const;
  StretchReference reference(Index strand, Index position, const MeshState& now) const;
  Index element_at(const MaterialPoint& point, const MeshState& now) const;

  using Six = StretchLoad::Vector6;
  // The rates by λ at fixed unknowns of x1, z1, angle1, x2, z2, angle2 of an element: not 0 where supports move its
  // ends.
  Six end_rates(Index strand, Index position) const;
  // Whether a support holds an end of the element elsewhere than at rest, always or with λ.
  bool has_displaced_end(Index strand, Index position) const;

  using SixBySix = StretchLoad::Matrix6;
  // What an element and the load along it answer to x1, z1, angle1, x2, z2, angle2. `force_lambda` is the derivative of
  // the force by λ at fixed unknowns, to which ends that supports move belong.
  struct Response {
    double energy = 0.0;
    Six force = Six::Zero(), force_lambda = Six::Zero();
    SixBySix stiffness = SixBySix::Zero();
    std::array<Six, 2> force_rate{Six::Zero(), Six::Zero()};

    Response& operator+=(const Response& other) {
      energy += other.energy;
      force += other.force;
      force_lambda += other.force_lambda;
      stiffness += other.stiffness;
      for (std::size_t end = 0; end < 2; ++end) force_rate[end] += other.force_rate[end];
      return *this;
    }
  };
  // With and without the point loads inside the element.
  Response respond(Index strand, Index position, const MeshState& now, bool with_rates) const;
  Response respond_unloaded(Index strand, Index position, const MeshState& now, bool with_rates) const;
  void add_loads(Index strand, Index position, const StretchReference& stretch, const Ends& at, const MeshState& now,
                 Response& out) const;
  void add_pressure(Index strand, Index position, const Ends& at, const MeshState& now, Response& out) const;
  Response with_end_forces(Response response, Index strand, Index position, const MeshState& now) const;

  // The element on one side of a node, where the node stands among its degrees of freedom, and the sign of what the
  // element does to the node, by which it is stretched and bent.
  struct ElementBeside {
    Index element, place;
    double sign;
    Index turn() const { return place + 2; }
  };
  static ElementBeside beside(Index position, At side) {
    return side == At::before ? ElementBeside{.element = position - 1, .place = 3, .sign = 1.0}
                              : ElementBeside{.element = position, .place = 0, .sign = -1.0};
  }
  AxisStrain strain_of(const Response& response, Index strand, Index position, At side, const MeshState& now) const;
  static void add_foundation(const SlidingStructure::Run& strand, const StretchReference& stretch,
                             const Vec2& first_at_rest, const Ends& at, Response& out);

  // A point load that has no node.
  struct InnerLoad {
    Index strand;
    double s;
    const SlidingStructure::PointLoad* load;
    Vec2 rest;                      // where it acts at rest
    Index first = held, last = -1;  // elements of the segment that hands it on to an obstacle; held: none does
  };
  Index element_of(const InnerLoad& load, const MeshState& now) const {
    const Index e = element_at({.strand = load.strand, .s = load.s}, now);
    return load.first == held ? outside_pressed(load, e, now) : std::clamp(e, load.first, load.last);
  }
  Index outside_pressed(const InnerLoad& load, Index position, const MeshState& now) const;
  using PlaceByEnds = Eigen::Matrix<double, 2, 6>;
  PlaceByEnds place_by_ends(const InnerLoad& load, const Ends& at, double S1, double S2, double lambda,
                            Vec2* place) const;
  static PlaceByEnds place_on_chord(const InnerLoad& load, const Ends& at, double S1, double S2, Vec2* place);
  Response respond(const InnerLoad& load, Index position, const MeshState& now, bool with_rates) const;

  // A straight segment's one element, of which `force` is the unknown axial force.
  struct Straight {
    Index strand, position, force;
  };
  // What the axial force of such an element answers: its equation, and the derivatives of that.
  struct AxialResponse {
    double value = 0.0, by_itself = 0.0, by_lambda = 0.0;
    Six by_ends = Six::Zero();
    std::array<double, 2> rate{};
  };
  const Straight* straight_at(Index strand, Index position) const;
  Response respond_straight(const Straight& straight, const MeshState& now, AxialResponse* axial) const;
  void add_straight(const Straight& straight, const MeshState& now, Eigen::Ref<Vector> F, Linearization* out) const;

  // Adds what an element answers.
  void add_forces(Index strand, Index position, const Response& response, Eigen::Ref<Vector> F) const;
  // `axial` is null where the axial force is not asked, or the element has none of its own.
  void add(Index strand, Index position, const Response& response, const AxialResponse* axial,
           Linearization& out) const;

  // Up to four elements of a segment that are evaluated side by side.
  struct Four {
    Index strand, position;  // of the first
    int count;
    std::array<Index, 2> breakpoint;                  // between which they lie; held: a fixed place
    std::array<double, Lanes::count + 1> from_first;  // of their nodes: fraction of the way to the second
    bool shifted;                                     // BlockAssembly::are_shifted()
    bool inside;                                      // there are four, and no node is an end of the strand
  };
  using Rest = SlidingBeamLanes::Rest;
  void number_fours();
  Rest rest_from(Index strand, Index position, Index most, const MeshState& now) const;
  // visit(four, what it is at rest at the first and at the second node of each element)
  template <typename Visit>
  void for_each_four(const MeshState& now, const Visit& visit) const;
  SlidingBeamLanes::Response respond(const Four& four, const Rest& first, const Rest& second, const MeshState& now,
                                     SlidingBeamLanes::Wanted wanted) const;
  double energy_of_fours(const MeshState& now) const;
  void add_fours(const MeshState& now, Eigen::Ref<Vector> F, Linearization* out) const;
  void add(const Four& four, const Rest& first, const Rest& second, const MeshState& now, Eigen::Ref<Vector> F,
           Linearization* out) const;
  void add_nodal(const Four& four, const Lanes* of_elements, double* to) const;

  // visit(beam) with the beam of a stretch, by value, as warm as it is at λ.
  template <typename Visit>
  void with_beam(Index strand, const StretchReference& stretch, double lambda, const Visit& visit) const;
  // visit(k, rate of the element's force by breakpoint k) for each that moves an end of the element.
  template <typename Visit>
  void for_each_rate(Index strand, Index position, const Response& response, const Visit& visit) const;

  const SlidingStructure& structure_;
  ElementsPerSegment cut_;
  std::vector<std::pair<Index, Index>> breakpoints_;
  std::vector<MeshedRun> runs_;
  std::vector<Index> unknown_of_dof_;  // of the anchors, and of x and z where point loads have nodes
  std::vector<InnerLoad> inner_loads_;
  std::vector<Straight> straights_;
  BlockAssembly assembly_{0, {}};
  std::vector<Four> fours_;
  std::vector<std::pair<Index, Index>> others_;  // strand and position of the elements that are evaluated one by one
  StateMetric metric_;
  double displacement_weight_ = 0.0, rotation_weight_ = 0.0;
};

template <typename Visit>
void SlidingStructureMesh::with_beam(Index strand, const StretchReference& stretch, double lambda,
                                     const Visit& visit) const {
  const SlidingStructure::Run& described = structure_.at(strand);
  if (described.thermal.is_zero()) return with_slender_beam(stretch, described.slender(), 1.0, visit);
  const HeatedStretch hot = heated(stretch, described.thermal, lambda);
  with_slender_beam(hot.reference, described.slender(), hot.stiffer, visit);
}

template <typename Visit>
void SlidingStructureMesh::for_each_rate(Index strand, Index position, const Response& response,
                                         const Visit& visit) const {
  for (std::size_t end = 0; end < 2; ++end) {
    const Coordinate& place = mesh_of(strand).nodes[static_cast<std::size_t>(position) + end];
    for (std::size_t j = 0; j < 2; ++j)
      if (place.breakpoint[j] != held && place.weight[j] != 0.0)
        visit(place.breakpoint[j], Six(place.weight[j] * response.force_rate[end]));
  }
}

}  // namespace arcwall
