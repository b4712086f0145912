#pragma once

#include <string>
#include <vector>

namespace arcwall {

/// Whether the header of a table names units, as in `mid [cm]`.
enum class UnitLabels { shown, left_out };

/// Whether every attempted step is kept in the record.
enum class StepLedger { kept, none };

/// What a run is of, and how its files are written.
struct RunDescription {
  std::string deck{};  ///< file, as the user named it
  std::string deck_text{};
  std::vector<std::string> assignments{};  ///< of --set
  UnitLabels units = UnitLabels::shown;
  StepLedger ledger = StepLedger::none;

  /// Visits all of it.
  template <typename Archive>
  void serialize(Archive& archive) {
    bool shown = units == UnitLabels::shown;
    bool kept = ledger == StepLedger::kept;
    archive(deck, deck_text, assignments, shown, kept);
    ledger = kept ? StepLedger::kept : StepLedger::none;
    units = shown ? UnitLabels::shown : UnitLabels::left_out;
  }
};

}  // namespace arcwall
