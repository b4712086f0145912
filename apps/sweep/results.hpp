#pragma once

#include <filesystem>

#include "apps/sweep/case_records.hpp"
#include "apps/sweep/case_result.hpp"

namespace arcwall::sweep {

/// What the cases of a sweep have come to, in folders of theirs or in records.
class Results {
 public:
  /// Of all cases, or of a part of them. Throws OutputError.
  Results(std::filesystem::path sweep_folder, std::size_t cases, const Part& part = {});

  /// Whether there are results of a case.
  bool has(int number) const;

  /// Whether something outside hindered a case that has results.
  bool was_hindered(int number) const;

  /// OutputError if results are there but damaged.
  CaseResult read(int number) const;

  /// The folder with the case's results; empty if they are in a record or there are none.
  std::optional<std::filesystem::path> folder(int number) const;

  const RecordIndex& records() const { return records_; }
  RecordIndex& records() { return records_; }

 private:
  std::filesystem::path sweep_folder_;
  bool has_folders_;  // else nobody has to look for each case's
  RecordIndex records_;
};

}  // namespace arcwall::sweep
