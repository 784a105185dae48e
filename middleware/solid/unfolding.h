// middleware/solid/unfolding.h: a posture near to a given one in which an avatar does not touch
// itself. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/skeleton.h"
#include "middleware/solid/certifier.h"

namespace foretouch::internal {

/// Turns joints back towards their rest pose, as little as a coarse grid allows: those between two
/// links that touch, and no others. A tracked pose often touches itself where the tracker errs by
/// a centimetre, with folded arms say; a solid avatar cannot begin there.
class Unfolding {
 public:
  explicit Unfolding(const Skeleton& skeleton);

  /// `posture` becomes `asked` with some joints turned, and its own links are apart. False: they
  /// touch even with those joints at rest, or the tick's work is spent. Roots stay where they are.
  [[nodiscard]] bool unfold(const Pose& asked, Certifier& certifier, Pose& posture);

 private:
  [[nodiscard]] bool loosenBetween(LinkId one, LinkId other);
  void turnBack(const Pose& asked, double share, Pose& posture) const;

  Skeleton skeleton_;
  Pose rest_;
  std::vector<std::uint8_t> isLoose_;  // per joint
};

}  // namespace foretouch::internal
