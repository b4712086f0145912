#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/algebra/assembly.hpp"
#include "core/observable.hpp"
#include "core/system.hpp"
#include "core/tracked_point.hpp"
#include "elements/axis.hpp"
#include "elements/element.hpp"
#include "elements/element_order.hpp"
#include "elements/essenburg_beam.hpp"
#include "elements/foundation_law.hpp"
#include "elements/nodal_terms.hpp"
#include "elements/section.hpp"
#include "elements/thermal_strain.hpp"
#include "elements/truss.hpp"

namespace arcwall {

/// What a node can do. Every joint has x and z; rotations belong to the members that are rigidly joined there; e and ξ
/// of the Essenburg theory (see EssenburgNode) to members that go on straight there.
enum class Freedom : std::uint8_t { x, z, rotation, thickness, thickness2 };

enum class Theory { euler_bernoulli, elastica, reissner, essenburg, truss };

/// A load is multiplied by λ or held while λ varies.
enum class LoadKind { proportional, constant };

/// Whether a load along a member is given in x and z, or along its stress-free axis and across it to the left at each
/// place. It is dead either way.
enum class LoadFrame { global, member };

/// A sequence of elements between two joints.
struct MemberDescription {
  std::string name{};
  Index from = 0, to = 0;  ///< joints
  std::shared_ptr<const Axis> axis{};
  std::vector<SineDeviation> imperfection{};
  Theory theory = Theory::euler_bernoulli;
  int order = 2;  ///< exact, essenburg: 1 or 2, the degree of the shape functions; elastica: 4 or 6, of convergence
  QuadraticTerm quadratic = QuadraticTerm::fixed;  ///< essenburg
  TrussStrain strain = TrussStrain::green;
  Section section{};
  int elements = 1;
  bool hinge_from = false, hinge_to = false;
};

/// Freedoms of a section whose thickness changes.
struct ThicknessFreedoms {
  Index e = 0, xi = 0;
};

/// A section of a member at one of its nodes.
struct MemberSection {
  Index node = 0;                                  ///< in the structure
  std::optional<Index> rotation{};                 ///< freedom; a bar has none
  std::optional<ThicknessFreedoms> thickness{};    ///< essenburg
  AxisPoint axis{}, shape{};                       ///< without and with imperfection
  QuadraticTerm quadratic = QuadraticTerm::fixed;  ///< essenburg
  double fraction = 0.0;                           ///< of the member's arc length
  double tributary = 0.0;                          ///< length of axis that a contact force here stands for

  EssenburgNode kinematics() const;
};

/// The mesh of a member: node k of n + 1, at equal spacing of the axis' arc length. Elements of higher order have a
/// middle node besides, which is a node of the structure but none of the mesh: nothing is joined, loaded or measured
/// there.
struct MemberMesh {
  std::string name{};
  std::vector<Index> nodes{};                     ///< index of each node in the structure
  std::vector<std::optional<Index>> rotations{};  ///< freedom of the member's rotation at each node; a bar has none
  AxisPoints axis{}, shape{};                     ///< without and with imperfection
  std::optional<double> height{};                 ///< of the section
  std::vector<Index> middle_nodes{};              ///< of each element, in the structure; empty where there are none
  std::vector<Index> middle_rotations{};          ///< their freedoms, as many
  double length = 0.0;                            ///< of the axis
  // Of the Essenburg theory alone, else empty:
  std::vector<ThicknessFreedoms> thickness{}, middle_thickness{};  ///< at each node, and at each middle node
  std::vector<AxisPoint> middle_axis{}, middle_shape{};            ///< at the middle nodes
  QuadraticTerm quadratic = QuadraticTerm::fixed;

  double fraction(std::size_t k) const { return double(k) / double(nodes.size() - 1); }

  /// At a node of the mesh.
  MemberSection section(std::size_t k) const;

  /// Where contact is tied to the mesh, in the order along the member: its nodes; of the Essenburg theory, whose
  /// contact forces are pressures, the middle nodes too.
  std::vector<MemberSection> contact_sections() const;
};

class SlidingStructure;
class StructureBuilder;

/// Beams and bars between joints, supports, springs to ground and loads. Freedoms count every x, z, rotation and change
/// of thickness, from the stress-free state; unknowns x are those u that no support holds, the others have values ū:
///
///     F(x, λ) = f(u, λ) + terms of single freedoms, see NodalTerms;   F_λ = ∂f/∂λ + K_xh ū′ + …
///
/// K_xh are the columns of the stiffness by held freedoms, and ū′ the rates of their values by λ.
class Structure final : public System {
 public:
  Index size(const Piece&) const override { return assembly_.unknown_count(); }
  void residual(const State& state, Eigen::Ref<Vector> F) const override;
  void linearize(const State& state, Linearization& out) const override;
  double energy(const State& state) const override;

  /// ds² = mean over nodes of |Δu|²/L² + mean of Δθ², L = length_scale(); changes of thickness follow these.
  Vector weights(const Piece&) const override;

  std::vector<Index> turning_sets(const Piece&) const override;

  double squared_motion_by_lambda(const Piece&) const override;

  /// Diagonal of the box around the stress-free structure [length].
  double length_scale() const { return length_scale_; }

  /// Greatest reference load, moments divided by the length scale, or what holds a member that is heated from
  /// expanding [force]; 0 if none varies.
  double force_scale() const { return force_scale_; }

  /// Size of the round-off in nodal forces: stiff short elements between nodes that are far from the origin [force].
  double force_roundoff() const;

  const std::vector<MemberMesh>& members() const { return members_; }
  Index node_count() const { return static_cast<Index>(positions_.size()); }
  const Vec2& position(Index node) const { return positions_[static_cast<std::size_t>(node)]; }  ///< stress-free
  /// The freedom of a node in x or z.
  Index freedom(Index node, Freedom which) const {
    return first_freedom_[static_cast<std::size_t>(node)] + (which == Freedom::z);
  }

  /// The unknown of a freedom, empty if a support holds it.
  std::optional<Index> unknown(Index freedom) const;

  /// Displacement or rotation; where it is held, what the support gives it.
  double value(const State& state, Index freedom) const;

  /// The rate of this value by λ at fixed unknowns: that of the support, 0 of a freedom that is not held.
  double held_rate(Index freedom) const { return nodal_.support(freedom).proportional; }

  /// Current position of a node.
  Vec2 current(const State& state, Index node) const;

  /// The node and freedom that an unknown stands for.
  struct Meaning {
    std::int32_t node;
    Freedom freedom;
  };
  Meaning meaning(Index unknown) const;
  Meaning meaning_of_freedom(Index freedom) const { return meaning_of_freedom_[static_cast<std::size_t>(freedom)]; }

  /// Force (or moment) that a support exerts on the structure through a freedom it holds; 0 in one that is free.
  /// Contact forces on the supported node itself are not seen.
  double reaction(const State& state, Index freedom) const;
  Row reaction_gradient(const State& state, Index freedom) const;

  // --- what it is made of, for those who sum it themselves ---------------------------------------------------------

  /// Elements are numbered member by member, along each; those that were added come last.
  Index element_count() const { return static_cast<Index>(elements_.size()); }
  const Element& element(Index e) const { return elements_[e]; }

  /// Of the local unknowns of an element.
  ShiftedIndices element_freedoms(Index e) const { return element_freedoms_[e]; }

  /// A load or a foundation along an element, whose unknowns its potential has.
  struct ElementLoad {
    std::shared_ptr<const Element> potential;
    Index element;             ///< also its block of the assembly
    bool is_grounded = false;  ///< resists a translation: a foundation
  };
  const std::vector<ElementLoad>& element_loads() const { return element_loads_; }

  /// Which of them act on an element.
  std::span<const std::uint32_t> loads_of_element(Index e) const {
    if (first_load_of_element_.empty()) return {};
    const auto first = first_load_of_element_[static_cast<std::size_t>(e)];
    const auto last = first_load_of_element_[static_cast<std::size_t>(e) + 1];
    return std::span(loads_by_element_).subspan(first, last - first);
  }

  /// Loads, supports and springs of single freedoms.
  const NodalTerms& nodal_terms() const { return nodal_; }

  /// The structure with the updated form of its elements, stress-free or after an increment that led to a state: see
  /// IncrementalStructure.
  std::unique_ptr<Structure> updated() const;
  std::unique_ptr<Structure> updated(const State& state) const;

  /// Whether all elements have that form.
  bool can_be_updated() const;

 private:
  friend class StructureBuilder;

  Structure(const Structure&) = default;
  Structure(Index unknowns, const IndexLists& blocks) : assembly_(unknowns, blocks) {}
  void arrange();                     // what follows from the elements
  double weight(Freedom kind) const;  // in the path metric
  template <class ValueOf>
  std::unique_ptr<Structure> updated_at(const ValueOf& value_of) const;
  std::vector<bool> translation_free() const;                  // see Linearization
  void gather(Index block, const Vector& x, double* u) const;  // held freedoms 0
  struct Local;
  // Evaluates an element with its held freedoms at their values. If derivatives are asked for, `f_lambda` is that at
  // fixed unknowns, to which the rates of held freedoms belong.
  double evaluate(const Element& element, Index block, const State& state, Local& out, bool with_derivatives) const;
  // Adds an element that depends on λ. Where K is not null, its stiffness goes to the values of K's matrix.
  void add_driven(const Element& element, Index block, const State& state, double* F, double* K,
                  double* F_lambda) const;
  // Calls visit(element, block) for each element that has the freedom, and for each load along such an element.
  template <class Visit>
  void for_each_with(Index freedom, const Visit& visit) const;
  // Adds the forces of elements and, where K is not null, their stiffness to the values of K's matrix.
  void add(const ElementOrder::Four& four, const ClassicBeamLanes& beams, const Vector& x, double* F, double* K) const;
  void add_elements(const Vector& x, double* F, double* K) const;
  Index unknown_or_held(Index freedom) const { return unknown_of_freedom_[static_cast<std::size_t>(freedom)]; }

  std::vector<Vec2> positions_;
  std::vector<Index> first_freedom_;  // x of each node; z follows
  std::vector<MemberMesh> members_;
  std::vector<std::int32_t> unknown_of_freedom_;  // −1: held
  std::vector<Meaning> meaning_of_freedom_;
  std::vector<std::int32_t> freedom_of_unknown_;
  ElementList elements_;   // element e is block e of the assembly
  Index first_added_ = 0;  // the first element that no member has
  ElementOrder order_;
  ShiftedLists element_freedoms_;
  std::vector<ElementLoad> element_loads_;
  std::vector<std::uint32_t> loads_by_element_, first_load_of_element_;  // empty without loads
  NodalTerms nodal_;
  BlockAssembly assembly_;
  double rotations_ = 1.0;  // how many there are
  double length_scale_ = 1.0, force_scale_ = 0.0, heat_rate_ = 0.0;
  std::vector<std::int32_t> turning_set_;  // of each freedom
};

/// Describes a structure step by step; build() makes it.
class StructureBuilder {
 public:
  /// A joint of members. Returns its node.
  Index add_joint(const Vec2& position);

  /// So many members will be added: no room is kept for more.
  void expect_members(std::size_t count);

  /// Meshes the member at once, so that its inner nodes can be loaded. Returns its index.
  Index add_member(MemberDescription member);
  const MemberMesh& mesh(Index member) const { return meshes_[static_cast<std::size_t>(member)]; }

  /// The rotation that the rigidly joined member ends at a joint share; empty if there are none.
  std::optional<Index> shared_rotation(Index joint) const { return shared_rotation_[static_cast<std::size_t>(joint)]; }

  /// Of the member ends at a joint whose thickness changes.
  std::vector<ThicknessFreedoms> thickness(Index joint) const;

  Index freedom(Index node, Freedom which) const {
    return first_freedom_[static_cast<std::size_t>(node)] + (which == Freedom::z);
  }

  /// A support that holds a freedom, or moves it: a displacement [length] or rotation [rad] from the stress-free state.
  void fix(Index freedom, const Driven& value = {}) { nodal_.hold(freedom, value); }

  /// A linear spring between a freedom and the ground, stress-free with the structure [force/length, force·length].
  void add_ground_stiffness(Index freedom, double stiffness) { nodal_.add_ground_stiffness(freedom, stiffness); }

  /// The same between two freedoms, of which one is held or both belong to members.
  void add_spring(Index first, Index second, double stiffness) { nodal_.add_spring(first, second, stiffness); }

  /// A spring of another law, to the ground where there is no first freedom; find_mechanism() does not see it.
  void add_spring(std::optional<Index> first, Index second, std::shared_ptr<const SpringLaw> law) {
    nodal_.add_spring({.first = first, .second = second, .law = std::move(law)});
  }

  void add_load(Index freedom, double value, LoadKind kind);
  void add_distributed_load(Index member, const Vec2& load, LoadKind kind, LoadFrame frame = LoadFrame::global);

  /// A pressure on the deformed axis of a member that is no bar, to the right of the direction of travel, by length of
  /// this axis [force/length]. It has a potential where open_pressed_joint() finds nothing.
  void add_pressure(Index member, const Driven& pressure);

  /// A joint where the pressure on members ends and that no support holds in x or z: there the work of the pressure
  /// depends on the way.
  std::optional<Index> open_pressed_joint() const;

  /// A strain and a curvature that the sections of a member take without force, as temperatures make them. Not for the
  /// Essenburg theory; bars have no curvature.
  void add_thermal_strain(Index member, const ThermalStrain& thermal);

  /// Springs to the ground all along a member that is no bar: force per length of the stress-free axis and of
  /// displacement, in x and in z [force/length²]. find_mechanism() does not see them.
  void add_foundation(Index member, const Vec2& stiffness);

  /// The same in x or in z by a law, whose forces are by length [force/length].
  void add_foundation(Index member, Freedom direction, std::shared_ptr<const SpringLaw> law);

  /// An element of any kind between freedoms that members have, at most Element::max_unknowns, in the order of its
  /// unknowns. Only for meshes whose nodes are fixed; find_mechanism() does not see it.
  void add_element(std::shared_ptr<const Element> element, std::vector<Index> freedoms);

  /// The structure; `ramp` makes the constant loads and values of supports the proportional ones and leaves the others
  /// out, so that a path in λ from 0 to 1 applies them.
  std::unique_ptr<Structure> build(bool ramp = false) const;

  /// The same for meshes with breakpoints that move. Only beams without shear: see can_slide(). Members for which
  /// `alike(a, b)` is false are not joined to one strand, however they meet: walls see strands.
  std::unique_ptr<SlidingStructure> build_sliding(
      bool ramp = false, const std::function<bool(const std::string&, const std::string&)>& alike = nullptr) const;

  /// Whether all members are of a theory for which build_sliding() is meant, and there are no other elements.
  bool can_slide() const;

 private:
  struct DistributedLoad {
    Index member;
    Vec2 load;
    LoadKind kind;
    LoadFrame frame;
  };

  struct AddedElement {
    std::shared_ptr<const Element> element;
    std::vector<Index> freedoms;
  };

  struct EndThickness {
    Index joint;
    bool hinged;
    double angle, height;  // of the axis, of the section
    QuadraticTerm quadratic;
    ThicknessFreedoms freedoms;
  };

  // The greatest proportional load, moments divided by the length.
  double force_scale(const NodalTerms& terms, double length) const;
  // Says of each node whether a load, a support or a spring acts on one of its freedoms.
  std::vector<bool> nodes_with_terms() const;
  bool carries_force_alone(Index node, Index rotation) const;  // of the terms that a node may have
  Index add_node(const Vec2& position);
  Index add_freedom(Index node, Freedom which);
  void add_middle_node(const MemberDescription& member, const ImperfectAxis& shape, int element, MemberMesh& mesh);
  Index end_rotation(Index joint, bool hinged);
  ThicknessFreedoms add_thickness(Index node);
  ThicknessFreedoms end_thickness(Index joint, const MemberDescription& member, double angle, bool hinged);
  std::vector<Index> element_freedoms(const MemberMesh& mesh, std::size_t element) const;

  std::vector<Vec2> positions_;
  std::vector<Index> first_freedom_;
  std::vector<std::optional<Index>> shared_rotation_;
  std::vector<EndThickness> end_thickness_;
  std::vector<Structure::Meaning> freedoms_;
  std::vector<MemberDescription> descriptions_;
  std::vector<MemberMesh> meshes_;
  std::vector<Index> first_element_;  // of each member
  NodalTerms nodal_;
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

  // The steps of build().
  std::unique_ptr<Structure> numbered() const;
  std::vector<std::int32_t> turning_sets() const;
  template <class Make>
  void add_along(Structure& structure, std::size_t m, const Make& make, bool is_grounded = false) const;
  void add_dead_loads(Structure& structure, bool ramp) const;
  void add_foundations(Structure& structure) const;
  void add_pressures(Structure& structure, bool ramp) const;
  void scale_by_heat(Structure& structure, const std::vector<ThermalStrain>& thermal) const;
  static void sort_loads(Structure& structure);
};

}  // namespace arcwall
