#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "model/session.hpp"

namespace arcwall {

/// A session as the content of its checkpoint, and back.
class SessionContent {
 public:
  static nlohmann::json of(Session& session, const std::optional<BranchEnd>& stopped);

  /// Throws OutputError, which names `file`, for content that is none of this program. A `model` is taken for what the
  /// deck in it builds; it must not be that of another session if load increments are taken.
  static Session read(const nlohmann::json& content, const std::string& file, Session::Resume how,
                      std::shared_ptr<Model> model = nullptr);
};

}  // namespace arcwall
