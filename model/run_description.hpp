#pragma once

#include <string>
#include <vector>

namespace arcwall {

/// Whether the header of a table names units, as in `mid [cm]`.
enum class UnitLabels { shown, left_out };

/// Whether every attempted step is kept in the record.
enum class StepLedger { kept, none };

/// What is traced of a deck.
enum class Traced {
  path,   ///< its paths
  curve,  ///< the event of its `[curve]`, while a number varies
};

/// What a run is of, and how its files are written.
struct RunDescription {
  std::string deck{};  ///< file, as the user named it
  std::string deck_text{};
  std::string deck_path{};                 ///< that of the file, whole; empty where the text is not from one
  std::vector<std::string> assignments{};  ///< of --set
  UnitLabels units = UnitLabels::shown;
  StepLedger ledger = StepLedger::none;
  Traced traced = Traced::path;

  /// Visits all of it.
  template <typename Archive>
  void serialize(Archive& archive) {
    bool shown = units == UnitLabels::shown;
    bool kept = ledger == StepLedger::kept;
    bool of_curve = traced == Traced::curve;
    archive(deck, deck_text, deck_path, assignments, shown, kept, of_curve);
    traced = of_curve ? Traced::curve : Traced::path;
    ledger = kept ? StepLedger::kept : StepLedger::none;
    units = shown ? UnitLabels::shown : UnitLabels::left_out;
  }
};

}  // namespace arcwall
