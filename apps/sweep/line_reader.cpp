#include "apps/sweep/line_reader.hpp"

namespace arcwall::sweep {

bool LineReader::next(std::string& line) {
  constexpr std::size_t part = std::size_t{1} << 18;
  for (std::size_t searched = used_;;) {
    const std::size_t end = buffer_.find('\n', searched);
    if (end != std::string::npos) {
      begin_ = buffer_begin_ + used_;
      line.assign(buffer_, used_, end - used_);
      used_ = end + 1;
      return true;
    }
    buffer_.erase(0, used_);
    buffer_begin_ += used_;
    used_ = 0;
    searched = buffer_.size();
    const std::string more = file_.bytes(buffer_begin_ + buffer_.size(), part);
    if (more.empty()) return false;
    buffer_ += more;
  }
}

}  // namespace arcwall::sweep
