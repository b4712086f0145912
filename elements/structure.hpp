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
#include "elements/section.hpp"
#include "elements/truss.hpp"

namespace arcwall {

/// What a node can do. Every joint has x and z; rotations belong to the members that are rigidly joined there; e and ξ
/// of the Essenburg theory (see EssenburgNode) to members that go on straight there.
enum class Freedom : std::uint8_t { x, z, rotation, thickness, thickness2 };

enum class Theory { classic, elastica, exact, essenburg, truss };

/// A load is multiplied by λ or held while λ varies.
enum class LoadKind { proportional, constant };

/// A sequence of elements between two joints.
struct MemberDescription {
  std::string name{};
  Index from = 0, to = 0;  ///< joints
  std::shared_ptr<const Axis> axis{};
  std::vector<SineDeviation> imperfection{};
  Theory theory = Theory::classic;
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

/// Beams and bars between joints, supports and dead loads: F(x, λ) = f_int(x) − λ f − f₀, with displacements and
/// rotations from the stress-free state as unknowns. Freedoms count every x, z, rotation and change of thickness;
/// unknowns those that no support holds.
class Structure final : public System {
 public:
  Index size(const Piece&) const override { return assembly_.unknown_count(); }
  void residual(const State& state, Eigen::Ref<Vector> F) const override;
  void linearize(const State& state, Linearization& out) const override;
  double energy(const State& state) const override;

  /// ds² = mean over nodes of |Δu|²/L² + mean of Δθ², L = length_scale(); changes of thickness follow these.
  Vector weights(const Piece&) const override;

  /// Diagonal of the box around the stress-free structure [length].
  double length_scale() const { return length_scale_; }

  /// Greatest reference load, moments divided by the length scale [force]; 0 if no load varies.
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

  /// Displacement or rotation, 0 where held.
  double value(const State& state, Index freedom) const;

  /// Current position of a node.
  Vec2 current(const State& state, Index node) const;

  /// The node and freedom that an unknown stands for.
  struct Meaning {
    std::int32_t node;
    Freedom freedom;
  };
  Meaning meaning(Index unknown) const;

  /// Force (or moment) that a support exerts on the structure through a freedom it holds; 0 in one that is free.
  /// Contact forces on the supported node itself are not seen.
  double reaction(const State& state, Index freedom) const;
  Row reaction_gradient(const State& state, Index freedom) const;

  // --- what it is made of, for those who sum it themselves ---------------------------------------------------------

  /// Elements are numbered member by member, along each.
  Index element_count() const { return static_cast<Index>(elements_.size()); }
  const Element& element(Index e) const { return elements_[e]; }

  /// Of the local unknowns of an element.
  ShiftedIndices element_freedoms(Index e) const { return element_freedoms_[e]; }

  /// A load along an element, whose unknowns its potential has.
  struct ElementLoad {
    std::shared_ptr<const Element> potential;
    LoadKind kind;
    Index element;  ///< also its block of the assembly
  };
  const std::vector<ElementLoad>& element_loads() const { return element_loads_; }

  /// Which of them act on an element.
  std::span<const std::uint32_t> loads_of_element(Index e) const {
    if (first_load_of_element_.empty()) return {};
    const auto first = first_load_of_element_[static_cast<std::size_t>(e)];
    const auto last = first_load_of_element_[static_cast<std::size_t>(e) + 1];
    return std::span(loads_by_element_).subspan(first, last - first);
  }

  /// Force or moment on a freedom.
  double point_load(Index freedom, LoadKind kind) const {
    return (kind == LoadKind::proportional ? load_ : constant_load_).coeff(freedom);
  }

  /// The structure with the updated form of its elements after an increment that led to a state: see
  /// IncrementalStructure.
  std::unique_ptr<Structure> updated(const State& state) const;

  /// Whether all elements have that form.
  bool can_be_updated() const;

 private:
  friend class StructureBuilder;

  Structure(const Structure&) = default;
  Structure(Index unknowns, const IndexLists& blocks) : assembly_(unknowns, blocks) {}
  void arrange();                              // what follows from the elements
  std::vector<bool> translation_free() const;  // see Linearization
  void gather(Index block, const Vector& x, double* u) const;
  // Adds the forces of elements and, where K is not null, their stiffness to the values of K's matrix.
  void add(const ElementOrder::Four& four, const ClassicBeamLanes& beams, const Vector& x, double* F, double* K) const;
  void add_elements(const Vector& x, double* F, double* K) const;
  using PointLoads = Eigen::SparseVector<double, Eigen::ColMajor, Index>;  // per freedom
  void subtract(const PointLoads& loads, double factor, double* F) const;

  std::vector<Vec2> positions_;
  std::vector<Index> first_freedom_;  // x of each node; z follows
  std::vector<MemberMesh> members_;
  std::vector<std::int32_t> unknown_of_freedom_;  // −1: held
  std::vector<Meaning> meaning_of_freedom_;
  std::vector<std::int32_t> freedom_of_unknown_;
  ElementList elements_;  // element e is block e of the assembly
  ElementOrder order_;
  ShiftedLists element_freedoms_;
  std::vector<ElementLoad> element_loads_;
  std::vector<std::uint32_t> loads_by_element_, first_load_of_element_;  // empty without loads
  PointLoads load_, constant_load_;
  BlockAssembly assembly_;
  double rotations_ = 1.0;  // how many there are
  double length_scale_ = 1.0, force_scale_ = 0.0;
};

/// Describes a structure step by step; build() makes it.
class StructureBuilder {
 public:
  /// A joint of members. Returns its node.
  Index add_joint(const Vec2& position);

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
  void fix(Index freedom) { held_[static_cast<std::size_t>(freedom)] = true; }
  void add_load(Index freedom, double value, LoadKind kind);
  void add_distributed_load(Index member, const Vec2& load, LoadKind kind);

  /// The structure; `ramp` makes the constant loads the proportional ones and leaves the others out, so that a path in
  /// λ from 0 to 1 applies them.
  std::unique_ptr<Structure> build(bool ramp = false) const;

  /// The same for meshes with breakpoints that move. Only beams without shear: see can_slide(). Members for which
  /// `alike(a, b)` is false are not joined to one strand, however they meet: walls see strands.
  std::unique_ptr<SlidingStructure> build_sliding(
      bool ramp = false, const std::function<bool(const std::string&, const std::string&)>& alike = nullptr) const;

  /// Whether all members are of a theory for which build_sliding() is meant.
  bool can_slide() const;

 private:
  struct Load {
    Index freedom;
    double value;
    LoadKind kind;
  };
  struct DistributedLoad {
    Index member;
    Vec2 load;
    LoadKind kind;
  };

  struct EndThickness {
    Index joint;
    bool hinged;
    double angle, height;  // of the axis, of the section
    QuadraticTerm quadratic;
    ThicknessFreedoms freedoms;
  };

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
  std::vector<bool> held_;
  std::vector<MemberDescription> descriptions_;
  std::vector<MemberMesh> meshes_;
  std::vector<Load> loads_;
  std::vector<DistributedLoad> distributed_loads_;
};

}  // namespace arcwall
