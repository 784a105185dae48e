// middleware/query/manifold.h: up to four points that hold what two surfaces do where they are
// near, chosen so that neither threads nor the numbers of triangles matter. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "lss/separation.h"
#include "middleware/query/query.h"

namespace foretouch::internal {

/// A part of a surface at an instant: an LSS, or a triangle.
struct ManifoldPart {
  Hull hull;
  double radius;
  std::int32_t lss;
  std::int32_t triangle;
};

/// Keeps its memory.
class Manifold {
 public:
  /// `nhat`: from the other side to the one, where two parts meet.
  void begin(double within, const Eigen::Vector3d& nhat);
  /// The closest points, and those of the corners, as far as they are within the distance, and on
  /// the surfaces: what lies on a face is held at its corners.
  void offer(const ManifoldPart& one, const ManifoldPart& other);
  /// Fills the points, as ContactDetails says.
  void choose(ContactDetails& details);

 private:
  void keep(const ManifoldPart& one, const ManifoldPart& other, const Hull& hull,
            const Hull& otherHull);

  double within_ = 0.0;
  Eigen::Vector3d nhat_ = Eigen::Vector3d::Zero();
  std::vector<ContactPoint> points_;
};

}  // namespace foretouch::internal
