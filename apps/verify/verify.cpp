#include "apps/verify/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/output/text_table.hpp"
#include "apps/verify/compliant_walls.hpp"
#include "apps/verify/counts.hpp"
#include "apps/verify/energy_balance.hpp"
#include "apps/verify/passages.hpp"
#include "apps/verify/point_checks.hpp"
#include "apps/verify/rates.hpp"
#include "apps/verify/shown_values.hpp"
#include "apps/verify/stored_files.hpp"

namespace arcwall::verify {

namespace {

Scales scales_of(const Model& model) {
  return {.length = model.structure().length_scale(),
          .force = model.contact() != nullptr ? model.contact()->scales().force : model.structure().force_scale()};
}

bool is_reaction(deck::Component component) {
  return component == deck::Component::reaction_x || component == deck::Component::reaction_z ||
         component == deck::Component::reaction_moment;
}

// Of forces, moments or pressures of nodes.
double roundoff_of_force(const Model& model, const std::string& monitor, deck::Component component) {
  const double force = 10.0 * model.structure().force_roundoff(), length = model.structure().length_scale();
  if (component == deck::Component::max_moment) return force * length;
  if (is_pressure(component)) return force / length;
  if (is_stress(component)) {
    double most = 0.0;
    for (const OuterFibres& fibres : outer_fibres(model.deck(), *deck::find(model.deck().monitors, monitor)))
      for (const double fraction : {0.0, 0.5, 1.0})
        most = std::max(most, fibres.exertion(force, force * length, fraction));
    return most;
  }
  return force;
}

// Monitors are differences of places, or sums of nodal forces: their round-off is that of these. Reactions of a run in
// increments are of stresses that no state tells.
double roundoff_of(const MonitorColumn& column, const Model& model) {
  // Where a quantity turns, its place is as sure as the root of its round-off; formulas of walls differ in the order of
  // their operations.
  constexpr double turn = 1e-7;
  if (column.is_place) return turn;
  if (is_reaction(column.component) || is_extreme(column.component))
    return roundoff_of_force(model, column.name, column.component);
  constexpr double place = 1e-14, gap = 1e-12;
  return (column.component == deck::Component::gap ? gap : place) * model.structure().length_scale();
}

void add_monitors(const PointAtHand& at, PathExpectation& expected, Findings& findings) {
  const Model& model = at.model;
  for (const MonitorColumn& column : model.monitors()) {
    expected.names.push_back(column.name);
    if (is_reaction(column.component) && model.in_increments()) {
      expected.monitors.push_back(0.0);
      expected.allowed.push_back(infinity);
      continue;
    }
    double value = column.quantity->value(at.point.state);
    if (const deck::Monitor* monitor = deck::find(model.deck().monitors, column.name)) {
      if (column.component == deck::Component::dissipation)
        for (std::size_t wall = 0; wall < at.point.dissipation.size(); ++wall)
          if (monitor->wall.empty() || monitor->wall == model.deck().walls[wall].name)
            value += monitor->sign * at.point.dissipation[wall];
      if (const auto own = own_value(at, *monitor)) value = monitor->sign * column.factor * *own;
      if (is_extreme(column.component) || column.component == deck::Component::mean_pressure)
        check_greatest(at, *monitor, std::abs(value) / column.factor,
                       roundoff_of_force(model, column.name, column.component), findings);
    }
    expected.monitors.push_back(value);
    expected.allowed.push_back(
        std::isfinite(value) ? 1e-12 * std::abs(value) + column.factor * roundoff_of(column, model) : 0.0);
  }
}

// Where the stiffness is singular, as where a branch leaves another, or at a change of contact beside a neutral span,
// eigenvalues are as near to zero as the place is sure. A contact that slides moves its mesh, which this second
// variation does not know of: it turns up to 1e-2 of arc length from where the other does, on coarse meshes, where the
// eigenvalue is a hundredth of the next.
ZeroEigenvalue zero_eigenvalue(const Model& model, const Record& record, const RecordPoint& point) {
  constexpr double near = 1e-2;
  constexpr ZeroEigenvalue regular{.least = 1e-11}, singular_zero{.least = 1e-6, .of_next = 1e-2, .of_parts = 1e-4};
  const bool slides = model.sliding() != nullptr && point.contacts > 0;
  const auto is_here = [&](double arc, Index step) {
    return slides ? std::abs(arc - point.arc) <= near : step == point.step;
  };
  const RecordBranch& branch = record.branches.at(static_cast<std::size_t>(point.branch));
  if (branch.origin && !branch.after_jump && is_here(0.0, 0)) return singular_zero;
  const auto singular = [&](const RecordEvent& event) {
    if (event.branch != point.branch || !is_here(event.arc, event.step)) return false;
    if (event.step == point.step && point.count.stability == Stability::undecided) return true;
    return event.kind == EventKind::limit_point || event.kind == EventKind::branch_point ||
           (event.branch_end && event.branch_end->reason == EndReason::equilibrium_family);
  };
  return std::any_of(record.events.begin(), record.events.end(), singular) ? singular_zero : regular;
}

Index listed_contacts(const Touches& touches) {
  return std::count_if(touches.all.begin(), touches.all.end(),
                       [](const Touch& touch) { return touch.closed && touch.listed; });
}

Index slipping_contacts(const Touches& touches) {
  const auto& compliant = touches.of_compliant_walls;
  return std::count_if(touches.all.begin(), touches.all.end(),
                       [](const Touch& touch) { return touch.friction && touch.friction->slips; }) +
         std::count_if(compliant.begin(), compliant.end(),
                       [](const ContactPoint& contact) { return contact.friction && slips(contact.friction->mode); });
}

// `uncounted`: points whose unstable directions were not counted.
std::vector<std::string> left_out(const Model& model, Index uncounted, bool moves_supports) {
  std::vector<std::string> sentences;
  if (model.in_increments())
    sentences.emplace_back(
        "equilibrium, gaps, contact forces, energies, reactions and unstable directions: load increments do not "
        "satisfy equilibrium");
  else if (uncounted > 0)
    sentences.push_back(
        fmt::format("unstable directions at {} points: more than {} unknowns are too many for dense eigenvalues, which "
                    "are needed beside singular points",
                    uncounted, most_of_dense));
  if (model.contact() != nullptr && model.sliding() == nullptr)
    sentences.emplace_back("penetration between nodes: node contact does not exclude it");
  if (model.sliding() != nullptr)
    sentences.emplace_back(
        "stability counts near zone ends, and where elements turn by more than 0.3 rad: checked only as an interval, "
        "between contact rotations fixed and free");
  if (model.compliant() != nullptr)
    sentences.emplace_back(
        "energy and stiffness of compliant walls: those of the program, whose edges of contact lie inside elements; "
        "their forces are compared with laws and distances by a rule of 64 parts");
  if (model.compliant() != nullptr && deck::has_friction(model.deck()))
    sentences.emplace_back(
        "rates of watched monitors on compliant walls with friction: places begin to slip within any difference");
  if (deck::has_friction(model.deck()))
    sentences.emplace_back(
        "stability counts and the choice among several solutions at contacts with friction: no energy determines them");
  sentences.emplace_back(
      "arc lengths, iterations, residuals, critical modes and types of bifurcations: single states do not determine "
      "them");
  if (moves_supports)
    sentences.emplace_back(
        "unstable_load_control with moving contact points, with contact at supported nodes, and if λ moves more than "
        "supports");
  if (!model.in_increments())
    sentences.emplace_back(
        "pairs of events that cancel between two points of the path: --again traces the path with smaller steps");
  return sentences;
}

// Friction opposes slip: what slips at two points that follow each other has slipped against its friction force. Where
// contact moves along a body whose stretch rises or falls on the way, the length that it has passed is known between
// two bounds. check_energy_balance() looks at the material points on compliant walls.
void check_slips(const Model& model, const RecordPoint& before, const RecordPoint& after, Findings& findings) {
  const FrictionalContact* const contacts = model.friction();
  const ActiveSet& active_set = after.state.active_set;
  if (contacts == nullptr || before.state.active_set != active_set) return;
  for (const Index j : contacts->slipping(active_set)) {
    const ContactPlace from = contacts->place(before.state, j), to = contacts->place(after.state, j);
    double way = to.w - from.w, unsure = 0.0;
    if (contacts->rolls(active_set, j)) {
      way -= 0.5 * (from.stretch + to.stretch) * (to.s - from.s);
      unsure = 0.5 * std::abs((to.stretch - from.stretch) * (to.s - from.s));
    }
    const ContactLabel label = model.contacts()->contact(after.state, j).label;
    findings.compare("friction opposes slip", -slip_sense(contacts->mode(active_set, j)) * way,
                     1e-9 * model.structure().length_scale() + unsure, label.wall + " at " + label.member);
  }
}

class Verifier {
 public:
  Verifier(const Model& model, const Record& record, const StoredFiles& files, const std::string& states_file)
      : model_(model),
        record_(record),
        states_file_(states_file),
        scales_(scales_of(model)),
        path_rows_(csv_rows(files.path_csv)),
        contact_rows_(csv_rows(files.contacts_csv)) {
    for (Index stage = 0; stage <= static_cast<Index>(model.ended_stages().size()); ++stage) {
      walls_.push_back(walls_of(model.at_stage(stage).deck()));
      members_.emplace_back(model.at_stage(stage));
    }
  }

  Verdict run(const StoredFiles& files) {
    Findings& findings = verdict_.findings;
    findings.at("path.csv", 0, 0);
    findings.require("path.csv has one row per point", path_rows_.size() == record_.points.size(),
                     fmt::format("{} rows, {} points", path_rows_.size(), record_.points.size()));
    for (std::size_t i = 0; i < record_.points.size(); ++i)
      if (!check_point(i)) return verdict_;  // nothing else can be told
    for (const RecordBranch& branch : record_.branches) {
      if (!record_.has_friction) break;
      findings.at(states_file_, branch.id, branch.points - 1);
      check_energy_balance(model_.at_stage(record_.stage_number(branch.id)), record_, branch.id, findings);
    }
    findings.at("contacts.csv", 0, 0);
    findings.require("contacts.csv has one row per closed contact", next_contact_ == contact_rows_.size(),
                     fmt::format("{} rows, {} closed contacts", contact_rows_.size(), next_contact_));
    const std::vector<ListedEvent> events = check_events(files.events_json, record_, model_, walls_, findings);
    if (!model_.in_increments()) check_completeness(events, record_, model_, findings);
    verdict_.not_checked = left_out(model_, uncounted_, record_.moves_supports);
    return verdict_;
  }

 private:
  // Whether a point has the contacts of before a change that makes a stretch.
  bool waits_for_stretch(std::size_t number) const {
    if (model_.sliding() == nullptr) return false;
    const auto makes_stretch = [&](Index step) {
      return std::any_of(record_.events.begin(), record_.events.end(), [&](const RecordEvent& event) {
        return event.branch == record_.points[number].branch && event.step == step &&
               (event.kind == EventKind::contact_spreads || event.kind == EventKind::contact_splits ||
                event.kind == EventKind::contact_opens);
      });
    };
    return change_before(record_.points, number, makes_stretch) != number;
  }

  bool check_point(std::size_t number) {
    const RecordPoint& point = record_.points[number];
    Findings& findings = verdict_.findings;
    findings.at(states_file_, point.branch, point.step);
    const auto stage = static_cast<std::size_t>(record_.stage_number(point.branch));
    const Model& model = model_.at_stage(static_cast<Index>(stage));
    const bool well_formed = is_well_formed(model, point.state);
    findings.require("states are finite and complete", well_formed, "its unknowns");
    if (!well_formed) return false;
    const PointAtHand at = at_hand(model, members_[stage], point, walls_[stage], scales_);
    PathExpectation expected{.contacts = listed_contacts(at.touches), .moves_supports = record_.moves_supports};
    if (model.compliant() != nullptr) expected.contacts = model.closed_contacts(point.state);
    if (record_.has_friction) expected.slipping = slipping_contacts(at.touches);
    add_monitors(at, expected, findings);
    if (!record_.stages.empty()) expected.stage = record_.stage_of(point.branch);
    if (!model_.in_increments()) {
      check_contacts(at, findings, waits_for_stretch(number));
      check_compliant_walls(model, at.walls, point.state, findings);
      check_equilibrium(at, findings);
      check_point_loads(at, findings);
      expected.energy = energy(at);
      expected.energy->value *= model.frame().factor();
      expected.energy->magnitude *= model.frame().factor();
      expected.energy->rounded *= model.frame().factor();
      const ZeroEigenvalue zero = zero_eigenvalue(model, record_, point);
      expected.unstable = unstable_range(at, zero);
      if (!expected.unstable) ++uncounted_;
      if (record_.moves_supports && point.unstable_load_control)
        expected.unstable_load_control = unstable_load_control_range(at, zero);
      if (number > 0 && record_.points[number - 1].branch == point.branch)
        check_passages(model, walls_[stage], record_.points[number - 1], point, findings);
      check_rates(model.watched(), record_.points, number, findings);
      if (number > 0 && record_.points[number - 1].branch == point.branch)
        check_slips(model, record_.points[number - 1], point, findings);
    }
    if (number < path_rows_.size()) {
      findings.at("path.csv", point.branch, point.step);
      check_path_row(path_rows_[number], point, expected, findings);
    }
    findings.at("contacts.csv", point.branch, point.step);
    check_contact_rows(contact_rows_, next_contact_, point, at.touches, model, findings);
    return true;
  }

  const Model& model_;
  const Record& record_;
  std::string states_file_;
  Scales scales_;
  WallsOfStages walls_;
  std::vector<PlainMembers> members_;  // of each stage
  std::vector<std::vector<std::string>> path_rows_, contact_rows_;
  std::size_t next_contact_ = 0;
  Index uncounted_ = 0;
  Verdict verdict_;
};

}  // namespace

Verdict verify(const Model& model, const Record& record, const StoredFiles& files, const std::string& states_file) {
  return Verifier(model, record, files, states_file).run(files);
}

std::string to_text(const Verdict& verdict) {
  using Side = TableColumn::Side;
  std::vector<std::vector<std::string>> rows;
  for (const CheckSummary& check : verdict.findings.checks())
    rows.push_back({check.name, std::to_string(check.count), fmt::format("{:.3g}", std::max(check.value, 0.0)),
                    fmt::format("{:.3g}", check.bound), check.branch < 0 ? "" : std::to_string(check.branch),
                    std::to_string(check.step)});
  std::string text = text_table({{"check", Side::left},
                                 {"values", Side::right},
                                 {"worst", Side::right},
                                 {"bound", Side::right},
                                 {"branch", Side::right},
                                 {"step", Side::right}},
                                rows);
  text += fmt::format("\nAll {} checks passed.\n\nnot checked:\n", verdict.findings.checks().size());
  for (const std::string& sentence : verdict.not_checked) text += "- " + sentence + "\n";
  return text;
}

std::string to_text(const Failure& failure) {
  const std::string where = failure.branch < 0 ? fmt::format("point {}", failure.step)
                                               : fmt::format("branch {}, step {}", failure.branch, failure.step);
  std::string text = fmt::format("{}: {}: {}", failure.file, where, failure.what);
  if (failure.value) text += fmt::format(": {:.6g} exceeds {:.6g}", *failure.value, *failure.bound);
  return text;
}

}  // namespace arcwall::verify
