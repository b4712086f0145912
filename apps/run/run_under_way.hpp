#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/output/path_csv.hpp"
#include "apps/output/record.hpp"
#include "apps/run/tracing.hpp"
#include "apps/study.hpp"

namespace arcwall {

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

/// A run that is traced, kept and taken up again. Taken up, it goes on to the last bit as if it had never stopped.
class RunUnderWay {
 public:
  /// Reads and builds the deck. Throws InputError.
  explicit RunUnderWay(RunDescription description);

  /// Finds the start; `reason` says why there is none.
  bool begin(std::string& reason);

  /// One more point; false when everything has ended.
  bool advance();

  /// Whether every branch has its end.
  bool has_ended() const;

  /// Ends everything where it is, from outside. A checkpoint does not know of it but for `stopped`.
  void stop(const BranchEnd& end);

  const RunDescription& description() const { return description_; }
  const Study& study() const { return *study_; }
  const Record& record() const { return *record_; }

  /// Bytes from which the run can be taken up where it is; `stopped`, if it ends here for a reason from outside.
  std::string checkpoint(const std::optional<BranchEnd>& stopped = {});

  enum class Resume {
    go_on,     ///< from where the run was stopped
    as_ended,  ///< with the end that it had when it was stopped
  };

  /// The run of a checkpoint. Throws OutputError, which names `file`, for bytes that are none of this program.
  static RunUnderWay from(std::string_view checkpoint, const std::string& file, Resume how);

  /// The same for what a checkpoint contains. A `study` is taken for what the deck in it builds; it must not be that of
  /// another run if load increments are taken.
  static RunUnderWay from_content(const nlohmann::json& content, const std::string& file, Resume how,
                                  std::shared_ptr<Study> study = nullptr);

 private:
  RunUnderWay(RunDescription description, std::shared_ptr<Study> study);

  RunDescription description_;
  std::shared_ptr<Study> study_;
  std::unique_ptr<Record> record_;
  State start_{};
  std::unique_ptr<Tracing> tracing_;
};

/// The run whose files are in a folder, from its checkpoint. Throws OutputError if there is none or it cannot be read.
RunUnderWay stored_run(const std::filesystem::path& folder, RunUnderWay::Resume how);

}  // namespace arcwall
