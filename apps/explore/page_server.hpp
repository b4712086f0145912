#pragma once

#include <functional>
#include <string>

#include "apps/explore/worker.hpp"

namespace arcwall::explore {

/// Serves the page of one deck on 127.0.0.1, to those who know its address: until a signal asks for the end, or until
/// no browser has shown the page for a moment. `listening` is told the address, which has a random part.
///
/// Answers go only to requests whose Host, and Origin where there is one, are this server; others get 403. Nothing is
/// written; of files only those are read that the deck names. Throws OutputError where no port is to be had.
void serve(const EditedDeck& deck, const TraceLimits& limits, const std::function<void(const std::string&)>& listening);

}  // namespace arcwall::explore
