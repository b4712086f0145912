#pragma once

#include <string>
#include <vector>

#include "apps/verify/findings.hpp"
#include "model/model.hpp"
#include "model/record.hpp"

/// Checks a run again by plain formulas: strain energies of its own with automatic derivatives, walls evaluated from
/// the deck, dense eigenvalues. Of what tracing computes with take part the stress-free axes, where the nodes of a mesh
/// that slides are, how its elements bend beside contacts, the pressure of compliant walls, and in the balance of work
/// the rate of the energy by λ.
namespace arcwall::verify {

/// The files of a run as texts; contacts_csv is empty of decks without walls.
struct StoredFiles {
  std::string path_csv{}, contacts_csv{}, events_json{}, result_json{}, deck_toml{};
};

struct Verdict {
  Findings findings{};
  std::vector<std::string> not_checked{};  ///< one sentence each
};

/// `record` holds the states, `states_file` is the name under which messages speak of them.
Verdict verify(const Model& model, const Record& record, const StoredFiles& files, const std::string& states_file);

/// The table of worst figures, and what was not checked.
std::string to_text(const Verdict& verdict);

/// The first failure: file, branch, step, what, value and bound.
std::string to_text(const Failure& failure);

}  // namespace arcwall::verify
