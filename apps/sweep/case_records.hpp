#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/sweep/design.hpp"
#include "model/regular_file.hpp"

/// Results of cases as lines of a few files, where a folder for each case would be too many: `results/0-of-1.jsonl`.
/// Each process appends to a file of its own.
namespace arcwall::sweep {

inline constexpr const char* records_folder_name = "results";

/// Of N equal shares of the cases the one with number I: I, I + N, …
struct Part {
  std::size_t number = 0, parts = 1;

  bool has(std::size_t case_number) const { return case_number % parts == number; }
};

/// What the line of a case says before all else.
enum class RecordKind {
  result,     ///< what the case came to
  hindered,   ///< a full disk, too little memory or a kill kept it from its end
  forgotten,  ///< what earlier rounds say of it no longer holds
};

/// Where the record of each case is. 16 bytes a case; the records stay on the disk.
class RecordIndex {
 public:
  /// Of `cases` cases. With a part, files of other parts of the same number are not looked at: they have none of its
  /// cases. Throws OutputError.
  RecordIndex(const std::filesystem::path& sweep_folder, std::size_t cases, const Part& part = {});

  bool has(int number) const { return kind(number) == RecordKind::result || was_hindered(number); }
  bool was_hindered(int number) const { return kind(number) == RecordKind::hindered; }

  /// The record of a case that has one. Throws OutputError if it is damaged.
  Json read(int number) const;

  /// Rounds count up when cases are run again though they have results. The last of any case, and that of a case.
  std::uint16_t last_round() const { return last_round_; }
  std::uint16_t round_of(int number) const;

  /// That case `number` has no record in this round.
  void forget(int number, std::uint16_t round);

 private:
  struct Place {
    std::uint64_t begin = 0;
    std::uint32_t file = no_file;
    std::uint16_t round = 0;
    RecordKind kind = RecordKind::forgotten;
  };
  static constexpr std::uint32_t no_file = UINT32_MAX;

  void read_file(const std::filesystem::path& file);
  std::optional<RecordKind> kind(int number) const;

  std::vector<Place> places_;
  std::vector<RegularFile> files_{};
  std::uint16_t last_round_ = 0;
};

/// A file of records that this process alone appends to.
class RecordWriter {
 public:
  /// Takes the file of the part. What a killed process left behind the last line is cut off. Throws OutputError, also
  /// where another process has the file.
  RecordWriter(const std::filesystem::path& sweep_folder, const Part& part);
  RecordWriter(const RecordWriter&) = delete;
  RecordWriter& operator=(const RecordWriter&) = delete;

  /// What was appended is on the disk.
  ~RecordWriter();

  /// `content`: an object, of which the line has the members; empty for what is forgotten. Whole or not at all; throws
  /// OutputError.
  void append(int number, std::uint16_t round, RecordKind kind, const Json& content = Json::object());

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uintmax_t size_ = 0;
};

}  // namespace arcwall::sweep
