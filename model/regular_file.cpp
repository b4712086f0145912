#include "model/regular_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

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

class Descriptor {
 public:
  explicit Descriptor(const fs::path& file)
      : number_(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {
    if (number_ < 0) fail_by_system(file, errno);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { ::close(number_); }

  int number() const { return number_; }

 private:
  int number_;
};

}  // namespace

// The kind is asked before the file is opened, since opening a device may do something, and again behind that, since
// another file may have taken the name.
std::string bytes_of_regular_file(const fs::path& file, std::uintmax_t most) {
  struct stat about {};
  if (::stat(file.c_str(), &about) != 0) fail_by_system(file, errno);
  require_regular(file, about);
  const Descriptor descriptor(file);
  if (::fstat(descriptor.number(), &about) != 0) fail_by_system(file, errno);
  require_regular(file, about);
  if (static_cast<std::uintmax_t>(about.st_size) > most)
    fail(file, "has " + std::to_string(about.st_size) + " bytes, more than the " + std::to_string(most) +
                   " that such a file can have");
  std::string bytes(static_cast<std::size_t>(about.st_size), '\0');
  std::size_t count = 0;
  while (count < bytes.size()) {
    const ssize_t got = ::read(descriptor.number(), bytes.data() + count, bytes.size() - count);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_by_system(file, errno);
    if (got == 0) break;  // it has been cut meanwhile
    count += static_cast<std::size_t>(got);
  }
  bytes.resize(count);
  return bytes;
}

}  // namespace arcwall
