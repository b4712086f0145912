#include "apps/sweep/case_result.hpp"

#include <csignal>
#include <cstring>

#include "apps/output/exit_status.hpp"
#include "apps/sweep/runner.hpp"
#include "core/error.hpp"
#include "model/event_names.hpp"
#include "model/regular_file.hpp"

namespace arcwall::sweep {

namespace fs = std::filesystem;

namespace {

// Empty where there is none.
std::string content(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored) ? bytes_of_regular_file(file) : std::string();
}

[[noreturn]] void fail_as_damaged(const fs::path& path) {
  throw OutputError(path.string() + ": is damaged; run the case again with --force");
}

Json parsed(const fs::path& file) {
  Json json = Json::parse(content(file), nullptr, false);
  if (!json.is_object()) fail_as_damaged(file);
  return json;
}

// Why a run without results ended.
std::string reason_without_results(int status) {
  switch (static_cast<ExitStatus>(status)) {
    case ExitStatus::wrong_input:
      return "wrong_input";
    case ExitStatus::no_start:
      return "no_start";
    case ExitStatus::file_error:
      return "file_error";
    case ExitStatus::out_of_memory:
      return "out_of_memory";
    case ExitStatus::success:
    case ExitStatus::internal_error:
    case ExitStatus::ended_early:
    case ExitStatus::limit_met:
    case ExitStatus::not_confirmed:
    case ExitStatus::interrupted:
      break;
  }
  return "internal_error";
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

// The end of the first branch that accounts for the status of the run.
void add_end(const Json& result, CaseResult& target) {
  for (const Json& branch : result.at("branches")) {
    const Json& end = branch.at("end");
    const std::string reason = end.at("reason");
    const auto known = end_reason(reason);
    if (!known || static_cast<int>(exit_status(*known)) != target.status) continue;
    target.reason = reason;
    target.detail = end.at("detail");
    return;
  }
}

// Throws Json::exception for what is no event: it has a text `kind`, and its λ and monitors are numbers or not known.
void add_event(const Json& event, CaseResult& target) {
  const auto require_number_if_known = [](const Json& value) {
    if (!value.is_null() && !value.is_number()) static_cast<void>(value.get_ref<const Json::number_float_t&>());
  };
  static_cast<void>(event.at("kind").get_ref<const std::string&>());
  require_number_if_known(event.value("lambda", Json()));
  for (const auto& [name, value] : event.at("monitors").get_ref<const Json::object_t&>())
    require_number_if_known(value);
  target.events.push_back(event);
}

std::string signal_text(int signal) {
  const char* description = ::sigdescr_np(signal);
  return "signal " + std::to_string(signal) + (description == nullptr ? "" : " (" + std::string(description) + ")");
}

bool is_limit(const Json& event) {
  const std::string kind = event.value("kind", "");
  return kind == to_text(EventKind::limit_point) || kind == to_text(EventKind::contact_limit_point);
}

std::optional<double> load(const Json& event, const std::string& monitor = {}) {
  const Json value = monitor.empty() ? event.value("lambda", Json()) : event.at("monitors").value(monitor, Json());
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

}  // namespace

bool CaseResult::failed() const {
  const bool early = status && static_cast<ExitStatus>(*status) == ExitStatus::ended_early;
  return !there || (status != 0 && !(early && snap_load(*this)));
}

Json CaseEnd::json() const {
  Json json;
  json["case"] = number;
  json["set"] = set;
  json["options"] = options;
  json["max_time"] = most_seconds ? Json(*most_seconds) : Json(nullptr);
  json["status"] = status ? Json(*status) : Json(nullptr);
  json["signal"] = signal == 0 ? Json(nullptr) : Json(signal);
  json["overdue"] = overdue;
  return json;
}

bool CaseEnd::was_hindered() const {
  if (!status) return signal == SIGKILL && !overdue;
  const auto as = static_cast<ExitStatus>(*status);
  return as == ExitStatus::file_error || as == ExitStatus::out_of_memory;
}

std::optional<CaseEnd> read_case_end(const Json& json) {
  if (!json.is_object()) return std::nullopt;
  const Json status = json.value("status", Json()), signal = json.value("signal", Json());
  if (!status.is_number_integer() && !signal.is_number_integer()) return std::nullopt;
  CaseEnd end{.overdue = json.value("overdue", Json()) == Json(true)};
  if (status.is_number_integer()) end.status = status.get<int>();
  if (signal.is_number_integer()) end.signal = signal.get<int>();
  return end;
}

namespace {

// The numbers and λ of the rows of curve.csv, which has them behind the point's own and its arc.
std::vector<std::pair<double, double>> curve_points(const std::string& csv) {
  std::vector<std::pair<double, double>> points;
  for (std::size_t line = csv.find('\n'); line != std::string::npos && line + 1 < csv.size();
       line = csv.find('\n', line + 1)) {
    const std::size_t arc = csv.find(',', line), key = csv.find(',', arc + 1), lambda = csv.find(',', key + 1);
    if (lambda == std::string::npos) break;
    points.emplace_back(std::strtod(csv.c_str() + key + 1, nullptr), std::strtod(csv.c_str() + lambda + 1, nullptr));
  }
  return points;
}

// The end of a curve that accounts for the status of its process.
void add_end_of_curve(const Json& curve, CaseResult& target) {
  target.reason = to_text(EndReason::stop);
  for (const Json& special : curve.at("specials")) {
    if (!special.contains("reason")) continue;
    const std::string reason = special.at("reason");
    const auto known = end_reason(reason);
    if (!known || static_cast<int>(exit_status(*known)) != target.status) continue;
    target.reason = reason;
    target.detail = special.at("why");
    return;
  }
}

// A curve of events, or the worst combination of numbers: one λ.
void read_curve(const fs::path& folder, CaseResult& result) {
  const Json curve = parsed(folder / "curve.json");
  if (curve.contains("worst")) {
    result.reason = to_text(EndReason::stop);
    result.counts = {{"points", curve.at("runs")}};
    add_event({{"kind", "worst"}, {"lambda", curve.at("lambda")}, {"monitors", Json::object()}}, result);
    return;
  }
  result.counts = {{"points", curve.at("points")}};
  add_end_of_curve(curve, result);
  for (const Json& special : curve.at("specials")) add_event(special, result);
  result.curve = curve_points(content(folder / "curve.csv"));
}

}  // namespace

CaseResult read_folder(const fs::path& folder, const CaseEnd& end) {
  CaseResult result{.there = true, .status = end.status};
  std::error_code ignored;
  if (!end.status) {
    result.reason = end.overdue ? std::string(to_text(EndReason::max_time)) : "crash";
    result.detail = end.overdue ? "did not stop and was killed" : signal_text(end.signal);
  } else if (fs::exists(folder / "curve.json", ignored)) {
    read_curve(folder, result);
  } else if (fs::exists(folder / "result.json", ignored)) {
    const Json outputs = parsed(folder / "result.json");
    result.counts = outputs.at("counts");
    add_end(outputs, result);
    const Json record_of_events = parsed(folder / "events.json");
    for (const Json& event : record_of_events.at("events")) add_event(event, result);
  } else {
    result.reason = reason_without_results(*result.status);
    result.detail = first_line(content(folder / messages_file_name));
  }
  return result;
}

// Of an event what tables and maps need.
Json record_of(const CaseEnd& end, const CaseResult& result) {
  Json record = end.json();
  for (const char* of_the_list : {"case", "set"}) record.erase(of_the_list);
  record["reason"] = result.reason;
  record["detail"] = result.detail;
  record["counts"] = result.counts;
  Json& events = record["events"] = Json::array();
  for (const Json& event : result.events) {
    Json& kept = events.emplace_back(Json::object());
    for (const char* key : {"id", "kind", "branch", "step", "arc", "lambda", "monitors", "unstable_before",
                            "unstable_after", "reason", "point", "key", "why"})
      if (event.contains(key)) kept[key] = event.at(key);
  }
  if (!result.curve.empty()) record["curve"] = result.curve;
  return record;
}

CaseResult result_of_record(const Json& record) {
  CaseResult result{.there = true,
                    .reason = record.at("reason").get<std::string>(),
                    .detail = record.at("detail").get<std::string>(),
                    .counts = record.at("counts")};
  if (!record.at("status").is_null()) result.status = record.at("status").get<int>();
  for (const Json& event : record.at("events")) add_event(event, result);
  if (record.contains("curve")) result.curve = record.at("curve").get<std::vector<std::pair<double, double>>>();
  return result;
}

std::optional<double> first_load(const CaseResult& result, const std::vector<std::string>& kinds,
                                 const std::string& monitor) {
  for (const Json& event : result.events)
    for (const std::string& kind : kinds)
      if (event.value("kind", "") == kind) return load(event, monitor);
  return std::nullopt;
}

std::vector<double> limit_loads(const CaseResult& result) {
  std::vector<double> loads;
  for (const Json& event : result.events) {
    const auto lambda = load(event);
    if (is_limit(event) && lambda) loads.push_back(*lambda);
  }
  return loads;
}

std::optional<double> snap_load(const CaseResult& result, const std::string& monitor) {
  for (const Json& event : result.events)
    if (is_limit(event) && event.value("unstable_before", Json()) == 0 && event.value("unstable_after", Json()) != 0)
      return load(event, monitor);
  return std::nullopt;
}

}  // namespace arcwall::sweep
