#pragma once

#include <memory>
#include <string>
#include <vector>

#include "contact/multiplier_contact.hpp"
#include "elements/member_point.hpp"
#include "elements/structure.hpp"

/// Models that several suites use; all numbers that matter are arguments or stand in the comments.
namespace arcwall::test {

/// Two bars between supports at (∓b, 0) and an apex at (0, h), loaded there by λ downwards. The apex moves in x only
/// when `sways`.
struct VonMisesTruss {
  double EA = 1.0, half_span = 10.0, rise = 1.0;
  TrussStrain strain = TrussStrain::green;
  bool sways = true;

  std::unique_ptr<Structure> structure() const;
};

/// Theory and order of the beams of a model.
struct BeamTheory {
  Theory theory = Theory::classic;
  int order = 2;
};

/// A straight cantilever from (0, 0) to (L, 0), clamped at the left.
struct Cantilever {
  double EA = 1e4, EI = 1.0, length = 1.0;
  int elements = 8;
  double tip_force = 0.0, tip_moment = 0.0;  ///< times λ; the force acts along z
  BeamTheory beam{};

  std::unique_ptr<Structure> structure() const;
};

/// Lee's frame (Lee, Manuel & Rossow 1968): column (0,0)-(0,120), beam (0,120)-(120,120), pinned ends, E = 720, A = 6,
/// I = 2, λ downwards 24 from the corner. `elements` on each of the two; a multiple of 5.
std::unique_ptr<Structure> lee_frame(int elements, const BeamTheory& beam = {});

/// Deep circular arch of 215°, R = 100, EA = 1e8, EI = 1e6, hinged left, clamped right, λ downwards at the crown.
/// `elements` on each half.
std::unique_ptr<Structure> deep_arch(int elements, const BeamTheory& beam = {});

/// Williams' toggle: two rigidly joined bars between clamped ends, half span 12.943, rise 0.386, E = 1.03e7, section
/// 0.753 × 0.243, λ downwards at the apex. `elements` on each bar.
std::unique_ptr<Structure> williams_toggle(int elements, const BeamTheory& beam = {});

/// A vertical observable of the joint at which a model is loaded.
std::shared_ptr<const Observable> displacement(const Structure& structure, Index node, Freedom which);

/// A wall that all nodes of member 0 are tested against, on the face that looks at it or on the axis.
struct TestWall {
  std::string name{};
  Side side = Side::above;
  std::shared_ptr<const Profile> profile{};
  bool on_axis = false;
};

/// A structure with node contact of all its members: guards are scaled as in a study whose first step is `first_step`.
class ContactModel {
 public:
  ContactModel(std::unique_ptr<Structure> structure, const std::vector<TestWall>& walls, double first_step);

  const Structure& structure() const { return *structure_; }
  const MultiplierContact& system() const { return *contact_; }

 private:
  std::unique_ptr<Structure> structure_;
  std::unique_ptr<MultiplierContact> contact_;
};

/// The channel of Selke & Kikuchi's second example [kN, cm]: a pinned column of length 2 and square section 0.1 (E =
/// 2.1e4, so EA = 210, EI = 0.175) between walls 0.15 from its axis, λ pushes its right end to the left.
struct Channel {
  int elements = 80;
  std::vector<SineDeviation> imperfection{};
  bool walls = true;
  double first_step = 0.05;
  double cm = 1.0;  ///< the user's unit of length [1/cm]: 0.01 for metres
  double kN = 1.0;  ///< of force [1/kN]: 1000 for newtons

  ContactModel model() const;
};

/// Half sine of 0.00176 and a third harmonic that bends the middle away from the wall: the snap becomes a limit point.
std::vector<SineDeviation> snapping_imperfection(double cm = 1.0);

}  // namespace arcwall::test
