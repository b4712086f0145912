#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "core/equations.hpp"

namespace arcwall {

/// A place on a strand of slender members, by the arc length along its stress-free axis.
struct MaterialPoint {
  Index strand = 0;
  double s = 0.0;
};

struct SectionStiffness {
  double EA = 0.0, EI = 0.0;
};

/// An end of a strand.
struct StrandEnd {
  Index strand = 0;
  bool last = false;
  bool operator==(const StrandEnd&) const = default;
};

/// Elements of one length, up to a breakpoint, a point load inside the strand or the strand's end.
struct MeshSegment {
  MeshSegment() = default;
  MeshSegment(int number, Index at_load = -1) : elements(number), load(at_load) {}

  int elements = 1;
  Index load = -1;  ///< at which the segment ends, by SlidingBody::point_loads; −1: elsewhere

  /// The nodes are pressed on an obstacle, to which they hand these loads on that act inside the segment: on the two
  /// nodes beside them, as on those of a bar. Others have no part in it, be they at its end.
  bool pressed = false;
  std::vector<Index> handed_on{};

  /// The one element between two breakpoints lies straight: it bears an axial force, which is an unknown, and the
  /// moment that holds its natural curvature straight. It may have no length.
  bool straight = false;

  bool ends_at_load() const { return load >= 0; }
  bool operator==(const MeshSegment&) const = default;
};

/// How the strands of a body are meshed: the segments of each. k breakpoints and l loads that have nodes make k + l + 1
/// segments. A load that has none acts inside an element.
using ElementsPerSegment = std::vector<std::vector<MeshSegment>>;

/// Where a point of the axis is, and the direction of the axis there.
struct AxisPlace {
  Vec2 position{};
  double angle = 0.0;  ///< of the tangent, continuous along the strand [rad]
};

/// Curvature and stretch of the axis on one side of a node.
struct AxisStrain {
  double curvature = 0.0;  ///< d angle / d stress-free arc length [1/length]
  double stretch = 1.0;    ///< d deformed arc length / d stress-free arc length
};

/// The same with their derivatives.
struct AxisStrainGradient : AxisStrain {
  Vector curvature_dx{}, curvature_ds{};
  Vector stretch_dx{}, stretch_ds{};
  double curvature_dlambda = 0.0, stretch_dlambda = 0.0;  ///< of loads along the element, and of ends that are moved
};

/// Where the nodes of a sliding mesh and its breakpoints are, and the parameter: all that its equations depend on. A
/// view, whose vectors must outlive it.
struct MeshState {
  Eigen::Ref<const Vector> x;  ///< unknowns of the mesh
  Eigen::Ref<const Vector> s;  ///< material coordinates of the breakpoints [length]
  double lambda;
};

/// Unknowns of a node in x: x and z of its position, and its rotation; −1 where a support holds it.
using NodeUnknowns = std::array<Index, 3>;

/// A mesh of a body between breakpoints that may move along it. Equilibrium of its nodes depends on where they are, x,
/// and on the breakpoints' material coordinates s: F(x, s, λ). Immutable.
///
/// x holds positions and angles, not displacements: what is tied to a breakpoint's node then does not depend on s.
class SlidingMesh {
 public:
  virtual ~SlidingMesh() = default;

  virtual const ElementsPerSegment& elements_per_segment() const = 0;
  virtual Index unknowns() const = 0;

  /// The last of the unknowns, so many, are the axial forces of straight segments. To K they are multipliers: of what
  /// each holds, a little gives way by itself.
  virtual Index axial_forces() const = 0;

  /// Which unknown is the axial force of the element behind a node; empty of elements that are not straight ones.
  virtual std::optional<Index> axial_force(Index strand, Index position) const = 0;

  /// s has as many entries, strand by strand in ascending order.
  virtual Index breakpoints() const = 0;

  /// How far apart two x are, as Equations::metric() has it.
  virtual const StateMetric& metric() const = 0;

  virtual void residual(const MeshState& now, Eigen::Ref<Vector> F) const = 0;

  /// F, K, F_λ and, as columns of B, ∂F/∂s; `pattern_of` is left alone.
  virtual void linearize(const MeshState& now, Linearization& out) const = 0;

  virtual double energy(const MeshState& now) const = 0;

  // --- geometry: the nodes of a strand have positions 0 … n along it ------------------------------------------------

  virtual Index nodes(Index strand) const = 0;
  virtual double coordinate(Index strand, Index position, const Eigen::Ref<const Vector>& s) const = 0;
  virtual NodeUnknowns node_unknowns(Index strand, Index position) const = 0;
  virtual AxisPlace node(Index strand, Index position, const MeshState& now) const = 0;

  /// The rates of x, z and angle of a node by λ at fixed unknowns: 0 except at ends whose supports move.
  virtual Eigen::Vector3d node_rate(Index strand, Index position) const = 0;

  /// Run and position of breakpoint k.
  virtual std::pair<Index, Index> breakpoint(Index k) const = 0;

  enum class At { before, behind };

  /// On one side of a node. The curvature's derivatives are those at a place that the breakpoints do not move.
  virtual AxisStrain node_strain(Index strand, Index position, At side, const MeshState& now) const = 0;
  virtual AxisStrainGradient node_strain_gradient(Index strand, Index position, At side,
                                                  const MeshState& now) const = 0;

  /// Just before or behind breakpoint k, which moves along the body.
  AxisStrain strain(Index k, At side, const MeshState& now) const {
    const auto [strand, position] = breakpoint(k);
    return node_strain(strand, position, side, now);
  }
  virtual AxisStrainGradient strain_gradient(Index k, At side, const MeshState& now) const = 0;

  /// At an end of a strand.
  AxisStrain end_strain(Index strand, bool last, const MeshState& now) const {
    return node_strain(strand, last ? nodes(strand) - 1 : 0, last ? At::before : At::behind, now);
  }
  AxisStrainGradient end_strain_gradient(Index strand, bool last, const MeshState& now) const {
    return node_strain_gradient(strand, last ? nodes(strand) - 1 : 0, last ? At::before : At::behind, now);
  }

  /// Energy of the element behind a node, the potential of the load along it included.
  virtual double element_energy(Index strand, Index position, const MeshState& now) const = 0;

  /// What the nodes exert on the element behind a node: x, z and moment at its first and at its second end, the loads
  /// on it included.
  using EndForces = std::array<Eigen::Vector3d, 2>;
  virtual EndForces end_forces(Index strand, Index position, const MeshState& now) const = 0;

  /// Returns the point loads inside the element after a node, in the order of their places.
  struct PointLoad {
    double s = 0.0;             ///< material coordinate [length]
    Vec2 force = Vec2::Zero();  ///< [force]
    bool on_wall = false;       ///< a zone of contact hands it on to the wall: it bends nothing
  };
  virtual std::vector<PointLoad> point_loads_in(Index strand, Index position, const MeshState& now) const = 0;

  /// What point loads and springs exert on an end of a strand: along x, and along z [force]. With derivatives by x and
  /// λ.
  struct EndLoad {
    Vec2 force = Vec2::Zero();
    std::array<Vector, 2> dx{};
    Vec2 dlambda = Vec2::Zero();
  };
  virtual EndLoad load_on_end(Index strand, bool last, const MeshState& now) const = 0;

  /// Any place, by interpolation consistent with the elements.
  virtual AxisPlace place(const MaterialPoint& point, const MeshState& now) const = 0;

  /// Derivatives of x, z and angle of a place: rows by x, rows by s, and by λ at fixed x and s.
  struct PlaceGradient {
    Eigen::Matrix<double, 3, Eigen::Dynamic> dx{}, ds{};
    Eigen::Vector3d dlambda = Eigen::Vector3d::Zero();
  };
  virtual PlaceGradient place_gradient(const MaterialPoint& point, const MeshState& now) const = 0;

  /// A place inside the element behind a node, at a fraction of the element.
  virtual AxisPlace inside(Index strand, Index position, double fraction, const MeshState& now) const = 0;

  /// The same shape on another mesh of the body.
  virtual Vector transferred(const MeshState& now, const SlidingMesh& to, const Vector& s_to) const = 0;
};

/// The layout of a state on such a mesh: x of the mesh stands first in State::x, s last.
class SlidingLayout : public Layout {
 public:
  virtual const SlidingMesh& mesh() const = 0;
};

inline const SlidingMesh& mesh_of(const State& state) {
  return static_cast<const SlidingLayout&>(*state.active_set.layout()).mesh();
}

/// `state` must outlive the view.
inline MeshState mesh_state_of(const State& state) {
  const SlidingMesh& mesh = mesh_of(state);
  return {.x = state.x.head(mesh.unknowns()), .s = state.x.tail(mesh.breakpoints()), .lambda = state.lambda};
}

/// A structure of slender members that can be meshed in many ways.
class SlidingBody {
 public:
  virtual ~SlidingBody() = default;

  virtual Index strands() const = 0;
  virtual double length(Index strand) const = 0;

  /// Half the height of the sections [length]; 0 for contact on the axis.
  virtual double half_height(Index strand) const = 0;

  /// Number of elements that a stretch of a strand asks for, not rounded.
  virtual double elements_between(Index strand, double from, double to) const = 0;

  /// Curvature that the axis has at a place without force, temperatures included, by stress-free length [1/length].
  virtual double natural_curvature(const MaterialPoint& point, double lambda) const = 0;

  /// Its first or second derivative by stress-free length [1/length², 1/length³]. A stretch of 0.4 or 6 % of the strand
  /// is looked at on either side.
  virtual double natural_curvature_derivative(const MaterialPoint& point, int derivative) const = 0;

  /// Strain that the axis has without force, and its rate by λ.
  struct FreeStrain {
    double value = 0.0, rate = 0.0;
  };
  virtual FreeStrain free_strain(Index strand, double lambda) const = 0;

  /// EA [force] and EI [force·length²] at a place, or a derivative of them by stress-free length.
  virtual SectionStiffness stiffness(const MaterialPoint& point, int derivative = 0) const = 0;
  double axial_stiffness(const MaterialPoint& point) const { return stiffness(point).EA; }
  double bending_stiffness(const MaterialPoint& point) const { return stiffness(point).EI; }

  /// Where point loads act inside a strand: material coordinates, ascending [length].
  virtual const std::vector<double>& point_loads(Index strand) const = 0;

  /// One of them, and its rate by λ [force].
  struct PointForce {
    Vec2 value = Vec2::Zero(), rate = Vec2::Zero();
  };
  virtual PointForce point_load(Index strand, Index load, double lambda) const = 0;

  /// What acts along a strand at a place of it that is here now, where the axis has this stretch: loads, pressure, and
  /// the springs of a foundation [force per stress-free length].
  virtual Vec2 load(const MaterialPoint& point, const AxisPlace& place, double stretch, double lambda) const = 0;

  /// Whether a support holds the end of a strand in z.
  virtual bool end_is_held(Index strand, bool last) const = 0;

  /// The first of the ends that are one place to a contact, with the end of this strand: at a joint whose strands turn
  /// together. To contact on faces they are if they are in line and as thick.
  virtual StrandEnd first_of_joint(Index strand, bool last, bool on_axis) const = 0;

  /// Whether an end of a strand is a tip: free to move in z and to turn, with no other strand at it.
  virtual bool is_tip(Index strand, bool last) const = 0;

  /// The other end at a joint of two strands that turn together, which no support holds in z or from turning; empty at
  /// other ends.
  virtual std::optional<StrandEnd> joined_end(Index strand, bool last) const = 0;

  /// Whether contact may come up to an end of a strand: a tip, a hinged end, one on a plane of symmetry or such a
  /// joint. There it is a contact of the end itself; of a hinged one only on a roller, with walls that cross its way.
  bool lets_contact_come(Index strand, bool last) const {
    return is_tip(strand, last) || is_hinged(strand, last) || is_on_plane(strand, last) || joined_end(strand, last);
  }

  /// Whether supports hold an end of a strand in z and its rotation.
  virtual bool is_clamped(Index strand, bool last) const = 0;

  /// Whether supports hold an end of a strand in z and leave its rotation to it, with no other strand at it.
  virtual bool is_hinged(Index strand, bool last) const = 0;

  /// Whether supports hold an end of a strand as a plane of symmetry across the axis does: in rotation and along the
  /// axis, not along the plane.
  virtual bool is_on_plane(Index strand, bool last) const = 0;

  /// Whether an end of a strand is hinged and may move in x.
  virtual bool is_on_roller(Index strand, bool last) const = 0;

  /// Words for messages: member and fraction of its length.
  virtual std::pair<std::string, double> label(const MaterialPoint& point) const = 0;

  virtual std::shared_ptr<const SlidingMesh> mesh(const ElementsPerSegment& cut) const = 0;

  /// The unknowns of a mesh in the stress-free state.
  virtual Vector rest(const SlidingMesh& mesh, const Vector& s) const = 0;

  virtual double length_scale() const = 0;
  virtual double force_scale() const = 0;
};

}  // namespace arcwall
