#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "model/curve_session.hpp"
#include "model/session.hpp"

namespace arcwall {

/// What the content of a checkpoint is of. Throws OutputError, which names `file`, for content that is none of this
/// program, or of another version.
RunDescription described_in(const nlohmann::json& content, const std::string& file);

/// A session as the content of its checkpoint, and back.
class SessionContent {
 public:
  static nlohmann::json of(Session& session, const std::optional<BranchEnd>& stopped);

  /// Throws OutputError, which names `file`, for content that is none of this program.
  static Session read(const nlohmann::json& content, const std::string& file, Session::Resume how);
};

/// The same of a curve of events.
class CurveContent {
 public:
  static nlohmann::json of(const CurveSession& session, const std::optional<BranchEnd>& stopped);

  /// Throws OutputError, which names `file`, for content that is none of this program.
  static CurveSession read(const nlohmann::json& content, const std::string& file, Session::Resume how);
};

}  // namespace arcwall
