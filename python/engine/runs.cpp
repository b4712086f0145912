#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "answers/sessions.hpp"
#include "apps/cli/trace_and_write.hpp"
#include "apps/output/branch_map_page.hpp"
#include "apps/output/events_json.hpp"
#include "apps/output/load_text.hpp"
#include "apps/output/report_html.hpp"
#include "apps/output/search_rows.hpp"
#include "python/engine/columns.hpp"
#include "python/engine/deck_file.hpp"
#include "python/engine/interrupt_watch.hpp"
#include "python/engine/shapes.hpp"

namespace arcwall::python {

namespace {

// A session of Python's. While one thread traces it without the interpreter's lock, no other looks inside.
class Run {
 public:
  explicit Run(Session session, double seconds = 0.0) : session_(std::move(session)), seconds_(seconds) {}

  static std::unique_ptr<Run> of_deck(const std::string& file, const std::string& text,
                                      const std::vector<std::string>& assignments) {
    const Clock::time_point begin = Clock::now();
    const py::gil_scoped_release without_lock;
    Session session = make_session(described(file, text, assignments));
    return std::make_unique<Run>(std::move(session), seconds_since(begin));
  }

  static std::unique_ptr<Run> of_checkpoint(const py::bytes& checkpoint, const std::string& name) {
    return std::make_unique<Run>(
        resume_session(static_cast<std::string_view>(checkpoint), name, Session::Resume::go_on));
  }

  static std::unique_ptr<Run> of_folder(const std::string& folder) {
    return std::make_unique<Run>(stored_session(folder, Session::Resume::go_on));
  }

  // At most so many points more, in that time; returns how many there were. Signals are looked at between points.
  Index advance(Index most_points, double most_seconds) {
    const Tracing tracing(*this);
    const Clock::time_point begin = Clock::now();
    Index points = 0;
    bool more = points < most_points;
    if (more && !begun()) raise("NoStart", "there is no equilibrium at the start: " + session_.problem());
    while (more) {
      {
        const py::gil_scoped_release without_lock;
        const Clock::time_point since = Clock::now();
        while (more && seconds_since(since) < between_signals) {
          more = session_.next() != nullptr;
          points += more;
          more = more && points < most_points && seconds_since(begin) < most_seconds;
        }
        seconds_ += seconds_since(since);
      }
      raise_what_waits();
    }
    return points;
  }

  const Session& session() const {
    require_idle();
    return session_;
  }
  const Record& record() const { return session().record(); }

  void save(const std::string& folder, bool force, bool pictures) {
    const Tracing tracing(*this);
    const py::gil_scoped_release without_lock;
    const OutputFolder output(folder, session_.record().deck, force ? Foreign::overwrite : Foreign::refuse);
    const CallOptions options{.pictures = pictures ? CallOptions::Pictures::written : CallOptions::Pictures::left_out};
    write_run(session_, output, options, stopped, {.total = seconds_, .tracing = seconds_});
  }

  py::bytes checkpoint() {
    require_idle();
    if (session_.record().points.empty())
      throw std::runtime_error("this path has no point yet, from which it could be taken up: trace one");
    return session_.checkpoint();
  }

 private:
  inline static const BranchEnd stopped{.reason = EndReason::interrupted, .detail = "the path was stopped here"};

  // While it lives others are kept out. The interpreter's lock is held when it is made and when it goes.
  class Tracing {
   public:
    explicit Tracing(Run& run) : run_(run) {
      run.require_idle();
      run.busy_ = true;
    }
    Tracing(const Tracing&) = delete;
    Tracing& operator=(const Tracing&) = delete;
    ~Tracing() { run_.busy_ = false; }

   private:
    Run& run_;
  };

  void require_idle() const {
    if (busy_) throw std::runtime_error("this path is being traced or written in another thread");
  }

  bool begun() {
    const py::gil_scoped_release without_lock;
    return session_.begin();
  }

  Session session_;
  double seconds_;  // spent in the libraries
  bool busy_ = false;
};

const RecordPoint& point_at(const Run& run, Index point) {
  const auto& points = run.record().points;
  if (point < 0 || point >= static_cast<Index>(points.size()))
    throw py::index_error("there is no point " + std::to_string(point) + "; the path has " +
                          std::to_string(points.size()));
  return points[static_cast<std::size_t>(point)];
}

// State, T, slip and anchor; none of a contact without friction.
py::object friction(const std::optional<RecordFriction>& of) {
  if (!of) return py::none();
  return py::make_tuple(std::string(to_text(of->mode)), of->force, of->slip, of->anchor);
}

py::dict point(const Run& run, Index index) {
  const RecordPoint& at = point_at(run, index);
  py::dict dict = to_python(point_json(run.record(), at)).cast<py::dict>();
  dict["residual"] = at.residual;
  py::list forces;
  for (const RecordForce& force : at.forces)
    forces.append(py::make_tuple(label(force.label), force.x, force.force, force.pressure, friction(force.friction)));
  dict["forces"] = forces;
  return dict;
}

// Members with their points, contacts with their forces, and walls.
py::tuple shape(const Run& run, Index index) {
  const RecordPoint& at = point_at(run, index);
  const Model& model = run.session().model().at_stage(run.record().stage_number(at.branch));
  const auto [members, contacts] = shape_parts(shape_of(model, at.state));
  return py::make_tuple(members, contacts, walls_at(model, at.lambda));
}

// --- pages ----------------------------------------------------------------------------------------------------------

std::string report(const Run& run) {
  const Model& model = run.session().model();
  const DrawnScenes drawn = scenes_to_draw(model, run.record());
  return ReportPage(run.record(), report_content(model, run.record(), drawn)).text();
}

std::string curve(const Run& run, std::optional<std::size_t> monitor) {
  return curve_html(run.record(), driven_by_lambda(run.session().model().whole_deck()), monitor);
}

}  // namespace

void bind_runs(py::module_& module) {
  py::class_<Run> run(module, "Run");
  run.def(py::init(&Run::of_deck), py::arg("file"), py::arg("text"), py::arg("assignments"))
      .def_static("of_checkpoint", &Run::of_checkpoint, py::arg("checkpoint"), py::arg("name"))
      .def_static("of_folder", &Run::of_folder, py::arg("folder"))
      .def("advance", &Run::advance, py::arg("points"), py::arg("seconds"))
      .def("has_ended", [](const Run& self) { return self.session().has_ended(); })
      .def("save", &Run::save, py::arg("folder"), py::arg("force"), py::arg("pictures"))
      .def("checkpoint", &Run::checkpoint)
      .def("warnings", [](const Run& self) { return self.session().model().warnings(); })
      .def("search", [](const Run& self) { return to_python(search_json(self.record())); })
      .def("branch_map",
           [](const Run& self) {
             const Session& session = self.session();
             return to_python(branch_map_json(session.record(), branch_map_of(session.model(), session.record())));
           })
      .def("description",
           [](const Run& self) {
             const RunDescription& of = self.session().description();
             return py::make_tuple(of.deck, of.deck_text, of.assignments);
           })
      .def("point", &point, py::arg("index"))
      .def("shape", &shape, py::arg("index"))
      .def("report", &report)
      .def("curve", &curve, py::arg("monitor"));
  bind_record(run);
}

}  // namespace arcwall::python
