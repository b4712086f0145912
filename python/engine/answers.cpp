#include <limits>

#include "apps/converge/convergence.hpp"
#include "apps/converge/convergence_files.hpp"
#include "apps/output/curve_files.hpp"
#include "apps/output/files.hpp"
#include "core/error.hpp"
#include "model/deck/reader.hpp"
#include "model/model.hpp"
#include "python/engine/deck_file.hpp"
#include "python/engine/interrupt_watch.hpp"
#include "python/engine/shapes.hpp"

namespace arcwall::python {

namespace {

using Assignments = std::vector<std::string>;

// What a library answers while other threads of Python run. `ask` is given the watch by which it may be stopped.
template <typename Ask>
auto without_lock(const Ask& ask) {
  InterruptWatch watch;
  auto answer = [&] {
    const py::gil_scoped_release released;
    return ask([&watch] { return watch.stopped(); });
  }();
  watch.raise();
  return answer;
}

// The content of convergence.json and of convergence.txt.
py::tuple study(const std::string& file, const std::string& text, const Assignments& assignments, int levels,
                int factor) {
  const deck::Deck deck = deck::read_deck_text(text, file, assignments);
  const auto found = without_lock(
      [&](const auto& stopped) { return converge(deck, {.levels = levels, .factor = factor, .stopped = stopped}); });
  const std::string path = described(file, text, assignments).deck_path;
  return py::make_tuple(to_python(convergence_json(*found, {.text = text, .path = path, .assignments = assignments})),
                        convergence_text(*found));
}

enum class Question { curve, worst };

// The deck has a table [curve] that asks this.
void require(const deck::Deck& deck, Question question) {
  const bool curve = question == Question::curve;
  const std::string key = curve ? "parameter" : "worst";
  const auto refuse = [&](const std::string& message, const std::string& cure) {
    throw InputError({{.file = deck.source.file, .key = "curve", .message = message, .cure = cure}});
  };
  if (!deck.curve)
    refuse("the deck does not say which event is followed",
           curve ? "give the event, the number that varies and its range" : "give the event, the numbers and a radius");
  if (deck.curve->parameter.empty() == curve)
    refuse("the deck asks something else, there is no key " + key,
           curve ? "worst() gives the worst combination" : "curve() follows the event");
}

// --- curves of events -----------------------------------------------------------------------------------------------

template <typename Number, typename Of>
py::array_t<Number> column(const EventCurve& curve, const Of& of) {
  py::array_t<Number> array(static_cast<py::ssize_t>(curve.points.size()));
  Number* to = array.mutable_data();
  for (const CurvePoint& point : curve.points) *to++ = of(point);
  return array;
}

template <typename Number>
double or_nan(const std::optional<Number>& value) {
  return value ? static_cast<double>(*value) : std::numeric_limits<double>::quiet_NaN();
}

// In the order of curve.csv: of each its name, unit and values.
py::list columns(const EventCurve& curve) {
  using P = const CurvePoint&;
  py::list list;
  const auto add = [&](const std::string& name, const std::string& unit, const py::object& values) {
    list.append(py::make_tuple(name, unit, values));
  };
  add("arc", "", column<double>(curve, [](P at) { return at.arc; }));
  add("key", curve.key_unit, column<double>(curve, [](P at) { return at.key; }));
  add("lambda", "", column<double>(curve, [](P at) { return at.lambda; }));
  for (std::size_t i = 0; i < curve.columns.size(); ++i)
    add(curve.columns[i].name, curve.columns[i].unit, column<double>(curve, [i](P at) { return at.monitors[i]; }));
  add("slope", "", column<double>(curve, [](P at) { return or_nan(at.slope); }));
  add("unstable_before", "", column<double>(curve, [](P at) { return or_nan(at.unstable_before); }));
  add("unstable_after", "", column<double>(curve, [](P at) { return or_nan(at.unstable_after); }));
  add("contacts", "", column<std::int64_t>(curve, [](P at) { return at.contacts; }));
  for (std::size_t i = 0; i < curve.columns.size(); ++i)
    add("slope-" + curve.columns[i].name, "", column<double>(curve, [i](P at) { return or_nan(at.slopes[i]); }));
  return list;
}

py::list shapes(const EventCurve& curve) {
  py::list list;
  for (const CurvePoint& point : curve.points) {
    const auto [members, contacts] = shape_parts(point.shape);
    list.append(py::make_tuple(members, contacts));
  }
  return list;
}

py::dict files_dict(const NamedTexts& files) {
  py::dict dict;
  for (const auto& [name, content] : files) dict[py::str(name)] = content;
  return dict;
}

// The content of curve.json, columns, shapes, the files of the program, its table and its picture of λ over the number.
py::tuple event_curve(const std::string& file, const std::string& text, const Assignments& assignments) {
  const deck::Deck deck = deck::read_deck_text(text, file, assignments);
  require(deck, Question::curve);
  const EventCurve curve = without_lock([&](const auto& stopped) { return trace_event_curve(deck, stopped); });
  if (!curve.problem.empty()) raise("NoAnswer", curve.problem);
  const std::vector<LoadText> loads = driven_by_lambda(deck);
  const RunDescription of = described(file, text, assignments);
  return py::make_tuple(to_python(curve_json(curve, of)), columns(curve), shapes(curve),
                        files_dict(curve_files(curve, loads, UnitLabels::shown, of)), curve_text(curve),
                        curve_picture(curve, loads));
}

// The content of curve.json and the program's table.
py::tuple worst(const std::string& file, const std::string& text, const Assignments& assignments) {
  const deck::Deck deck = deck::read_deck_text(text, file, assignments);
  require(deck, Question::worst);
  const WorstCombination found = without_lock([&](const auto& stopped) { return worst_combination(deck, stopped); });
  if (!found.problem.empty()) raise("NoAnswer", found.problem);
  return py::make_tuple(to_python(worst_json(deck, found, described(file, text, assignments))),
                        worst_text(deck, found));
}

// --- what belongs to them -------------------------------------------------------------------------------------------

py::dict walls(const std::string& file, const std::string& text, const Assignments& assignments, double lambda) {
  return walls_at(Model(deck::read_deck_text(text, file, assignments)), lambda);
}

void write_curve(const std::string& folder, const std::string& deck, bool force,
                 const std::vector<std::pair<std::string, std::string>>& files) {
  const py::gil_scoped_release released;
  const Foreign foreign = force ? Foreign::overwrite : Foreign::refuse;
  require_no_run(folder, foreign);
  const OutputFolder output(folder, deck, foreign);
  FileSet set(output);
  for (const auto& [name, content] : files) set.write(name, content);
  set.put_in_place();
}

}  // namespace

void bind_answers(py::module_& module) {
  module.def("study", &study, py::arg("file"), py::arg("text"), py::arg("assignments"), py::arg("levels"),
             py::arg("factor"));
  module.def("event_curve", &event_curve, py::arg("file"), py::arg("text"), py::arg("assignments"));
  module.def("worst", &worst, py::arg("file"), py::arg("text"), py::arg("assignments"));
  module.def("walls", &walls, py::arg("file"), py::arg("text"), py::arg("assignments"), py::arg("lam"));
  module.def("write_curve", &write_curve, py::arg("folder"), py::arg("deck"), py::arg("force"), py::arg("files"));
}

}  // namespace arcwall::python
