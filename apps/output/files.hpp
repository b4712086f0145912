#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace arcwall {

/// Writes beside `file` under a hidden name and renames: `file` is whole, or what it was before. Throws OutputError.
void write_whole(const std::filesystem::path& file, std::string_view text);

/// What is done with a folder that something other than the same deck filled.
enum class Foreign { refuse, overwrite };

/// Throws OutputError if `folder` is no folder, or is foreign and to be refused: it is not empty and its result.json
/// does not name `deck`, a file name without folder. Changes nothing.
void require_usable(const std::filesystem::path& folder, const std::string& deck, Foreign foreign);

/// The folder that a run writes its files into.
class OutputFolder {
 public:
  /// Makes the folder and its parents if they are not there, and sees that a file can be written into it. Throws
  /// OutputError; require_usable() holds.
  OutputFolder(std::filesystem::path folder, const std::string& deck, Foreign foreign);

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
  std::filesystem::path folder_;
  bool made_ = false;
};

}  // namespace arcwall
