#include "apps/sweep/results.hpp"

#include "apps/sweep/case_folder.hpp"
#include "apps/sweep/runner.hpp"
#include "core/error.hpp"
#include "model/regular_file.hpp"

namespace arcwall::sweep {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail_as_damaged(const fs::path& path) {
  throw OutputError(path.string() + ": is damaged; run the case again with --force");
}

// Null where there is none.
Json case_json(const fs::path& folder) {
  std::error_code ignored;
  const fs::path file = folder / case_file_name;
  return fs::exists(file, ignored) ? Json::parse(bytes_of_regular_file(file), nullptr, false) : Json();
}

bool holds_anything(const fs::path& folder) {
  std::error_code ignored;
  return fs::exists(folder, ignored) && !fs::is_empty(folder, ignored);
}

}  // namespace

Results::Results(fs::path sweep_folder, std::size_t cases, const Part& part)
    : sweep_folder_(std::move(sweep_folder)),
      has_folders_(holds_anything(sweep_folder_ / "cases")),
      records_(sweep_folder_, cases, part) {}

std::optional<fs::path> Results::folder(int number) const {
  if (!has_folders_ || !is_complete(sweep_folder_, number)) return std::nullopt;
  return case_folder(sweep_folder_, number);
}

bool Results::has(int number) const { return folder(number).has_value() || records_.has(number); }

bool Results::was_hindered(int number) const {
  const auto of_case = folder(number);
  if (!of_case) return records_.was_hindered(number);
  const auto end = read_case_end(case_json(*of_case));
  return end && end->was_hindered();  // what is damaged is told where it is collected
}

CaseResult Results::read(int number) const {
  const auto of_case = folder(number);
  if (!of_case && !records_.has(number)) return {.reason = "not_run"};
  try {
    if (!of_case) return result_of_record(records_.read(number));
    const auto end = read_case_end(case_json(*of_case));
    if (!end) fail_as_damaged(*of_case / case_file_name);
    return read_folder(*of_case, *end);
  } catch (const Json::exception&) {
    fail_as_damaged(of_case ? *of_case : sweep_folder_ / records_folder_name);
  }
}

}  // namespace arcwall::sweep
