#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contact/moving_obstacle.hpp"
#include "contact/multiplier_contact.hpp"
#include "contact/profile.hpp"
#include "elements/member_point.hpp"
#include "elements/structure.hpp"
#include "tests/support/beam_theories.hpp"
#include "tests/support/branch.hpp"

/// Structures that several suites use; all numbers that matter are arguments or stand in the comments. Theories that
/// are flexible in shear take GA, the others leave it out.
namespace arcwall::test {

/// Two bars between supports at (∓b, 0) and an apex at (0, h), joint 1, loaded there by λ downwards. The apex moves in
/// x only when `sways`.
struct VonMisesTruss {
  double EA = 1.0, half_span = 10.0, rise = 1.0;
  TrussStrain strain = TrussStrain::green;
  bool sways = true;

  std::unique_ptr<Structure> structure() const;
};

/// A straight cantilever from (0, 0) to (L, 0), clamped at the left; the tip is joint 1.
struct Cantilever {
  double EA = 1e4, EI = 1.0, length = 1.0;
  int elements = 8;
  double tip_force = 0.0, tip_moment = 0.0;  ///< times λ; the force acts along z
  double tip_push = 0.0;                     ///< times λ, against x
  double GA = 0.0;
  BeamTheory beam{};

  std::unique_ptr<Structure> structure() const;
};

/// A member that is clamped at one end and free at the other: joints 0 and 1, of which these are which.
struct ClampedMember {
  StructureBuilder builder{};
  Index clamped = 0, free = 1;
};

/// From the clamp to the tip, or where it is `reversed` the other way; along an arc if it has a middle, else straight.
ClampedMember clamped_member(const Vec2& clamp, const Vec2& tip, bool reversed, MemberDescription described,
                             const std::optional<Vec2>& middle = std::nullopt);

/// A straight column from (0, 0) to (L, 0), pushed at its right end, joint 1, by λ. The left end is held, the right one
/// slides along x; both are pinned, or clamped.
struct Column {
  double EA = 1000.0, EI = 1.0, length = 1.0;
  bool clamped = false;
  int elements = 40;
  double GA = 0.0;
  BeamTheory beam{};

  std::unique_ptr<Structure> structure() const;
};

/// Lee's frame (Lee, Manuel & Rossow 1968): column (0,0)-(0,120), beam (0,120)-(120,120), pinned ends, E = 720, A = 6,
/// I = 2, λ downwards at joint 2, which is 24 from the corner. Shear: ν = 0.3, shear correction 1. `elements` on each
/// of the two; a multiple of 5.
std::unique_ptr<Structure> lee_frame(int elements, const BeamTheory& beam = {});

/// Williams' toggle: two rigidly joined bars between clamped ends, half span 12.943, rise 0.386, E = 1.03e7, section
/// 0.753 × 0.243, λ downwards at the apex, joint 1. `elements` on each bar.
std::unique_ptr<Structure> williams_toggle(int elements, const BeamTheory& beam = {});

/// Roorda's frame: column (0,0)-(0,1), beam (0,1)-(1,1), outer ends pinned, rigid corner, joint 1. There λ acts
/// downwards and a couple −e λ, of a load that stands beside the column. EI = 1. `elements` on each of the two.
struct RoordaFrame {
  double EA = 1e6, eccentricity = 0.0;
  int elements = 20;
  BeamTheory beam{};

  std::unique_ptr<Structure> structure() const;
};

/// A square of four bars of length 1 on its corner, hinged at the bottom, joint 0, and at the top, joint 2, rigid at
/// the sides, joints 1 and 3. The bottom is held, the top moves along z under 2 λ upwards. EI = 1. `elements` on each
/// bar.
struct DiamondFrame {
  double EA = 1000.0;
  int elements = 16;
  BeamTheory beam{};

  std::unique_ptr<Structure> structure() const;
};

/// A circular arch about the origin from −half_angle to half_angle against the vertical, loaded by λ downwards at its
/// crown, joint 1. `elements` on each half.
struct CircularArch {
  double radius = 1.0, half_angle = pi / 2.0;
  double EA = 1e6, EI = 1.0;
  bool clamped_left = false, clamped_right = false;
  int elements = 16;
  double GA = 0.0;
  BeamTheory beam{};

  std::unique_ptr<Structure> structure() const;
};

/// Deep circular arch of 215°, R = 100, EA = 1e8, EI = 1e6, hinged left, clamped right (DaDeppo & Schmidt 1975).
std::unique_ptr<Structure> deep_arch(int elements, const BeamTheory& beam = {}, double GA = 0.0);

/// Pinned semicircle, R = 127, EA = 1378·64.52, EI = 1378·41.62.
std::unique_ptr<Structure> pinned_semicircle(int elements, const BeamTheory& beam = {});

/// Pinned, chord 10000, rise 500, EA = 2e6, EI = 2e10 (after Clarke & Hancock 1990).
std::unique_ptr<Structure> shallow_arch(int elements, const BeamTheory& beam = {});

/// A degree of freedom of a joint as an observable.
std::shared_ptr<const Observable> displacement(const Structure& structure, Index node, Dof which);

/// The rotation that the rigidly joined members at a joint share.
std::shared_ptr<const Observable> joint_rotation(const Structure& structure, Index joint);

/// Where a joint has gone.
Vec2 displacement_of(const Structure& structure, const State& state, Index node);

/// A structure and how far its path is followed.
struct PathModel {
  std::string name{};
  std::unique_ptr<Structure> structure{};
  Index loaded = 1;
  double first_step = 0.02;
  std::vector<TargetValue> target_values{};
  bool watch = false;  ///< turning points of the loaded joint's z are events

  TraceOptions options() const;
  std::vector<Watch> watched() const;
};

/// A bound of a joint's displacement that ends the branch.
TargetValue stop_at(const Structure& structure, Index node, Dof which, double value);

/// A wall that all nodes of member 0 are tested against, on the face that looks at it or on the axis.
struct TestWall {
  std::string name{};
  Side side = Side::above;
  std::shared_ptr<const Profile> profile{};
  bool on_axis = false;
  RigidMotion motion{};   ///< of the wall, by λ
  double friction = 0.0;  ///< for points that move

  std::shared_ptr<const Obstacle> obstacle() const;
};

/// Every section that carries contact against every wall.
std::vector<Candidate> candidates(const Structure& structure, const std::vector<TestWall>& walls);

/// A structure with node contact of all its members: guards are scaled as in a study whose first step is `first_step`.
class ContactModel {
 public:
  ContactModel(std::unique_ptr<Structure> structure, const std::vector<TestWall>& walls, double first_step,
               const ContactLaw& law = {});

  const Structure& structure() const { return *structure_; }
  const MultiplierContact& system() const { return *contact_; }

 private:
  std::unique_ptr<Structure> structure_;
  std::unique_ptr<MultiplierContact> contact_;
};

/// Selke & Kikuchi's first example [kN, cm]: a beam of length 2 and square section 0.2 (E = 21000, EI = 2.8), 0.08
/// above a flat foundation, bent down by end moments λ; its right end slides.
ContactModel foundation_beam(int elements, const ContactLaw& law = {});
std::unique_ptr<Structure> foundation_structure(int elements);
std::vector<TestWall> foundation_wall();

/// The channel of Selke & Kikuchi's second example [kN, cm]: a pinned column of length 2 and square section 0.1 (E =
/// 2.1e4, so EA = 210, EI = 0.175) between walls 0.15 from its axis, λ pushes its right end to the left.
struct Channel {
  int elements = 80;
  std::vector<SineDeviation> imperfection{};
  bool walls = true;
  double first_step = 0.05;
  double cm = 1.0;  ///< the user's unit of length [1/cm]: 0.01 for metres
  double kN = 1.0;  ///< of force [1/kN]: 1000 for newtons
  ContactLaw law{};

  ContactModel model() const;
};

/// Half sine of 0.00176 and a third harmonic that bends the middle away from the wall: the snap becomes a limit point.
std::vector<SineDeviation> snapping_imperfection(double cm = 1.0);

}  // namespace arcwall::test
