#pragma once

#include <memory>
#include <ostream>

namespace arcwall {

/// While it lives, what is written to a stream is shown and not obeyed: names and titles of a deck, or names of files,
/// may have characters that move a terminal's cursor, colour it or turn its lines round. They are written as
/// printable() has them; line breaks and tabs stay.
class PrintableStream {
 public:
  /// The stream outlives this.
  explicit PrintableStream(std::ostream& stream);
  PrintableStream(const PrintableStream&) = delete;
  PrintableStream& operator=(const PrintableStream&) = delete;
  ~PrintableStream();

 private:
  class Buffer;

  std::ostream& stream_;
  std::unique_ptr<Buffer> buffer_;
};

}  // namespace arcwall
