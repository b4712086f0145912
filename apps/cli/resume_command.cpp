#include <iostream>

#include "answers/curve_session.hpp"
#include "apps/cli/commands.hpp"
#include "apps/cli/trace_and_write.hpp"
#include "apps/cli/trace_curve.hpp"
#include "core/error.hpp"

namespace arcwall {

namespace {

ExitStatus resume(const Options& options) {
  const Stopwatch since_begin;
  const std::filesystem::path where = options.words().front();
  const OutputFolder folder(where);  // before it is read, so that what is read is the last state
  const CallOptions call = call_options(options);
  StoredTracing stored = stored_tracing(where, Session::Resume::go_on);
  if (auto* const curve = std::get_if<CurveSession>(&stored)) {
    if (call.report == CallOptions::Report::json_lines)
      throw InputError("--json: " + where.string() + " holds a curve of events, which has no lines of JSON");
    if (curve->tracing().has_ended()) std::cerr << "note: the curve had ended; nothing is left to trace\n";
    return trace_curve_and_write(*curve, folder, call);
  }
  auto& run = std::get<Session>(stored);
  if (run.has_ended()) std::cerr << "note: the run had ended; nothing is left to trace\n";
  return trace_and_write(run, folder, call, since_begin);
}

}  // namespace

Command resume_command() {
  return {.description = {.name = "resume",
                          .example = "trace-path resume results --max-time 3600",
                          .usage = "DIR [options]",
                          .summary = "continue a run or a curve that was interrupted or met a limit",
                          .options = call_options(),
                          .least_words = 1,
                          .most_words = 1},
          .run = resume};
}

}  // namespace arcwall
