// Monitors and the path.
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/text.hpp"
#include "model/deck/reader_parts.hpp"

namespace arcwall::deck {

namespace {

constexpr std::array<std::string_view, 10> reserved_names{"branch",    "step",     "arc",    "lambda",     "unstable",
                                                          "stability", "contacts", "energy", "iterations", "event"};

void read_monitor_name(Cursor& table, const Deck& deck, Monitor& monitor) {
  if (!table.text("name", Presence::required, monitor.name)) return;
  const bool reserved = std::find(reserved_names.begin(), reserved_names.end(), monitor.name) != reserved_names.end();
  if (!is_name(monitor.name)) {
    table.report("name", in_quotes(monitor.name, 60) + " is no name", "use letters, digits, _ and - only");
  } else if (reserved) {
    table.report("name", in_quotes(monitor.name) + " is the name of another column of path.csv", "choose another name");
  } else if (find(deck.monitors, monitor.name) != nullptr) {
    table.report("name", in_quotes(monitor.name) + " is the name of another monitor", "give each monitor its own");
  }
}

// The members that have a node at that place.
std::vector<const Member*> members_at(const Deck& deck, const Place& place) {
  std::vector<const Member*> members;
  for (const Member& member : deck.members) {
    const bool ends_there = member.from == place.name || member.to == place.name;
    if (place.fraction ? member.name == place.name : ends_there) members.push_back(&member);
  }
  return members;
}

void check_faces(Cursor& table, const Deck& deck, const Monitor& monitor) {
  if (monitor.component != Component::face_above_z && monitor.component != Component::face_below_z) return;
  const Member* without = member_without_faces(deck, members_at(deck, monitor.at));
  if (without == nullptr) return;
  table.report("component",
               "section " + without->section + " of member " + without->name + " has no height, so no face",
               "give the section a height, or monitor \"z\"");
}

Monitor read_monitor(Cursor& table, const Names& names, const Deck& deck) {
  Monitor monitor{.position = table.position()};
  read_monitor_name(table, deck, monitor);
  const bool at = read_place(table, "at", names, deck, monitor.at);
  const bool component = table.word("component", Presence::required, component_words, monitor.component);
  if (at && component) check_faces(table, deck, monitor);
  if (table.integer("sign", Presence::optional, {.low = -1, .high = 1}, monitor.sign) && monitor.sign == 0) {
    table.report("sign", "0 is out of range", "give 1 or -1");
  }
  table.finish();
  return monitor;
}

// A key that stands for λ or a monitor.
bool check_column(Cursor& table, const Value& item, const Names& names) {
  if (item.key == "lambda" || contains(names.monitors, item.key)) return true;
  std::vector<std::string> candidates = names.monitors;
  candidates.emplace_back("lambda");
  table.report_unknown({item.key, item.key_position}, table.path_of(item.key), "is neither lambda nor a monitor",
                       candidates);
  return false;
}

void read_land(Cursor& table, const Names& names, Path& path) {
  for (const Value& item : table.value().items) {
    Landing landing{.name = item.key, .position = item.key_position};
    const bool known = check_column(table, item, names);
    if (table.numbers(item.key, Presence::required, landing.values) && known) path.land.push_back(landing);
  }
}

void read_stop_bounds(Cursor& table, const Value& item, const Names& names, Stop& stop) {
  StopBounds bounds{.name = item.key, .position = item.key_position};
  const bool known = check_column(table, item, names);
  std::vector<double> values;
  if (!table.numbers(item.key, Presence::required, values)) return;
  if (values.size() != 2 || !(values[0] < values[1])) {
    std::string found;
    for (std::size_t i = 0; i < std::min<std::size_t>(values.size(), 3); ++i) {
      found += (i > 0 ? ", " : "") + round_trip(values[i]);
    }
    table.report(item.key, "[" + found + (values.size() > 3 ? ", …" : "") + "] are no bounds",
                 "give [low, high] with low less than high");
  } else if (known) {
    bounds.low = values[0];
    bounds.high = values[1];
    stop.bounds.push_back(bounds);
  }
}

// One word, or an array of them.
void read_stop_events(Cursor& table, const Value& item, Stop& stop) {
  StopEvent event{};
  if (item.kind != Value::Kind::array) {
    if (table.word("event", Presence::required, stop_event_words, event)) stop.events.push_back(event);
    return;
  }
  std::vector<Reference> words;
  table.references("event", Presence::required, words);
  for (const Reference& word : words) {
    if (const auto known = from_text(stop_event_words, word.text)) {
      stop.events.push_back(*known);
    } else {
      table.report_unknown(word, table.path_of("event"), "is not one of the words for this key",
                           texts(stop_event_words));
    }
  }
}

// Events that are not looked for end nothing.
void check_stop_events(Cursor& table, const Path& path) {
  for (const StopEvent event : path.stop.events) {
    const std::string name = text_of(stop_event_words, event);
    if (path.events == Events::none)
      table.report("stop", "event = " + in_quotes(name) + " never happens with events = \"none\"",
                   "leave out events, or write events = \"detect\"");
    else if (event == StopEvent::displacement_limit && path.watch.empty())
      table.report("stop", "event = " + in_quotes(name) + " never happens: no monitor is watched",
                   "add watch = [\"MONITOR\"] to [path]");
  }
}

void read_stop(Cursor table, const Names& names, Stop& stop) {
  for (const Value& item : table.value().items) {
    if (item.key == "contacts") {
      table.integer("contacts", Presence::required, {.low = 1}, stop.contacts);
    } else if (item.key == "event") {
      read_stop_events(table, item, stop);
    } else {
      read_stop_bounds(table, item, names, stop);
    }
  }
}

void read_watch(Cursor& table, const Names& names, Path& path) {
  const Value* found = table.find("watch", Presence::optional);
  if (found == nullptr || (found->kind == Value::Kind::array && found->items.empty())) return;
  std::vector<Reference> watched;
  table.references("watch", Presence::optional, watched);
  for (const Reference& monitor : watched) {
    if (contains(names.monitors, monitor.text)) {
      path.watch.push_back(monitor.text);
    } else {
      table.report_unknown(monitor, table.path_of("watch"), "is not a monitor of this deck", names.monitors);
    }
  }
}

void read_control(Cursor& table, const Names& names, const Deck& deck, Path& path) {
  auto control_table = table.table("control", Presence::optional);
  if (!control_table) return;
  Control control;
  read_place(*control_table, "at", names, deck, control.at);
  control_table->word("component", Presence::required, control_words, control.component);
  control_table->finish();
  path.control = control;
}

void read_steps(Cursor& table, Path& path) {
  table.number("step", Presence::optional, not_zero, path.step);
  const bool min = table.number("min_step", Presence::optional, positive, path.min_step);
  const bool max = table.number("max_step", Presence::optional, positive, path.max_step);
  const bool both_right = min == table.has("min_step") && max == table.has("max_step");
  if (both_right && path.max_step < path.min_step) {
    table.report(table.has("max_step") ? "max_step" : "min_step",
                 "max_step = " + round_trip(path.max_step) + " is less than min_step = " + round_trip(path.min_step),
                 "make max_step at least min_step");
  }
  table.integer("max_points", Presence::optional, {.low = 1}, path.max_points);
}

void check_method(Cursor& table, const Path& path) {
  if (path.method == PathMethod::displacement && !table.has("control")) {
    table.report("control", "is missing: method displacement needs it",
                 "add control = { at = \"MEMBER:0.5\", component = \"z\" }");
  }
  const Value* land = find(table.value(), "land");
  const bool lands_on_lambda = land != nullptr && find(*land, "lambda") != nullptr;
  if (path.method == PathMethod::incremental && !lands_on_lambda) {
    table.report("land", "lambda is missing: method incremental takes its increments from it",
                 "add land = { lambda = [...] }");
  }
}

}  // namespace

void read_monitors(Cursor& root, const Names& names, Deck& deck) {
  for (Cursor& table : root.tables("monitor")) deck.monitors.push_back(read_monitor(table, names, deck));
}

void read_path(Cursor& root, const Names& names, Deck& deck) {
  auto table = root.table("path", Presence::optional);
  if (!table) return;
  Path& path = deck.path;
  path.position = table->position();
  table->word("method", Presence::optional, path_method_words, path.method);
  if (auto land = table->table("land", Presence::optional)) read_land(*land, names, path);
  read_control(*table, names, deck, path);
  read_steps(*table, path);
  table->word("branches", Presence::optional, branches_words, path.branches);
  table->integer("depth", Presence::optional, {}, path.depth);
  read_watch(*table, names, path);
  table->word("events", Presence::optional, events_words, path.events);
  if (auto stop = table->table("stop", Presence::optional)) read_stop(*stop, names, path.stop);
  check_method(*table, path);
  check_stop_events(*table, path);
  table->finish();
}

}  // namespace arcwall::deck
