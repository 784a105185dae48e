// Rows between own links.
#include "middleware/solid/own_features.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "middleware/solid/certifier.h"
#include "middleware/solid/tree_pose.h"
#include "tests/middleware/solid/ball_alone.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

TEST(OwnFeatures, HoldTwoThatLieAlongEachOtherAtBothEnds) {
  RawSkeleton raw;
  raw.joints.push_back({"one", kNoParent, Vector3d::Zero(), Quaternion(Quaternion::Identity())});
  raw.joints.push_back({"other", 0, Vector3d(0, 0.3, 0), Quaternion(Quaternion::Identity())});
  const std::vector<Lss> rod{{Vector3d::Zero(), Vector3d(0.4, 0, 0), 0.1}};
  const Avatar avatar = Avatar::build(Skeleton::build(raw).value(), {rod, rod}).value();
  SolidOptions options;
  options.self = PairRules::asking(avatar, {{0, 1}}).value();
  const auto certifier =
      internal::Certifier::build(avatar, boardAt(Vector3d(0, 0, 9), 1.0), options).value();
  std::vector<LinkState> states;
  internal::placeLinks(avatar.skeleton(), restPose(avatar.skeleton()), states);
  std::vector<internal::ContactRow> rows;
  const internal::OwnFeatures own(certifier.plan());
  own.append(certifier.plan(), {states, states}, options.skin, {0.1, 0.1}, {1, 1}, rows);
  for (const internal::ContactRow& row : rows) {
    EXPECT_NEAR(row.gap, 0.1, 1e-12);
    EXPECT_NEAR(row.n.y(), -1.0, 1e-12);
    EXPECT_NEAR(row.x.y(), 0.1, 1e-12);
    EXPECT_NEAR(row.y.y(), 0.2, 1e-12);
  }
  for (const double x : {0.0, 0.4}) {
    EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), [x](const internal::ContactRow& row) {
      return std::abs(row.x.x() - x) < 1e-6 && std::abs(row.y.x() - x) < 1e-6;
    })) << x;
  }
}

}  // namespace
}  // namespace foretouch::test
