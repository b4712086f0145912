#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "model/session.hpp"

/// Sessions that answer all that their decks ask.
namespace arcwall {

/// Returns the session of a deck file. `assignments`: texts `key=value` that replace values of the deck. Throws
/// InputError with all errors of the deck.
Session open_session(const std::string& file, std::vector<std::string> assignments = {});

/// Returns the session of a deck in memory. Throws InputError likewise.
Session make_session(RunDescription description);

/// Returns the session of a checkpoint. Throws OutputError, which names `file`, if the bytes are not readable by this
/// version.
Session resume_session(std::string_view checkpoint, const std::string& file, Session::Resume how);

/// Returns the session of the checkpoint in a results folder. Throws OutputError if it is missing or unreadable.
Session stored_session(const std::filesystem::path& folder, Session::Resume how);

}  // namespace arcwall
