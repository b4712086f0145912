#pragma once

#include <filesystem>
#include <list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/output/folder_lock.hpp"
#include "model/run_description.hpp"

namespace arcwall {

/// A text in parts that follow each other.
using Pieces = std::vector<std::string_view>;

/// A file under a hidden name beside its place, which goes away unless it is put there. Throws OutputError.
class StagedFile {
 public:
  /// Empty; what stands at `target` is not touched.
  explicit StagedFile(std::filesystem::path target);
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;
  ~StagedFile();

  void write(const Pieces& text);
  void write(std::string_view text) { write(Pieces{text}); }

  /// What was written is on the disk when this returns.
  void flush_to_disk() const;

  /// No more is written.
  void close();

  /// Replaces what stands at the target. It is closed.
  void put_in_place();

 private:
  [[noreturn]] void give_up(int error) const;

  std::filesystem::path target_;
  std::filesystem::path path_;
  int descriptor_;
};

/// Writes beside `file` under a hidden name and renames: `file` is whole, or what it was before. Throws OutputError.
void write_whole(const std::filesystem::path& file, const Pieces& text);
inline void write_whole(const std::filesystem::path& file, std::string_view text) { write_whole(file, Pieces{text}); }

/// The same, and the file is on the disk when this returns, whatever happens to the machine then.
void write_durably(const std::filesystem::path& file, std::string_view text);

/// Throws InputError if a file that is written into `folder` would replace `input`, the file with the deck.
void require_other_than_input(const std::filesystem::path& folder, const std::filesystem::path& input);

/// What is done with a folder that something other than the same deck filled.
enum class Foreign { refuse, overwrite };

/// Which deck results are of.
struct DeckIdentity {
  DeckIdentity() = default;
  DeckIdentity(std::string name) : file(std::move(name)) {}
  DeckIdentity(const char* name) : file(name) {}
  DeckIdentity(std::string name, std::string whole, std::string crc)
      : file(std::move(name)), path(std::move(whole)), crc32(std::move(crc)) {}

  std::string file{};   ///< its name without folder
  std::string path{};   ///< the whole path; empty if it is not known
  std::string crc32{};  ///< of its text; empty if it is not known
};

/// That of the deck of a run.
DeckIdentity identity_of(const RunDescription& run);

/// The path of a file from the root on, without links.
std::string whole_path(const std::filesystem::path& file);

/// Of which other deck results are in the folder; empty if none are, or those of this one: a deck is the same while its
/// file has the same name and place, whatever has been changed in it, or the same name and text, wherever it lies.
std::optional<DeckIdentity> results_of_another(const std::filesystem::path& folder, const DeckIdentity& deck);

/// What `--force` takes away, as a note; empty if nothing.
std::string note_of_replaced(const std::filesystem::path& folder, const DeckIdentity& deck);

/// Throws OutputError if `folder` is no folder, or is foreign and to be refused: it is not empty, and its result.json,
/// or without one its convergence.json, curve.json or checkpoint, is not of this deck. Changes nothing.
void require_usable(const std::filesystem::path& folder, const DeckIdentity& deck, Foreign foreign);

/// The folder that a run writes its files into, and no other process meanwhile.
class OutputFolder {
 public:
  /// Makes the folder and its parents if they are not there, and sees that a file can be written into it. Files that a
  /// killed process has left half written are removed. Throws OutputError, also where another process is writing into
  /// the folder; require_usable() holds.
  OutputFolder(std::filesystem::path folder, const DeckIdentity& deck, Foreign foreign);

  /// The same of a folder that is there, whatever filled it.
  explicit OutputFolder(std::filesystem::path folder);

  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// A folder that this made and that is still empty is taken away.
  ~OutputFolder();

  const std::filesystem::path& path() const { return folder_; }

  /// Writes one file whole. Throws OutputError.
  void write_whole(const std::string& name, std::string_view text) const;

  /// The same, and the file is on the disk when this returns, whatever happens to the machine then.
  void write_durably(const std::string& name, std::string_view text) const;

 private:
  void take();

  std::filesystem::path folder_;
  std::optional<FolderLock> lock_{};
  bool made_ = false;
};

/// Files of a folder that belong together: none is put in place before all are written, so a disk that is full leaves
/// those of an earlier run as they were. A power cut may lose them; what they show is in the checkpoint, which
/// write_durably() has written before.
class FileSet {
 public:
  explicit FileSet(const OutputFolder& folder) : folder_(folder.path()) {}

  /// Throws OutputError.
  void write(const std::string& name, std::string_view text) { write(name, Pieces{text}); }
  void write(const std::string& name, const Pieces& text);

  /// In the order in which they were written. Throws OutputError.
  void put_in_place();

 private:
  std::filesystem::path folder_;
  std::list<StagedFile> files_{};
};

}  // namespace arcwall
