#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/sweep/design.hpp"
#include "model/run_description.hpp"

namespace arcwall::sweep {

/// A key of the deck, as of `--set`, and where the sweep names it.
struct Key {
  std::string name{};
  deck::Position position{};
};

/// A key that follows a varied one: offset + factor · value.
struct Tie {
  Key key{};
  std::size_t to = 0;  ///< which of the varied keys
  double factor = 1.0;
  double offset = 0.0;
};

/// A parameter study: one deck, and in each case other values for some of its keys.
struct Sweep {
  deck::Source source{};
  std::string title{};
  std::string deck{};  ///< file, from the sweep's folder
  deck::Position deck_position{};
  Traced traced = Traced::path;  ///< of each case, by `command`
  std::vector<Key> keys{};
  std::vector<std::vector<Json>> rows{};  ///< one a case; the values of the keys in their order
  std::vector<Tie> ties{};
};

/// No sweep has more cases, and none of more than `most_folders` has a folder for each.
inline constexpr int most_cases = 1'000'000, most_folders = 20'000;

/// Whether a sweep is read with the values of its cases, which a planned one has in its list of cases.
enum class Rows { made, left_out };

/// Reads and checks a sweep. Everything that is wrong with it is in one InputError.
Sweep read_sweep(const std::string& file, Rows rows = Rows::made);

/// The same for a text in memory; `file_name` is only named in messages.
Sweep read_sweep_text(std::string_view text, const std::string& file_name, Rows rows = Rows::made);

}  // namespace arcwall::sweep
