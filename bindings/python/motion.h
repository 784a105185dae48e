// bindings/python/motion.h: a motion and its avatar.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/skeleton.h"

namespace foretouch::python {

struct Motion {
  std::shared_ptr<Avatar> avatar;
  Pose start, end;
  ChainMotion chain;
};

/// The motions that a query has answered: one, or those of a batch.
struct AnsweredMotions {
  std::shared_ptr<const Motion> one;
  std::vector<Pose> poses, ends;  ///< Without `ends`: from each pose to the next.

  [[nodiscard]] std::size_t count() const {
    if (one != nullptr) return 1;
    return ends.empty() ? poses.size() - 1 : poses.size();
  }
  [[nodiscard]] const Pose& start(std::size_t step) const {
    return one != nullptr ? one->start : poses[step];
  }
  [[nodiscard]] const Pose& end(std::size_t step) const {
    if (one != nullptr) return one->end;
    return ends.empty() ? poses[step + 1] : ends[step];
  }
};

}  // namespace foretouch::python
