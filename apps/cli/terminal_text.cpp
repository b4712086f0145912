#include "apps/cli/terminal_text.hpp"

#include <streambuf>
#include <string>
#include <string_view>

#include "core/printable.hpp"

namespace arcwall {

namespace {

// The length of a text without a character at its end of which more may come.
std::size_t length_of_whole_characters(std::string_view text) {
  constexpr std::size_t longest = 4;
  for (std::size_t back = 1; back < longest && back <= text.size(); ++back) {
    const auto byte = static_cast<unsigned char>(text[text.size() - back]);
    if ((byte & 0xC0u) == 0x80u) continue;  // inside a character
    const std::size_t bytes = byte >= 0xF0u ? 4 : byte >= 0xE0u ? 3 : byte >= 0xC0u ? 2 : 1;
    return bytes > back ? text.size() - back : text.size();
  }
  return text.size();
}

}  // namespace

class PrintableStream::Buffer : public std::streambuf {
 public:
  explicit Buffer(std::streambuf* target) : target_(target) {}

  std::streambuf* target() const { return target_; }

 protected:
  std::streamsize xsputn(const char* text, std::streamsize count) override {
    begun_.append(text, static_cast<std::size_t>(count));
    return put(length_of_whole_characters(begun_)) ? count : 0;
  }

  int_type overflow(int_type character) override {
    if (traits_type::eq_int_type(character, traits_type::eof())) return traits_type::not_eof(character);
    const char one = traits_type::to_char_type(character);
    return xsputn(&one, 1) == 1 ? character : traits_type::eof();
  }

  int sync() override { return target_->pubsync(); }

 private:
  bool put(std::size_t length) {
    const std::string shown = printable(std::string_view(begun_).substr(0, length), LineBreaks::kept);
    begun_.erase(0, length);
    const auto count = static_cast<std::streamsize>(shown.size());
    return target_->sputn(shown.data(), count) == count;
  }

  std::streambuf* target_;
  std::string begun_;  // of a character whose last bytes have not come
};

PrintableStream::PrintableStream(std::ostream& stream)
    : stream_(stream), buffer_(std::make_unique<Buffer>(stream.rdbuf())) {
  stream_.rdbuf(buffer_.get());
}

PrintableStream::~PrintableStream() {
  const std::ios_base::iostate state = stream_.rdstate();
  stream_.rdbuf(buffer_->target());
  stream_.setstate(state);
}

}  // namespace arcwall
