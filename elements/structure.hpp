#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/algebra/assembly.hpp"
#include "core/observable.hpp"
#include "core/system.hpp"
#include "core/tracked_point.hpp"
#include "elements/axis.hpp"
#include "elements/compliant_wall.hpp"
#include "elements/element.hpp"
#include "elements/element_order.hpp"
#include "elements/essenburg_beam.hpp"
#include "elements/foundation_law.hpp"
#include "elements/line_load.hpp"
#include "elements/nodal_terms.hpp"
#include "elements/section.hpp"
#include "elements/thermal_strain.hpp"
#include "elements/truss.hpp"

namespace arcwall {

/// Kinds of degrees of freedom. Each joint has x and z. Rigidly joined members share a rotation. Members that continue
/// straight share the thickness unknowns e and ξ of the Essenburg theory (see EssenburgNode).
enum class Dof : std::uint8_t { x, z, rotation, thickness, thickness2 };

/// Theories of members: beams, and a bar (truss).
enum class Theory { euler_bernoulli, elastica, reissner, essenburg, truss };

/// A load is proportional to λ or constant.
enum class LoadKind { proportional, constant };

/// Describes a member: a sequence of elements between two joints.
struct MemberDescription {
  std::string name{};
  Index from = 0, to = 0;  ///< joints
  std::shared_ptr<const Axis> axis{};
  std::vector<SineDeviation> imperfection{};
  Theory theory = Theory::euler_bernoulli;
  int order =
      2;  ///< reissner, essenburg: degree of the shape functions, 1 or 2; elastica: order of convergence, 4 or 6
  QuadraticTerm quadratic = QuadraticTerm::fixed;  ///< essenburg
  TrussStrain strain = TrussStrain::green;
  Section section{};
  int elements = 1;
  bool hinge_from = false, hinge_to = false;
};

/// Indices of the thickness degrees of freedom of a section.
struct ThicknessDofs {
  Index e = 0, xi = 0;
};

/// Stores the section of a member at one of its nodes.
struct MemberSection {
  Index node = 0;                                  ///< in the structure
  std::optional<Index> rotation{};                 ///< degree of freedom; empty for a bar
  std::optional<ThicknessDofs> thickness{};        ///< essenburg
  AxisPoint axis{}, shape{};                       ///< without and with imperfection
  QuadraticTerm quadratic = QuadraticTerm::fixed;  ///< essenburg
  double fraction = 0.0;                           ///< of the member's arc length, in [0, 1]
  double tributary = 0.0;                          ///< tributary length of a contact force [length]

  EssenburgNode kinematics() const;
};

/// Stores the mesh of a member: n + 1 nodes at equal arc length of the axis. Middle nodes of higher-order elements
/// belong to the structure but not to the mesh: they carry no joint, load or monitor.
struct MemberMesh {
  std::string name{};
  std::vector<Index> nodes{};                     ///< index of each node in the structure
  std::vector<std::optional<Index>> rotations{};  ///< degree of freedom of the rotation at each node; empty for a bar
  AxisPoints axis{}, shape{};                     ///< without and with imperfection
  std::optional<double> height{};                 ///< of the section; of one that tapers, in the middle
  std::shared_ptr<const SectionTaper> taper{};    ///< of the section; null: uniform
  std::vector<Index> middle_nodes{};              ///< of each element, in the structure; may be empty
  std::vector<Index> middle_rotations{};          ///< their degrees of freedom, same size
  double length = 0.0;                            ///< of the axis [length]
  // Of the Essenburg theory alone, else empty:
  std::vector<ThicknessDofs> thickness{}, middle_thickness{};  ///< at each node, and at each middle node
  std::vector<AxisPoint> middle_axis{}, middle_shape{};        ///< at the middle nodes
  QuadraticTerm quadratic = QuadraticTerm::fixed;

  double fraction(std::size_t k) const { return double(k) / double(nodes.size() - 1); }

  /// Returns the height of the section at a fraction of the length; empty if it is unknown.
  std::optional<double> height_at(double fraction) const {
    return taper && height ? taper->at(fraction).height : height;
  }

  /// Returns the section at node k of the mesh.
  MemberSection section(std::size_t k) const;

  /// Returns the sections of node contact in order along the member: at the nodes, and for the Essenburg theory also at
  /// the middle nodes.
  std::vector<MemberSection> contact_sections() const;
};

class SlidingStructure;
class StructureBuilder;

/// Models beams and bars between joints, with supports, springs and loads. The degrees of freedom u are all x, z,
/// rotations and changes of thickness, from the stress-free state. The unknowns x are the unconstrained u; supports
/// prescribe the others, ū:
///
///     F(x, λ) = f(u, λ) + terms of single degrees of freedom, see NodalTerms;   F_λ = ∂f/∂λ + K_xh ū′ + …
///
/// K_xh: columns of the tangent stiffness for the prescribed degrees of freedom. ū′ = dū/dλ. Build it by
/// StructureBuilder.
class Structure final : public System {
 public:
  Dimensions dimensions(const ActiveSet&) const override { return {.unknowns = assembly_.unknown_count()}; }
  void residual(const State& state, Eigen::Ref<Vector> F) const override;
  void linearize(const State& state, Linearization& out) const override;
  double energy(const State& state) const override;

  /// Returns ds² = mean over nodes of |Δu|²/L² + mean of Δθ², L = length_scale().
  StateMetric metric(const ActiveSet&) const override { return metric_; }

  /// Returns the diagonal of the bounding box of the stress-free structure [length].
  double length_scale() const { return length_scale_; }

  /// Returns the largest reference load, with moments over the length scale, or the force that prevents thermal
  /// expansion [force]. 0 if nothing varies with λ.
  double force_scale() const { return force_scale_; }

  /// Returns the size of the round-off in nodal forces [force].
  double force_roundoff() const;

  const std::vector<MemberMesh>& members() const { return members_; }
  Index node_count() const { return static_cast<Index>(positions_.size()); }
  const Vec2& position(Index node) const { return positions_[static_cast<std::size_t>(node)]; }  ///< stress-free
  /// Returns the degree of freedom of a node in x or z.
  Index dof(Index node, Dof which) const { return first_dof_[static_cast<std::size_t>(node)] + (which == Dof::z); }

  /// Returns the unknown of a degree of freedom; empty if it is prescribed.
  std::optional<Index> unknown(Index dof) const;

  /// Returns true if the degree of freedom is prescribed, or will be in a later stage.
  bool is_ever_held(Index dof) const { return !unknown(dof) || held_later_.contains(dof); }

  /// Returns the displacement [length] or rotation [rad], free or prescribed.
  double value(const State& state, Index dof) const;

  /// Returns ∂value/∂λ at fixed unknowns; 0 if the degree of freedom is not prescribed.
  double held_rate(Index dof) const { return nodal_.support(dof).proportional; }

  /// Returns the current position of a node [length].
  Vec2 current(const State& state, Index node) const;

  /// Stores the node and the kind of a degree of freedom.
  struct Meaning {
    std::int32_t node;
    Dof dof;
  };
  Meaning meaning(Index unknown) const;
  Index dof_of_unknown(Index unknown) const { return dof_of_unknown_[static_cast<std::size_t>(unknown)]; }
  Meaning meaning_of_dof(Index dof) const { return meaning_of_dof_[static_cast<std::size_t>(dof)]; }

  /// Returns the support reaction on the structure in a degree of freedom [force or force·length]; 0 if it is free.
  /// Excludes contact forces on the supported node itself.
  double reaction(const State& state, Index dof) const;
  Row reaction_gradient(const State& state, Index dof) const;

  // --- elements and terms, for other assemblies ----------------------------------------------------------------------

  /// Returns the number of elements: numbered along each member, then those of add_element().
  Index element_count() const { return static_cast<Index>(elements_.size()); }
  const Element& element(Index e) const { return elements_[e]; }

  /// Returns the degrees of freedom of an element's local unknowns.
  ShiftedIndices element_dofs(Index e) const { return element_dofs_[e]; }

  /// Stores a load or a foundation along an element; its potential has the element's unknowns.
  struct ElementLoad {
    std::shared_ptr<const Element> potential;
    Index element;                        ///< also its block of the assembly
    bool is_grounded = false;             ///< a foundation or a compliant wall: it resists translation
    std::optional<std::uint32_t> wall{};  ///< of a WallPressure: the number of its wall, in the order of add_wall()

    /// Returns false for a wall that is open on the state's active set, whose entries are those of the walls.
    bool acts_on(const State& state) const {
      return !wall || *wall >= state.active_set.contacts() || state.active_set[*wall] != 0;
    }
  };
  const std::vector<ElementLoad>& element_loads() const { return element_loads_; }

  /// Returns the numbers of the element loads that act on an element.
  std::span<const std::uint32_t> loads_of_element(Index e) const {
    if (first_load_of_element_.empty()) return {};
    const auto first = first_load_of_element_[static_cast<std::size_t>(e)];
    const auto last = first_load_of_element_[static_cast<std::size_t>(e) + 1];
    return std::span(loads_by_element_).subspan(first, last - first);
  }

  /// Returns loads, supports and springs of single degrees of freedom.
  const NodalTerms& nodal_terms() const { return nodal_; }

  /// Returns the structure in the updated Lagrangian formulation, stress-free or with `state` as reference: see
  /// IncrementalStructure.
  std::unique_ptr<Structure> updated() const;
  std::unique_ptr<Structure> updated(const State& state) const;

  /// Returns true if all elements have that formulation.
  bool can_be_updated() const;

 private:
  friend class StructureBuilder;

  Structure(const Structure&) = default;
  Structure(Index unknowns, const IndexLists& blocks) : assembly_(unknowns, blocks) {}
  void arrange();                 // what follows from the elements
  double weight(Dof kind) const;  // in the path metric
  StateMetric made_metric(const std::vector<std::int32_t>& set_of_dof) const;
  template <class ValueOf>
  std::unique_ptr<Structure> updated_at(const ValueOf& value_of) const;
  std::vector<bool> translation_free() const;                     // see Linearization
  void gather(Index block, const Vector& x, double* u) const;     // held degrees of freedom 0
  void gather(Index block, const State& state, double* u) const;  // held ones at their values
  struct Local;
  // Evaluates an element, its held degrees of freedom at their values. If derivatives are asked for, `f_lambda` is
  // that at fixed unknowns, to which the rates of held degrees of freedom belong.
  void evaluate(const Element& element, Index block, const State& state, Local& out, bool with_derivatives) const;
  // Adds an element that depends on λ. Where K is not null, its stiffness goes to the values of K's matrix.
  void add_driven(const Element& element, Index block, const State& state, double* F, double* K,
                  double* F_lambda) const;
  // Calls visit(element, block) for each element that has the degree of freedom, and for each load along such an
  // element that acts on the state.
  template <class Visit>
  void for_each_with(Index dof, const State& state, const Visit& visit) const;
  // Adds the forces of elements and, where K is not null, their stiffness to the values of K's matrix.
  void add(const ElementOrder::Four& four, const ClassicBeamLanes& beams, const Vector& x, double* F, double* K) const;
  void add_elements(const Vector& x, double* F, double* K) const;
  Index unknown_or_held(Index dof) const { return unknown_of_dof_[static_cast<std::size_t>(dof)]; }

  std::vector<Vec2> positions_;
  std::vector<Index> first_dof_;  // x of each node; z follows
  std::vector<MemberMesh> members_;
  std::vector<std::int32_t> unknown_of_dof_;  // −1: held
  std::vector<Meaning> meaning_of_dof_;
  std::vector<std::int32_t> dof_of_unknown_;
  ElementList elements_;   // element e is block e of the assembly
  Index first_added_ = 0;  // the first element that no member has
  ElementOrder order_;
  ShiftedLists element_dofs_;
  std::vector<ElementLoad> element_loads_;
  std::vector<std::uint32_t> loads_by_element_, first_load_of_element_;  // empty without loads
  NodalTerms nodal_;
  BlockAssembly assembly_;
  double rotations_ = 1.0;  // how many there are
  double length_scale_ = 1.0, force_scale_ = 0.0, heat_rate_ = 0.0;
  StateMetric metric_;
  std::set<Index> held_later_;  // see StructureBuilder::expect_hold()
};

/// Collects the description of a structure; build() creates it.
class StructureBuilder {
 public:
  /// Adds a joint at a position [length] and returns its node.
  Index add_joint(const Vec2& position);

  /// Reserves memory for `count` members.
  void expect_members(std::size_t count);

  /// Adds and meshes a member; returns its index.
  Index add_member(MemberDescription member);
  const MemberMesh& mesh(Index member) const { return meshes_[static_cast<std::size_t>(member)]; }

  /// Returns the rotation shared by the rigidly joined member ends; empty if there are none.
  std::optional<Index> shared_rotation(Index joint) const { return shared_rotation_[static_cast<std::size_t>(joint)]; }

  /// Returns the thickness degrees of freedom of the member ends at a joint; may be empty.
  std::vector<ThicknessDofs> thickness(Index joint) const;

  /// Returns the degree of freedom of a node in x or z.
  Index dof(Index node, Dof which) const { return first_dof_[static_cast<std::size_t>(node)] + (which == Dof::z); }

  /// Prescribes a degree of freedom: displacement [length] or rotation [rad] from the stress-free state.
  void fix(Index dof, const Driven& value = {}) { nodal_.hold(dof, value); }

  /// Adds a linear spring to the ground, stress-free with the structure [force/length or force·length].
  void add_ground_stiffness(Index dof, double stiffness) { nodal_.add_ground_stiffness(dof, stiffness); }

  /// Adds a linear spring between two degrees of freedom: one is prescribed, or both belong to members.
  void add_spring(Index first, Index second, double stiffness) { nodal_.add_spring(first, second, stiffness); }

  /// Adds a nonlinear spring; without `first`, to the ground. find_mechanism() ignores it.
  void add_spring(std::optional<Index> first, Index second, std::shared_ptr<const SpringLaw> law) {
    nodal_.add_spring({.first = first, .second = second, .law = std::move(law)});
  }

  /// Adds a load [force], or a moment [force·length] on a rotation, positive in the degree of freedom.
  void add_load(Index dof, double value, LoadKind kind);

  /// Says that a load may act on a degree of freedom, as it does in another stage: a member has a node for it.
  void expect_load(Index dof) { expected_loads_.insert(dof); }

  /// Says that a degree of freedom, free now, will be prescribed in a later stage: members are cut there alike.
  void expect_hold(Index dof) { expected_holds_.insert(dof); }

  /// Adds a dead load along a member.
  void add_distributed_load(Index member, const LineLoad& load, LoadKind kind);

  /// Adds a uniform dead load along a member, by length of the stress-free axis [force/length].
  void add_distributed_load(Index member, const Vec2& load, LoadKind kind, LoadFrame frame = LoadFrame::global) {
    add_distributed_load(member, LineLoad{.first = load, .frame = frame}, kind);
  }

  /// Returns the arc length of a member's stress-free axis without imperfection [length].
  double length_of(Index member) const { return descriptions_[static_cast<std::size_t>(member)].axis->length(); }

  /// Adds a follower pressure on a beam, positive to the right of the member direction, by deformed length
  /// [force/length]. It is conservative if open_pressed_joint() is empty.
  void add_pressure(Index member, const Driven& pressure);

  /// Returns a joint at which a pressure ends, free in x and z; its work there depends on the path. Empty if there is
  /// none.
  std::optional<Index> open_pressed_joint() const;

  /// Adds a stress-free strain and curvature, for example thermal. Not for the Essenburg theory; bars have no
  /// curvature.
  void add_thermal_strain(Index member, const ThermalStrain& thermal);

  /// Adds a linear foundation along a beam, in x and z, by length of the stress-free axis [force/length²].
  /// find_mechanism() ignores it.
  void add_foundation(Index member, const Vec2& stiffness);

  /// Adds a nonlinear foundation in x or z; the forces of its law are by length [force/length].
  void add_foundation(Index member, Dof direction, std::shared_ptr<const SpringLaw> law);

  /// Adds a compliant wall in the way of a beam. Only for build(), not for build_sliding(); find_mechanism() ignores
  /// it.
  void add_wall(Index member, CompliantWall wall);

  /// Adds an element between degrees of freedom of members, in the order of its unknowns; at most
  /// Element::max_unknowns. Only for build(), not for build_sliding(); find_mechanism() ignores it.
  void add_element(std::shared_ptr<const Element> element, std::vector<Index> dofs);

  /// Returns the structure. `ramp`: scale the constant loads and prescribed values with λ and omit the proportional
  /// ones; a path from λ = 0 to 1 then applies the preload.
  std::unique_ptr<Structure> build(bool ramp = false) const;

  /// Returns the structure with moving mesh nodes, for moving contact points. Requires can_slide(). Members a, b with
  /// `alike(a, b)` false are never joined to one member run.
  std::unique_ptr<SlidingStructure> build_sliding(
      bool ramp = false, const std::function<bool(const std::string&, const std::string&)>& alike = nullptr) const;

  /// Returns true if build_sliding() supports all members and there are no added elements.
  bool can_slide() const;

 private:
  struct DistributedLoad {
    Index member;
    LineLoad load;
    LoadKind kind;
  };

  struct AddedElement {
    std::shared_ptr<const Element> element;
    std::vector<Index> dofs;
  };

  struct EndThickness {
    Index joint;
    bool hinged;
    double angle, height;  // of the axis, of the section
    QuadraticTerm quadratic;
    ThicknessDofs dofs;
  };

  // The greatest proportional load, moments divided by the length.
  double force_scale(const NodalTerms& terms, double length) const;
  // Says of each node whether a load, a support or a spring acts on one of its degrees of freedom.
  std::vector<bool> nodes_with_terms() const;
  bool carries_force_alone(Index node, Index rotation) const;  // of the terms that a node may have
  Index add_node(const Vec2& position);
  Index add_dof(Index node, Dof which);
  void add_middle_node(const MemberDescription& member, const ImperfectAxis& shape, int element, MemberMesh& mesh);
  Index end_rotation(Index joint, bool hinged);
  ThicknessDofs add_thickness(Index node);
  ThicknessDofs end_thickness(Index joint, const MemberDescription& member, double angle, bool hinged);
  std::vector<Index> element_dofs(const MemberMesh& mesh, std::size_t element) const;

  std::vector<Vec2> positions_;
  std::vector<Index> first_dof_;
  std::vector<std::optional<Index>> shared_rotation_;
  std::vector<EndThickness> end_thickness_;
  std::vector<Structure::Meaning> dofs_;
  std::vector<MemberDescription> descriptions_;
  std::vector<MemberMesh> meshes_;
  std::vector<Index> first_element_;  // of each member
  NodalTerms nodal_;
  std::set<Index> expected_loads_, expected_holds_;  // degrees of freedom
  bool is_ever_held(Index dof) const { return nodal_.is_held(dof) || expected_holds_.contains(dof); }
  std::vector<DistributedLoad> distributed_loads_;
  std::vector<FoundationLaw> foundations_;  // of each member
  std::vector<ThermalStrain> thermal_;      // likewise
  std::vector<ThermalStrain> thermal_of(bool ramp) const;
  std::vector<Driven> pressures_;  // likewise
  std::vector<Driven> pressures_of(bool ramp) const;
  // With the ends of pressed members, whose places are counted from the first joint.
  Vec2 origin() const { return positions_.front(); }
  std::vector<NodalTerms::PressedEnd> pressed_ends() const;
  NodalTerms nodal_terms(bool ramp) const;
  std::vector<AddedElement> added_elements_;
  struct WallOfMember {
    Index member;
    CompliantWall wall;
  };
  std::vector<WallOfMember> walls_;

  // The steps of build().
  std::unique_ptr<Structure> numbered() const;
  std::vector<std::int32_t> turning_sets() const;
  template <class Make>
  void add_along(Structure& structure, std::size_t m, const Make& make, bool is_grounded = false) const;
  // The dead loads that act on a member, and what λ does to them.
  std::vector<DrivenLineLoad> loads_along(Index member, bool ramp) const;
  void add_dead_loads(Structure& structure, bool ramp) const;
  void add_foundations(Structure& structure) const;
  void add_pressures(Structure& structure, bool ramp) const;
  void add_walls(Structure& structure, bool ramp) const;
  void scale_by_heat(Structure& structure, const std::vector<ThermalStrain>& thermal) const;
  static void sort_loads(Structure& structure);
};

}  // namespace arcwall
