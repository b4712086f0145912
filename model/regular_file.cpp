#include "model/regular_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "core/error.hpp"

namespace arcwall {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
  throw OutputError(file.string() + ": " + what);
}

[[noreturn]] void fail_by_system(const fs::path& file, int error) {
  fail(file, "cannot be read: " + std::generic_category().message(error));
}

std::string kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

void require_regular(const fs::path& file, const struct stat& about) {
  if (!S_ISREG(about.st_mode)) fail(file, "is " + kind_of(about.st_mode) + " where a file is expected");
}

}  // namespace

// The kind is asked before the file is opened, since opening a device may do something, and again behind that, since
// another file may have taken the name.
RegularFile::RegularFile(fs::path file, std::uintmax_t most) : path_(std::move(file)) {
  struct stat about {};
  if (::stat(path_.c_str(), &about) != 0) fail_by_system(path_, errno);
  require_regular(path_, about);
  descriptor_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (descriptor_ < 0) fail_by_system(path_, errno);
  try {
    if (::fstat(descriptor_, &about) != 0) fail_by_system(path_, errno);
    require_regular(path_, about);
    size_ = static_cast<std::uintmax_t>(about.st_size);
    if (size_ > most)
      fail(path_, "has " + std::to_string(size_) + " bytes, more than the " + std::to_string(most) +
                      " that such a file can have");
  } catch (const OutputError&) {
    ::close(descriptor_);
    throw;
  }
}

RegularFile::RegularFile(RegularFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_) {}

RegularFile::~RegularFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::string RegularFile::bytes(std::uintmax_t at, std::size_t count) const {
  std::string bytes(count, '\0');
  std::size_t read = 0;
  while (read < bytes.size()) {
    const ssize_t got = ::pread(descriptor_, bytes.data() + read, bytes.size() - read, static_cast<off_t>(at + read));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_by_system(path_, errno);
    if (got == 0) break;  // its end, or it has been cut meanwhile
    read += static_cast<std::size_t>(got);
  }
  bytes.resize(read);
  return bytes;
}

std::string bytes_of_regular_file(const fs::path& file, std::uintmax_t most) {
  const RegularFile opened(file, most);
  return opened.bytes(0, static_cast<std::size_t>(opened.size()));
}

}  // namespace arcwall
