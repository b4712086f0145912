#include "apps/cli/json_lines.hpp"

#include <iostream>

#include "apps/output/events_json.hpp"
#include "apps/output/exit_status.hpp"

namespace arcwall {

using OrderedJson = nlohmann::ordered_json;

namespace {

void print(const char* name, OrderedJson json) {
  std::cout << to_text(OrderedJson{{name, std::move(json)}}, JsonLayout::one_line);
}

OrderedJson ending(const RecordBranch& branch) {
  OrderedJson json{{"branch", branch.id}};
  json.update(end_json(*branch.end));
  json["status"] = static_cast<int>(exit_status(branch.end->reason));
  return json;
}

}  // namespace

JsonLines::JsonLines(const Record& record) : points_(record.points.size()), events_(record.events.size()) {
  while (branch_ < record.branches.size() && record.branches[branch_].end) ++branch_;
}

// Each point and its events, and behind a branch's last one how it ended.
void JsonLines::print_new(const Record& record) {
  for (; branch_ < record.branches.size(); ++branch_) {
    const RecordBranch& branch = record.branches[branch_];
    const auto events_until = [&](Index step) {
      for (; events_ < record.events.size(); ++events_) {
        const RecordEvent& event = record.events[events_];
        if (event.branch != branch.id || event.step > step) return;
        print("event", event_json(record, event));
      }
    };
    for (; points_ < record.points.size() && record.points[points_].branch == branch.id; ++points_) {
      print("point", point_json(record, record.points[points_]));
      events_until(record.points[points_].step);
    }
    events_until(branch.points);
    if (!branch.end) break;
    print("end", ending(branch));
  }
  std::cout << std::flush;
}

}  // namespace arcwall
