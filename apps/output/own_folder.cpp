#include "apps/output/own_folder.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <memory>
#include <system_error>
#include <utility>

#include "core/error.hpp"

namespace arcwall {

namespace fs = std::filesystem;

namespace {

constexpr int as_folder = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;

[[noreturn]] void fail_by_system(const fs::path& path, const std::string& what) {
  throw OutputError(path.string() + ": " + what + ": " + std::generic_category().message(errno));
}

// `descriptor` stays open: the stream has one of its own, and begins at the front.
std::vector<std::string> names_of(int descriptor, const fs::path& path) {
  const int own = ::openat(descriptor, ".", as_folder);
  if (own < 0) fail_by_system(path, "cannot be read");
  const std::unique_ptr<DIR, int (*)(DIR*)> stream(::fdopendir(own), &::closedir);
  if (!stream) {
    ::close(own);
    fail_by_system(path, "cannot be read");
  }
  std::vector<std::string> names;
  for (errno = 0; const dirent* entry = ::readdir(stream.get()); errno = 0) {
    std::string name = entry->d_name;
    if (name != "." && name != "..") names.push_back(std::move(name));
  }
  if (errno != 0) fail_by_system(path, "cannot be read");
  return names;
}

// Another process may have removed it meanwhile, which is as well.
void remove_in(int folder, const std::string& name, const fs::path& path) {
  if (::unlinkat(folder, name.c_str(), 0) == 0 || errno == ENOENT) return;
  if (errno != EISDIR && errno != EPERM) fail_by_system(path, "cannot be removed");
  const int inner = ::openat(folder, name.c_str(), as_folder);
  if (inner < 0) fail_by_system(path, "cannot be removed");
  try {
    for (const std::string& one : names_of(inner, path)) remove_in(inner, one, path / one);
  } catch (const OutputError&) {
    ::close(inner);
    throw;
  }
  ::close(inner);
  if (::unlinkat(folder, name.c_str(), AT_REMOVEDIR) != 0 && errno != ENOENT) fail_by_system(path, "cannot be removed");
}

}  // namespace

std::optional<OwnFolder> OwnFolder::open(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), as_folder);
  if (descriptor >= 0) return OwnFolder(path, descriptor);
  if (errno == ENOENT) return std::nullopt;
  if (errno != ENOTDIR && errno != ELOOP) fail_by_system(path, "cannot be opened");
  std::error_code ignored;
  throw OutputError(path.string() + (fs::is_symlink(path, ignored) ? ": is a link" : ": is no folder") +
                    " where the program keeps a folder of its own; remove it, or name another folder");
}

OwnFolder::OwnFolder(OwnFolder&& other) noexcept : path_(std::move(other.path_)), descriptor_(other.release()) {}

OwnFolder::~OwnFolder() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

int OwnFolder::release() { return std::exchange(descriptor_, -1); }

std::vector<std::string> OwnFolder::names() const { return names_of(descriptor_, path_); }

bool OwnFolder::has_file(const std::string& name) const {
  struct stat about {};
  return ::fstatat(descriptor_, name.c_str(), &about, AT_SYMLINK_NOFOLLOW) == 0 && S_ISREG(about.st_mode);
}

void OwnFolder::remove(const std::string& name) const { remove_in(descriptor_, name, path_ / name); }

}  // namespace arcwall
