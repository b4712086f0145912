// Command lines that mix options, values right and wrong, and `--set`: the program ends with a status that the
// documentation has and no defect, and says why where the status is that of an error. Commands that fork or serve pages
// are the matter of command_line.py.
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "apps/cli/commands.hpp"
#include "apps/cli/example_decks.hpp"
#include "apps/cli/interrupt.hpp"
#include "apps/cli/program.hpp"
#include "apps/output/files.hpp"
#include "tests/fuzz/require.hpp"

namespace arcwall::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr std::array numbers{
    "0", "1", "3", "-1", "1e400", "nan", "inf", "-0", "0x", "1e-300", "999999999999999999999", "", " ", "1,5", "3.5"};
constexpr std::array texts{"x",  "=1",   "-",   "--",      "\u202e", "a b", "/dev/null", "..", "results",
                           "[1", "%s%n", "1/0", "\x1b[2J", "{}",     "'",   "study",     ".",  "done"};
constexpr std::array keys{"path.step",
                          "path.max_points",
                          "path.method",
                          "path.jumps",
                          "path.search",
                          "path.stop",
                          "path",
                          "load.0.force",
                          "load.9.force",
                          "load",
                          "wall",
                          "member",
                          "material.bar.E",
                          "point.a",
                          "title",
                          "a.b.c.d",
                          "contact",
                          "units",
                          "path.stop.lambda",
                          "monitor",
                          "monitor.0",
                          "member.left.elements",
                          "stage",
                          ""};
constexpr std::array values{"1.0", "3",  "0",  "-1",  "1e400", "nan",   "x",      "",        "[0,-1]", "[nan,0]",
                            "[1]", "{}", "[]", "'t'", "true",  "'arc'", "[-1,1]", "'nodes'", "\"",     "0.001"};
constexpr std::array places{"truss.toml", "done", "study", "sweep.toml", "missing", "measured.csv", "", "."};

// Bytes as choices; all the same once they are used up.
class Choices {
 public:
  Choices(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  bool any() const { return left_ > 0; }
  std::size_t below(std::size_t count) {
    if (left_ == 0) return 0;
    --left_;
    return *data_++ % count;
  }
  template <class List>
  std::string of(const List& list) {
    return std::string(list[below(list.size())]);
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

// Commands, each with a place where it finds what it wants.
struct Called {
  Command command;
  const char* place;
};

const std::vector<Called>& called() {
  static const std::vector<Called> all = [] {
    std::vector<Called> list;
    for (const Command& command : commands()) {
      const std::string& name = command.description.name;
      if (name == "explore") continue;
      const bool of_a_run = name == "resume" || name == "report" || name == "verify";
      list.push_back({command, of_a_run ? "done" : name == "examples" ? "truss" : "truss.toml"});
    }
    for (const Command& command : sweep_commands()) {
      const std::string& name = command.description.name;
      if (name != "sweep run") list.push_back({command, name == "sweep plan" ? "sweep.toml" : "study"});
    }
    return list;
  }();
  return all;
}

std::vector<std::string> command_line(Choices& choose) {
  const auto& [command, place] = called()[choose.below(called().size())];
  std::vector<std::string> words;
  std::istringstream names(command.description.name);
  for (std::string name; names >> name;) words.push_back(name);
  if (choose.below(8) != 7) words.emplace_back(place);
  while (choose.any() && words.size() < 16) {
    const std::size_t kind = choose.below(8);
    if (kind == 0) {
      words.push_back(choose.of(places));
    } else if (kind == 1) {
      words.push_back(choose.of(texts));
    } else if (kind == 2) {
      words.insert(words.end(), {"--set", choose.of(keys) + "=" + choose.of(values)});
    } else if (!command.description.options.empty()) {
      const auto& options = command.description.options;
      words.push_back("--" + options[choose.below(options.size())].name);
      const std::size_t value = choose.below(4);
      if (value == 1) words.push_back(choose.of(numbers));
      if (value == 2) words.push_back(choose.of(texts));
      if (value == 3) words.back() += "=" + choose.of(numbers);
    }
  }
  return words;
}

int status_of(const std::vector<std::string>& words) {
  try {
    return static_cast<int>(run_program(words));
  } catch (const std::exception& problem) {
    return static_cast<int>(report(problem));
  }
}

// Whatever is written goes into a buffer.
class Redirected {
 public:
  explicit Redirected(std::ostream& stream) : stream_(stream), before_(stream.rdbuf(buffer_.rdbuf())) {}
  Redirected(const Redirected&) = delete;
  Redirected& operator=(const Redirected&) = delete;
  ~Redirected() {
    stream_.rdbuf(before_);
    stream_.clear();
  }
  std::string text() const { return buffer_.str(); }

 private:
  std::ostringstream buffer_;
  std::ostream& stream_;
  std::streambuf* before_;
};

// A folder to be in, with a deck, a run and a sweep; `--out ..` stays inside of the one around it.
void prepare() {
  std::string outer = (fs::temp_directory_path() / "arcwall-fuzz-XXXXXX").string();
  require(::mkdtemp(outer.data()) != nullptr, "there is no temporary folder");
  fs::create_directory(fs::path(outer) / "work");
  fs::current_path(fs::path(outer) / "work");
  for (const ExampleDeck& example : example_decks())
    if (example.name == std::string_view("truss")) write_whole("truss.toml", std::string(example.text));
  write_whole("sweep.toml", "title = \"t\"\ndeck = \"truss.toml\"\n[grid]\n\"path.step\" = [1.0, 2.0]\n");
  write_whole("measured.csv", "lambda,\"mid [a,b]\"\n0.1,\"0.01\"\n");
  const Redirected output(std::cout), messages(std::cerr);
  require(status_of({"run", "truss.toml", "--out", "done", "--quiet"}) == 0, "the truss does not run");
  require(status_of({"sweep", "plan", "sweep.toml", "--out", "study"}) == 0, "the sweep has no plan");
}

bool is_documented(int status) { return status == 0 || (status >= 2 && status <= 8) || status == 130; }

void call(const std::vector<std::string>& words) {
  int status = 0;
  std::string said;
  {
    const Redirected output(std::cout), messages(std::cerr);
    status = status_of(words);
    said = messages.text();
  }
  if (std::getenv("ARCWALL_FUZZ_SHOW") != nullptr) {
    for (const std::string& word : words) std::cerr << "'" << word << "' ";
    std::cerr << "\n" << status << ": " << said << "\n";
  }
  require(is_documented(status), said.c_str());
  const bool is_error = status == 2 || status == 4 || status == 5;
  require(!is_error || !said.empty(), "an error without a word");
}

}  // namespace
}  // namespace arcwall::fuzz

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  arcwall::let_writes_fail();
  arcwall::fuzz::prepare();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  arcwall::fuzz::Choices choose(data, size);
  arcwall::fuzz::call(arcwall::fuzz::command_line(choose));
  return 0;
}
