#include "apps/sweep/case_result.hpp"

#include <csignal>
#include <cstring>

#include "apps/output/exit_status.hpp"
#include "apps/sweep/case_folder.hpp"
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

std::string signal_text(int signal) {
  const char* description = ::sigdescr_np(signal);
  return "signal " + std::to_string(signal) + (description == nullptr ? "" : " (" + std::string(description) + ")");
}

CaseResult read_folder(const fs::path& folder) {
  CaseResult result{.there = true};
  const Json record = parsed(folder / case_file_name);
  std::error_code ignored;
  if (record.at("status").is_null()) {
    const bool overdue = record.at("overdue").get<bool>();
    result.reason = overdue ? std::string(to_text(EndReason::max_time)) : "crash";
    result.detail = overdue ? "did not stop and was killed" : signal_text(record.at("signal").get<int>());
    return result;
  }
  result.status = record.at("status").get<int>();
  if (fs::exists(folder / "result.json", ignored)) {
    const Json outputs = parsed(folder / "result.json");
    result.counts = outputs.at("counts");
    add_end(outputs, result);
    const Json record_of_events = parsed(folder / "events.json");
    for (const Json& event : record_of_events.at("events")) result.events.push_back(event);
  } else {
    result.reason = reason_without_results(*result.status);
    result.detail = first_line(content(folder / messages_file_name));
  }
  return result;
}

bool is_limit(const Json& event) {
  const std::string kind = event.value("kind", "");
  return kind == to_text(EventKind::limit_point) || kind == to_text(EventKind::contact_limit_point);
}

std::optional<double> load(const Json& event) {
  const Json lambda = event.value("lambda", Json());
  return lambda.is_number() ? std::optional(lambda.get<double>()) : std::nullopt;
}

}  // namespace

bool CaseResult::failed() const {
  const bool early = status && static_cast<ExitStatus>(*status) == ExitStatus::ended_early;
  return !there || (status != 0 && !(early && snap_load(*this)));
}

CaseResult read_result(const fs::path& sweep_folder, int number) {
  if (!is_complete(sweep_folder, number)) return {.reason = "not_run"};
  const fs::path folder = case_folder(sweep_folder, number);
  try {
    return read_folder(folder);
  } catch (const Json::exception&) {
    fail_as_damaged(folder);
  }
}

bool was_hindered(const fs::path& sweep_folder, int number) {
  const Json record = Json::parse(content(case_folder(sweep_folder, number) / case_file_name), nullptr, false);
  if (!record.is_object()) return false;  // told where it is collected
  const Json status = record.value("status", Json());
  if (status.is_number_integer())
    return status == static_cast<int>(ExitStatus::file_error) || status == static_cast<int>(ExitStatus::out_of_memory);
  return record.value("signal", Json()) == SIGKILL && !record.value("overdue", false);
}

std::optional<double> first_load(const CaseResult& result, const std::vector<std::string>& kinds) {
  for (const Json& event : result.events)
    for (const std::string& kind : kinds)
      if (event.value("kind", "") == kind) return load(event);
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

std::optional<double> snap_load(const CaseResult& result) {
  for (const Json& event : result.events)
    if (is_limit(event) && event.value("unstable_before", Json()) == 0 && event.value("unstable_after", Json()) != 0)
      return load(event);
  return std::nullopt;
}

}  // namespace arcwall::sweep
