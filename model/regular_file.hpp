#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace arcwall {

/// More than any file of a run or of a sweep has: 16 GiB.
inline constexpr std::uintmax_t largest_stored_file = std::uintmax_t{1} << 34;

/// The bytes of a regular file, or of one that a link leads to. Nothing else is opened: a pipe would wait for somebody
/// who writes, and a device may never end. Throws OutputError, which names the file, for all that is no regular file,
/// has more than `most` bytes, or cannot be read.
std::string bytes_of_regular_file(const std::filesystem::path& file, std::uintmax_t most = largest_stored_file);

/// A regular file that is read in parts. Throws OutputError as bytes_of_regular_file() does.
class RegularFile {
 public:
  explicit RegularFile(std::filesystem::path file, std::uintmax_t most = largest_stored_file);
  RegularFile(RegularFile&& other) noexcept;
  RegularFile& operator=(RegularFile&&) = delete;
  RegularFile(const RegularFile&) = delete;
  ~RegularFile();

  const std::filesystem::path& path() const { return path_; }

  /// When it was opened.
  std::uintmax_t size() const { return size_; }

  /// At most `count` bytes from there on; fewer at the end of the file.
  std::string bytes(std::uintmax_t at, std::size_t count) const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uintmax_t size_ = 0;
};

}  // namespace arcwall
