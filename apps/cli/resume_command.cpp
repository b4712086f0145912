#include <iostream>

#include "apps/cli/commands.hpp"
#include "apps/cli/trace_and_write.hpp"

namespace arcwall {

namespace {

ExitStatus resume(const Options& options) {
  const Stopwatch since_begin;
  const std::filesystem::path where = options.words().front();
  const OutputFolder folder(where);  // before it is read, so that what is read is the last state
  Session run = stored_session(where, Session::Resume::go_on);
  if (run.has_ended()) std::cerr << "note: the run had ended; nothing is left to trace\n";
  return trace_and_write(run, folder, call_options(options), since_begin);
}

}  // namespace

Command resume_command() {
  return {.description = {.name = "resume",
                          .example = "trace-path resume results --max-time 3600",
                          .usage = "DIR [options]",
                          .summary = "goes on with a run that was interrupted or met a limit",
                          .options = call_options(),
                          .least_words = 1,
                          .most_words = 1},
          .run = resume};
}

}  // namespace arcwall
