#include "core/printable.hpp"

namespace arcwall {

namespace {

bool continues(char byte) { return (static_cast<unsigned char>(byte) & 0xC0u) == 0x80u; }

std::string in_hexadecimal(std::uint32_t value, int digits) {
  std::string text;
  for (int digit = digits - 1; digit >= 0; --digit) text += "0123456789ABCDEF"[(value >> (4 * digit)) & 0xFu];
  return text;
}

std::string escape(std::uint32_t code) {
  if (code == '\n') return "\\n";
  if (code == '\t') return "\\t";
  return "\\u" + in_hexadecimal(code, 4);
}

}  // namespace

Utf8Character first_character(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  if (lead < 0x80u) return {.code = lead};
  const std::size_t bytes = lead >= 0xF0u ? 4 : lead >= 0xE0u ? 3 : 2;
  if (lead < 0xC2u || lead > 0xF4u || text.size() < bytes) return {};
  std::uint32_t code = lead & (0x7Fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if (!continues(text[i])) return {};
    code = code << 6u | (static_cast<unsigned char>(text[i]) & 0x3Fu);
  }
  const std::uint32_t least = bytes == 4 ? 0x10000u : bytes == 3 ? 0x800u : 0x80u;
  if (code < least || code > 0x10FFFFu || (code >= 0xD800u && code <= 0xDFFFu)) return {};
  return {.bytes = bytes, .code = code};
}

bool is_printable(std::uint32_t code) {
  const bool control = code < 0x20u || (code >= 0x7Fu && code < 0xA0u);
  const bool line = code == 0x2028u || code == 0x2029u;
  const bool direction = code == 0x061Cu || code == 0x200Eu || code == 0x200Fu ||
                         (code >= 0x202Au && code <= 0x202Eu) || (code >= 0x2066u && code <= 0x2069u);
  return !control && !line && !direction;
}

std::string printable(std::string_view text, LineBreaks breaks) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const Utf8Character next = first_character(text);
    const bool stays = next.code && (is_printable(*next.code) ||
                                     (breaks == LineBreaks::kept && (*next.code == '\n' || *next.code == '\t')));
    if (stays)
      result += text.substr(0, next.bytes);
    else
      result += next.code ? escape(*next.code) : "\\x" + in_hexadecimal(static_cast<unsigned char>(text.front()), 2);
    text.remove_prefix(next.bytes);
  }
  return result;
}

}  // namespace arcwall
