// Where a motion that meets something is cut.
#include "middleware/solid/certifier.h"

#include <gtest/gtest.h>

#include "tests/middleware/solid/ball_alone.h"

namespace foretouch::test {
namespace {

TEST(Certifier, CutsHalfASkinBeforeWhatItMeetsOrNearWhereItBegan) {
  const SolidOptions options;
  const Avatar avatar = ballAlone(0.1);
  const Scene scene = boardAt(Eigen::Vector3d::Zero(), 5.0);
  auto certifier = internal::Certifier::build(avatar, scene, options).value();
  for (const double begins : {0.9, 0.02, 0.5 * options.skin}) {
    certifier.beginTick(1'000'000);
    const Pose from = ballAt({0.3, 0.2, 0.1 + begins}), to = ballAt({-0.3, 0.1, -0.4});
    Pose reached;
    const internal::Certified answer = certifier.certify(from, to, reached);
    EXPECT_FALSE(answer.isClear);
    EXPECT_TRUE(answer.hasHit);
    const double gap = reached.translations[0].z() - 0.1;
    EXPECT_NEAR(gap, std::min(0.5 * options.skin, 0.95 * begins), 1e-9);
    EXPECT_LE(answer.clearance, gap);
    EXPECT_GT(answer.clearance, 0.0);
    EXPECT_TRUE(certifier.isClear(from, reached));
  }
}

}  // namespace
}  // namespace foretouch::test
