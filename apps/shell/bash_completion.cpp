#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "apps/cli/commands.hpp"
#include "apps/cli/example_decks.hpp"
#include "apps/shell/shell_files.hpp"
#include "model/deck/key_list.hpp"

namespace arcwall {

namespace {

// One word after the other.
std::string joined(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); }

std::vector<std::string> names_of(const std::vector<ExampleDeck>& decks) {
  std::vector<std::string> names;
  for (const ExampleDeck& deck : decks) names.emplace_back(deck.name);
  return names;
}

// Each key of a deck as far as it is known: up to a name, and of lists that of the first element.
std::vector<std::string> beginnings_of_keys() {
  std::set<std::string> keys;
  for (const deck::DeclaredKey& key : deck::declared_keys()) {
    if (key.kind != deck::DeclaredKey::Kind::value) continue;
    std::string path = key.path().substr(0, key.path().find('*'));
    std::replace(path.begin(), path.end(), '#', '0');
    keys.insert(path.ends_with('.') ? path : path + "=");
  }
  return {keys.begin(), keys.end()};
}

// How the script completes what the help calls so; empty for what cannot be guessed, as numbers.
std::string completer(const std::string& placeholder) {
  if (placeholder == "DIR") return "_trace_path_folders";
  if (placeholder == "FILE") return "_trace_path_files";
  if (placeholder == "DECK" || placeholder == "SWEEP") return "_trace_path_decks";
  if (placeholder == "NAME")
    return "_trace_path_words '" + joined(names_of(example_decks())) + " " + joined(names_of(example_devices())) + " " +
           joined(names_of(example_sweeps())) + "'";
  if (placeholder == "key=value") return "_trace_path_keys '" + joined(beginnings_of_keys()) + "'";
  if (placeholder.find('|') == std::string::npos) return "";
  std::string words = placeholder;
  std::replace(words.begin(), words.end(), '|', ' ');
  return "_trace_path_words '" + words + "'";
}

// `DIR` of `[DIR] [options]`.
std::string first_placeholder(const std::string& usage) {
  std::string word = usage.substr(0, usage.find(' '));
  std::erase_if(word, [](char c) { return c == '[' || c == ']'; });
  return word;
}

std::string option_words(const CommandDescription& command) {
  std::vector<std::string> words;
  for (const OptionDescription& option : command.options) words.push_back("--" + option.name);
  words.emplace_back("--help");
  words.emplace_back("--version");
  return joined(words);
}

// The branch of a `case` over commands: after an option that takes a value that value, else options or words.
std::string branch(const CommandDescription& command) {
  std::string text = fmt::format("    '{}')\n      case $before in\n", command.name);
  for (const OptionDescription& option : command.options) {
    if (option.value.empty()) continue;
    const std::string values = completer(option.value);
    text += fmt::format("        --{}) {}return ;;\n", option.name, values.empty() ? "" : values + "; ");
  }
  text += "      esac\n";
  const std::string words = completer(first_placeholder(command.usage));
  return text + fmt::format("      _trace_path_options '{}'{} ;;\n", option_words(command),
                            words.empty() ? "" : " || " + words);
}

std::string command_words(const std::vector<Command>& commands) {
  std::vector<std::string> words;
  for (const Command& command : commands)
    words.push_back(command.description.name.substr(command.description.name.rfind(' ') + 1));
  return joined(words);
}

constexpr const char* helpers = R"sh(# Completion of trace-path for bash.

_trace_path_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$current"); }

_trace_path_folders() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -d -- "$current")
}

_trace_path_files() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -f -- "$current")
}

# Files that end in .toml, and folders on the way to them.
_trace_path_decks() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -f -X '!*.toml' -- "$current"; compgen -d -- "$current")
}

# Keys of a deck, behind which no space is wanted.
_trace_path_keys() {
  compopt -o nospace 2>/dev/null
  _trace_path_words "$1"
}

# Options if one has been begun; else false.
_trace_path_options() { [[ $current == -* ]] && _trace_path_words "$1"; }

)sh";

// COMP_WORDS has = as a word of its own.
constexpr const char* beginning = R"sh(_trace_path() {
  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]} begin=2
  COMPREPLY=()
  if [[ $current == '=' ]]; then
    current=
  elif [[ $before == '=' ]]; then
    before=${COMP_WORDS[COMP_CWORD - 2]}
  fi
)sh";

}  // namespace

std::string bash_completion() {
  const std::string first = command_words(commands()) + " sweep";
  std::string text = std::string(helpers) + beginning;
  text += fmt::format(
      "  if ((COMP_CWORD == 1)); then\n"
      "    _trace_path_options '--help --version' && return\n"
      "    local decks\n"
      "    _trace_path_decks\n"
      "    decks=(\"${{COMPREPLY[@]}}\")\n"
      "    _trace_path_words '{}'\n"
      "    COMPREPLY+=(\"${{decks[@]}}\")\n"
      "    return\n"
      "  fi\n",
      first);
  text += fmt::format(
      "  if [[ $command == sweep ]]; then\n"
      "    if ((COMP_CWORD == 2)); then\n"
      "      _trace_path_options '--help --version' || _trace_path_words '{}'\n"
      "      return\n"
      "    fi\n"
      "    command=\"sweep ${{COMP_WORDS[2]}}\"\n"
      "    begin=3\n"
      "  fi\n",
      command_words(sweep_commands()));
  // What follows -- belongs to run, and so do the options behind a deck alone.
  text +=
      "  local i\n"
      "  for ((i = begin; i < COMP_CWORD; ++i)); do\n"
      "    [[ ${COMP_WORDS[i]} == -- && $command == 'sweep run' ]] && command=run\n"
      "  done\n"
      "  [[ $command == *.toml ]] && command=run\n"
      "  case $command in\n";
  for (const Command& command : commands()) text += branch(command.description);
  for (const Command& command : sweep_commands()) text += branch(command.description);
  return text + "  esac\n}\n\ncomplete -F _trace_path trace-path\n";
}

}  // namespace arcwall
