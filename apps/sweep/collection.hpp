#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/sweep/case_result.hpp"
#include "model/deck/deck.hpp"

namespace arcwall::sweep {

/// A sweep with all that its cases came to so far.
struct Collection {
  Sweep sweep{};
  std::vector<Case> cases{};
  std::vector<CaseResult> results{};  ///< one a case
  deck::Deck deck{};                  ///< of the first case; without members if it cannot be read
};

/// Reads a planned folder; cases that have not been run are part of it. InputError, OutputError.
Collection collect(const std::filesystem::path& folder);

/// The value that a case gives to a varied key.
const Json& value_of(const Case& one, const std::string& key);

/// sweep.csv: one row an event of each case.
std::string sweep_csv(const Collection& collection);

/// cases.csv: one row a case.
std::string cases_csv(const Collection& collection);

/// Why cases failed, or have not been run.
struct Failure {
  std::string reason{};
  std::vector<int> cases{};
};

/// Each reason once, in the order of the first case that has it.
std::vector<Failure> failures(const Collection& collection);

/// `3, 8, 12, …`: the first few of the numbers.
std::string listed(const std::vector<int>& numbers);

}  // namespace arcwall::sweep
