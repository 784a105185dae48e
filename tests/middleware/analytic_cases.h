// tests/middleware/analytic_cases.h: motions whose first contact is known in closed form. Makes
// each case in its own frame and then places it by a random rigid placement, up to 10 km from the
// origin: the avatar's root carries the placement, the scene is placed in long double.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/skeleton.h"
#include "middleware/scene/scene.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {

struct AnalyticCase {
  std::string name;
  Lss lss;
  // The moving joint's pose in the case's own frame.
  Quaternion fromRotation = Quaternion::Identity(), toRotation = Quaternion::Identity();
  Eigen::Vector3d fromTranslation = Eigen::Vector3d::Zero(),
                  toTranslation = Eigen::Vector3d::Zero();
  std::vector<Triangle> triangles;  // in the case's own frame until place()
  /// First t with separation 0; nothing if the motion stays clear.
  std::optional<double> impact;
  bool startsInContact = false;
  /// Separation of LSS surface and scene at t, closed form (negative: inside).
  std::function<double(double)> separationAt;

  Quaternion placeRotation = Quaternion::Identity();
  Eigen::Vector3d placeTranslation = Eigen::Vector3d::Zero();
  double guard = 1e-12;  ///< Metres: the largest displacement by placing in doubles.

  void place(Random& random);
  [[nodiscard]] Avatar avatar() const;
  [[nodiscard]] ChainMotion motion() const;
  [[nodiscard]] Scene scene() const;
  static constexpr LinkId kLink = 1;
};

using CaseMaker = AnalyticCase (*)(Random&);
AnalyticCase fallingSphere(Random& random);
AnalyticCase rodToFloor(Random& random);
AnalyticCase rodToEdge(Random& random);
AnalyticCase rodToVertex(Random& random);
AnalyticCase parallelRod(Random& random);
AnalyticCase passingSphere(Random& random);
AnalyticCase standingStill(Random& random);
AnalyticCase halfTurn(Random& random);

}  // namespace foretouch::test
