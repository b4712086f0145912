#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "contact/multiplier_contact.hpp"
#include "contact/outline.hpp"
#include "elements/structure.hpp"
#include "model/deck/values.hpp"

/// The walls of a deck, and how contact with them is met.
namespace arcwall::deck {

enum class ContactSurface { face, axis };

struct FlatProfile {
  double z = 0.0;

  bool operator==(const FlatProfile&) const = default;
};

/// ψ = z + slope x.
struct LineProfile {
  double z = 0.0;
  double slope = 0.0;

  bool operator==(const LineProfile&) const = default;
};

/// The upper arc for a wall below, the lower for one above.
struct CircleProfile {
  Vector centre{};
  double radius = 0.0;

  bool operator==(const CircleProfile&) const = default;
};

/// ψ = apex.z + ½ curvature (x − apex.x)².
struct ParabolaProfile {
  Vector apex{};
  double curvature = 0.0;

  bool operator==(const ParabolaProfile&) const = default;
};

/// C² interpolating cubic.
struct SplineProfile {
  std::vector<double> x{};  ///< strictly increasing, at least 2
  std::vector<double> z{};  ///< as many

  bool operator==(const SplineProfile&) const = default;
};

/// All on one side of a straight line.
struct HalfPlaneOutline {
  Vector point{};
  Vector normal{};  ///< to the body

  bool operator==(const HalfPlaneOutline&) const = default;
};

struct CircleOutline {
  Vector centre{};
  double radius = 0.0;
  Keep keep = Keep::outside;

  bool operator==(const CircleOutline&) const = default;
};

struct EllipseOutline {
  Vector centre{};
  Vector axes{};       ///< half of the first and of the second
  double angle = 0.0;  ///< of the first from the x-axis [rad]
  Keep keep = Keep::outside;

  bool operator==(const EllipseOutline&) const = default;
};

/// Points in the order in which an outline runs.
struct OutlinePoints {
  std::vector<double> x{};  ///< at least 2; of a closed one 3, the first of which is not repeated
  std::vector<double> z{};  ///< as many
  bool closed = false;
  Keep keep = Keep::outside;  ///< of a closed one; of an open one the body is to the left

  std::vector<Vec2> points() const;

  bool operator==(const OutlinePoints&) const = default;
};

/// Straight between the points; Wall::radii() round the corners.
struct PolylineOutline : OutlinePoints {
  /// A corner: which of the points, how much the outline turns there towards the body [rad], and the lengths of the
  /// lines before and behind.
  struct Corner {
    std::size_t point = 0;
    double turn = 0.0, before = 0.0, behind = 0.0;

    /// Whether the body is in a hollow there, between two lines.
    bool is_hollow() const { return turn > 1e-9; }
  };
  std::vector<Corner> corners() const;

  struct Part;
  /// The outline in parts without hollow corners that are sharp, which reach a little beyond these: what is in such a
  /// corner touches two of them. Itself where it has none, or is closed and has one alone, so that no parts are to be
  /// told apart. `radii`: at each point.
  std::vector<Part> without_sharp_hollows(const std::vector<double>& radii) const;
};

/// Stores a part of a polyline and the radii at its points.
struct PolylineOutline::Part {
  PolylineOutline outline{};
  std::vector<double> radii{};
};

/// C² interpolating cubic by chord length.
struct CurveOutline : OutlinePoints {};

using Outline = std::variant<HalfPlaneOutline, CircleOutline, PolylineOutline, EllipseOutline, CurveOutline>;

/// How λ moves a wall as a rigid body: by this times λ.
struct WallMotion {
  double x = 0.0, z = 0.0;               ///< [length]
  double rotation = 0.0;                 ///< [rad]
  Vector about{};                        ///< the point about which it turns, where that is at rest
  Driven progress{.proportional = 1.0};  ///< takes the place of λ in a stage; no key of a deck

  bool operator==(const WallMotion&) const = default;
};

/// The pressure of a compliant wall by its penetration: one number, two or a table.
struct WallLaw {
  using Interpolation = SpringLaw::Interpolation;
  std::optional<double> stiffness{};  ///< at the touch [force/length²]
  std::optional<double> depth{};      ///< over which it grows by e; empty: constant [length]
  std::vector<double> penetration{};  ///< increasing from 0 [length]
  std::vector<double> pressure{};     ///< as many, ≥ 0, from 0 [force/length]
  Interpolation interpolation = SpringLaw::Interpolation::linear;  ///< of the table
  /// By which friction holds what sticks, by length of axis; empty: as stiff as the law at penetration 0
  /// [force/length²].
  std::optional<double> tangential_stiffness{};

  PressureLaw law() const;

  /// The stiffness along the wall of what sticks.
  double along() const { return tangential_stiffness ? *tangential_stiffness : law().at(0.0).stiffness; }

  bool operator==(const WallLaw&) const = default;
};

struct Wall {
  std::string name{};
  Position position{};
  Side side = Side::above;
  ContactSurface contact_surface = ContactSurface::face;
  std::vector<std::string> members{};  ///< empty: every member
  std::variant<FlatProfile, LineProfile, CircleProfile, ParabolaProfile, SplineProfile> profile{};
  std::optional<Outline> outline{};    ///< instead of side and profile
  double corner_radius = 0.0;          ///< of all corners of a polyline [length]
  std::vector<double> corner_radii{};  ///< of each corner in turn [length]; empty: corner_radius
  double interference = 0.0;           ///< so far it begins moved back from the structure [length]
  double retracted = 0.0;  ///< so far its outline begins behind its place and comes with λ; no key of a deck [length]
  std::optional<WallMotion> motion{};
  double friction = 0.0;         ///< coefficient μ of Coulomb friction ≥ 0 [-]
  std::optional<WallLaw> law{};  ///< of a compliant wall; empty: that of all walls

  /// Of a polyline: the radius at each of its points, 0 at the ends of an open one.
  std::vector<double> radii() const;

  bool operator==(const Wall&) const = default;
};

/// Friction of a wall and a member that differs from the wall's.
struct FrictionPair {
  Position position{};
  std::string wall{};    ///< empty: every wall
  std::string member{};  ///< empty: every member
  std::string point{};   ///< at which a member ends; empty: everywhere
  double coefficient = 0.0;

  bool operator==(const FrictionPair&) const = default;
};

enum class ContactPoints { nodes, moving };

/// Where friction acts on the section.
enum class FrictionAt { touch, axis };

struct Contact {
  ContactLaw::Method method = ContactLaw::Method::rigid;
  std::optional<ContactPoints> points{};  ///< empty: moving for euler-bernoulli and elastica, else nodes
  std::optional<double> penalty{};        ///< 1/μ, there for `penalty` and `augmented` [force/length²]
  double gap_tolerance = 1e-10;           ///< [length]
  FrictionAt friction_at = FrictionAt::touch;
  std::optional<WallLaw> law{};  ///< of compliant walls without their own

  bool is_compliant() const { return method == ContactLaw::Method::compliant; }

  bool operator==(const Contact&) const = default;
};

}  // namespace arcwall::deck
