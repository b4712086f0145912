#include "apps/output/contacts_csv.hpp"

#include "core/text.hpp"
#include "model/event_names.hpp"

namespace arcwall {

namespace {

std::string header(const Record& record, UnitLabels labels) {
  const bool both = !record.force_unit.empty() && !record.length_unit.empty();
  return "branch,step,lambda,wall,member,fraction," + csv_title("x", record.length_unit, labels) + "," +
         csv_title("force", record.force_unit, labels) + "," +
         csv_title("pressure", both ? record.force_unit + "/" + record.length_unit : "", labels) +
         (record.has_friction ? "," + csv_title("friction", record.force_unit, labels) + ",state," +
                                    csv_title("slip", record.length_unit, labels) + "," +
                                    csv_title("anchor", record.length_unit, labels)
                              : "") +
         "\n";
}

std::string friction_cells(const RecordForce& contact) {
  if (!contact.friction) return ",,,,";
  const RecordFriction& friction = *contact.friction;
  return "," + round_trip(friction.force) + "," + std::string(to_text(friction.mode)) + "," +
         round_trip(friction.slip) + "," + (friction.anchor ? round_trip(*friction.anchor) : "");
}

std::string row(const Record& record, const RecordPoint& point, const RecordForce& contact) {
  return std::to_string(point.branch) + "," + std::to_string(point.step) + "," + round_trip(point.lambda) + "," +
         csv_cell(contact.label.wall) + "," + csv_cell(contact.label.member) + "," +
         round_trip(contact.label.fraction) + "," + round_trip(contact.x) + "," + round_trip(contact.force) + "," +
         (contact.pressure ? round_trip(*contact.pressure) : "") +
         (record.has_friction ? friction_cells(contact) : "") + "\n";
}

}  // namespace

std::string contacts_csv(const Record& record, UnitLabels labels) {
  std::string text = header(record, labels);
  for (const RecordPoint& point : record.points)
    for (const RecordForce& contact : point.forces) text += row(record, point, contact);
  return text;
}

}  // namespace arcwall
