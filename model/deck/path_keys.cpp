// The path and the monitors.
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/text.hpp"
#include "model/deck/deck_keys.hpp"
#include "model/deck/value.hpp"

namespace arcwall::deck {

namespace {

constexpr std::array<std::string_view, 10> reserved_names{"branch",    "step",     "arc",    "lambda",     "unstable",
                                                          "stability", "contacts", "energy", "iterations", "event"};

// --- the path -------------------------------------------------------------------------------------------------------

bool bounds_key(Keys& keys, const Key& key, StopBounds& bounds) {
  const bool known = keys.refers(key, Named::column);
  std::vector<double> values{bounds.low, bounds.high};
  if (!keys.numbers(key, values, unit::none, "`[low, high]`, of λ or a monitor")) return false;
  if (values.size() != 2 || !(values[0] < values[1])) {
    std::string found;
    for (std::size_t i = 0; i < std::min<std::size_t>(values.size(), 3); ++i)
      found += (i > 0 ? ", " : "") + round_trip(values[i]);
    keys.report(key.name, "[" + found + (values.size() > 3 ? ", …" : "") + "] are no bounds",
                "give [low, high] with low less than high");
    return false;
  }
  bounds.low = values[0];
  bounds.high = values[1];
  return known;
}

// One word, or an array of them.
void stop_event_key(Keys& keys, Stop& stop) {
  const Key key = optional("event", "none");
  const char* meaning = "kind of event, or array of kinds, at which the branch ends";
  if (keys.holds_array(key.name)) {
    keys.words(key, stop.events, stop_event_words, "is not one of the words for this key", meaning);
  } else {
    EventKind event{};
    if (keys.word(key, event, stop_event_words, meaning)) stop.events.push_back(event);
  }
}

void stop_keys(Keys& keys, Stop& stop) {
  keys.entries(stop.bounds, &StopBounds::name,
               [&](const Key& key, StopBounds& bounds) { return bounds_key(keys, key, bounds); },
               {"contacts", "event"});
  keys.integer(optional("contacts", "none"), stop.contacts, {.low = 0},
               "number of closed contacts, counted as in `path.csv`, at which the branch ends; 0: the last one opens");
  stop_event_key(keys, stop);
}

// Events that are not looked for end nothing.
// A jump begins at an event that is located.
void check_jump(Keys& keys, BranchPolicy branches, const Path& path) {
  if (branches != BranchPolicy::jump) return;
  if (path.method == PathMethod::incremental)
    keys.report("branches", "\"jump\" needs equilibria, which method \"incremental\" leaves",
                "use method \"spherical\"");
  else if (path.method == PathMethod::load)
    keys.report("branches", "\"jump\" begins where λ turns, and method \"load\" ends there",
                "use method \"spherical\"");
  else if (path.events != EventSearch::locate)
    keys.report("branches",
                "\"jump\" needs located events, and events is " + in_quotes(text_of(events_words, path.events)),
                "leave out events, or write events = \"locate\"");
}

void check_stop_events(Keys& keys, const Path& path) {
  for (const EventKind event : path.stop.events) {
    const std::string name = text_of(stop_event_words, event);
    if (path.events == EventSearch::none)
      keys.report("stop", "event = " + in_quotes(name) + " never happens with events = \"none\"",
                  "leave out events, or write events = \"detect\"");
    else if (event == EventKind::turning_point && path.watch.empty())
      keys.report("stop", "event = " + in_quotes(name) + " never happens: no monitor is watched",
                  "add watch = [\"MONITOR\"] to [path]");
    else if (event == EventKind::value_crossing && path.watch_zero.empty() && path.watch_values.empty())
      keys.report("stop", "event = " + in_quotes(name) + " never happens: no value is watched",
                  "add watch = { zero = [\"MONITOR\"] } to [path]");
  }
}

// Each value is another than that where λ is.
void visit_key(Keys& keys, std::vector<double>& visit) {
  keys.numbers(optional("visit", "none"), visit, unit::none, "values to which λ goes in turn");
  if (!keys.reads()) return;
  double last = 0.0;
  for (std::size_t i = 0; i < visit.size(); ++i) {
    const double before = std::exchange(last, visit[i]);
    if (visit[i] != before) continue;
    return keys.report("visit",
                       "λ is there already (" +
                           (i == 0 ? std::string("it begins at 0") : round_trip(before) + " twice in a row") + ")",
                       "leave the value out");
  }
  if (!visit.empty() && keys.has("stop"))
    keys.report("stop", "visit says already where λ ends", "leave out stop, or visit");
}

void control_keys(Keys& keys, Control& control) {
  keys.place("at", control.at, "a place");
  keys.word("component", control.component, control_words, "");
}

void step_keys(Keys& keys, Path& path) {
  keys.number(optional("step"), path.step, unit::none, not_zero,
              "increment of λ of the first predictor; its sign is the direction");
  const bool min =
      keys.number(optional("min_step"), path.min_step, unit::none, positive, "arc length below which a branch ends");
  const bool max = keys.number(optional("max_step"), path.max_step, unit::none, positive,
                               "limit of the motion of the structure in a step, as a fraction of its size; not of λ");
  const bool both_right = min == keys.has("min_step") && max == keys.has("max_step");
  if (both_right && path.max_step < path.min_step)
    keys.report(keys.has("max_step") ? "max_step" : "min_step",
                "max_step = " + round_trip(path.max_step) + " is less than min_step = " + round_trip(path.min_step),
                "make max_step at least min_step");
  keys.integer(optional("max_points"), path.max_points, {.low = 1}, "limit on points; the run ends with status 6");
  if (keys.has("max_points")) path.max_points_given.in_deck = true;
}

void check_method(Keys& keys, const Path& path, bool names_lambda) {
  if (path.method == PathMethod::displacement && !keys.has("control"))
    keys.report("control", "is missing: method displacement needs it",
                "add control = { at = \"MEMBER:0.5\", component = \"z\" }");
  if (path.method == PathMethod::incremental && !names_lambda)
    keys.report("output_at", "lambda is missing: method incremental takes its increments from it",
                "add output_at = { lambda = [...] }");
}

// Whether it names lambda.
bool output_at_key(Keys& keys, const Key& output_at, std::vector<OutputValues>& list, const char* meaning) {
  bool names_lambda = false;
  keys.table(
      output_at, Form::dotted,
      [&](Keys& of) {
        names_lambda = of.has("lambda");
        of.entries(list, &OutputValues::name, [&](const Key& key, OutputValues& output) {
          const bool known = of.refers(key, Named::column);
          return of.numbers(key, output.values, unit::none, "") && known;
        });
      },
      meaning);
  return names_lambda;
}

// Monitors that turn, or a table that has values to pass as well.
void watch_key(Keys& keys, Path& path) {
  const Key watch = optional("watch", "none");
  const bool passes = !path.watch_zero.empty() || !path.watch_values.empty();
  const bool is_table = keys.lists() || (keys.reads() ? keys.holds_table("watch") : passes);
  if (!is_table) {
    keys.names(watch, path.watch, Named::monitor, EmptyList::means_none, "");
    return;
  }
  keys.table(
      watch, Form::dotted,
      [&](Keys& of) {
        of.names(optional("turning", "none"), path.watch, Named::monitor, EmptyList::means_none, "");
        of.names(optional("zero", "none"), path.watch_zero, Named::column, EmptyList::means_none, "");
        output_at_key(of, optional("value", "none"), path.watch_values, "");
      },
      "`turning`, or an array alone: monitors whose turning points are events (`turning-point`); `zero`: λ or monitors "
      "whose zeros are (`value-crossing`); `value`: the same of other values, `{ lift = [0.5] }`");
}

void search_keys(Keys& keys, Path& path) {
  keys.flag(optional("search"), path.search,
            "search for disconnected branches and trace them ([how-to](../how-to/disconnected-branches.md))");
  keys.numbers(optional("search_at", "five values over the λ range of the events except start and end"), path.search_at,
               unit::none, "load factors of the search");
  keys.integer(optional("search_guesses"), path.search_guesses, {.low = 1, .high = 1000000},
               "initial guesses per load factor");
  keys.integer(optional("search_seed"), path.search_seed, {.low = 0}, "seed of the guesses; results repeat exactly");
}

void check_search(Keys& keys, const Path& path) {
  for (const char* key : {"search_at", "search_guesses", "search_seed"})
    if (!keys.has("search") && keys.has(key)) {
      keys.report(key, "is given, but nothing is looked for", "add search = true, or leave it out");
      return;
    }
  if (!path.search) return;
  if (path.method == PathMethod::incremental)
    keys.report("search", "method \"incremental\" leaves no equilibria to look beside", "use method \"spherical\"");
  const StopBounds* const bounds = find(path.stop.bounds, "lambda");
  for (const double value : path.search_at)
    if (bounds != nullptr && (value < bounds->low || value > bounds->high)) {
      keys.report("search_at",
                  round_trip(value) + " is outside stop.lambda = [" + round_trip(bounds->low) + ", " +
                      round_trip(bounds->high) + "]",
                  "give values between these bounds, or wider bounds");
      return;
    }
}

void path_keys(Keys& keys, Path& path) {
  path.position = keys.position();
  keys.word(optional("method"), path.method, path_method_words,
            "`\"load\"`, `\"displacement\"`, `\"riks\"` (fixed normal plane), `\"normal-plane\"` (updated), "
            "`\"cylindrical\"`, `\"spherical\"` (both Crisfield), `\"pseudo-arclength\"`; `\"incremental\"`: load "
            "increments without iteration through `output_at.lambda`, subdivided to at most `step`");
  const bool names_lambda = output_at_key(
      keys, optional("output_at", "none"), path.output_at,
      "values of λ or of monitors at which an exact path point is output: `{ lambda = [0.4], mid = [-0.05] }`");
  keys.part("control", path.control, [&](Control& control) {
    keys.table(
        optional("control", "none"), Form::dotted, [&](Keys& of) { control_keys(of, control); },
        "of `\"displacement\"`; the component is `\"x\"`, `\"z\"` or `\"rotation\"`");
  });
  step_keys(keys, path);
  keys.word(
      optional("branches"), path.branches, branches_words,
      "branch switching: `\"primary\"`, `\"most-stable\"`, `\"all\"` or `\"jump\"` (below); disconnected branches need "
      "`search`");
  keys.integer(optional("depth"), path.depth, {}, "of `\"all\"`: generations of branches");
  watch_key(keys, path);
  keys.word(optional("events"), path.events, events_words,
            "`\"locate\"`: limit and turning points become points of the path; `\"detect\"`: reported at the end of "
            "their step; `\"none\"`: ignored. Only `\"locate\"` locates and follows bifurcations. Contact changes are "
            "always located");
  keys.word(optional("equilibrium_family"), path.equilibrium_family, equilibrium_family_words,
            "if equilibrium fixes only the total length of several contact zones: `\"symmetric\"` continues with the "
            "solution in which the lengths of adjacent zones change by equal amounts; `\"stop\"` ends the branch");
  keys.flag(optional("jumps"), path.jumps,
            "compute the state that the structure jumps to, at constant λ, after each loss of stability "
            "([how-to](../how-to/snap-destination.md)); `false` in the cases of a sweep");
  if (keys.has("jumps")) path.jumps_given.in_deck = true;
  keys.any_texts(
      optional("sensitivity", "none"), path.sensitivity,
      "parameters, as in `--set`, by which the λ of each event is differentiated ([how-to](../how-to/sensitivity.md))");
  search_keys(keys, path);
  keys.table(
      optional("stop"), Form::header, [&](Keys& stop) { stop_keys(stop, path.stop); }, "");
  visit_key(keys, path.visit);
  if (keys.reads()) check_search(keys, path);
  check_method(keys, path, names_lambda);
  check_jump(keys, path.branches, path);
  check_stop_events(keys, path);
}

// --- stages ---------------------------------------------------------------------------------------------------------

void stage_keys(Keys& keys, Stage& stage, const Deck& deck) {
  if (keys.text("name", stage.name, "letters, digits, _ and -") && !is_name(stage.name)) {
    keys.report("name", in_quotes(stage.name, 60) + " is no name", "use letters, digits, _ and - only");
  } else if (keys.reads() && find(deck.stages, stage.name) != nullptr) {
    keys.report("name", in_quotes(stage.name) + " is the name of another stage", "give each stage its own");
  }
  const bool known = keys.choices("drives", stage.drives, driven_things(deck), "is nothing that λ may drive",
                                  "what λ scales: `load.0`, `prescribed.1` (counted from 0), or `wall.NAME`");
  const auto changes = [&](const std::string& thing) { return varies(deck, thing); };
  if (known && std::none_of(stage.drives.begin(), stage.drives.end(), changes))
    keys.report("drives", "nothing varies with λ in this stage: what it drives is zero",
                "name a load or a movement that is not zero");
  keys.number(optional("step", "as in [path]"), stage.step, unit::none, not_zero, "as in [path]");
  keys.number(optional("max_step", "as in [path]"), stage.max_step, unit::none, positive, "as in [path]");
  keys.word(optional("branches", "as in [path]"), stage.branches, branches_words, "as in [path]");
  if (stage.branches) check_jump(keys, *stage.branches, deck.path);
  output_at_key(keys, optional("output_at", "as in [path]"), stage.output_at, "as in [path]");
  visit_key(keys, stage.visit);
  keys.part("stop", stage.stop, [&](Stop& stop) {
    keys.table(
        optional("stop", "as in [path]"), Form::dotted, [&](Keys& of) { stop_keys(of, stop); }, "as in [path]");
  });
}

// Each thing has its turn, and the state in which a stage ends is one.
void check_stages(Keys& root, const Deck& given) {
  if (!root.reads()) return;
  if (!given.stages.empty() && !given.path.visit.empty())
    root.report("path", "visit belongs to a deck without stages", "give it to the stages that go to and fro");
  const Deck deck = with_visits_as_stages(given);
  if (deck.stages.empty()) return;
  const char* const table = given.stages.empty() ? "path" : "stage";
  // What a wrong name would have been cannot be told.
  const auto drives_something = [](const Stage& stage) { return !stage.drives.empty(); };
  const bool all_known = std::all_of(deck.stages.begin(), deck.stages.end(), drives_something);
  for (const std::string& thing : all_known ? driven_things(deck) : std::vector<std::string>()) {
    const auto driven = [&](const Stage& stage) { return drives(stage, thing); };
    if (std::none_of(deck.stages.begin(), deck.stages.end(), driven))
      root.report("stage", "no stage drives " + thing, "name it in drives of a stage, or make it constant");
  }
  for (const Stage& stage : deck.stages)
    if (find(deck.stages, stage.name) != &stage)
      root.report("stage", "stage " + in_quotes(stage.name) + " has the name that a visit of another one has",
                  "give it another name");
  for (std::size_t i = 0; i + 1 < deck.stages.size(); ++i) {
    const Stop& stop = deck.stages[i].stop ? *deck.stages[i].stop : deck.path.stop;
    if (stop.bounds.empty() && !stop.contacts && stop.events.empty())
      root.report("stage",
                  "nothing stops stage " + in_quotes(deck.stages[i].name) + ", so that the next one never begins",
                  "give it a stop, as in stop = { lambda = [-1.0, 1.0] }");
    if (deck.stages[i].branches.value_or(deck.path.branches) == BranchPolicy::all)
      root.report(table,
                  "stage " + in_quotes(deck.stages[i].name) + " traces all branches, and the next one begins on one",
                  "give it branches = \"most-stable\" or \"primary\"");
  }
  if (deck.path.search)
    root.report("path", "search = true belongs to a deck without stages and visit", "leave out search");
  if (deck.path.method == PathMethod::incremental)
    root.report("path", "method \"incremental\" has no stages and no visit", "use method \"spherical\"");
  if (find(deck.monitors, std::string("stage")) != nullptr)
    root.report("monitor", "\"stage\" is the name of another column of path.csv", "choose another name");
}

// --- monitors -------------------------------------------------------------------------------------------------------

void name_key(Keys& keys, const Deck& deck, Monitor& monitor) {
  if (!keys.text("name", monitor.name,
                 "not one of `branch`, `step`, `arc`, `lambda`, `unstable`, `stability`, `contacts`, `energy`, "
                 "`iterations`, `event`"))
    return;
  const bool of_friction = monitor.name == "slipping" || monitor.name == "dissipation";
  const bool reserved = std::find(reserved_names.begin(), reserved_names.end(), monitor.name) != reserved_names.end() ||
                        (of_friction && has_friction(deck));
  if (!is_name(monitor.name)) {
    keys.report("name", in_quotes(monitor.name, 60) + " is no name", "use letters, digits, _ and - only");
  } else if (reserved) {
    keys.report("name", in_quotes(monitor.name) + " is the name of another column of path.csv", "choose another name");
  } else if (find(deck.monitors, monitor.name) != nullptr) {
    keys.report("name", in_quotes(monitor.name) + " is the name of another monitor", "give each monitor its own");
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

void check_face(Keys& keys, const Deck& deck, const Monitor& monitor) {
  if (monitor.component != Component::face_above_z && monitor.component != Component::face_below_z) return;
  const Member* without = member_without_faces(deck, members_at(deck, monitor.at));
  if (without == nullptr) return;
  keys.report("component", "section " + without->section + " of member " + without->name + " has no height, so no face",
              "give the section a height, or monitor \"z\"");
}

constexpr const char* what_to_monitor =
    "give `at` for a place, `wall` for the force of a wall, both for the gap between them, `wall` and `member` for its "
    "force on that member, `member` for the maximum "
    "moment or stress of a member, or `spring` for the force of a spring";

// What has a component, and what is to be written where it stands with something else.
struct Owner {
  const char* is;
  const char* cure;
};

Owner owner_of(Component component) {
  switch (component) {
    case Component::force_x:
    case Component::force_z:
      return {"a wall or a spring", "write `wall` or `spring` instead, or give reaction-x or reaction-z of a place"};
    case Component::friction_force:
      return {"a wall", "write `wall` instead, or give both `at` and `wall`"};
    case Component::friction_use:
      return {"a wall", "write `wall` instead"};
    case Component::dissipation:
      return {"a wall or the whole structure", "write `wall` instead, or leave out `at` for all walls"};
    case Component::slip:
    case Component::gap:
      return {"a place and a wall", "give both `at` and `wall`"};
    case Component::contact_start:
    case Component::contact_end:
      return {"a wall and a member", "give both `wall` and `member`"};
    case Component::max_moment:
      return {"a member", "write `member` instead"};
    case Component::max_stress:
    case Component::utilisation:
      return {"a member or the whole structure", "write `member` instead, or leave out `at` for all members"};
    case Component::greatest_pressure:
    case Component::least_pressure:
    case Component::mean_pressure:
      return {"a foundation", "write `spring` with the name of a [[spring]] that has `on`"};
    case Component::x:
    case Component::z:
    case Component::rotation:
    case Component::face_above_z:
    case Component::face_below_z:
    case Component::reaction_x:
    case Component::reaction_z:
    case Component::reaction_moment:
    case Component::axial_force:
    case Component::moment:
    case Component::thickness:
    case Component::thickness2:
      break;
  }
  return {"a place", "write `at` instead"};
}

bool is_force(Component component) {
  return component == Component::force_x || component == Component::force_z || component == Component::moment;
}

// Whether what is monitored has the component; reports it if not.
bool check_owner(Keys& keys, const Monitor& monitor) {
  const Component component = monitor.component;
  const std::string word = text_of(component_words, component);
  const auto refuse = [&](const std::string& message, const std::string& cure) {
    keys.report("component", message, cure);
    return false;
  };
  switch (monitor.of()) {
    case Monitored::place:
      if (const Owner owner = owner_of(component); owner.is != std::string_view("a place"))
        return refuse(word + " belongs to " + owner.is, owner.cure);
      return true;
    case Monitored::wall:
      if (is_contact_edge(component) && monitor.member.empty())
        return refuse(word + " is a place along a member", "add `member`: the one that the wall touches");
      if (component == Component::dissipation && !monitor.member.empty())
        return refuse("dissipation is that of a wall on all its members", "leave out `member`");
      if (component == Component::slip) return refuse("slip is that of a place: give at", "");
      return is_force(component) || is_contact_edge(component) || is_of_friction(component) ||
             refuse("a wall has no " + word, component == Component::gap ? "add `at`: the place of which it is the gap"
                                                                         : "give force-x, force-z or moment");
    case Monitored::gap:
      return component == Component::gap || component == Component::force_x || component == Component::force_z ||
             component == Component::friction_force || component == Component::slip ||
             refuse("a place and a wall have a gap and a force between them, and no " + word,
                    "give gap, force-x or force-z, or leave out `wall` or `at`");
    case Monitored::member:
      return component == Component::max_moment || is_stress(component) ||
             refuse("a member as a whole has no " + word,
                    "give max-moment, max-stress or utilisation, or write `at` with a place of the member");
    case Monitored::structure:
      if (is_stress(component) || component == Component::dissipation) return true;
      keys.report("at", "the monitor has none of `at`, `wall`, `member` and `spring`", what_to_monitor);
      return false;
    case Monitored::spring:
      return is_force(component) || is_pressure(component) ||
             refuse("a spring has no " + word,
                    "give force-x, force-z or moment, or greatest-pressure, least-pressure or mean-pressure of a "
                    "foundation");
  }
  return true;
}

Dof direction_of(Component component) {
  if (component == Component::force_x) return Dof::x;
  return component == Component::force_z ? Dof::z : Dof::rotation;
}

// A spring has forces in the directions in which it acts, a foundation a pressure.
void check_spring(Keys& keys, const Deck& deck, const Monitor& monitor) {
  const Spring* spring = find(deck.springs, monitor.spring);
  if (spring == nullptr) return;  // it has errors of its own
  const bool along = std::holds_alternative<Foundation>(spring->kind);
  if (along != is_pressure(monitor.component))
    return keys.report(
        "component",
        "spring " + monitor.spring + " is " + (along ? "a foundation" : "no foundation") + ", which has no " +
            text_of(component_words, monitor.component),
        along ? "give greatest-pressure, least-pressure or mean-pressure" : "give force-x, force-z or moment");
  const Dof direction = direction_of(monitor.component);
  if (!along && !acts_in(*spring, direction))
    keys.report("component",
                "spring " + monitor.spring + " has no stiffness in " + text_of(spring_direction_words, direction),
                "name the component of a direction in which it acts");
}

// Outer fibres of beams need a height, and a part of what is allowed what that is.
void check_stress(Keys& keys, const Deck& deck, const Monitor& monitor) {
  std::vector<const Member*> members, beams;
  for (const Member& member : deck.members)
    if (monitor.of() == Monitored::structure || member.name == monitor.member) members.push_back(&member);
  for (const Member* member : members)
    if (member->theory != Theory::truss) beams.push_back(member);
  if (const Member* const without = member_without_faces(deck, beams))
    keys.report("component",
                "section " + without->section + " of member " + without->name +
                    " has no height: the stress in its outer fibres is not known",
                "add section." + without->section + ".height, twice the distance of the outer fibre from the axis");
  if (monitor.component != Component::utilisation) return;
  for (const Member* member : members) {
    const Material* const material = find(deck.materials, member->material);
    if (material == nullptr || material->allowable) continue;
    return keys.report("component",
                       "material " + material->name + " of member " + member->name + " has no allowable stress",
                       "add material." + material->name + ".allowable");
  }
}

void check_monitored(Keys& keys, const Deck& deck, const Monitor& monitor) {
  if (!check_owner(keys, monitor)) return;
  const bool of_friction = is_of_friction(monitor.component);
  if (of_friction && !has_friction(deck))
    keys.report("component", "no wall of the deck has friction", "give the wall `friction`");
  if (monitor.of() == Monitored::place) check_face(keys, deck, monitor);
  if (monitor.of() == Monitored::spring) check_spring(keys, deck, monitor);
  const double end = monitor.at.fraction.value_or(0.0);
  if (of_friction) return;  // at nodes
  if (monitor.of() == Monitored::gap && monitor.component != Component::gap && end != 0.0 && end != 1.0)
    keys.report("at", "contact inside a member moves along it, so that no place has a force of its own",
                "name an end of the member, as MEMBER:1, or write `member` for the force on the whole member");
  if (is_stress(monitor.component)) return check_stress(keys, deck, monitor);
  const Member* member = monitor.of() == Monitored::member ? find(deck.members, monitor.member) : nullptr;
  if (member != nullptr && member->theory == Theory::truss)
    keys.report("member", "member " + member->name + " is a truss, which carries no moment", "name a beam");
}

// One of these keys, a wall with a place or a member, or none of a stress in the whole structure.
bool check_what_is_monitored(Keys& keys) {
  std::vector<std::string> given;
  for (const char* key : {"at", "wall", "member", "spring"})
    if (keys.has(key)) given.emplace_back(key);
  const bool of_wall = given.size() == 2 && (given[0] == "wall" || given[1] == "wall") && given[1] != "spring";
  if (given.size() <= 1 || of_wall) return true;
  keys.report(given.back(), "the monitor has both `" + given[0] + "` and `" + given.back() + "`", what_to_monitor);
  return false;
}

void monitored_keys(Keys& keys, Monitor& monitor, const Deck& deck) {
  if (keys.reads() && !check_what_is_monitored(keys)) return keys.give_up();
  bool right = true;
  const auto shows = [&](const char* key, const std::string& name) {
    return keys.lists() || (keys.reads() ? keys.has(key) : !name.empty());
  };
  if (shows("at", monitor.at.name)) right = keys.place("at", monitor.at, "a place") && right;
  const auto name_key = [&](const char* key, std::string& name, Named of, const char* meaning) {
    if (shows(key, name)) right = keys.name(key, name, of, meaning) && right;
  };
  name_key("wall", monitor.wall, Named::wall,
           "instead of `at`: a wall (resultant force); with `at`: a wall (gap, force on the end of a member)");
  name_key("member", monitor.member, Named::member,
           "instead of `at`: a member (maximum moment or stress); with `wall`: the member on which the force acts");
  name_key("spring", monitor.spring, Named::spring, "instead of `at`: a spring (its force)");
  if (keys.word("component", monitor.component, component_words, "one of the following") && right)
    check_monitored(keys, deck, monitor);
}

void monitor_keys(Keys& keys, Monitor& monitor, const Deck& deck) {
  name_key(keys, deck, monitor);
  monitored_keys(keys, monitor, deck);
  if (keys.integer(optional("sign"), monitor.sign, {.low = -1, .high = 1}, "1 or −1; factor of the column") &&
      monitor.sign == 0)
    keys.report("sign", "0 is out of range", "give 1 or -1");
}

}  // namespace

void declare_path(Keys& root, Deck& deck) {
  root.table(
      optional("path"), Form::header, [&](Keys& keys) { path_keys(keys, deck.path); }, "");
  root.tables(
      optional("stage"), deck.stages, [&](Keys& keys, Stage& stage) { stage_keys(keys, stage, deck); }, "");
  const auto keys_of_monitor = [&](Keys& keys, Monitor& monitor) { monitor_keys(keys, monitor, deck); };
  root.tables(optional("monitor"), deck.monitors, keys_of_monitor, "");
  check_stages(root, deck);
}

void declare_keys(Keys& root, Deck& deck) {
  declare_sections(root, deck);
  declare_members(root, deck);
  const bool loads_are_right = declare_loads(root, deck);
  declare_springs(root, deck);
  const bool walls_are_right = declare_walls(root, deck);
  declare_path(root, deck);
  declare_curve(root, deck);
  if (loads_are_right && walls_are_right) check_driven(root, deck);
  if (loads_are_right) check_movements(root, deck);
}

}  // namespace arcwall::deck
