#include <fmt/format.h>

#include <array>
#include <cassert>
#include <cstdint>

#include "apps/cli/commands.hpp"
#include "apps/cli/example_decks.hpp"
#include "apps/shell/shell_files.hpp"
#include "model/version.hpp"

namespace arcwall {

namespace {

// The character that begins at `at`, which moves behind it; the text is UTF-8.
std::uint32_t next_character(const std::string& text, std::size_t& at) {
  const auto byte = [&] { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[at++])); };
  const std::uint32_t first = byte();
  const int more = first >= 0xF0u ? 3 : first >= 0xE0u ? 2 : first >= 0xC0u ? 1 : 0;
  std::uint32_t character = more == 0 ? first : first & (0x3Fu >> static_cast<unsigned>(more));
  for (int i = 0; i < more && at < text.size(); ++i) character = (character << 6u) | (byte() & 0x3Fu);
  return character;
}

// Text without any meaning to roff: dashes that can be copied, nothing that looks like a request.
std::string roff(const std::string& text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::uint32_t character = next_character(text, at);
    if (character == '\\') {
      result += "\\e";
    } else if (character == '-') {
      result += "\\-";
    } else if (character == '\'') {
      result += "\\(aq";
    } else if (character == '.' && result.empty()) {
      result += "\\&.";
    } else if (character < 0x80u) {
      result += static_cast<char>(character);
    } else {
      result += fmt::format("\\[u{:04X}]", character);
    }
  }
  return result;
}

std::string sentence(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text + ".";
}

std::string entry(const std::string& title, const std::string& text) { return ".TP\n" + title + "\n" + text + "\n"; }

std::string option_title(const OptionDescription& option) {
  const std::string name = "\\fB" + roff("--" + option.name) + "\\fR";
  return option.value.empty() ? name : name + " \\fI" + roff(option.value) + "\\fR";
}

std::string command_section(const CommandDescription& command) {
  std::string text = fmt::format(".SS \"trace\\-path {} {}\"\n{}\n", roff(command.name), roff(command.usage),
                                 roff(sentence(command.summary)));
  text += ".PP\n.nf\n.RS\n" + roff(command.example) + "\n.RE\n.fi\n";
  for (const OptionDescription& option : command.options)
    text += entry(option_title(option), roff(sentence(option.help)));
  return text;
}

constexpr std::array statuses{ExitStatus::success,     ExitStatus::internal_error, ExitStatus::wrong_input,
                              ExitStatus::ended_early, ExitStatus::no_start,       ExitStatus::file_error,
                              ExitStatus::limit_met,   ExitStatus::not_confirmed,  ExitStatus::out_of_memory,
                              ExitStatus::interrupted};

std::string meaning(ExitStatus status) {
  switch (status) {
    case ExitStatus::success:
      return "every branch ended as specified in the deck, or the command succeeded";
    case ExitStatus::internal_error:
      return "a defect of the program";
    case ExitStatus::wrong_input:
      return "the command line or a file given to the program is wrong; every error is reported";
    case ExitStatus::ended_early:
      return "a branch ended early, or a case of a sweep failed; what was traced is written";
    case ExitStatus::no_start:
      return "there is no equilibrium at the start, or curve cannot follow the event";
    case ExitStatus::file_error:
      return "a file cannot be read or written";
    case ExitStatus::limit_met:
      return "a limit on points or time was met";
    case ExitStatus::not_confirmed:
      return "a check of verify failed";
    case ExitStatus::out_of_memory:
      return "memory ran out; trace-path resume goes on from the last checkpoint";
    case ExitStatus::interrupted:
      return "interrupted by a signal";
  }
  assert(false);
  return {};
}

std::string example_names() {
  std::string text;
  for (const auto* list : {&example_decks(), &example_devices(), &example_sweeps()})
    for (const ExampleDeck& deck : *list) text += (text.empty() ? "" : ", ") + std::string(deck.name);
  return text;
}

}  // namespace

std::string man_page() {
  std::string text = fmt::format(".TH TRACE\\-PATH 1 \"\" \"arcwall {}\" \"User Commands\"\n", roff(program_version()));
  text += ".SH NAME\ntrace\\-path \\- follow equilibrium paths of beams, frames and trusses among rigid obstacles\n";
  text +=
      ".SH SYNOPSIS\n"
      "\\fBtrace\\-path\\fR \\fICOMMAND\\fR [\\fIargument\\fR|\\fIoption\\fR]...\n.br\n"
      "\\fBtrace\\-path\\fR \\fIDECK\\fR [\\fIoption\\fR]...\n"
      ".SH DESCRIPTION\n"
      "A deck is one text file, in TOML, that describes a plane structure, its loads and the obstacles in its way.\n"
      "The program follows the equilibrium path from the unloaded structure through limit points, snap\\-backs and "
      "changes\n"
      "of contact, and writes its points and the events on it.\n"
      "With a deck alone, \\fBtrace\\-path\\fR \\fIDECK\\fR means \\fBtrace\\-path run\\fR \\fIDECK\\fR.\n"
      ".PP\n"
      "Every command also takes \\fB\\-\\-help\\fR and \\fB\\-\\-version\\fR. Options are not shortened.\n"
      "Data goes to standard output, everything else to standard error.\n"
      ".SH COMMANDS\n";
  for (const Command& command : commands()) text += command_section(command.description);
  for (const Command& command : sweep_commands()) text += command_section(command.description);
  text += ".SH EXIT STATUS\n";
  for (const ExitStatus status : statuses)
    text += entry(fmt::format("\\fB{}\\fR", static_cast<int>(status)), roff(sentence(meaning(status))));
  text += ".SH ENVIRONMENT\n" + entry("\\fBNO_COLOR\\fR", "If it is set, no progress line is shown.") +
          ".SH EXAMPLES\n"
          "Decks that come with the program: " +
          roff(example_names()) +
          ".\n"
          ".PP\n.nf\n.RS\n"
          "trace\\-path examples channel \\-\\-out channel.toml\n"
          "trace\\-path run channel.toml\n"
          ".RE\n.fi\n";
  return text;
}

}  // namespace arcwall
