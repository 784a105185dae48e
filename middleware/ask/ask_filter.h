// middleware/ask/ask_filter.h: what a question leaves out. Not installed.
#pragma once

#include "articulated/result.h"
#include "middleware/ask/ask.h"
#include "middleware/world/world_parts.h"

namespace foretouch::internal {

/// Which of a body is asked about. Refers to the question.
class AskFilter {
 public:
  explicit AskFilter(const AskWhom& whom) : whom_(whom) {}

  /// False: no part of the body, or of the scene, is.
  [[nodiscard]] bool mayTake(const WorldParts& world, BodyId body) const;
  [[nodiscard]] bool takes(BodyId body, LinkId link, ObjectId object) const;

 private:
  const AskWhom& whom_;
};

/// Errors: unknown bodies or links.
[[nodiscard]] Result<Done> checkedParts(const WorldParts& world, const AskWhom& whom);
[[nodiscard]] Result<Done> checkedBody(const WorldParts& world, BodyId body, const char* where);

}  // namespace foretouch::internal
