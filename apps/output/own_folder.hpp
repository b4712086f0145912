#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace arcwall {

/// A folder that the program keeps for itself, as `shapes` in those of runs or the draft of a case: all that it empties
/// it opens in this way. No link is followed, whatever takes the folder's name later.
class OwnFolder {
 public:
  /// Empty where nothing has the name. Throws OutputError, which names the path, for a link and all else that is no
  /// folder.
  static std::optional<OwnFolder> open(const std::filesystem::path& path);

  OwnFolder(OwnFolder&& other) noexcept;
  OwnFolder& operator=(OwnFolder&&) = delete;
  OwnFolder(const OwnFolder&) = delete;
  ~OwnFolder();

  const std::filesystem::path& path() const { return path_; }

  /// Owned by this object unless it is released.
  int descriptor() const { return descriptor_; }
  int release();

  /// What is in it, without order. Throws OutputError.
  std::vector<std::string> names() const;

  /// Whether `name` in it is a regular file, and no link to one.
  bool has_file(const std::string& name) const;

  /// Takes away what has that name, a folder with all that is in it; a link, not what it leads to. Throws OutputError.
  void remove(const std::string& name) const;

 private:
  OwnFolder(std::filesystem::path path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}

  std::filesystem::path path_;
  int descriptor_;
};

}  // namespace arcwall
