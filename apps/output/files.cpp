#include "apps/output/files.hpp"

#include <fcntl.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "apps/output/own_folder.hpp"
#include "apps/output/result_json.hpp"
#include "core/error.hpp"
#include "model/checkpoint/checkpoint_file.hpp"
#include "model/regular_file.hpp"

namespace arcwall {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& file, const std::string& what, const std::string& reason) {
  throw OutputError(file.string() + ": " + what + ": " + reason);
}

// Empty where there is no regular file.
std::string bytes_if_any(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored) ? bytes_of_regular_file(file) : std::string();
}

// The deck that filled a folder, by its result.json, or of a run that has not ended by its checkpoint; without a name
// if that cannot be told.
DeckIdentity filled_by(const fs::path& folder) {
  std::error_code ignored;
  const std::array<const char*, 3> files{"result.json", "convergence.json", "curve.json"};
  const auto first =
      std::find_if(files.begin(), files.end(), [&](const char* name) { return fs::exists(folder / name, ignored); });
  if (first == files.end()) {
    const DeckOfCheckpoint deck = deck_of_checkpoint(bytes_if_any(folder / "checkpoint"));
    return {deck.file, deck.path, crc32_text(deck.text)};
  }
  const nlohmann::json result = nlohmann::json::parse(bytes_if_any(folder / *first), nullptr, false);
  const auto text = [&](const char* pointer) {
    const auto at = nlohmann::json::json_pointer(pointer);
    return result.is_object() && result.contains(at) && result.at(at).is_string() ? result.at(at).get<std::string>()
                                                                                  : std::string();
  };
  return {text("/deck/file"), text("/deck/path"), text("/deck/crc32")};
}

// Where the place or the text of one of them is not known, the name has to do.
bool is_same(const DeckIdentity& a, const DeckIdentity& b) {
  if (a.file != b.file) return false;
  const bool known = !a.path.empty() && !b.path.empty() && !a.crc32.empty() && !b.crc32.empty();
  return !known || a.path == b.path || a.crc32 == b.crc32;
}

const std::string& shown_path(const DeckIdentity& deck) { return deck.path.empty() ? deck.file : deck.path; }

// What is written into the folder of a run or of a study of meshes, besides shapes.
constexpr std::array output_names{"branches.json",    "path.csv",        "contacts.csv", "events.json",
                                  "events.txt",       "deck.toml",       "result.json",  "report.html",
                                  "shapes.pvd",       "steps.jsonl",     "checkpoint",   "probe",
                                  "convergence.json", "convergence.txt", "curve.json",   "curve.csv"};

bool is_whole_number(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

// Whether the name is that of a file that a killed process was writing, see StagedFile, or of its lock.
bool is_name_of_leftover(const std::string& name) {
  if (name == folder_lock_name) return true;
  const std::size_t dot = name.rfind('.');
  if (name.front() != '.' || dot < 2 || !is_whole_number(name.substr(dot + 1))) return false;
  const std::string target = name.substr(1, dot - 1), stem = target.substr(0, target.find('.'));
  return std::find(output_names.begin(), output_names.end(), target) != output_names.end() ||
         (target == stem + ".vtu" && (stem == "walls" || is_whole_number(stem)));
}

bool is_leftover(const fs::directory_entry& entry) {
  std::error_code ignored;
  return is_name_of_leftover(entry.path().filename().string()) && !entry.is_symlink(ignored) &&
         entry.is_regular_file(ignored);
}

void remove_leftovers(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
    if (is_leftover(entry) && entry.path().filename() != folder_lock_name) fs::remove(entry.path(), ignored);
}

void remove_leftovers(const OwnFolder& folder) {
  for (const std::string& name : folder.names())
    if (is_name_of_leftover(name) && folder.has_file(name)) folder.remove(name);
}

// Whether nothing but leftovers is in a folder.
bool holds_nothing(const fs::path& folder, std::error_code& error) {
  const fs::directory_iterator entries(folder, error);
  return std::all_of(begin(entries), end(entries), [](const auto& entry) { return is_leftover(entry); });
}

}  // namespace

StagedFile::StagedFile(fs::path target)
    : target_(std::move(target)),
      path_(target_.parent_path() / ("." + target_.filename().string() + "." + std::to_string(::getpid()))),
      descriptor_(-1) {
  // A file that is renamed to a device would take its place.
  std::error_code ignored;
  if (fs::is_other(target_, ignored)) fail(target_, "cannot be written", "it is a device, a pipe or a socket");
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (descriptor_ < 0) give_up(errno);
}

StagedFile::~StagedFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!path_.empty()) ::unlink(path_.c_str());
}

void StagedFile::write(const Pieces& text) {
  std::vector<iovec> left;
  for (const std::string_view piece : text)
    if (!piece.empty()) left.push_back({.iov_base = const_cast<char*>(piece.data()), .iov_len = piece.size()});
  for (auto at = left.begin(); at != left.end();) {
    const auto count = static_cast<int>(std::min<std::ptrdiff_t>(left.end() - at, IOV_MAX));
    const ssize_t written = ::writev(descriptor_, &*at, count);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) give_up(errno);
    auto rest = static_cast<std::size_t>(written);
    for (; at != left.end() && rest >= at->iov_len; ++at) rest -= at->iov_len;
    if (at == left.end()) break;
    at->iov_base = static_cast<char*>(at->iov_base) + rest;
    at->iov_len -= rest;
  }
}

void StagedFile::flush_to_disk() const {
  if (::fsync(descriptor_) != 0) give_up(errno);
}

// Some file systems report a full disk only here.
void StagedFile::close() {
  if (::close(std::exchange(descriptor_, -1)) != 0) give_up(errno);
}

void StagedFile::put_in_place() {
  std::error_code error;
  fs::rename(path_, target_, error);
  if (error) give_up(error.value());
  path_.clear();
}

void StagedFile::give_up(int error) const {
  fail(target_, "cannot be written", std::generic_category().message(error));
}

void write_whole(const fs::path& file, const Pieces& text) {
  StagedFile staged(file);
  staged.write(text);
  staged.close();
  staged.put_in_place();
}

void write_durably(const fs::path& file, std::string_view text) {
  StagedFile staged(file);
  staged.write(text);
  staged.flush_to_disk();
  staged.close();
  staged.put_in_place();
  // The new name, too. Not every file system can do this, and none needs it for the file to be whole.
  const fs::path parent = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const int folder = ::open(parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  ::fsync(folder);
  ::close(folder);
}

void require_other_than_input(const fs::path& folder, const fs::path& input) {
  for (const char* name : output_names) {
    std::error_code ignored;
    if (fs::exists(folder / name, ignored) && fs::equivalent(folder / name, input, ignored))
      throw InputError({Diagnostic{.file = input.string(),
                                   .message = "would be written over by " + (folder / name).string(),
                                   .cure = "name another folder with --out"}});
  }
}

DeckIdentity identity_of(const RunDescription& run) {
  return {fs::path(run.deck).filename().string(), run.deck_path, crc32_text(run.deck_text)};
}

std::string whole_path(const fs::path& file) {
  std::error_code error;
  const fs::path found = fs::canonical(file, error);
  return (error ? fs::absolute(file).lexically_normal() : found).string();
}

std::optional<DeckIdentity> results_of_another(const fs::path& folder, const DeckIdentity& deck) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return std::nullopt;
  DeckIdentity there = filled_by(folder);
  if (there.file.empty() || is_same(there, deck)) return std::nullopt;
  return there;
}

std::string note_of_replaced(const fs::path& folder, const DeckIdentity& deck) {
  const auto other = results_of_another(folder, deck);
  return other ? folder.string() + ": the results of " + shown_path(*other) + " are replaced by those of " +
                     shown_path(deck)
               : std::string();
}

void require_usable(const fs::path& folder, const DeckIdentity& deck, Foreign foreign) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (!fs::exists(status)) {
    if (error && error != std::errc::no_such_file_or_directory) fail(folder, "cannot be used", error.message());
    return;
  }
  if (!fs::is_directory(status)) fail(folder, "is not a folder", "name another with --out");
  if (foreign == Foreign::overwrite) return;
  const bool empty = holds_nothing(folder, error);
  if (error) fail(folder, "cannot be read", error.message());
  if (empty) return;
  const std::string cure = "name another folder with --out, or write over it with --force";
  if (const auto other = results_of_another(folder, deck))
    fail(folder, "was filled by another deck, " + shown_path(*other), cure);
  if (filled_by(folder).file.empty()) fail(folder, "is not empty, and not filled by this program", cure);
}

// Whether the folder can be used is asked a second time when no other process can fill it any more.
OutputFolder::OutputFolder(fs::path folder, const DeckIdentity& deck, Foreign foreign) : folder_(std::move(folder)) {
  require_usable(folder_, deck, foreign);
  std::error_code error;
  made_ = fs::create_directories(folder_, error);
  if (error) fail(folder_, "cannot be made", error.message());
  lock_.emplace(folder_);
  require_usable(folder_, deck, foreign);
  take();
}

OutputFolder::OutputFolder(fs::path folder) : folder_(std::move(folder)) {
  std::error_code ignored;
  if (!fs::is_directory(folder_, ignored)) throw OutputError(folder_.string() + ": there is no such folder");
  lock_.emplace(folder_);
  take();
}

void OutputFolder::take() {
  const auto shapes = OwnFolder::open(folder_ / "shapes");
  remove_leftovers(folder_);
  if (shapes) remove_leftovers(*shapes);
  const StagedFile probe(folder_ / "probe");
}

OutputFolder::~OutputFolder() {
  lock_.reset();
  if (made_) ::rmdir(folder_.c_str());  // fails if something is in it, as it should
}

void OutputFolder::write_whole(const std::string& name, std::string_view text) const {
  arcwall::write_whole(folder_ / name, text);
}

void OutputFolder::write_durably(const std::string& name, std::string_view text) const {
  arcwall::write_durably(folder_ / name, text);
}

void FileSet::write(const std::string& name, const Pieces& text) {
  StagedFile& file = files_.emplace_back(folder_ / name);
  file.write(text);
  file.close();
}

void FileSet::put_in_place() {
  for (StagedFile& file : files_) file.put_in_place();
}

}  // namespace arcwall
