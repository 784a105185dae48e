// middleware/ask/ask_filter.h: whom a question leaves out. Not installed.
#pragma once

#include "articulated/result.h"
#include "middleware/ask/ask.h"
#include "middleware/world/world_parts.h"

namespace foretouch::internal {

/// Which of a body is asked about. Refers to the question.
class AskFilter {
 public:
  explicit AskFilter(const WorldQuestion& question) : question_(question) {}

  /// False: no part of the body, or of the scene, is.
  [[nodiscard]] bool mayTake(const WorldParts& world, BodyId body) const;
  [[nodiscard]] bool takes(BodyId body, LinkId link, ObjectId object) const;

 private:
  const WorldQuestion& question_;
};

/// Errors: unknown bodies or links.
[[nodiscard]] Result<Done> checkedParts(const WorldParts& world, const WorldQuestion& question);

}  // namespace foretouch::internal
