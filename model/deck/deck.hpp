#pragma once

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "contact/continuum_choice.hpp"
#include "continuation/explorer.hpp"
#include "continuation/trace_options.hpp"
#include "core/error.hpp"
#include "elements/structure.hpp"
#include "model/deck/frame.hpp"
#include "model/deck/values.hpp"
#include "model/deck/walls.hpp"

/// One deck as plain values: what the user wrote, with every default filled in and every name known to point somewhere.
///
/// Choices that the libraries have are theirs. Numbers are in the user's own consistent units. Lists keep the order of
/// the deck. Two decks are equal if they say the same, wherever in a file they say it.
namespace arcwall::deck {

/// Labels only; nothing is converted.
struct Units {
  std::string length{};
  std::string force{};

  bool operator==(const Units&) const = default;
};

/// A number that formulas use by its name.
struct Variable {
  std::string name{};
  Position position{};
  double value = 0.0;

  bool operator==(const Variable&) const = default;
};

/// What the deck has in place of a number.
struct Formula {
  std::string text{};
  double value = 0.0;  ///< the number

  bool operator==(const Formula&) const = default;
};

/// By their keys as in `--set`.
using Formulas = std::map<std::string, Formula>;

struct Material {
  std::string name{};
  Position position{};
  double E = 0.0;                     ///< Young's modulus, > 0 [force/length²]
  std::optional<double> nu{};         ///< Poisson's ratio, in (-1, 1/2); there for every theory that needs it
  std::optional<double> expansion{};  ///< thermal expansion, there for members that are heated [1/degree]
  std::optional<double> allowable{};  ///< allowable stress, > 0, there for members of a utilisation [force/length²]

  bool operator==(const Material&) const = default;
};

/// Sizes `…_to` are those at the end of a member, linear from its beginning; empty: the same all along.
struct Rectangle {
  double width = 0.0;   ///< along y [length]
  double height = 0.0;  ///< along z [length]
  std::optional<double> width_to{}, height_to{};

  bool operator==(const Rectangle&) const = default;
};

struct Circle {
  double radius = 0.0;
  std::optional<double> radius_to{};

  bool operator==(const Circle&) const = default;
};

struct Tube {
  double radius = 0.0;     ///< outer
  double thickness = 0.0;  ///< in (0, radius]
  std::optional<double> radius_to{}, thickness_to{};

  bool operator==(const Tube&) const = default;
};

/// A section of which only the properties are known.
struct General {
  double A = 0.0;
  double I = 0.0;
  std::optional<double> shear_area{};
  std::optional<double> height{};

  bool operator==(const General&) const = default;
};

/// The same at places along a member, linear between them.
struct SectionTable {
  std::vector<double> at{};                    ///< fractions of the member's length, ascending from 0 to 1
  std::vector<double> A{};                     ///< as many
  std::vector<double> I{};                     ///< as many
  std::vector<double> shear_area{}, height{};  ///< as many, or none

  bool operator==(const SectionTable&) const = default;
};

struct Section {
  std::string name{};
  Position position{};
  std::variant<Rectangle, Circle, Tube, General, SectionTable> shape{};
  std::optional<double> shear_correction{};  ///< factor on the shear stiffness; empty: the theory's own

  bool operator==(const Section&) const = default;
};

struct SectionProperties {
  double A = 0.0;                      ///< [length²]
  double I = 0.0;                      ///< second moment of area about y [length⁴]
  std::optional<double> height{};      ///< between the faces z = ±h/2; empty: the section has no faces [length]
  std::optional<double> shear_area{};  ///< empty: A times a correction [length²]
};

/// At a fraction of a member's length, which matters to sections that taper.
SectionProperties properties(const Section& section, double fraction);

/// Whether a section varies along a member, and whether its height does.
bool tapers(const Section& section);
bool height_tapers(const Section& section);

/// Whether its height is known.
bool has_faces(const Section& section);

struct Point {
  std::string name{};
  Position position{};
  Vector at{};

  bool operator==(const Point&) const = default;
};

/// The axis is the chord.
struct Straight {
  bool operator==(const Straight&) const = default;
};

/// The circular arc through a third point, which is off the chord.
struct Arc {
  Vector via{};

  bool operator==(const Arc&) const = default;
};

/// z = chord + rise sin(waves π s/length).
struct SineAxis {
  double rise = 0.0;
  int waves = 1;  ///< half waves, ≥ 1

  bool operator==(const SineAxis&) const = default;
};

/// Interpolating cubic spline over the cumulative chord length; the first and the last point are the member's ends.
struct Curve {
  std::vector<double> x{};
  std::vector<double> z{};  ///< as many as x, at least 2

  bool operator==(const Curve&) const = default;
};

/// Stress-free deviation amplitude·sin(waves π s/length), positive 90° anticlockwise from the direction of travel.
struct Imperfection {
  Position position{};
  double amplitude = 0.0;
  int waves = 1;  ///< half waves, ≥ 1

  bool operator==(const Imperfection&) const = default;
};

/// Equally long elements between two points.
struct Member {
  std::string name{};
  Position position{};
  std::string from{};  ///< a point, another one than `to` and elsewhere
  std::string to{};
  Theory theory = Theory::euler_bernoulli;
  std::string material{};
  std::string section{};
  int elements = 1;
  std::optional<int> order{};                  ///< essenburg and exact: 1 or 2; elastica: 4 or 6; otherwise empty
  QuadraticTerm along = QuadraticTerm::fixed;  ///< essenburg only
  TrussStrain strain = TrussStrain::green;     ///< truss only
  std::variant<Straight, Arc, SineAxis, Curve> axis{};
  std::vector<Imperfection> imperfections{};  ///< they add
  bool hinge_from = false;                    ///< this end transmits no moment
  bool hinge_to = false;

  bool operator==(const Member&) const = default;
};

struct Support {
  std::string point{};
  Position position{};
  std::vector<Dof> directions{};  ///< at least one, each once
  std::optional<Dof> symmetry{};  ///< the direction across a plane of symmetry that it stands for

  bool operator==(const Support&) const = default;
};

/// A node of the structure: a point, or a fraction of a member.
struct Place {
  std::string name{};                ///< of the point or the member
  std::optional<double> fraction{};  ///< of the member's arc length, within 1e-9 of a node; empty: a point
  Position position{};

  bool operator==(const Place&) const = default;
};

/// `P` or `column:0.5`, as in a deck.
std::string to_text(const Place& place);

/// From where a prescribed movement counts: the stress-free place, or the place where the point is when the first stage
/// that drives the movement begins.
enum class MovedFrom { rest, stage };

/// A support that moves a point: the directions that are named are held.
struct Prescribed {
  Position position{};
  std::string point{};
  std::optional<double> x{}, z{};    ///< displacement [length]; at least one of these
  std::optional<double> rotation{};  ///< [rad]
  bool constant = false;             ///< not multiplied by λ
  MovedFrom from = MovedFrom::rest;
  bool holds = true;  ///< false in the deck of a stage before the one that takes hold of the point

  bool operator==(const Prescribed&) const = default;
};

struct PointLoad {
  Place at{};
  Vector force{};
  double moment = 0.0;  ///< positive anticlockwise [force·length]

  /// A force or a moment acts here in some stage: the member has a node for it in all. No keys of a deck.
  bool has_force = false, has_moment = false;

  bool operator==(const PointLoad&) const = default;
};

struct MemberLoad {
  std::string member{};
  Vector distributed{};  ///< dead [force/length of the undeformed axis]
  LoadFrame frame = LoadFrame::global;
  LoadMeasure per = LoadMeasure::axis;
  std::optional<Vector> distributed_to{};  ///< at the end of the member, linear between; empty: uniform

  /// As elements take it, on a member of a length.
  LineLoad along(double length) const;

  bool operator==(const MemberLoad&) const = default;
};

/// A pressure that follows the deformed axis of a member that is no truss.
struct Pressure {
  std::string member{};
  double pressure = 0.0;  ///< to the right of the direction of travel [force/length of the deformed axis]

  bool operator==(const Pressure&) const = default;
};

/// A change of temperature of a member that can expand.
struct Heat {
  std::string member{};
  double temperature = 0.0;  ///< [degree]
  double gradient = 0.0;     ///< hotter to the left of the direction of travel; 0 of a truss [degree/length]

  bool operator==(const Heat&) const = default;
};

struct Load {
  Position position{};
  std::variant<PointLoad, MemberLoad, Heat, Pressure> action{};
  bool constant = false;  ///< not multiplied by λ

  bool operator==(const Load&) const = default;
};

/// Of a spring, in each direction; at least one is not 0.
struct Stiffness {
  double x = 0.0, z = 0.0;  ///< ≥ 0 [force/length]
  double rotation = 0.0;    ///< ≥ 0 [force·length]

  bool operator==(const Stiffness&) const = default;
};

/// The force of a spring in one direction by its displacement: C¹ or by straight pieces through these points, constant
/// beyond them.
struct TableLaw {
  using Interpolation = SpringLaw::Interpolation;
  Dof direction = Dof::z;                        ///< x, z or rotation
  std::vector<double> displacement{};            ///< strictly increasing, at least 2, with 0
  std::vector<double> force{};                   ///< as many, 0 at 0
  std::optional<Interpolation> interpolation{};  ///< empty: smooth, which was not asked for

  SpringLaw law() const { return {displacement, force, interpolation.value_or(Interpolation::smooth)}; }

  bool operator==(const TableLaw&) const = default;
};

/// A spring between a place and the ground.
struct GroundSpring {
  Place at{};
  Stiffness stiffness{};
  std::optional<TableLaw> law{};  ///< instead of a stiffness

  bool operator==(const GroundSpring&) const = default;
};

/// A spring on the differences of two points' displacements and rotations.
struct PointToPointSpring {
  std::vector<std::string> points{};  ///< two
  Stiffness stiffness{};
  std::optional<TableLaw> law{};  ///< instead of a stiffness

  bool operator==(const PointToPointSpring&) const = default;
};

/// Springs to the ground all along a member.
struct Foundation {
  std::string member{};
  double x = 0.0, z = 0.0;        ///< ≥ 0, at least one is not 0 [force/length²]
  std::optional<TableLaw> law{};  ///< instead of these, in x or in z; forces by length

  bool operator==(const Foundation&) const = default;
};

/// Stress-free with the structure.
struct Spring {
  std::string name{};  ///< empty: none, and no monitor shows it
  Position position{};
  std::variant<GroundSpring, PointToPointSpring, Foundation> kind{};

  bool operator==(const Spring&) const = default;
};

/// What is measured, or controlled, at a place.
enum class Component {
  x,
  z,
  rotation,
  face_above_z,
  face_below_z,
  reaction_x,
  reaction_z,
  reaction_moment,
  axial_force,
  moment,
  force_x,
  force_z,
  friction_force,
  friction_use,
  dissipation,
  slip,
  gap,
  contact_start,
  contact_end,
  max_moment,
  max_stress,
  utilisation,
  greatest_pressure,
  thickness,
  thickness2,
  least_pressure,
  mean_pressure
};

/// Whether it is the greatest or least that sections along members carry, whose place may jump.
constexpr bool is_extreme(Component component) {
  return component == Component::max_moment || component == Component::max_stress ||
         component == Component::utilisation || component == Component::greatest_pressure ||
         component == Component::least_pressure;
}

/// Whether it is of the friction of a wall.
constexpr bool is_of_friction(Component component) {
  return component == Component::friction_force || component == Component::friction_use ||
         component == Component::dissipation || component == Component::slip;
}

/// Whether it is of the pressure of a foundation.
constexpr bool is_pressure(Component component) {
  return component == Component::greatest_pressure || component == Component::least_pressure ||
         component == Component::mean_pressure;
}

/// Whether it is the place of an edge of contact.
constexpr bool is_contact_edge(Component component) {
  return component == Component::contact_start || component == Component::contact_end;
}

/// Whether it is a stress in the outer fibres, or a part of what is allowed of one.
constexpr bool is_stress(Component component) {
  return component == Component::max_stress || component == Component::utilisation;
}

/// What a monitor is of.
enum class Monitored {
  place,
  wall,       ///< the resultant of its contact forces on the structure, or on a member
  gap,        ///< between a place and a wall, or the contact force there
  member,     ///< the greatest of what its sections carry
  structure,  ///< the same of all members
  spring
};

/// Of a place of the structure, of a wall, of both, of a member, of a spring, or of the whole structure.
struct Monitor {
  std::string name{};
  Position position{};
  Place at{};
  std::string wall{}, member{}, spring{};  ///< empty: of none
  Component component = Component::z;
  int sign = 1;  ///< 1 or -1, multiplies the column

  Monitored of() const {
    if (!spring.empty()) return Monitored::spring;
    if (!member.empty()) return wall.empty() ? Monitored::member : Monitored::wall;
    if (wall.empty()) return at.name.empty() ? Monitored::structure : Monitored::place;
    return at.name.empty() ? Monitored::wall : Monitored::gap;
  }

  bool operator==(const Monitor&) const = default;
};

enum class PathMethod { load, displacement, riks, normal_plane, cylindrical, spherical, pseudo_arclength, incremental };

/// Values at which there is a point of the path.
struct OutputValues {
  std::string name{};  ///< `lambda` or a monitor
  Position position{};
  std::vector<double> values{};  ///< at least one

  bool operator==(const OutputValues&) const = default;
};

/// Bounds that end a branch.
struct StopBounds {
  std::string name{};  ///< `lambda` or a monitor
  Position position{};
  double low = 0.0;
  double high = 0.0;  ///< > low

  bool operator==(const StopBounds&) const = default;
};

struct Stop {
  std::vector<StopBounds> bounds{};
  std::optional<int> contacts{};    ///< as many closed contacts end the branch
  std::vector<EventKind> events{};  ///< the first of any of these does

  bool operator==(const Stop&) const = default;
};

/// The displacement that displacement control prescribes.
struct Control {
  Place at{};
  Component component = Component::z;  ///< x, z or rotation

  bool operator==(const Control&) const = default;
};

/// Whether the deck has a key whose default stands in its place; like a position no part of the deck's value.
struct Given {
  bool in_deck = false;

  friend bool operator==(const Given&, const Given&) { return true; }
};

struct Path {
  Position position{};
  PathMethod method = PathMethod::spherical;
  std::vector<OutputValues> output_at{};
  std::optional<Control> control{};  ///< there for displacement control
  double step = 0.02;                ///< of λ, for the first predictor; its sign is the direction; not 0
  double min_step = 1e-8;            ///< [path metric]
  double max_step = 0.2;             ///< ≥ min_step [path metric]
  int max_points = 5000;
  Given max_points_given{};
  BranchPolicy branches = BranchPolicy::most_stable;
  int depth = 2;
  std::vector<std::string> watch{};          ///< monitors whose turning points are events
  std::vector<std::string> watch_zero{};     ///< columns whose zeros are
  std::vector<OutputValues> watch_values{};  ///< and values of columns that are when they are passed
  EventSearch events = EventSearch::locate;
  ContinuumChoice equilibrium_family = ContinuumChoice::symmetric;
  bool jumps = true;  ///< the states to which the structure jumps after losses of stability are looked for
  Given jumps_given{};
  std::vector<std::string> sensitivity{};  ///< keys of numbers, as in `--set`, by which events have derivatives
  bool search = false;                     ///< equilibria are looked for that no traced branch passes
  std::vector<double> search_at{};         ///< values of λ; empty: five, chosen by the events
  int search_guesses = 50;                 ///< at each of them
  int search_seed = 1;
  Stop stop{};
  std::vector<double> visit{};  ///< values of λ to which it goes one after the other; of a deck without stages

  bool operator==(const Path&) const = default;
};

/// An event that is followed while a number of the deck varies, or what combination of numbers makes worst.
struct EventToFollow {
  Position position{};
  EventKind event = EventKind::limit_point;
  int number = 1;                    ///< among the events of its kind, from 1
  std::string parameter{};           ///< key of the number, as in `--set`; empty: `worst` is asked for
  std::vector<double> range{};       ///< its least and greatest value, in this order
  std::optional<double> step{};      ///< of the number, for the first predictor
  int max_points = 500;              ///< on each side of the deck's own value
  std::vector<double> output_at{};   ///< values of the number at which there is a point
  std::vector<std::string> worst{};  ///< keys of the numbers that are combined
  std::optional<double> radius{};    ///< the norm of their change

  bool operator==(const EventToFollow&) const = default;
};

/// A part of the run in which λ drives some things, from where the stage before has left all. λ begins at 0 again,
/// or goes on.
struct Stage {
  std::string name{};
  Position position{};
  std::vector<std::string> drives{};  ///< of driven_things(), at least one
  // In place of those of [path]:
  std::optional<Stop> stop{};
  std::vector<OutputValues> output_at{};
  std::optional<double> step{}, max_step{};
  std::optional<BranchPolicy> branches{};
  std::vector<double> visit{};  ///< in place of `stop`: values of λ to which it goes one after the other
  bool goes_on = false;         ///< no key: λ begins where the stage before has ended, see with_visits_as_stages()

  bool operator==(const Stage&) const = default;
};

struct Deck {
  Source source{};
  Frame frame{};  ///< in which all coordinates and lengths are but those of monitors; the user's own unless in_frame()
  std::string title{};
  std::string description{};
  Units units{};
  std::vector<Variable> variables{};
  std::vector<Material> materials{};
  std::vector<Section> sections{};
  std::vector<Point> points{};
  std::vector<Member> members{};  ///< at least one
  std::vector<Support> supports{};
  std::vector<Prescribed> prescribed{};
  std::vector<Load> loads{};  ///< of these and what is prescribed at least one is neither constant nor zero
  std::vector<Spring> springs{};
  std::vector<Wall> walls{};
  std::vector<FrictionPair> frictions{};  ///< the last that fits counts
  Contact contact{};
  Path path{};
  std::vector<Stage> stages{};  ///< empty: one that drives all that is not constant
  std::vector<Monitor> monitors{};
  std::optional<EventToFollow> curve{};
  Formulas formulas{};

  bool operator==(const Deck&) const = default;
};

/// The element of a list with that name, or null.
template <class Named>
const Named* find(const std::vector<Named>& list, const std::string& name) {
  for (const Named& element : list) {
    if (element.name == name) return &element;
  }
  return nullptr;
}

/// Names of all that λ may drive, by kind and number or name: `load.0`, `prescribed.1`, `wall.hill`.
std::vector<std::string> driven_things(const Deck& deck);

/// The name there of a load or of a movement that is prescribed, by its place in the deck's list of these.
std::string driven_thing(const std::string& kind, std::size_t which);

bool drives(const Stage& stage, const std::string& thing);

/// Returns the deck with a stage in place of each value of `visit`, that ends there: NAME-1, NAME-2, …, of a deck
/// without stages visit-1, visit-2, …
Deck with_visits_as_stages(Deck deck);

/// Returns the stage, counted from 0, in which a movement takes hold of its point: the first that drives it. Empty of a
/// movement from rest, and of one that no stage drives.
std::optional<std::size_t> gripping_stage(const Deck& deck, std::size_t prescribed);

/// Whether a spring, or a foundation, resists displacements or rotations of this kind.
bool acts_in(const Spring& spring, Dof direction);

/// Whether a wall stands in the way of a member.
bool concerns(const Wall& wall, const std::string& member);

/// Whether a member lies around a wall, as a ring around its shaft: a circle which it stays outside of, and the member
/// an arc about the same centre, to within the wall's interference. In a deck without friction such a wall grows into
/// place.
bool is_enclosed(const Deck& deck, const Wall& wall);

/// Where contact is looked for, and in words why: the deck says so, or it is the default.
struct PointsOfContact {
  ContactPoints points = ContactPoints::nodes;
  std::string why{};
};
PointsOfContact points_of_contact(const Deck& deck);

/// The coefficient of friction of a wall on a member, at a fraction of its length: its ends are points, which pairs may
/// name.
double friction_of(const Deck& deck, const Wall& wall, const std::string& member, double fraction);

/// Whether a wall has friction on a member.
bool has_friction(const Deck& deck);

/// Why contact points do not move along members whose sections taper; empty if they may.
std::string why_tapers_hold_contact(const Deck& deck);

/// The line of two straight walls on both sides of an axis that leave nothing between them but round-off of the size of
/// the structure; empty for other walls.
std::optional<LineProfile> line_without_clearance(const Deck& deck, const Wall& a, const Wall& b);

/// The same for all pairs of a deck's walls, each without a look at all others. The deck must outlive it.
class WallsWithoutClearance {
 public:
  explicit WallsWithoutClearance(const Deck& deck);

  /// Indices of the walls that leave no clearance beside this one, in their order.
  std::vector<std::size_t> beside(std::size_t wall) const;

 private:
  struct Line {
    double z = 0.0, slope = 0.0;
    std::size_t wall = 0;
  };
  static bool is_lower(const Line& a, const Line& b) { return a.z < b.z; }

  const Deck& deck_;
  double reach_;
  std::vector<Line> below_{}, above_{};  // walls of a side that axes touch, by their heights
};

/// Whether nothing but the default of max_points ends the path.
bool is_unbounded(const Path& path);

/// The same deck with nothing asked about its paths: no sensitivities, no jumps, no curve. For models beside a run.
Deck without_answers(Deck deck);

/// How messages name a `--set key=value`: on one line, cut where it gets long.
std::string origin_of(const std::string& assignment);

/// A diagnostic about the part of the deck that stands there, for the stages after reading.
Diagnostic diagnostic_at(const Source& source, const Position& position, std::string key, std::string message,
                         std::string cure = {});

}  // namespace arcwall::deck
