// Any bytes as a checkpoint: it is refused with an OutputError, or the run goes on for some points. The first byte says
// of which run; the rest is the content of its checkpoint, to which the right length and sum are added, since hardly
// any altered bytes would pass these. What the run is of stays as it is: decks are the matter of the other targets.
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>

#include "apps/checkpoint/archive.hpp"
#include "apps/checkpoint/checkpoint_file.hpp"
#include "apps/run/run_under_way.hpp"
#include "core/error.hpp"
#include "tests/fuzz/kept_runs.hpp"

namespace arcwall::fuzz {
namespace {

constexpr int most_points = 2;

void take_up(const nlohmann::json& kept, std::string_view bytes) try {
  nlohmann::json content = from_cbor(bytes);
  constexpr std::size_t version = 0, description = 1;
  if (!content.is_array() || content.size() < 2) return;
  content[version] = kept[version];
  content[description] = kept[description];
  RunUnderWay run = RunUnderWay::from(to_checkpoint(content), "checkpoint", RunUnderWay::Resume::go_on);
  for (int points = 0; points < most_points && run.advance(); ++points) continue;
} catch (const BadArchive&) {
} catch (const OutputError&) {
}

void read(std::string_view bytes) {
  try {
    from_checkpoint(bytes, "checkpoint");
  } catch (const OutputError&) {
  }
  if (bytes.empty()) return;
  const auto which = static_cast<std::uint8_t>(bytes.front()) % kept_runs().size();
  take_up(kept_runs()[which], bytes.substr(1));
}

}  // namespace
}  // namespace arcwall::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  arcwall::fuzz::read({reinterpret_cast<const char*>(data), size});
  return 0;
}
