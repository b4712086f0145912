// Checkpoints: they are refused with an OutputError, or the run goes on. An input that begins as a checkpoint does is
// read as a file. Of others the first byte says of which kept run they are. If it is the run's number the rest is the
// content of a checkpoint, without the length and sum that hardly any altered bytes would have; else the rest are edits
// of what the run kept, which leave most of it in order and get further.
//
// What the run is of stays as it is: decks are the matter of the other targets. To take a point costs a hundred times
// as much as to read, so one input in 128 does.
#include <fuzzer/FuzzedDataProvider.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string_view>

#include "answers/deck_answers.hpp"
#include "core/error.hpp"
#include "model/checkpoint/archive.hpp"
#include "model/checkpoint/checkpoint_file.hpp"
#include "model/session_content.hpp"
#include "tests/fuzz/edited_content.hpp"
#include "tests/fuzz/kept_runs.hpp"
#include "tests/fuzz/one_in.hpp"

namespace arcwall::fuzz {
namespace {

using nlohmann::json;

// How far the inputs came; printed at the end.
struct Tally {
  long taken_up = 0, gone_on = 0;

  ~Tally() { std::fprintf(stderr, "taken up: %ld\ngone on: %ld\n", taken_up, gone_on); }
} tally;

bool is_to_go_on(std::string_view bytes) { return is_one_in(128, bytes); }

void take_up(const json& kept, json content, bool go_on) try {
  if (!content.is_array() || content.size() < head_entries) return;
  std::copy_n(kept.begin(), head_entries, content.begin());
  Session run = SessionContent::read(content, "checkpoint", Session::Resume::go_on, deck_answers());
  ++tally.taken_up;
  if (!go_on) return;
  run.next();
  ++tally.gone_on;
} catch (const OutputError&) {
}

void read_file(std::string_view bytes) try { from_checkpoint(bytes, "checkpoint"); } catch (const OutputError&) {
}

void read_content(const json& kept, std::string_view bytes, bool go_on) try {
  take_up(kept, from_cbor(bytes), go_on);
} catch (const BadArchive&) {
}

void read(std::string_view bytes) {
  if (bytes.empty()) return;
  const auto first = static_cast<std::uint8_t>(bytes.front());
  const json& kept = kept_runs()[first % kept_runs().size()];
  if (bytes.starts_with("arcwall")) {
    read_file(bytes);
  } else if (first < kept_runs().size()) {
    read_content(kept, bytes.substr(1), is_to_go_on(bytes));
  } else {
    FuzzedDataProvider data(reinterpret_cast<const std::uint8_t*>(bytes.data()) + 1, bytes.size() - 1);
    take_up(kept, edited(kept, data), is_to_go_on(bytes));
  }
}

}  // namespace
}  // namespace arcwall::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  arcwall::fuzz::read({reinterpret_cast<const char*>(data), size});
  return 0;
}
