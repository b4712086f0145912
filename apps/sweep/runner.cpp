#include "apps/sweep/runner.hpp"

#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <list>

#include "apps/output/exit_status.hpp"
#include "apps/output/files.hpp"
#include "apps/sweep/case_folder.hpp"
#include "apps/sweep/case_result.hpp"
#include "apps/sweep/child.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "model/regular_file.hpp"

namespace arcwall::sweep {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

// Of a draft: with which words its run was begun.
constexpr const char* begun_file_name = "begun.json";

struct RunningCase {
  const Case* one = nullptr;
  CaseDraft draft;
  pid_t child = 0;
  std::optional<Clock::time_point> deadline{};  // to be killed
  bool overdue = false;                         // was killed
};

Clock::time_point after(double seconds) {
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

// Whether the process ended because somebody wanted it to, and not at the end of its case.
bool was_stopped(const ChildEnd& how, bool interrupted) {
  if (how.signal != 0) return interrupted || how.signal == SIGINT || how.signal == SIGTERM;
  return how.status == static_cast<int>(ExitStatus::interrupted);
}

class Pool {
 public:
  Pool(const RunRequest& request, const std::function<void(const RunCounts&)>& progress)
      : request_(request), progress_(progress) {}
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  // Cases are left running only where their results could not be kept.
  ~Pool() {
    for (const RunningCase& one : running_) {
      ::kill(one.child, SIGKILL);
      ::waitpid(one.child, nullptr, 0);
    }
  }

  RunCounts run(const std::vector<Case>& cases) {
    auto next = cases.begin();
    while (true) {
      while (next != cases.end() && !counts_.interrupted && static_cast<int>(running_.size()) < request_.jobs)
        begin(*next++);
      if (running_.empty()) return counts_;
      wait();
    }
  }

 private:
  void begin(const Case& one) {
    if (is_complete(request_.folder, one.number)) {
      if (!was_hindered(request_.folder, one.number)) {
        ++counts_.complete;
        return;
      }
      forget(request_.folder, one.number);
    }
    auto draft = CaseDraft::claim(request_.folder, one.number);
    if (!draft) {
      ++counts_.busy;
      return;
    }
    RunningCase& added = running_.emplace_back(RunningCase{.one = &one, .draft = std::move(*draft)});
    const ChildCommand anew = command(one, added.draft);
    const std::string text = Json(anew.arguments).dump(-1, ' ', false, Json::error_handler_t::replace);
    const bool goes_on = can_go_on(added.draft.path(), text);
    if (!goes_on) {
      added.draft.clear();
      write_whole(added.draft.path() / begun_file_name, text);
    }
    added.child = start(with_limits(goes_on ? resuming(anew, added.draft) : anew));
    if (request_.most_seconds) added.deadline = after(*request_.most_seconds + request_.patience);
  }

  // Without pictures: they are many times as large as the rest, and `trace-path report` draws those of a case. The
  // folder is named from the sweep's, so that messages are the same wherever that is.
  ChildCommand command(const Case& one, const CaseDraft& claimed) const {
    const fs::path& draft = claimed.path();
    const std::string folder = fs::path(draft.parent_path().filename() / draft.filename()).string();
    ChildCommand result{.program = request_.program,
                        .arguments = {"run", "./" + one.deck, "--out", folder, "--force", "--quiet", "--no-pictures"},
                        .folder = request_.folder,
                        .messages = fs::absolute(draft / messages_file_name),
                        .kept_open = claimed.lock_descriptor()};
    std::vector<std::string>& words = result.arguments;
    words.insert(words.end(), request_.options.begin(), request_.options.end());
    for (const std::string& assignment : assignments(one)) words.insert(words.end(), {"--set", assignment});
    return result;
  }

  // The limit of time is of one process, not of the case.
  ChildCommand with_limits(ChildCommand command) const {
    if (request_.most_seconds)
      command.arguments.insert(command.arguments.end(), {"--max-time", round_trip(*request_.most_seconds)});
    return command;
  }

  // The same case with the same options was begun here, and has a checkpoint. A limit on points counts for each call,
  // so that such a case would not be what it is without the interruption.
  bool can_go_on(const fs::path& draft, const std::string& text) const {
    std::error_code ignored;
    const fs::path begun = draft / begun_file_name;
    const auto limits_points = [](const std::string& word) { return word.starts_with("--max-points"); };
    return fs::is_regular_file(begun, ignored) && fs::is_regular_file(draft / "checkpoint", ignored) &&
           std::none_of(request_.options.begin(), request_.options.end(), limits_points) &&
           bytes_of_regular_file(begun) == text;
  }

  ChildCommand resuming(const ChildCommand& anew, const CaseDraft& claimed) const {
    const fs::path& draft = claimed.path();
    ChildCommand command = anew;
    command.arguments = {"resume", fs::path(draft.parent_path().filename() / draft.filename()).string(), "--quiet",
                         "--no-pictures"};
    return command;
  }

  void wait() {
    std::optional<Clock::time_point> earliest;
    for (const RunningCase& one : running_)
      if (one.deadline && (!earliest || *one.deadline < *earliest)) earliest = one.deadline;
    constexpr double forever = 3600.0;
    const double seconds =
        earliest ? std::max(0.0, std::chrono::duration<double>(*earliest - Clock::now()).count()) : forever;
    const int signal = signals_.next(seconds);
    if (signal == SIGINT || signal == SIGTERM) interrupt();
    kill_overdue();
    reap();
  }

  // Asks the running cases to stop; the second time they are killed.
  void interrupt() {
    for (RunningCase& one : running_) {
      ::kill(one.child, counts_.interrupted ? SIGKILL : SIGTERM);
      one.deadline = after(request_.patience);
    }
    counts_.interrupted = true;
  }

  void kill_overdue() {
    for (RunningCase& one : running_) {
      if (!one.deadline || Clock::now() < *one.deadline) continue;
      one.overdue = true;
      one.deadline.reset();
      ::kill(one.child, SIGKILL);
    }
  }

  void reap() {
    for (auto one = running_.begin(); one != running_.end();) {
      int status = 0;
      if (::waitpid(one->child, &status, WNOHANG) != one->child) {
        ++one;
        continue;
      }
      end(*one, {.status = WIFEXITED(status) ? WEXITSTATUS(status) : 0,
                 .signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0});
      one = running_.erase(one);
      progress_(counts_);
    }
  }

  void end(RunningCase& one, const ChildEnd& how) {
    if (how.status == not_started) throw OutputError(request_.program.string() + ": cannot be started");
    if (was_stopped(how, counts_.interrupted)) {
      counts_.interrupted = true;
      std::error_code ignored;
      if (fs::exists(one.draft.path() / "checkpoint", ignored)) one.draft.leave();
      return;
    }
    const bool may_go_on = how.signal == 0 && how.status == static_cast<int>(ExitStatus::limit_met);
    if (!may_go_on) fs::remove(one.draft.path() / begun_file_name);
    write_whole(one.draft.path() / case_file_name, case_json(one, how));
    const fs::path messages = one.draft.path() / messages_file_name;
    if (fs::is_empty(messages)) fs::remove(messages);
    one.draft.publish();
    ++counts_.ran;
    if (how.signal != 0 || how.status != 0) ++counts_.failed;
  }

  std::string case_json(const RunningCase& one, const ChildEnd& how) const {
    Json json;
    json["case"] = one.one->number;
    json["set"] = Json::object();
    for (const auto& [key, value] : one.one->set) json["set"][key] = value;
    json["options"] = request_.options;
    json["max_time"] = request_.most_seconds ? Json(*request_.most_seconds) : Json(nullptr);
    json["status"] = how.signal == 0 ? Json(how.status) : Json(nullptr);
    json["signal"] = how.signal == 0 ? Json(nullptr) : Json(how.signal);
    json["overdue"] = one.overdue;
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  }

  const RunRequest& request_;
  const std::function<void(const RunCounts&)>& progress_;
  SignalQueue signals_;
  std::list<RunningCase> running_;
  RunCounts counts_;
};

}  // namespace

RunCounts run_cases(const RunRequest& request, const std::vector<Case>& cases,
                    const std::function<void(const RunCounts&)>& progress) {
  return Pool(request, progress).run(cases);
}

}  // namespace arcwall::sweep
