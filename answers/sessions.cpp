#include "answers/sessions.hpp"

#include <utility>

#include "answers/deck_answers.hpp"
#include "model/deck/given_points.hpp"
#include "model/session_content.hpp"

namespace arcwall {

Session open_session(const std::string& file, std::vector<std::string> assignments) {
  return make_session({.deck = file, .deck_text = deck::read_deck_file(file), .assignments = std::move(assignments)});
}

Session make_session(RunDescription description) { return {std::move(description), deck_answers()}; }

Session resume_session(std::string_view checkpoint, const std::string& file, Session::Resume how) {
  return Session::from(checkpoint, file, how, deck_answers());
}

Session stored_session(const std::filesystem::path& folder, Session::Resume how) {
  return resume_session(bytes_of_checkpoint(folder), (folder / "checkpoint").string(), how);
}

}  // namespace arcwall
