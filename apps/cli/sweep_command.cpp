#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>

#include "apps/cli/commands.hpp"
#include "apps/cli/program.hpp"
#include "apps/cli/progress.hpp"
#include "apps/output/files.hpp"
#include "apps/output/text_table.hpp"
#include "apps/sweep/case_folder.hpp"
#include "apps/sweep/job_script.hpp"
#include "apps/sweep/planner.hpp"
#include "apps/sweep/runner.hpp"
#include "apps/sweep/sweep_report.hpp"
#include "core/error.hpp"
#include "model/deck/cursor.hpp"
#include "model/deck/reader.hpp"
#include "model/event_names.hpp"

namespace arcwall {

namespace fs = std::filesystem;

const char* const sweep_summary = "run parameter studies: one deck with many sets of values";

namespace {

constexpr const char* this_program = "/proc/self/exe";

// --- plan

ExitStatus plan(const Options& options) {
  const std::string& file = options.words().front();
  const fs::path folder = options.text("out").value_or(fs::path(file).stem().string());
  const sweep::Plan plan = sweep::plan(file);
  sweep::write(plan, folder);
  std::vector<std::string> keys;
  for (const sweep::Key& key : plan.sweep.keys) keys.push_back(key.name);
  std::cout << fmt::format("{} cases of {} planned in {}; varied: {}\nnext: trace-path sweep run {}\n",
                           plan.cases.size(), plan.cases.front().deck, folder.string(), fmt::join(keys, ", "),
                           sweep::shell_word(folder.string()));
  return ExitStatus::success;
}

// --- run

// Options of `run` that the sweep gives itself.
constexpr std::array owned_options{"out", "force", "json", "quiet", "dry-run", "max-time", "no-pictures"};

// Whether the deck of a planned sweep says where falls are looked for.
bool says_jumps(const fs::path& folder) {
  const sweep::Case first = sweep::CaseReader(folder).next().value();
  try {
    return deck::read_deck((folder / first.deck).string(), sweep::assignments(first)).path.jumps_given.in_deck;
  } catch (const InputError&) {
    return true;  // its cases say what is wrong
  }
}

// What a planned sweep traces of its cases.
Traced traced_of(const fs::path& folder) {
  return sweep::read_sweep((folder / sweep::sweep_file_name).string(), sweep::Rows::left_out).traced;
}

// Wrong options are told before anything runs.
void check_passed_on(const std::vector<std::string>& words, Traced traced) {
  std::vector<std::string> whole{"DECK"};
  whole.insert(whole.end(), words.begin(), words.end());
  const Options options((traced == Traced::curve ? curve_command() : run_command()).description, whole);
  for (const char* name : owned_options)
    if (options.has(name))
      throw InputError(fmt::format("--{} cannot be passed on to the cases{}", name,
                                   name == std::string("max-time") ? "; give it before --" : ""));
  for (const char* name : {"help", "version"})
    if (options.has(name)) throw InputError(fmt::format("--{} cannot be passed on to the cases", name));
}

// `I/N`: of N equal shares the one with number I, counted from 0.
sweep::Part share(const std::string& part) {
  const std::size_t slash = part.find('/');
  const auto number = [&](const std::string& text) {
    const bool digits = !text.empty() && text.size() < 10 && text.find_first_not_of("0123456789") == std::string::npos;
    return digits ? std::stoul(text) : std::string::npos;
  };
  const std::size_t first = number(part.substr(0, slash)),
                    parts = slash == std::string::npos ? std::string::npos : number(part.substr(slash + 1));
  if (first == std::string::npos || parts == std::string::npos || first >= parts)
    throw InputError(fmt::format("--part is {}; write I/N with I from 0 to N − 1, as in 0/4", part));
  return {.number = first, .parts = parts};
}

// How many cases the options choose, of all.
std::size_t chosen(std::size_t cases, const Options& options) {
  const std::optional<int> number = options.number("case");
  const std::optional<std::string> part = options.text("part");
  if (number && part) throw InputError("--case and --part are given; keep one of them");
  if (number && static_cast<std::size_t>(*number) >= cases)
    throw InputError(fmt::format("--case is {}; the sweep has the cases 0 to {}", *number, cases - 1));
  if (number) return 1;
  const sweep::Part of = part ? share(*part) : sweep::Part();
  return cases / of.parts + (of.number < cases % of.parts ? 1 : 0);
}

// As the program itself would end.
int run_as_program(const std::vector<std::string>& words) {
  try {
    return static_cast<int>(run_program(words));
  } catch (const std::exception& problem) {
    return static_cast<int>(report(problem));
  }
}

std::string text(const sweep::RunCounts& counts, std::size_t cases) {
  std::string line =
      fmt::format("{} of {} cases completed, {} of them new", counts.ran + counts.complete, cases, counts.ran);
  if (counts.failed > 0) line += fmt::format(", {} of the new ones failed", counts.failed);
  if (counts.busy > 0) line += fmt::format("; another process is running {}", counts.busy);
  return line;
}

ExitStatus run_sweep(const Options& options) {
  const fs::path& folder = options.words().front();
  const std::size_t all = sweep::count_cases(folder), cases = chosen(all, options);
  const bool records = options.has("records") || all > static_cast<std::size_t>(sweep::most_folders);
  const sweep::RunRequest request{.folder = folder,
                                  .program = this_program,
                                  .body = run_as_program,
                                  .jobs = options.count("jobs").value_or(1),
                                  .traced = traced_of(folder),
                                  .jumps = says_jumps(folder),
                                  .options = options.passed_on(),
                                  .most_seconds = options.seconds("max-time"),
                                  .keep = records ? sweep::Keep::records : sweep::Keep::folders,
                                  .part = options.text("part") ? share(*options.text("part")) : sweep::Part()};
  check_passed_on(request.options, request.traced);
  const sweep::Rerun rerun = options.has("force")    ? sweep::Rerun::all
                             : options.has("failed") ? sweep::Rerun::failed
                                                     : sweep::Rerun::none;
  sweep::RunCounts counts;
  {
    ProgressLine line(options.has("quiet") ? Progress::hidden : progress_wanted());
    counts = sweep::run_cases(request, options.number("case"), rerun,
                              [&](const sweep::RunCounts& now) { line.show(text(now, cases)); });
  }
  if (!options.has("quiet")) std::cout << text(counts, cases) << "\n";
  if (counts.interrupted) {
    std::cerr << "note: interrupted; the same command continues\n";
    return ExitStatus::interrupted;
  }
  return counts.failed > 0 && !options.has("tolerant") ? ExitStatus::ended_early : ExitStatus::success;
}

// --- status

void print_failures(const sweep::Overview& of_all) {
  std::vector<std::vector<std::string>> rows;
  for (const sweep::Failure& failure : of_all.failures)
    rows.push_back({failure.reason, std::to_string(failure.count), sweep::listed(failure)});
  if (!rows.empty())
    std::cout << "\n" << text_table({{"reason"}, {"cases", TableColumn::Side::right}, {"which"}}, rows);
}

ExitStatus show_status(const Options& options) {
  const sweep::Collection collection(options.words().front());
  const sweep::Overview of_all = sweep::overview(collection);
  std::size_t not_run = collection.size() - of_all.ran, begun = 0;
  for (const int number : sweep::begun_cases(collection.folder()))
    if (static_cast<std::size_t>(number) < collection.size() && !collection.results().has(number)) ++begun;
  std::cout << fmt::format("{} of {} cases completed, {} of them as the deck asks\n", of_all.ran, collection.size(),
                           collection.size() - of_all.failed);
  std::cout << fmt::format("{} more are running or were interrupted, {} have not begun\n", begun, not_run - begun);
  print_failures(of_all);
  return ExitStatus::success;
}

// --- emit

constexpr deck::Words<sweep::Engine, 2> engine_words{
    {{"parallel", sweep::Engine::parallel}, {"slurm", sweep::Engine::slurm}}};

// The value of an option that becomes a line of the script.
std::string directive(const Options& options, const std::string& name) {
  const std::string value = options.text(name).value_or("");
  const auto ends_the_word = [](char c) { return c == ' ' || (c >= 0 && c < ' ') || c == '\x7f'; };
  if (std::any_of(value.begin(), value.end(), ends_the_word))
    throw InputError(fmt::format("--{} is \"{}\"; a line of Slurm takes a word without blanks", name, value));
  return value;
}

ExitStatus emit(const Options& options) {
  check_passed_on(options.passed_on(), traced_of(options.words().front()));
  const std::vector<std::string> engines = deck::texts(engine_words);
  const auto name = options.text("engine");
  if (!name) throw InputError(fmt::format("--engine is missing; it is {}", fmt::join(engines, " or ")));
  const auto engine = deck::from_text(engine_words, *name);
  if (!engine)
    throw InputError(fmt::format("there is no engine {}{}; there are {}", *name, suggestion(*name, engines),
                                 fmt::join(engines, " and ")));
  const fs::path folder = options.words().front();
  std::cout << sweep::script(*engine, {.program = fs::read_symlink(this_program),
                                       .folder = fs::absolute(folder),
                                       .cases = static_cast<int>(sweep::count_cases(folder)),
                                       .jobs = options.count("jobs"),
                                       .tasks = options.count("tasks"),
                                       .time = directive(options, "time"),
                                       .memory = directive(options, "memory"),
                                       .partition = directive(options, "partition"),
                                       .log = directive(options, "log"),
                                       .records = options.has("records"),
                                       .options = options.passed_on()});
  return ExitStatus::success;
}

// --- collect

std::vector<std::string> map_keys(const sweep::Sweep& sweep, const std::vector<std::string>& wanted) {
  constexpr std::size_t most = 2;
  std::vector<std::string> names;
  for (const sweep::Key& key : sweep.keys) names.push_back(key.name);
  for (const std::string& name : wanted)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw InputError(fmt::format("--over is {}, which is not varied{}; varied are {}", name, suggestion(name, names),
                                   fmt::join(names, ", ")));
  if (wanted.size() > most) throw InputError("--over is given more than twice; a map has two axes");
  if (!wanted.empty()) return wanted;
  names.resize(std::min(names.size(), most));
  return names;
}

std::vector<std::string> map_monitors(const sweep::Overview& of_all, const std::vector<std::string>& wanted) {
  for (const std::string& name : wanted)
    if (std::find(of_all.monitors.begin(), of_all.monitors.end(), name) == of_all.monitors.end())
      throw InputError(fmt::format("--monitor is {}, which no case has{}; they have {}", name,
                                   suggestion(name, of_all.monitors), fmt::join(of_all.monitors, ", ")));
  return wanted;
}

ExitStatus collect(const Options& options) {
  const sweep::Collection collection(options.words().front());
  const sweep::Overview of_all = sweep::overview(collection);
  sweep::SweepPage page(collection, of_all, map_keys(collection.sweep(), options.texts("over")),
                        map_monitors(of_all, options.texts("monitor")));
  sweep::Tables tables(collection, of_all);
  collection.visit([&](const sweep::Case& one, const sweep::CaseResult& result) {
    tables.add(one, result);
    page.add(one, result);
  });
  tables.finish();
  write_whole(collection.folder() / "report.html", page.text());
  std::cout << fmt::format("{} cases, {} ended as the deck asks; written: cases.csv, sweep.csv, {}report.html in {}\n",
                           collection.size(), collection.size() - of_all.failed,
                           collection.sweep().traced == Traced::curve ? "curves.csv, " : "",
                           collection.folder().string());
  print_failures(of_all);
  return ExitStatus::success;
}

}  // namespace

std::vector<Command> sweep_commands() {
  return {
      {.description = {.name = "sweep plan",
                       .example = "trace-path sweep plan sweep.toml --out study",
                       .usage = "SWEEP [options]",
                       .summary = "validate all cases and create a study folder",
                       .options = {{"out", "DIR",
                                    "folder to write into (default: the sweep's name without its ending)"}},
                       .least_words = 1,
                       .most_words = 1},
       .run = plan},
      {.description = {.name = "sweep run",
                       .example = "trace-path sweep run study --jobs 4 -- --max-points 2000",
                       .usage = "DIR [options] [-- options of run or curve]",
                       .summary = "run the cases that have no results yet; the same command continues",
                       .options = {{"case", "K", "run only this case; the first is 0"},
                                   {"part", "I/N", "run share I of N equal shares of the cases; the first is 0"},
                                   {"jobs", "N", "processes at a time (default: 1)"},
                                   {"max-time", "SECONDS", "end a case after that time; it counts as failed"},
                                   {"failed", "", "run the cases that failed again"},
                                   {"force", "", "run all cases again"},
                                   {"records", "", "keep results as lines of one file, without a folder for each case"},
                                   {"tolerant", "", "status 0 though cases failed: what they came to is a result"},
                                   {"quiet", "", "no progress and no counts"}},
                       .least_words = 1,
                       .most_words = 1,
                       .passes_on = true},
       .run = run_sweep},
      {.description = {.name = "sweep status",
                       .example = "trace-path sweep status study",
                       .usage = "DIR",
                       .summary = "show progress and failures, with reasons",
                       .least_words = 1,
                       .most_words = 1},
       .run = show_status},
      {.description = {.name = "sweep emit",
                       .example = "trace-path sweep emit study --engine slurm --time 0:30:00 --memory 2G >study.sh",
                       .usage = "DIR --engine parallel|slurm [options] [-- options of run]",
                       .summary = "print a job script for GNU parallel or Slurm",
                       .options = {{"engine", "parallel|slurm", "the program that runs the cases"},
                                   {"jobs", "N", "tasks at a time (default: that of the engine)"},
                                   {"tasks", "N", "share the cases among N tasks (default: one each, at most 1000)"},
                                   {"time", "LIMIT", "of a task of Slurm, as in 0:30:00"},
                                   {"memory", "SIZE", "of a task of Slurm, as in 2G"},
                                   {"partition", "NAME", "of Slurm"},
                                   {"log", "FILE", "what tasks of Slurm print, as in logs/%A_%a.txt"},
                                   {"records", "", "keep results as lines of a file for each task"}},
                       .least_words = 1,
                       .most_words = 1,
                       .passes_on = true},
       .run = emit},
      {.description = {.name = "sweep collect",
                       .example = "trace-path sweep collect study",
                       .usage = "DIR [options]",
                       .summary = "collect results into tables and maps of the event loads",
                       .options = {{.name = "over",
                                    .value = "KEY",
                                    .help = "varied key that the maps go over, one or two (default: the first two)",
                                    .repeatable = true},
                                   {.name = "monitor",
                                    .value = "NAME",
                                    .help = "monitor at the events to draw instead of λ, one or more",
                                    .repeatable = true}},
                       .least_words = 1,
                       .most_words = 1},
       .run = collect}};
}

}  // namespace arcwall
