// middleware/triggers/trigger_volume.h: the shape of a trigger: a volume with an inside, in a frame
// of its own. Metres.
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "articulated/result.h"
#include "lss/lss.h"
#include "middleware/scene/scene.h"

namespace foretouch {

namespace internal {
struct VolumeParts;
}

/// Immutable; cheap to copy (shared).
class TriggerVolume {
 public:
  /// A box around the origin of its frame, along its axes. Errors: an extent that is not above 0
  /// and below kMaxCoordinate.
  static Result<TriggerVolume> box(const Eigen::Vector3d& halfExtents);
  /// Around the origin. Errors: as above.
  static Result<TriggerVolume> sphere(double radius);
  /// Solid LSS, all of which are one volume. Errors: none, or as Avatar::build().
  static Result<TriggerVolume> lss(std::vector<Lss> lss);
  /// What is inside some object of the scene. The triangles may be turned any way, and in any
  /// order, but each object must be closed: every edge, by its exact coordinates, belongs to two of
  /// its triangles, or to another even number. Errors (Mismatch): an open edge; the message names
  /// the object and the edge, Error::index is a triangle of it. O(n log n).
  static Result<TriggerVolume> mesh(const Scene& closed);

  /// For the triggers' own sources.
  [[nodiscard]] const internal::VolumeParts& parts() const { return *parts_; }

 private:
  explicit TriggerVolume(std::shared_ptr<const internal::VolumeParts> parts)
      : parts_(std::move(parts)) {}
  std::shared_ptr<const internal::VolumeParts> parts_;
};

}  // namespace foretouch
