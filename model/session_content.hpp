#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "model/session.hpp"

namespace arcwall {

/// A session as the content of its checkpoint, and back.
class SessionContent {
 public:
  static nlohmann::json of(Session& session, const std::optional<BranchEnd>& stopped);

  /// Throws OutputError, which names `file`, for content that is none of this program.
  static Session read(const nlohmann::json& content, const std::string& file, Session::Resume how);
};

}  // namespace arcwall
