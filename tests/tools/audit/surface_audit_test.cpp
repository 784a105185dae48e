#include "tools/audit/surface_audit.h"

#include <gtest/gtest.h>

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// Links a, b, c with a ball of 1 m, a ball of 1 m and nothing.
Avatar threeLinks() {
  RawSkeleton raw;
  for (const char* name : {"a", "b", "c"}) {
    raw.joints.push_back({name, kNoParent, {0, 0, 0}, Quaternion::Identity()});
  }
  const Lss ball{{0, 0, 0}, {0, 0, 0}, 1.0};
  return Avatar::build(Skeleton::build(raw).value(), {{ball}, {ball}, {}}).value();
}

Triangle reaching(double x) {
  return {{Vector3d(x, 0, 0), Vector3d(0, 0.5, 0), Vector3d(0, 0, 0.5)}};
}

TEST(AuditSurface, FindsNothingAmissWhereLssContainTheirTriangles) {
  const SurfaceAudit audit = auditSurface(
      threeLinks(), {{reaching(0.5), reaching(-0.5)}, {reaching(1.0), reaching(0)}, {}});
  EXPECT_EQ(audit.triangles, 4u);
  EXPECT_EQ(audit.outside, 0u);
  EXPECT_TRUE(audit.ofOneTriangle.empty());
  EXPECT_TRUE(doubtsAbout(audit).empty());
  EXPECT_GT(audit.lssVolume, 8.0);
}

TEST(AuditSurface, SaysHowFarTheWorstTriangleSticksOutAndOnWhichLink) {
  const SurfaceAudit audit = auditSurface(
      threeLinks(), {{reaching(1.5), reaching(0.5)}, {reaching(1.25), reaching(3)}, {}});
  EXPECT_EQ(audit.outside, 3u);
  EXPECT_NEAR(audit.worstOutside, 2.0, 1e-15);
  EXPECT_EQ(audit.worstLink, "b");
  ASSERT_EQ(doubtsAbout(audit).size(), 1u);
  EXPECT_NE(doubtsAbout(audit)[0].find("3 triangles"), std::string::npos);
  EXPECT_NE(doubtsAbout(audit)[0].find("2000 mm on 'b'"), std::string::npos);
  EXPECT_NE(describe(audit).find("3, the worst by 2000 mm, on 'b'"), std::string::npos);
}

TEST(AuditSurface, ListsLinksOfOneTriangleAndMeshesWithoutAnLss) {
  const SurfaceAudit audit =
      auditSurface(threeLinks(), {{reaching(0.5)}, {}, {reaching(0.5), reaching(0.1)}});
  EXPECT_EQ(audit.ofOneTriangle, (std::vector<std::string>{"a"}));
  EXPECT_EQ(audit.withoutLss, (std::vector<std::string>{"c"}));
  EXPECT_EQ(audit.outside, 0u);
  ASSERT_EQ(doubtsAbout(audit).size(), 1u);
  EXPECT_NE(doubtsAbout(audit)[0].find("'c'"), std::string::npos);
}

TEST(ExcessInWords, IsAShareOfWhatIsContained) {
  EXPECT_EQ(excessInWords(3.0, 2.0), "50.0 % of the 2 m^3 that they contain");
  EXPECT_NE(excessInWords(3.0, 0.0).find("flat"), std::string::npos);
}

}  // namespace
}  // namespace foretouch::tools
