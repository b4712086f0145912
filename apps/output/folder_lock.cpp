#include "apps/output/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "core/error.hpp"

namespace arcwall {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& what, const std::string& message) {
  throw OutputError(what.string() + ": " + message);
}

// Where the folder lies on a disk of several machines, a process id says little without the machine's name.
std::string name_of_machine() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return "";
  return name.data();
}

std::string owner_text() { return std::to_string(::getpid()) + " " + name_of_machine() + "\n"; }

// `process 1234`, and its machine if that is another one.
std::string owner(int descriptor) {
  std::array<char, 300> text{};
  const ssize_t count = ::pread(descriptor, text.data(), text.size() - 1, 0);
  const std::string line(text.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
  const std::size_t blank = line.find(' '), end = line.find('\n');
  if (blank == 0 || blank == std::string::npos || end == std::string::npos || blank > end) return "another process";
  const std::string machine = line.substr(blank + 1, end - blank - 1);
  return "process " + line.substr(0, blank) + (machine == name_of_machine() ? "" : " on " + machine);
}

// Whether the file with this name is the one that was opened: who held the lock before may have removed that.
bool is_named(int descriptor, const fs::path& file) {
  struct stat held {
  }, named{};
  return ::fstat(descriptor, &held) == 0 && ::stat(file.c_str(), &named) == 0 && held.st_dev == named.st_dev &&
         held.st_ino == named.st_ino;
}

}  // namespace

FolderLock::FolderLock(fs::path folder) : file_(folder / folder_lock_name) {
  for (;;) {
    const int descriptor = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
    if (descriptor < 0) fail(folder, "nothing can be written into it: " + std::generic_category().message(errno));
    const bool free = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
    const std::string who = free ? std::string() : owner(descriptor);
    const bool current = is_named(descriptor, file_);
    if (free && current) {
      descriptor_ = descriptor;
      break;
    }
    ::close(descriptor);
    if (!current) continue;
    fail(folder, who + " is writing into this folder; wait until it ends, or name another folder with --out");
  }
  const std::string text = owner_text();
  if (::ftruncate(descriptor_, 0) != 0 || ::pwrite(descriptor_, text.data(), text.size(), 0) < 0) {
    // Others are held off without a name, too.
  }
}

// Removed while it is still locked: whoever opens it now sees that it has no name any more, and tries again.
FolderLock::~FolderLock() {
  ::unlink(file_.c_str());
  ::close(descriptor_);
}

}  // namespace arcwall
