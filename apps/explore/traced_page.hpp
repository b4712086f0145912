#pragma once

#include <functional>
#include <string>

namespace arcwall::explore {

/// A deck as its reader has changed it.
struct EditedDeck {
  std::string file{};  ///< as the user named it, for messages and for the files that the deck names
  std::string text{};
};

/// Takes one line of JSON.
using LineSink = std::function<void(const std::string& line)>;

/// Traces a deck and gives lines: `{"progress": …}` now and then, and one that ends it: the page of the run, as it is
/// written into a folder of results but without scripts, or what is wrong. After that time [s] the run is stopped, and
/// what was traced is given.
void trace_to_page(const EditedDeck& deck, double most_seconds, const LineSink& give);

}  // namespace arcwall::explore
