#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "model/session.hpp"

namespace arcwall {

/// What the content of a checkpoint is of. Throws OutputError, which names `file`, for content that is none of this
/// program, or of another version.
RunDescription described_in(const nlohmann::json& content, const std::string& file);

/// The bytes of the checkpoint in a results folder. Throws OutputError if there is none or it cannot be read.
std::string bytes_of_checkpoint(const std::filesystem::path& folder);

/// A session as the content of its checkpoint, and back.
class SessionContent {
 public:
  static nlohmann::json of(Session& session, const std::optional<BranchEnd>& stopped);

  /// Throws OutputError, which names `file`, for content that is none of this program.
  static Session read(const nlohmann::json& content, const std::string& file, Session::Resume how,
                      const Answers& answers);
};

}  // namespace arcwall
