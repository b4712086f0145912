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

}  // namespace arcwall
