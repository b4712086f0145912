#include "apps/output/events_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "apps/output/jump_rows.hpp"
#include "apps/output/roundoff.hpp"
#include "apps/output/search_rows.hpp"
#include "apps/output/sensitivity_rows.hpp"
#include "apps/output/shown_number.hpp"
#include "apps/output/text_table.hpp"
#include "core/printable.hpp"
#include "model/event_names.hpp"
#include "model/version.hpp"

namespace arcwall {

namespace {

constexpr std::size_t most_contacts = 3;  // named in one row

// ` slips to the right: |T| = 0.8 p, p = 15.688`; of a contact that closes `, slips to the right`.
std::string what_it_does(const RecordContact& contact, bool closes) {
  const RecordFriction& friction = *contact.friction;
  const std::string text = closes ? ", " : " ";
  if (!slips(friction.mode)) return text + "sticks";
  const double sense = slip_sense(friction.mode), x = sense * friction.tangent_x, z = sense * friction.tangent_z;
  const bool sideways = std::abs(x) >= std::abs(z);
  const std::string to = sideways ? (x > 0.0 ? "to the right" : "to the left") : (z > 0.0 ? "up" : "down");
  if (closes) return text + "slips " + to;
  return fmt::format("{}slips {}: |T| = {:.6g} p, p = {:.5g}", text, to, friction.coefficient,
                     contact.force.value_or(0.0));
}

std::string contacts(const RecordEvent& event) {
  const std::vector<RecordContact>& list = event.contacts;
  std::string text;
  for (std::size_t i = 0; i < std::min(list.size(), most_contacts); ++i) {
    const ContactLabel& label = list[i].label;
    text += fmt::format("{}{} at {}:{:.4g}", i > 0 ? ", " : "", label.wall, label.member, label.fraction);
    if (list[i].friction) text += what_it_does(list[i], event.kind == EventKind::contact_closes);
  }
  if (list.size() > most_contacts) text += fmt::format(" and {} more", list.size() - most_contacts);
  return text;
}

std::string table(const Record& record) {
  using Side = TableColumn::Side;
  const bool one_branch = record.branches.size() <= 1;
  const bool staged = !record.stages.empty();
  std::vector<TableColumn> columns{{"id", Side::right}};
  if (staged) columns.push_back({"stage"});
  if (!one_branch) columns.push_back({"branch", Side::right});
  columns.insert(columns.end(), {{"step", Side::right}, {"λ", Side::right}, {"kind"}, {"what"}});
  for (const RecordColumn& column : record.columns)
    columns.push_back({column.unit.empty() ? column.name : column.name + " [" + column.unit + "]", Side::right});
  columns.push_back({"unstable"});

  const std::vector<double> zero = roundoff(record);
  std::vector<std::vector<std::string>> rows;
  for (const RecordEvent& event : record.events) {
    std::vector<std::string>& row = rows.emplace_back();
    row.push_back(std::to_string(event.id));
    if (staged) row.push_back(record.stage_of(event.branch));
    if (!one_branch) row.push_back(std::to_string(event.branch));
    row.push_back(std::to_string(event.step));
    row.push_back(shown_lambda(event, 10));
    row.emplace_back(to_text(event.kind));
    row.push_back(event_detail(event));
    for (std::size_t i = 0; i < event.monitors.size(); ++i)
      row.push_back(shown_number(without_roundoff(event.monitors[i], zero[i]), 6));
    row.push_back(unstable_change(event));
  }
  return text_table(columns, rows);
}

std::string ending(const RecordBranch& branch) {
  const std::string points =
      fmt::format("branch {}: {} {}", branch.id, branch.points, branch.points == 1 ? "point" : "points");
  if (!branch.end) return points + "\n";
  return fmt::format("{}, ended: {}\n", points, printable(how_it_ended(*branch.end)));
}

// The branches that leave a branch, each behind the event where it does, and those that leave them in turn.
std::string tree(const Record& record, std::optional<Index> parent, int depth) {
  std::string text;
  for (const RecordBranch& branch : record.branches) {
    if (branch.parent != parent) continue;
    text += std::string(static_cast<std::size_t>(2 * depth), ' ');
    if (branch.origin)
      text += fmt::format("{} λ = {} (event {}): ", branch.after_jump ? "after a jump at" : "at",
                          shown_lambda(record.events[static_cast<std::size_t>(*branch.origin)], 10), *branch.origin);
    if (branch.found) text += found_at(record, branch) + ": ";
    text += ending(branch);
    if (branch.mirror_image)
      text +=
          fmt::format("{}its mirror image is not traced\n", std::string(static_cast<std::size_t>(2 * depth + 2), ' '));
    text += tree(record, branch.id, depth + 1);
  }
  return text;
}

std::string search_text(const Record& record) {
  const auto rows = search_rows(record);
  if (rows.empty()) return "";
  std::string text = "\nSearch for equilibria on other branches\n\n" + text_table(search_columns(), rows);
  if (const auto found = found_rows(record); !found.empty()) text += "\n" + text_table(found_columns(record), found);
  return text + "\n" + search_note() + "\n";
}

}  // namespace

std::string event_detail(const RecordEvent& event) {
  if (event.branch_end) return std::string(to_text(event.branch_end->reason));
  if (event.branch_type)
    return std::string(to_text(*event.branch_type)) +
           (event.multiplicity > 1 ? fmt::format(", {} modes", event.multiplicity) : "") +
           (event.unconfirmed ? ", unconfirmed" : "") + (event.mesh_artefact ? ", of the node contact" : "");
  if (event.unconfirmed) return "unconfirmed";
  if (event.extremum && event.contacts.empty()) return std::string(to_text(*event.extremum));
  if (event.value) return *event.monitor + " = " + shown_number(*event.value, 6);
  if (event.monitor) return *event.monitor;
  if (event.continuum)
    return contacts(event) + fmt::format("; of {} lengths only the sum is determined", event.continuum->parts);
  return contacts(event);
}

std::string shown_lambda(const RecordEvent& event, int digits) {
  return shown_uncertain(event.lambda, event.lambda_uncertainty, digits);
}

std::string uncertainty_note(const Record& record) {
  const auto is_marked = [](const RecordEvent& event) {
    return is_marked_uncertain(event.lambda, event.lambda_uncertainty);
  };
  if (std::none_of(record.events.begin(), record.events.end(), is_marked)) return "";
  return "λ = a ± b: the event lies between a − b and a + b and could not be located more closely; smaller steps may "
         "do so.";
}

std::string count_note(const Record& record) {
  const auto is_unknown = [](const RecordEvent& event) { return !event.unstable_before || !event.unstable_after; };
  if (std::none_of(record.events.begin(), record.events.end(), is_unknown)) return "";
  return "unstable: number of negative eigenvalues of the tangent stiffness; ?: the stiffness is singular, or a "
         "contact "
         "without force decides.";
}

std::string unstable_change(const RecordEvent& event) {
  const auto text = [](const std::optional<Index>& count) { return count ? std::to_string(*count) : "?"; };
  if (event.unstable_before == event.unstable_after) return text(event.unstable_after);
  return text(event.unstable_before) + " → " + text(event.unstable_after);
}

std::string how_it_ended(const BranchEnd& end) {
  return fmt::format("{} ({})", end.detail.empty() ? explanation(end.reason) : end.detail, to_text(end.reason));
}

std::string events_text(const Record& record, const std::vector<std::string>& lambda_is) {
  std::string text = record.title.empty() ? "" : printable(record.title) + "\n";
  text += fmt::format("{}, trace-path {}\n", printable(record.deck), program_version());
  for (std::size_t i = 0; i < lambda_is.size(); ++i) {
    if (lambda_is[i].empty()) continue;
    text += "λ" + (i < record.stages.size() ? " of " + record.stages[i] : "") + ": " + lambda_is[i] + "\n";
  }
  text += "\n";
  text += table(record) + "\n";
  for (const std::string& note : {uncertainty_note(record), count_note(record)})
    if (!note.empty()) text += note + "\n\n";
  text += tree(record, std::nullopt, 0);
  if (const auto rows = sensitivity_rows(record); !rows.empty())
    text +=
        "\nSensitivities of the events: dλ/dn by a number n of the deck, the change of λ in per cent if n increases by "
        "one per cent, and the derivatives of the monitors\n\n" +
        text_table(sensitivity_columns(record), rows);
  if (const auto rows = jump_rows(record); !rows.empty())
    text += "\nJumps at constant λ: destination, energy released, and λ of the return jump when λ is reversed\n\n" +
            text_table(jump_columns(record), rows);
  return printable(text + search_text(record), LineBreaks::kept);
}

}  // namespace arcwall
