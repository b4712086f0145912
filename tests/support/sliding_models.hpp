#pragma once

#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "contact/sliding_contact.hpp"
#include "continuation/explorer.hpp"
#include "elements/sliding_structure.hpp"
#include "tests/support/models.hpp"

namespace arcwall {

/// In the names of tests.
inline void PrintTo(Theory theory, std::ostream* out) {
  *out << (theory == Theory::euler_bernoulli ? "euler-bernoulli"
           : theory == Theory::elastica      ? "elastica"
                                             : "another theory");
}

}  // namespace arcwall

/// Columns and beams among walls, with contact points that slide along them.
namespace arcwall::test {

/// A body with sliding contact: guards are scaled as in a study whose first step is `first_step`.
class SlidingModel {
 public:
  SlidingModel(const StructureBuilder& builder, const std::vector<TestWall>& walls, double first_step,
               ContinuumChoice continuum = ContinuumChoice::symmetric);

  const SlidingStructure& structure() const { return *structure_; }
  const SlidingContact& system() const { return *contact_; }

  /// What is read off a member at a fraction of its length.
  std::shared_ptr<const Observable> at(const std::string& member, double fraction,
                                       MemberObservable::Component component) const;

  /// Displacement of a joint.
  std::shared_ptr<const Observable> joint(Index node, Dof which) const;

 private:
  std::unique_ptr<SlidingStructure> structure_;
  std::unique_ptr<SlidingContact> contact_;
};

/// The channel of Selke & Kikuchi's second example [kN, cm]: a column of length 2 and square section 0.1 (EA = 210, EI
/// = 0.175) on the x-axis between walls, λ pushes its right end, node 1, to the left. Members are called "0", "1" ….
struct SlidingChannel {
  /// An active set of the column: to where it reaches, and its elements.
  struct Member {
    double to;
    int elements;
  };
  std::vector<Member> members{{2.0, 20}};
  std::vector<SineDeviation> imperfection{};         ///< of the first member
  std::optional<double> upper = 0.15, lower = 0.15;  ///< gaps at rest, at x = 0
  double slope = 0.0;                                ///< of both walls
  bool clamped = false;
  ContinuumChoice continuum = ContinuumChoice::symmetric;
  double end_moment = 0.0;  ///< at the left end, times λ
  double lateral = 0.0;     ///< along all members in z, times λ [per length]
  Theory theory = Theory::euler_bernoulli;
  bool reversed = false;  ///< members run from right to left
  double first_step = 0.05;
  double cm = 1.0, kN = 1.0;  ///< the user's units [1/cm], [1/kN]

  SlidingModel model() const;
};

/// Selke & Kikuchi's first example [kN, cm]: a beam of length 2 and square section 0.2 (EI = 2.8, EA = 840), its
/// supports sliding apart, bent by end moments λ onto a floor 0.08 below its lower face.
struct SlidingFoundation {
  int elements = 40;
  bool fixed = false;   ///< both supports in both directions; else the right one slides along x
  double turned = 0.0;  ///< of beam and floor together [rad]

  SlidingModel model() const;
};

/// A strip of length 20 and section 1 × 0.1 [kN, cm] (EA = 2100, EI = 1.75) that end moments λ bend round a cylinder of
/// radius 20, whose top is 0.5 below the strip's lower face and below its middle. The left support is fixed, the right
/// one slides along x.
struct SlidingCylinder {
  int elements = 20;
  Theory theory = Theory::euler_bernoulli;

  SlidingModel model() const;
};

/// A branch of an exploration, with why it ended.
struct ExploredBranch {
  BranchRecord record{};
  std::vector<Arc> arcs{};
  double lambda_scale = 1.0;  ///< λ₀ of the path metric
};

/// Everything that an explorer finds by the policy `follow`, with `preference` first when of two mirror images one is
/// chosen.
std::vector<ExploredBranch> follow(const System& system, const State& start, const TraceOptions& options,
                                   std::vector<std::shared_ptr<const Observable>> preference = {},
                                   std::vector<Watch> watched = {});

/// All that was found of a model up to a load.
struct SlidingPath {
  SlidingModel model;
  TraceOptions options;
  std::vector<ExploredBranch> branches;

  std::vector<Event> events() const;
  std::vector<EventKind> kinds() const;
  const State& last() const { return branches.back().arcs.back().to.state; }
  double force(Index contact) const { return model.system().force(last(), contact); }

  void expect_invariants() const;
};

/// From rest, between λ = −1 and `to`.
SlidingPath sliding_path(SlidingModel model, double to, double step);

/// All events of all branches in order, without starts; branch points that are left count once.
std::vector<Event> events_of(const std::vector<ExploredBranch>& branches);

/// The n-th event of a kind, counted from 0; fails the test if there is none.
Event event_of(const std::vector<ExploredBranch>& branches, EventKind kind, std::size_t n = 0);

/// The limit of values on meshes of h and h/2 for errors of order four.
inline double richardson(double coarse, double fine) { return fine + (fine - coarse) / 15.0; }

}  // namespace arcwall::test
