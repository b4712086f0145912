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
#include "apps/sweep/results.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "model/event_names.hpp"
#include "model/regular_file.hpp"

namespace arcwall::sweep {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;
using Moment = std::chrono::time_point<Clock, Seconds>;  // however far ahead

// Of a draft: with which words its run was begun.
constexpr const char* begun_file_name = "begun.json";

struct RunningCase {
  Case one;
  CaseDraft draft;
  pid_t child = 0;
  std::optional<Moment> deadline{};  // to be killed
  bool overdue = false;              // was killed
};

Moment after(double seconds) { return Clock::now() + Seconds(seconds); }

// Whether the process ended because somebody wanted it to, and not at the end of its case.
bool was_stopped(const ChildEnd& how, bool interrupted) {
  if (how.signal != 0) return interrupted || how.signal == SIGINT || how.signal == SIGTERM;
  return how.status == static_cast<int>(ExitStatus::interrupted);
}

// The cases that a request names, one after the other.
class Chosen {
 public:
  Chosen(const RunRequest& request, std::optional<int> one) : reader_(request.folder), part_(request.part), one_(one) {}

  std::optional<Case> next() {
    for (std::size_t number = seen_;; ++number) {
      const bool wanted = one_ ? number == static_cast<std::size_t>(*one_) : part_.has(number);
      seen_ = number + 1;
      if (wanted) return reader_.next();
      if (!reader_.skip()) return std::nullopt;
    }
  }

 private:
  CaseReader reader_;
  Part part_;
  std::optional<int> one_;
  std::size_t seen_ = 0;
};

class Pool {
 public:
  Pool(const RunRequest& request, const std::function<void(const RunCounts&)>& progress)
      : request_(request), progress_(progress), results_(request.folder, count_cases(request.folder), request.part) {
    if (request.keep == Keep::records) writer_.emplace(request.folder, request.part);
  }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  // Cases are left running only where their results could not be kept.
  ~Pool() {
    for (const RunningCase& one : running_) {
      ::kill(one.child, SIGKILL);
      ::waitpid(one.child, nullptr, 0);
    }
  }

  // What is to be run again has no results any more, or is a draft that can go on.
  void forget_results(Chosen cases, Rerun rerun) {
    if (rerun == Rerun::none) return;
    const auto round = static_cast<std::uint16_t>(results_.records().last_round() + 1);
    while (const auto one = cases.next()) {
      const int number = one->number;
      if (!results_.has(number)) continue;
      if (rerun == Rerun::failed) {
        const CaseResult result = results_.read(number);
        if (!result.failed()) continue;
        if (result.reason == to_text(EndReason::max_time) && result.status && results_.folder(number)) {
          reopen(request_.folder, number);
          continue;
        }
      }
      forget_result(number, round);
    }
  }

  RunCounts run(Chosen cases) {
    auto next = cases.next();
    while (true) {
      for (; next && !counts_.interrupted && static_cast<int>(running_.size()) < request_.jobs; next = cases.next())
        begin(std::move(*next));
      if (running_.empty()) return counts_;
      wait();
    }
  }

 private:
  void forget_result(int number, std::uint16_t round) {
    if (results_.folder(number)) forget(request_.folder, number);
    if (!results_.records().has(number)) return;
    if (!writer_) writer_.emplace(request_.folder, request_.part);
    writer_->append(number, round, RecordKind::forgotten);
    results_.records().forget(number, round);
  }

  void begin(Case one) {
    if (results_.has(one.number)) {
      if (!results_.was_hindered(one.number)) {
        ++counts_.complete;
        return;
      }
      if (results_.folder(one.number)) forget(request_.folder, one.number);
    }
    auto draft = CaseDraft::claim(request_.folder, one.number);
    if (!draft) {
      ++counts_.busy;
      return;
    }
    // Among those that run once its process is there, and not before: what follows may throw.
    std::list<RunningCase> being_added;
    RunningCase& added = being_added.emplace_back(RunningCase{.one = std::move(one), .draft = std::move(*draft)});
    const ChildCommand anew = command(added.one, added.draft);
    const std::string text = Json(anew.arguments).dump(-1, ' ', false, Json::error_handler_t::replace);
    const bool goes_on = can_go_on(added.draft.path(), text);
    if (!goes_on) {
      added.draft.clear();
      write_whole(added.draft.path() / begun_file_name, text);
    }
    added.child = start(with_limits(goes_on ? resuming(anew, added.draft) : anew));
    if (request_.most_seconds) added.deadline = after(*request_.most_seconds + request_.patience);
    running_.splice(running_.end(), being_added);
  }

  // Without pictures: they are many times as large as the rest, and `trace-path report` draws those of a case. The
  // folder is named from the sweep's, so that messages are the same wherever that is.
  ChildCommand command(const Case& one, const CaseDraft& claimed) const {
    const fs::path& draft = claimed.path();
    const std::string folder = fs::path(draft.parent_path().filename() / draft.filename()).string();
    ChildCommand result{.program = request_.program,
                        .body = request_.body,
                        .arguments = {request_.traced == Traced::curve ? "curve" : "run", "./" + one.deck, "--out",
                                      folder, "--force", "--quiet", "--no-pictures"},
                        .folder = request_.folder,
                        .messages = fs::absolute(draft / messages_file_name),
                        .kept_open = claimed.lock_descriptor()};
    std::vector<std::string>& words = result.arguments;
    const auto& given = request_.options;  // an option that is given twice is refused
    const bool is_given = std::find(given.begin(), given.end(), "--scratch") != given.end();
    if (request_.keep == Keep::records && !is_given) words.emplace_back("--scratch");
    // What the deck does not say is not asked of each of many cases, unless the options or the case say it.
    if (!request_.jumps && request_.traced == Traced::path) words.insert(words.end(), {"--set", "path.jumps=false"});
    words.insert(words.end(), given.begin(), given.end());
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
    if (request_.keep == Keep::records) command.arguments.emplace_back("--scratch");
    return command;
  }

  void wait() {
    std::optional<Moment> earliest;
    for (const RunningCase& one : running_)
      if (one.deadline && (!earliest || *one.deadline < *earliest)) earliest = one.deadline;
    constexpr Seconds longest(3600.0);
    const Seconds left = earliest ? std::clamp<Seconds>(*earliest - Clock::now(), Seconds::zero(), longest) : longest;
    const int signal = signals_.next(left.count());
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
      // Its number may be another process's from now on, whatever keeping its results throws.
      std::list<RunningCase> ended;
      ended.splice(ended.end(), running_, one++);
      end(ended.front(), {.status = WIFEXITED(status) ? WEXITSTATUS(status) : 0,
                          .signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0});
      ended.clear();
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
    keep(one, end_of(one, how));
    ++counts_.ran;
    if (how.signal != 0 || how.status != 0) ++counts_.failed;
  }

  // A folder appears whole, a record is a line; the draft of what is recorded goes away.
  void keep(RunningCase& one, const CaseEnd& end) {
    const fs::path& draft = one.draft.path();
    if (request_.keep == Keep::records) {
      const RecordKind kind = end.was_hindered() ? RecordKind::hindered : RecordKind::result;
      writer_->append(end.number, results_.records().round_of(end.number), kind,
                      record_of(end, read_folder(draft, end)));
      return;
    }
    if (end.status != static_cast<int>(ExitStatus::limit_met)) fs::remove(draft / begun_file_name);
    write_whole(draft / case_file_name, end.json().dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    const fs::path messages = draft / messages_file_name;
    if (fs::is_empty(messages)) fs::remove(messages);
    one.draft.publish();
  }

  CaseEnd end_of(const RunningCase& one, const ChildEnd& how) const {
    CaseEnd end{.number = one.one.number,
                .set = Json::object(),
                .options = request_.options,
                .most_seconds = request_.most_seconds,
                .signal = how.signal,
                .overdue = one.overdue};
    for (const auto& [key, value] : one.one.set) end.set[key] = value;
    if (how.signal == 0) end.status = how.status;
    return end;
  }

  const RunRequest& request_;
  const std::function<void(const RunCounts&)>& progress_;
  Results results_;
  std::optional<RecordWriter> writer_{};
  SignalQueue signals_;
  std::list<RunningCase> running_;
  RunCounts counts_;
};

}  // namespace

RunCounts run_cases(const RunRequest& request, std::optional<int> one, Rerun rerun,
                    const std::function<void(const RunCounts&)>& progress) {
  Pool pool(request, progress);
  pool.forget_results(Chosen(request, one), rerun);
  return pool.run(Chosen(request, one));
}

}  // namespace arcwall::sweep
