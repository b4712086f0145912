#include "apps/sweep/case_records.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <string_view>

#include "apps/sweep/line_reader.hpp"
#include "core/error.hpp"

namespace arcwall::sweep {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 3> kind_words{"result", "hindered", "forgotten"};

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
  throw OutputError(file.string() + ": " + what);
}

std::string reason() { return std::generic_category().message(errno); }

std::string stem(const Part& part) { return fmt::format("{}-of-{}", part.number, part.parts); }

// The numbers of `3-of-8.jsonl`; empty for another name.
std::optional<Part> part_of(const std::string& name) {
  Part part;
  const char* const end = name.data() + name.size();
  const auto first = std::from_chars(name.data(), end, part.number);
  const std::string_view between = "-of-";
  if (first.ec != std::errc() ||
      !std::string_view(first.ptr, static_cast<std::size_t>(end - first.ptr)).starts_with(between))
    return std::nullopt;
  const auto second = std::from_chars(first.ptr + between.size(), end, part.parts);
  const bool is_records = second.ec == std::errc() && std::string_view(second.ptr) == ".jsonl" && part.parts > 0;
  return is_records ? std::optional(part) : std::nullopt;
}

// What each line begins with, in this form to the letter, so that its place can be noted without a look at the rest.
struct Head {
  int number = 0;
  int round = 0;
  RecordKind kind = RecordKind::forgotten;
};

std::string head_text(const Head& head) {
  return fmt::format(R"({{"case":{},"round":{},"kind":"{}")", head.number, head.round,
                     kind_words[static_cast<std::size_t>(head.kind)]);
}

std::optional<Head> head_of(std::string_view line) {
  const auto take = [&](std::string_view word) {
    const bool there = line.starts_with(word);
    if (there) line.remove_prefix(word.size());
    return there;
  };
  const auto take_number = [&](int& number) {
    const auto [ptr, error] = std::from_chars(line.data(), line.data() + line.size(), number);
    line.remove_prefix(static_cast<std::size_t>(ptr - line.data()));
    return error == std::errc() && number >= 0;
  };
  Head head;
  if (!take(R"({"case":)") || !take_number(head.number) || !take(R"(,"round":)") || !take_number(head.round) ||
      head.round > UINT16_MAX || !take(R"(,"kind":")"))
    return std::nullopt;
  for (std::size_t i = 0; i < kind_words.size(); ++i) {
    if (!take(kind_words[i])) continue;
    head.kind = static_cast<RecordKind>(i);
    return take("\"") ? std::optional(head) : std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

// --- RecordIndex
// ------------------------------------------------------------------------------------------------------

RecordIndex::RecordIndex(const fs::path& sweep_folder, std::size_t cases, const Part& part) : places_(cases) {
  std::vector<fs::path> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(sweep_folder / records_folder_name, error)) {
    const auto of = part_of(entry.path().filename().string());
    if (of && (of->parts != part.parts || of->number == part.number)) names.push_back(entry.path());
  }
  std::sort(names.begin(), names.end());  // what is chosen does not depend on the order of a folder
  for (const fs::path& name : names) read_file(name);
}

// Of several records of a case the one of the last round counts, of these a result before all else, and the first.
void RecordIndex::read_file(const fs::path& file) {
  files_.emplace_back(file);
  LineReader lines(file);
  int count = 0;
  for (std::string line; lines.next(line);) {
    ++count;
    const auto head = head_of(line);
    if (!head || static_cast<std::size_t>(head->number) >= places_.size() || line.back() != '}')
      fail(file, fmt::format("line {} is damaged; remove the line, and the case is run again", count));
    Place& place = places_[static_cast<std::size_t>(head->number)];
    const auto round = static_cast<std::uint16_t>(head->round);
    last_round_ = std::max(last_round_, round);
    const bool stands =
        place.file != no_file && (place.round > round || (place.round == round && place.kind <= head->kind));
    if (stands) continue;
    place = {.begin = lines.begin(),
             .file = static_cast<std::uint32_t>(files_.size() - 1),
             .round = round,
             .kind = head->kind};
  }
}

std::optional<RecordKind> RecordIndex::kind(int number) const {
  const Place& place = places_.at(static_cast<std::size_t>(number));
  return place.file == no_file ? std::nullopt : std::optional(place.kind);
}

std::uint16_t RecordIndex::round_of(int number) const { return places_.at(static_cast<std::size_t>(number)).round; }

void RecordIndex::forget(int number, std::uint16_t round) {
  places_.at(static_cast<std::size_t>(number)) = {.round = round};
  last_round_ = std::max(last_round_, round);
}

Json RecordIndex::read(int number) const {
  const Place& place = places_.at(static_cast<std::size_t>(number));
  const RegularFile& file = files_.at(place.file);
  std::string line;
  for (std::size_t size = 4096;; size *= 4) {
    line = file.bytes(place.begin, size);
    const std::size_t end = line.find('\n');
    if (end != std::string::npos) {
      line.resize(end);
      break;
    }
    if (line.size() < size) break;
  }
  Json record = Json::parse(line, nullptr, false);
  if (!record.is_object())
    fail(file.path(), fmt::format("the record of case {} is damaged; run the case again with --force", number));
  return record;
}

// --- RecordWriter
// -----------------------------------------------------------------------------------------------------

RecordWriter::RecordWriter(const fs::path& sweep_folder, const Part& part) {
  const fs::path folder = sweep_folder / records_folder_name;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail(folder, "cannot be made: " + error.message());
  path_ = folder / (stem(part) + ".jsonl");
  descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
  if (descriptor_ < 0) fail(path_, "cannot be opened: " + reason());
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(descriptor_);
    fail(path_, "another process is running these cases; share them among several with --part I/N");
  }
  LineReader lines(path_);
  for (std::string line; lines.next(line);) size_ = lines.begin() + line.size() + 1;
  if (::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) fail(path_, "cannot be written: " + reason());
}

RecordWriter::~RecordWriter() {
  if (descriptor_ < 0) return;
  ::fdatasync(descriptor_);
  ::close(descriptor_);
}

void RecordWriter::append(int number, std::uint16_t round, RecordKind kind, const Json& content) {
  std::string line = head_text({.number = number, .round = round, .kind = kind});
  const std::string rest = content.dump(-1, ' ', false, Json::error_handler_t::replace);
  line += (rest == "{}" ? "}" : "," + rest.substr(1)) + "\n";
  std::size_t written = 0;
  while (written < line.size()) {
    const ssize_t count =
        ::pwrite(descriptor_, line.data() + written, line.size() - written, static_cast<off_t>(size_ + written));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const std::string why = reason();
      if (::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) fail(path_, "is damaged: " + reason());
      fail(path_, "cannot be written: " + why);
    }
    written += static_cast<std::size_t>(count);
  }
  size_ += line.size();
}

}  // namespace arcwall::sweep
