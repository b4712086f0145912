#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/observable.hpp"
#include "core/sliding_body.hpp"
#include "elements/heated_beam.hpp"
#include "elements/line_load.hpp"
#include "elements/member_point.hpp"
#include "elements/sliding_beam_lanes.hpp"

namespace arcwall {

class SlidingStructureMesh;

/// Slender beams between joints, supports and dead loads, to be meshed with breakpoints that move. Built by
/// StructureBuilder::build_sliding().
///
/// Members that continue each other at a joint without support, spring, moment or hinge are one strand where they lie
/// on one line or on one circle, whichever of their ends meet: a breakpoint passes such a joint without notice. What
/// else acts inside a member ends strands, too. A force does not: it acts on a node of the mesh, or inside an element
/// where a breakpoint is too near for that.
class SlidingStructure final : public SlidingBody {
 public:
  /// Whether two members, by name, may be parts of one strand.
  using Alike = std::function<bool(const std::string&, const std::string&)>;

  Index strands() const override { return static_cast<Index>(runs_.size()); }
  double length(Index strand) const override { return at(strand).length; }
  /// Of a section that tapers only its axis can be in contact: the half height in the member's middle.
  double half_height(Index strand) const override { return 0.5 * at(strand).section.height.value_or(0.0); }
  double half_height_at(const MaterialPoint& point) const {
    return 0.5 * at(point.strand).section_at(point.s).height.value_or(0.0);
  }
  double elements_between(Index strand, double from, double to) const override;
  double natural_curvature(const MaterialPoint& point, double lambda) const override;
  double natural_curvature_derivative(const MaterialPoint& point, int derivative) const override;
  SectionStiffness stiffness(const MaterialPoint& point, int derivative = 0) const override;
  FreeStrain free_strain(Index strand, double lambda) const override {
    const Driven& strain = at(strand).thermal.strain;
    return {.value = strain.at(lambda), .rate = strain.proportional};
  }
  Vec2 load(const MaterialPoint& point, const AxisPlace& place, double stretch, double lambda) const override;
  const std::vector<double>& point_loads(Index strand) const override { return at(strand).load_places; }
  PointForce point_load(Index strand, Index load, double lambda) const override {
    return at(strand).point_loads[static_cast<std::size_t>(load)].at(lambda);
  }
  bool end_is_held(Index strand, bool last) const override {
    return nodal_.is_held(at(strand).ends[last ? 1 : 0].dof[1]);
  }
  StrandEnd first_of_joint(Index strand, bool last, bool on_axis) const override;
  bool is_tip(Index strand, bool last) const override;
  std::optional<StrandEnd> joined_end(Index strand, bool last) const override;
  bool is_clamped(Index strand, bool last) const override {
    const End& end = at(strand).ends[last ? 1 : 0];
    return nodal_.is_held(end.dof[1]) && nodal_.is_held(end.dof[2]);
  }
  bool is_hinged(Index strand, bool last) const override;
  bool is_on_plane(Index strand, bool last) const override;
  bool is_on_roller(Index strand, bool last) const override {
    return is_hinged(strand, last) && !nodal_.is_held(at(strand).ends[last ? 1 : 0].dof[0]);
  }
  std::pair<std::string, double> label(const MaterialPoint& point) const override;
  std::shared_ptr<const SlidingMesh> mesh(const ElementsPerSegment& cut) const override;
  Vector rest(const SlidingMesh& mesh, const Vector& s) const override;
  double length_scale() const override { return length_scale_; }
  double force_scale() const override { return force_scale_; }

  /// A member, or a part of it, as a stretch of a strand.
  struct MemberPart {
    Index strand = 0;
    double from = 0.0, to = 0.0;                       ///< arc length along the strand, ascending
    double first_fraction = 0.0, last_fraction = 1.0;  ///< of the member, at these

    /// Whether the strand travels against the member.
    bool is_reversed() const { return first_fraction > last_fraction; }
    double least_fraction() const { return is_reversed() ? last_fraction : first_fraction; }
    double greatest_fraction() const { return is_reversed() ? first_fraction : last_fraction; }

    MaterialPoint at(double fraction) const {
      const double t = (fraction - first_fraction) / (last_fraction - first_fraction);
      return {.strand = strand, .s = from + t * (to - from)};
    }
  };

  /// The first part of a member that reaches to a fraction of its length; std::out_of_range if there is none.
  MemberPart part_at(const std::string& member, double fraction) const;

  /// The place of a member at a fraction of its length; std::out_of_range if there is none.
  MaterialPoint find(const std::string& member, double fraction) const {
    return part_at(member, fraction).at(fraction);
  }

  /// Where a joint's degree of freedom is that lies inside a strand; empty at ends of strands.
  std::optional<MaterialPoint> inside(Index dof) const;
  Dof kind(Index dof) const { return dofs_[static_cast<std::size_t>(dof)].dof; }

  /// All of a member, from end to end.
  std::vector<MemberPart> parts_of(const std::string& member) const;

  /// Stress-free place and direction of the axis, with or without imperfection.
  AxisPlace undeformed(const MaterialPoint& point, bool imperfect) const;

  /// What the unknown of a support's or a joint's degree of freedom is; see StructureBuilder::degree of freedom.
  Index dof(Index node, Dof which) const { return first_dof_[static_cast<std::size_t>(node)] + (which == Dof::z); }

  /// Displacement or rotation of a joint's degree of freedom, and the rate of this value by λ at fixed unknowns: that
  /// of the support, 0 of a degree of freedom that is not held.
  double value(const SlidingMesh& mesh, const MeshState& now, Index dof) const;
  double held_rate(Index dof) const { return nodal_.support(dof).proportional; }
  std::optional<Index> unknown(const SlidingMesh& mesh, Index dof) const;

  /// Force that a support exerts through a degree of freedom it holds, with its derivatives in x, s and λ; 0 in one
  /// that is free.
  struct Reaction {
    double value = 0.0;
    Vector dx{}, ds{};
    double dlambda = 0.0;
  };
  Reaction reaction(const SlidingMesh& mesh, const MeshState& now, Index dof) const;

 private:
  friend class StructureBuilder;
  friend class SlidingStructureMesh;

  // A stretch of a strand that is, or is part of, a member of the deck.
  struct Part {
    std::string member;
    double from, to;                       // arc length along the strand
    double first_fraction, last_fraction;  // of the member, descending where the strand travels against it
    double elements;                       // that it asks for
  };
  // A force on a node inside a member, by the degrees of freedom x and z of the deck's mesh there.
  struct PointLoad {
    std::array<Index, 2> dof{};
    std::array<Driven, 2> force{};

    PointForce at(double lambda) const {
      return {.value = {force[0].at(lambda), force[1].at(lambda)},
              .rate = {force[0].proportional, force[1].proportional}};
    }
  };
  // A joint that a strand passes, by its node.
  struct InnerJoint {
    Index node;
    double s;
  };
  // An end of a strand: its degrees of freedom x, z, rotation, and the stress-free angle.
  struct End {
    std::array<Index, 3> dof{};
    double angle = 0.0;
  };
  struct Run {
    std::shared_ptr<const Axis> axis{};
    std::shared_ptr<const ImperfectAxis> shape{};  // of the axis
    bool perfect = true;
    Theory theory = Theory::euler_bernoulli;
    int order = 2;
    Section section{};
    double length = 0.0, offset = 0.0;  // of the strand; where it begins on the axis
    std::vector<Part> parts{};
    std::array<End, 2> ends{};
    std::vector<DrivenLineLoad> loads{};      // by arc lengths of the axis
    FoundationLaw foundation{};               // to the ground
    Driven pressure{};                        // on its right [force/length]
    std::vector<PointLoad> point_loads{};     // inside the strand
    std::vector<double> load_places{};        // of these
    std::vector<InnerJoint> joints{};         // inside the strand
    std::optional<SlidingBeamLanes> beams{};  // where they can be evaluated side by side
    ThermalStrain thermal{};

    // Whether a load depends on the direction of the axis.
    bool load_turns() const {
      return std::any_of(loads.begin(), loads.end(), [](const DrivenLineLoad& one) { return !one.load.is_straight(); });
    }

    SlenderSection slender() const;
    // At a place of the strand.
    Section section_at(double s) const { return section.at((offset + s) / axis->length()); }
    bool has_foundation() const { return !foundation.is_zero(); }
  };

  SlidingStructure() = default;
  // `carries_force_alone`: of nodes with terms, given with their rotation; a strand passes those.
  using CarriesForceAlone = std::function<bool(Index node, Index rotation)>;
  class RunJoiner;
  void join_runs(const std::vector<bool>& with_terms, const CarriesForceAlone& carries_force_alone, const Alike& alike);
  bool passes(const Run& a, const Run& b, const std::vector<bool>& with_terms,
              const CarriesForceAlone& carries_force_alone) const;
  static Run reversed(const Run& run);
  Run joined(Run a, const Run& b, bool carries_force) const;
  Index node_of(const End& end) const { return dofs_[static_cast<std::size_t>(end.dof[0])].node; }
  PointLoad point_load(Index node) const;
  // All ends of strands at the joint with this degree of freedom, which an end has.
  const std::vector<StrandEnd>& ends_at(Index dof_z) const { return ends_at_joint_.at(dof_z); }
  double rest_value(Index dof) const;  // of the mesh's unknown at rest: the position, where that is one
  const Run& at(Index strand) const { return runs_[static_cast<std::size_t>(strand)]; }

  std::vector<Run> runs_;
  std::unordered_map<Index, std::vector<StrandEnd>> ends_at_joint_{};  // by its z; filled when runs are joined
  std::vector<Vec2> positions_;                                        // of the builder's nodes
  std::vector<Index> first_dof_;                                       // of the builder's nodes
  std::vector<Structure::Meaning> dofs_;
  NodalTerms nodal_;
  Vec2 origin_ = Vec2::Zero();  // of the areas under pressure
  double length_scale_ = 1.0, force_scale_ = 0.0;
};

/// What is read off a place of a member in a state whose layout is a SlidingLayout: as MemberObservable, but anywhere.
class PlaceObservable final : public Observable {
 public:
  /// `structure` must outlive this.
  PlaceObservable(const SlidingStructure& structure, const MaterialPoint& point, MemberObservable::Component component);

  double value(const State& state) const override;
  Row gradient(const State& state) const override;

 private:
  MaterialPoint point_;
  MemberObservable::Component component_;
  double offset_ = 0.0;  // of a face from the axis [length]
  double origin_ = 0.0;  // what is subtracted
};

/// Displacement or rotation of a joint's degree of freedom, or what a support does to the structure through it,
/// likewise.
class JointObservable final : public Observable {
 public:
  enum class What { motion, reaction };

  /// `structure` must outlive this.
  JointObservable(const SlidingStructure& structure, Index dof, What what)
      : structure_(structure), dof_(dof), what_(what) {}

  double value(const State& state) const override;
  Row gradient(const State& state) const override;

 private:
  const SlidingStructure& structure_;
  Index dof_;
  What what_;
};

}  // namespace arcwall
