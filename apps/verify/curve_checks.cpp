#include "apps/verify/curve_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "answers/sessions.hpp"
#include "apps/output/curve_files.hpp"
#include "apps/verify/compliant_walls.hpp"
#include "apps/verify/copies.hpp"
#include "apps/verify/counts.hpp"
#include "apps/verify/point_checks.hpp"
#include "apps/verify/stored_files.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "model/deck/reader.hpp"
#include "model/event_names.hpp"

namespace arcwall::verify {

namespace {

const char* const csv_check = "curve.csv matches the states";

// Eigenvalues of a stiffness whose diagonal is one that are zero at an event.
constexpr ZeroEigenvalue singular_zero{.least = 1e-6, .of_parts = 1e-4};

std::vector<std::string> assignments_at(const RunDescription& of, const std::string& key, double value) {
  std::vector<std::string> assignments = of.assignments;
  assignments.push_back(key + "=" + round_trip(value));
  return assignments;
}

class CurveVerifier {
 public:
  CurveVerifier(const CurveSession& session, const StoredCurve& files)
      : description_(session.description()),
        frame_(
            deck::frame_of(deck::read_deck_text(description_.deck_text, description_.deck, description_.assignments))),
        curve_(session.tracing().curve()),
        rows_(csv_rows(files.curve_csv)),
        expected_rows_(csv_rows(curve_csv(curve_, description_.units))) {}

  Verdict run(const StoredCurve& files) {
    verdict_.findings.at("curve.csv", -1, 0);
    verdict_.findings.require("curve.csv has one row per point", rows_.size() == curve_.points.size(),
                              fmt::format("{} rows, {} points", rows_.size(), curve_.points.size()));
    for (std::size_t i = 0; i < curve_.points.size(); ++i) {
      check_point(i);
      check_row(i);
    }
    verdict_.findings.at("curve.json", -1, 0);
    check_json("curve.json repeats the curve", files.curve_json, curve_json(curve_, description_), {"version"},
               verdict_.findings);
    add_what_is_not_checked();
    return std::move(verdict_);
  }

 private:
  // The deck is read anew, with the value that the point has.
  void check_point(std::size_t i) {
    const CurvePoint& point = curve_.points[i];
    Findings& findings = verdict_.findings;
    findings.at("checkpoint", -1, static_cast<Index>(i));
    std::optional<Model> model;
    std::string why = "its mesh is another one";
    try {
      model.emplace(deck::read_deck_text(description_.deck_text, description_.deck,
                                         assignments_at(description_, curve_.key, point.key)),
                    frame_);
    } catch (const InputError& error) {
      why = first_message(error);
    }
    const auto state = model ? state_on(*model, point.state) : std::nullopt;
    findings.require("there is a deck for each point", state.has_value(), why);
    if (!state) return;
    const bool well_formed = is_well_formed(*model, *state);
    findings.require("states are finite and complete", well_formed, "its unknowns");
    if (well_formed) check_state(*model, *state, point);
  }

  void check_state(const Model& model, const State& state, const CurvePoint& point) {
    Findings& findings = verdict_.findings;
    const Scales scales{
        .length = model.structure().length_scale(),
        .force = model.contact() != nullptr ? model.contact()->scales().force : model.structure().force_scale()};
    const std::vector<PlainWall> walls = walls_of(model.deck());
    const RecordPoint as_of_run{.lambda = state.lambda, .state = state};
    const PlainMembers members(model);
    const PointAtHand at = at_hand(model, members, as_of_run, walls, scales);
    check_contacts(at, findings);
    check_equilibrium(at, findings);
    check_compliant_walls(model, at.walls, state, findings);
    Index closed = std::count_if(at.touches.all.begin(), at.touches.all.end(),
                                 [](const Touch& touch) { return touch.closed && touch.listed; });
    if (model.compliant() != nullptr) closed = model.closed_contacts(state);
    findings.require("curve.csv matches the states", closed == point.contacts, "contacts");
    findings.compare("curve.csv matches the states", std::abs(point.lambda - state.lambda), 0.0, "lambda");
    for (std::size_t k = 0; k < curve_.columns.size(); ++k) {
      const double value = model.monitors()[k].quantity->value(state);
      findings.compare("curve.csv matches the states", std::abs(point.monitors[k] - value),
                       1e-12 * std::abs(value) + model.monitors()[k].factor * 1e-14 * (scales.length + scales.force),
                       "monitor " + curve_.columns[k].name);
    }
    check_event(at, point);
  }

  void check_event(const PointAtHand& at, const CurvePoint& point) {
    const bool critical = curve_.event == EventKind::limit_point || curve_.event == EventKind::branch_point;
    const bool slides = at.model.sliding() != nullptr && point.contacts > 0;
    if (curve_.event == EventKind::contact_closes) check_touch(at);
    const auto counted = critical ? unstable_range(at, singular_zero) : std::nullopt;
    if (!counted) return;
    const CountRange range = *counted;
    Findings& findings = verdict_.findings;
    if (!slides) findings.require("the stiffness is singular", range.most > range.least, "no eigenvalue is zero");
    if (!point.unstable_before || !point.unstable_after) return;
    const auto [low, high] = std::minmax(*point.unstable_before, *point.unstable_after);
    findings.require("unstable directions", low <= range.most && high >= range.least,
                     fmt::format("{} and {} on both sides of the event, eigenvalues give {} to {}", low, high,
                                 range.least, range.most));
  }

  // One contact at least has neither a gap nor a force.
  void check_touch(const PointAtHand& at) {
    double least = infinity;
    for (const Touch& touch : at.touches.all)
      least = std::min(
          least, std::max(std::abs(touch.gap.value()) / at.scales.length, std::abs(touch.force) / at.scales.force));
    if (const CompliantContact* const contact = at.model.compliant())
      for (Index j = 0; j < contact->contact_count(); ++j)
        least = std::min(least, std::abs(contact->nearest(at.point.state, j).gap) / at.scales.length);
    verdict_.findings.compare("changing contact has zero gap or force", least, 1e-8);
  }

  // Texts of numbers are written to the last digit.
  void check_row(std::size_t i) {
    if (i >= rows_.size()) return;
    Findings& findings = verdict_.findings;
    findings.at("curve.csv", -1, static_cast<Index>(i));
    const bool same = rows_[i].size() == expected_rows_[i].size();
    findings.require("curve.csv has its columns", same, "number of cells");
    for (std::size_t k = 0; same && k < rows_[i].size(); ++k)
      findings.require(csv_check, rows_[i][k] == expected_rows_[i][k],
                       fmt::format("cell {} is \"{}\" instead of \"{}\"", k + 1, rows_[i][k], expected_rows_[i][k]));
  }

  void add_what_is_not_checked() {
    std::vector<std::string>& list = verdict_.not_checked;
    list.emplace_back("arc and slope, and kinds of special points: single states do not determine them");
    if (curve_.event != EventKind::limit_point && curve_.event != EventKind::branch_point &&
        curve_.event != EventKind::contact_closes)
      list.emplace_back("that the path has the event there: --again traces the path at some points");
    else if (curve_.event != EventKind::contact_closes)
      list.emplace_back(
          "that the stiffness is singular to round-off, with moving contact points: --again traces the path at some "
          "points");
  }

  const RunDescription& description_;
  deck::Frame frame_;
  EventCurve curve_;
  std::vector<std::vector<std::string>> rows_, expected_rows_;
  Verdict verdict_{};
};

// Of the event that is nearest in λ.
std::optional<double> lambda_of_run(const RunDescription& of, const EventCurve& curve, const CurvePoint& point) {
  RunDescription run = of;
  run.traced = Traced::path;
  run.assignments = assignments_at(of, curve.key, point.key);
  for (const char* off : {"path.search=false", "path.jumps=false"}) run.assignments.emplace_back(off);
  Session session = make_session(std::move(run));
  if (!session.begin()) return std::nullopt;
  std::optional<double> nearest;
  while (session.next() != nullptr) {
  }
  for (const RecordEvent& event : session.events()) {
    if (event.kind != curve.event) continue;
    if (!nearest || std::abs(event.lambda - point.lambda) < std::abs(*nearest - point.lambda)) nearest = event.lambda;
  }
  return nearest;
}

}  // namespace

Verdict verify_curve(const CurveSession& session, const StoredCurve& files) {
  return CurveVerifier(session, files).run(files);
}

Comparison compare_with_runs(const CurveSession& session) {
  constexpr std::size_t places = 5;
  constexpr double same = 1e-8, another = 1e-4;  // of λ
  const EventCurve curve = session.tracing().curve();
  Comparison comparison{.worst_allowed = same};
  for (std::size_t i = 0; i < places && !curve.points.empty(); ++i) {
    const CurvePoint& point = curve.points[i * (curve.points.size() - 1) / (places - 1)];
    const auto lambda = lambda_of_run(session.description(), curve, point);
    const double off = lambda ? std::abs(*lambda - point.lambda) / std::max(std::abs(point.lambda), 1e-300) : infinity;
    const std::string where = fmt::format("{} at {} = {:.10g}", to_text(curve.event), curve.key, point.key);
    if (off > another) {
      comparison.reservations.push_back(where + " is not found by a run of the deck with that value");
      continue;
    }
    ++comparison.same;
    comparison.worst = std::max(comparison.worst, off);
    if (off > same)
      comparison.differences.push_back(fmt::format(
          "{} has λ = {:.10g}, and {:.10g} in a run of the deck with that value", where, point.lambda, *lambda));
  }
  return comparison;
}

}  // namespace arcwall::verify
