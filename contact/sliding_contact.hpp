#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "contact/candidate.hpp"
#include "contact/multiplier_contact.hpp"
#include "contact/sliding_layout.hpp"
#include "core/sliding_body.hpp"
#include "core/system.hpp"

namespace arcwall {

/// A rigid surface that slender members may touch.
struct Obstacle {
  std::string name{};
  std::shared_ptr<const Profile> profile{};
  Side side = Side::above;
  bool on_face = true;                  ///< contact of the members' faces, or of their axes
  std::vector<std::uint8_t> strands{};  ///< per strand whether it concerns it
};

struct LayoutEdit;

/// A body of slender members among obstacles, with contact where it is: the material coordinates s of the contact
/// points are unknowns, and the mesh moves with them (docs/theory.md, section 8).
///
///     F(x, s, λ) − Σ p_k ∇g_k − Σ m_k ∇t_k = 0,   −g_k = 0 (closed),   −t_k = 0,   m_k = 0
///
/// g is the gap, t the angle between the body and the wall, p ≥ 0 the contact force; m, a moment that holds the
/// tangency, vanishes, or at the ends of a pressed part what the body bends more than the wall does. Tracked points are
/// closed, or open and follow a least gap. Unknowns: x, p, m, s.
///
/// Between two closed points on one wall the body may lie on the wall: straight and without pressure, or with nodes
/// that are held on the wall, where wall or body are curved so that they press.
class SlidingContact final : public System {
 public:
  /// `body` must outlive this.
  SlidingContact(const SlidingBody& body, std::vector<Obstacle> obstacles, const ContactScales& scales);

  Index size(const Piece& piece) const override;
  void residual(const State& state, Eigen::Ref<Vector> F) const override;
  void linearize(const State& state, Linearization& out) const override;
  double energy(const State& state) const override;
  Vector weights(const Piece& piece) const override;
  Piece open_piece() const override { return open_; }
  Index multiplier_count(const Piece& piece) const override;

  Index guard_count(const Piece& piece) const override;
  Vector guards(const State& state) const override;
  Row guard_gradient(const State& state, Index j) const override;
  double guard(const State& state, Index j) const override;
  Vector unit_force(const State& state, Index j) const override;
  std::optional<Index> multiplier_index(const Piece& piece, Index j) const override;
  double multiplier_scale() const override { return scales_.force; }
  Vector transfer(const Vector& x, const Piece& from, const Piece& to) const override;
  std::vector<Transition> transitions(const State& state, const Direction& forward, Index bound,
                                      double tolerance) const override;
  bool admissible(const State& state, double margin) const override;
  std::optional<Transition> with_inserted_contact(const State& from, const Direction& forward, const State& to,
                                                  double margin) const override;
  Piece canonical_piece(const State& state) const override;
  std::optional<std::string> invalid_reason(const State& state) const override;

  /// How many points are tracked on a piece: unknowns behind those of K.
  Index border_width(const Piece& piece) const;

  /// The stress-free state, all contacts open.
  State rest() const;

  /// The same state of this body, of one on another body that differs from it in its loads alone.
  State adopted(const State& state) const;

  /// The layout with this cut and these points that began at these places; null if they do not belong together.
  std::shared_ptr<const SlidingContactLayout> layout_of(const ElementsPerSegment& cut,
                                                        std::vector<SlidingContactLayout::Point> points,
                                                        const Vector& origin) const;

  /// Where contact j of a piece is, and its force. The number of a guard on the pressure of a part on a wall stands for
  /// the place where the pressure is least.
  ContactLabel label(const State& state, Index j) const;
  Vec2 place(const State& state, Index j) const;
  double force(const State& state, Index j) const;

  /// A node inside a pressed part, which the wall holds.
  struct HeldNode {
    ContactLabel label{};  ///< tributary: half the way to the nodes beside it
    Vec2 place = Vec2::Zero();
    double force = 0.0;
  };
  std::vector<HeldNode> held_nodes(const State& state) const;

  /// The least gap at `places` points of each element against every obstacle, flat parts included [length].
  double least_gap(const State& state, int places) const;

  const ContactScales& scales() const { return scales_; }
  const SlidingBody& body() const { return body_; }
  const std::vector<Obstacle>& obstacles() const { return obstacles_; }

 private:
  // A body's node against an obstacle: gap, angle to the wall, and their derivatives by x, z and rotation.
  struct NodeGap {
    double gap, tilt, angle;  // angle: the tilt with its winding number and direction of travel
    Eigen::Vector3d gap_gradient, tilt_gradient;
    Eigen::Matrix3d gap_hessian, tilt_hessian;
  };
  // A node that touches or may touch.
  struct Touch {
    Index strand, position;
    std::size_t obstacle;
    double offset;
  };
  // How much more the wall bends towards the body than the body does: > 0 where contact is at a point [1/length].
  struct CurvatureGap {
    double value = 0.0;
    Vector dx{}, ds{};
    double dlambda = 0.0;
  };
  // A place where the gap is least.
  struct Minimum {
    std::size_t obstacle = 0;
    MaterialPoint at{};
    double gap = 0.0;
  };
  // Where the pressure of a held node's surroundings is least, in elements from the node; it is Σ weight · pressure of
  // the held nodes from `first` on.
  struct LeastPressure {
    double offset = 0.0;
    std::size_t first = 0;
    Vector weights{};
  };
  using Edit = std::function<void(LayoutEdit&)>;

  const SlidingContactLayout& layout(const Piece& piece) const;
  Touch touch(const SlidingContactLayout& on, std::size_t j) const;
  double normal_offset(std::size_t obstacle, Index strand) const;
  static Vec2 face(double offset, const AxisPlace& place);
  double face_gap(const Touch& touch, const AxisPlace& place) const;
  NodeGap node_gap(const Touch& touch, const MeshState& now, const SlidingContactLayout& on) const;
  CurvatureGap curvature_gap(const State& state, std::size_t k) const;
  Vector border_rates(const State& state) const;
  double bending_gap(const State& state, std::size_t k) const;
  double pressure(const State& state, std::size_t k) const;
  double wall_curvature(const State& state, std::size_t k) const;
  bool lies_by_itself(const State& state, std::size_t k) const;
  template <typename Visit>
  void for_each_force(const State& state, const Visit& visit) const;
  void add_contact(const State& state, Eigen::Ref<Vector> F) const;
  void lay_out(const State& state, Linearization& out) const;

  struct Lifting {
    std::size_t obstacle = 0;
    MaterialPoint at{};
  };
  std::optional<Lifting> lifting(const State& state, Index j) const;
  Index held_force(const State& state, std::size_t node) const;
  std::optional<std::size_t> touching_end(const State& state, std::size_t which) const;
  LeastPressure least_pressure(const State& state, std::size_t node) const;
  double least_pressure_around(const State& state, std::size_t node) const;
  double least_pressure_place(const State& state, std::size_t node) const;
  double limit_value(const State& state, std::size_t limit) const;
  Row limit_gradient(const State& state, std::size_t limit) const;
  template <typename Visit>
  void for_each_minimum(const State& state, bool everywhere, const Visit& visit) const;
  std::optional<Minimum> deepest(const State& state, double margin) const;
  std::optional<Minimum> nearest(const State& state, const Minimum& other) const;

  LayoutEdit draft_of(const State& state) const;
  std::shared_ptr<const SlidingContactLayout> layout_of(const LayoutEdit& edit) const;
  State redrawn(const State& state, const LayoutEdit& by, const std::shared_ptr<const SlidingContactLayout>& on) const;
  Transition remeshed(const State& state, const Direction& forward, const Edit& edit) const;

  std::vector<std::size_t> reached(const State& state, SlidingContactLayout::Bound bound, double tolerance) const;
  std::vector<Transition> straightened(const State& state, double tolerance) const;
  Transition continuum(const State& state, Index lines, Index ends) const;
  std::vector<Transition> spreads(const State& state, const std::vector<std::size_t>& points) const;
  std::string why_none_spreads(const State& state, const std::vector<std::size_t>& points) const;
  Transition spread(const State& state, const std::vector<std::size_t>& points, SlidingContactLayout::Span between,
                    double length) const;
  Transition shrunk(const State& state, std::size_t k, double tolerance) const;
  Transition shrunk_passage(const State& state, const LayoutEdit& edit, double s, Transition::Change change) const;
  Transition gathered(const State& state, const std::vector<std::size_t>& spans) const;
  Transition joined(const State& state, const std::vector<std::size_t>& gaps) const;
  std::vector<Transition> lifted(const State& state, double tolerance) const;
  void add_split(const State& state, const std::vector<std::size_t>& nodes, double length,
                 std::vector<Transition>& to) const;
  Transition without(const State& state, const Direction& forward, std::size_t k) const;
  Transition with_elements(const State& state, const Direction& forward, std::size_t segment, int elements) const;
  Index straightened_ends(const State& state, std::size_t k) const;
  double least_span(Index strand) const;
  double least_span(const SlidingContactLayout& on, std::size_t k) const;

  const SlidingBody& body_;
  std::vector<Obstacle> obstacles_;
  ContactScales scales_;
  struct Tied {  // a free end of a strand, which may touch though no tangent does
    Index strand;
    bool last;
    std::size_t obstacle;
    double travel;  // ±1: with or against x at rest; 0: neither
  };
  std::vector<Tied> tied_;
  Piece open_;
};

}  // namespace arcwall
