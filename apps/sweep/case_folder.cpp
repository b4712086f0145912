#include "apps/sweep/case_folder.hpp"

#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <chrono>
#include <thread>
#include <utility>

#include "apps/output/own_folder.hpp"
#include "core/error.hpp"

namespace arcwall::sweep {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& folder, const std::string& what, const std::string& reason) {
  throw OutputError(folder.string() + ": " + what + ": " + reason);
}

std::string folder_name(int number) { return fmt::format("{:05}", number); }

// Whether the descriptor is that of the folder with this name: another process may have renamed it before the lock was
// had.
bool is_named(int descriptor, const fs::path& path) {
  struct stat held {
  }, named{};
  return ::fstat(descriptor, &held) == 0 && ::lstat(path.c_str(), &named) == 0 && held.st_dev == named.st_dev &&
         held.st_ino == named.st_ino;
}

// False if another process holds the lock. One that was killed may take a moment to end: it may be waiting for the
// disk. File systems that cannot lock a folder say so by other errors; cases are then run unlocked.
bool lock(int descriptor) {
  using namespace std::chrono_literals;
  for (auto waited = 0ms; ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK; waited += 10ms) {
    if (waited >= 500ms) return false;
    std::this_thread::sleep_for(10ms);
  }
  return true;
}

fs::path draft_folder(const fs::path& sweep_folder, int number) {
  return sweep_folder / "cases" / ("." + folder_name(number));
}

}  // namespace

fs::path case_folder(const fs::path& sweep_folder, int number) { return sweep_folder / "cases" / folder_name(number); }

bool is_complete(const fs::path& sweep_folder, int number) {
  std::error_code ignored;
  return fs::exists(case_folder(sweep_folder, number), ignored);
}

// By way of a hidden name: what has the case's name is whole.
void forget(const fs::path& sweep_folder, int number) {
  const fs::path target = case_folder(sweep_folder, number);
  const fs::path hidden = target.parent_path() / (".old-" + folder_name(number));
  std::error_code error;
  fs::remove_all(hidden, error);
  if (!is_complete(sweep_folder, number)) return;
  fs::rename(target, hidden, error);
  if (!error) fs::remove_all(hidden, error);
  if (error) fail(target, "cannot be removed", error.message());
}

void reopen(const fs::path& sweep_folder, int number) {
  std::error_code error;
  const fs::path draft = draft_folder(sweep_folder, number);
  fs::remove_all(draft, error);
  fs::rename(case_folder(sweep_folder, number), draft, error);
  if (error) fail(draft, "cannot be made", error.message());
}

std::vector<int> begun_cases(const fs::path& sweep_folder) {
  std::vector<int> numbers;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(sweep_folder / "cases", ignored)) {
    const std::string name = entry.path().filename().string();
    int number = 0;
    const char* const end = name.data() + name.size();
    const auto read = std::from_chars(name.data() + 1, end, number);
    if (name.front() == '.' && read.ec == std::errc() && read.ptr == end) numbers.push_back(number);
  }
  return numbers;
}

std::optional<CaseDraft> CaseDraft::claim(const fs::path& sweep_folder, int number) {
  const fs::path target = case_folder(sweep_folder, number);
  const fs::path path = draft_folder(sweep_folder, number);
  std::error_code error;
  fs::create_directories(path, error);
  if (error) fail(path, "cannot be made", error.message());
  auto folder = OwnFolder::open(path);
  if (!folder) return std::nullopt;
  const int descriptor = folder->release();
  const bool held_by_another = !lock(descriptor);
  CaseDraft draft(path, target, descriptor);
  if (held_by_another || !is_named(descriptor, path)) {
    draft.path_.clear();
    return std::nullopt;
  }
  if (is_complete(sweep_folder, number)) return std::nullopt;
  return draft;
}

CaseDraft::CaseDraft(CaseDraft&& other) noexcept
    : path_(std::exchange(other.path_, {})),
      target_(std::move(other.target_)),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

CaseDraft::~CaseDraft() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
  if (descriptor_ >= 0) ::close(descriptor_);
}

void CaseDraft::clear() const {
  const auto folder = OwnFolder::open(path_);
  if (!folder) return;
  for (const std::string& name : folder->names()) folder->remove(name);
}

void CaseDraft::publish() {
  std::error_code error;
  fs::rename(path_, target_, error);
  if (error) fail(target_, "cannot be made", error.message());
  path_.clear();
}

}  // namespace arcwall::sweep
