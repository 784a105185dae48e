#include "tests/bindings/same_answers.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "tests/bindings/c_world.h"

namespace foretouch::test {

void expectSameVector(const double (&c)[3], const Eigen::Vector3d& cxx) {
  EXPECT_EQ(std::memcmp(c, cxx.data(), sizeof c), 0) << c[0] << " and " << cxx.x();
}

void expectSameDepth(double c, bool startsInside, double cxx) {
  if (startsInside && cxx == 0.0) {
    EXPECT_TRUE(std::isnan(c)) << c;
  } else {
    EXPECT_EQ(c, cxx);
  }
}

void expectSame(const ft_contact& c, const LinkContact& cxx, const Scene& scene) {
  EXPECT_EQ(c.size, sizeof c);
  EXPECT_EQ(c.link, cxx.link);
  EXPECT_EQ(c.verdict, static_cast<int>(cxx.verdict));
  EXPECT_EQ(c.reason, static_cast<int>(cxx.reason));
  EXPECT_EQ(c.toi, cxx.toi);
  EXPECT_EQ(c.free_until, cxx.freeUntil);
  EXPECT_EQ(c.separation, cxx.separation);
  expectSameDepth(c.penetration, cxx.verdict == Verdict::StartsInContact, cxx.penetration);
  expectSameVector(c.point_scene, cxx.p_WScene);
  expectSameVector(c.point_link, cxx.p_WLink);
  expectSameVector(c.normal, cxx.nhat_SL_W);
  EXPECT_EQ(c.triangle, cxx.triangle);
  EXPECT_EQ(c.object, cxx.triangle < 0 ? -1 : scene.object(cxx.triangle));
  EXPECT_EQ(c.lss, cxx.lss);
  EXPECT_EQ(c.link_triangle, cxx.linkTriangle);
  EXPECT_EQ(c.link_feature, static_cast<int>(cxx.linkFeature));
  EXPECT_EQ(c.scene_feature, static_cast<int>(cxx.sceneFeature));
}

std::size_t expectSameObjects(const ft_query* query, const StepContacts& step, const Scene& scene,
                              Scope scope) {
  std::size_t count = 0;
  const ft_status status = ft_query_objects(query, nullptr, 0, &count);
  EXPECT_EQ(status, scope == Scope::EveryObject ? FT_OK : FT_ERROR_MISMATCH);
  EXPECT_EQ(count, step.perObject.size());
  std::vector<ft_contact> contacts(count + 1);
  contacts[0].size = sizeof(ft_contact);
  if (count == 0) return 0;
  EXPECT_EQ(ft_query_objects(query, contacts.data(), count, nullptr), FT_OK);
  for (std::size_t i = 0; i < count; ++i) expectSame(contacts[i], step.perObject[i], scene);
  EXPECT_EQ(contacts[count].size, 0u) << "written past the end";
  return count;
}

void expectSame(const ft_contact_details& c, const ContactDetails& cxx) {
  expectSameVector(c.velocity_scene, cxx.v_WOther);
  expectSameVector(c.velocity_link, cxx.v_WLink);
  EXPECT_EQ(c.approach_speed, cxx.approachSpeed);
  EXPECT_EQ(c.approach_lower, cxx.approachLower);
  EXPECT_EQ(c.approach_upper, cxx.approachUpper);
  ASSERT_EQ(c.point_count, static_cast<int>(cxx.numPoints));
  for (std::size_t i = 0; i < cxx.numPoints; ++i) {
    expectSameVector(c.points[i].point_scene, cxx.points[i].p_WOther);
    expectSameVector(c.points[i].point_link, cxx.points[i].p_WLink);
    EXPECT_EQ(c.points[i].separation, cxx.points[i].separation);
    EXPECT_EQ(c.points[i].triangle, cxx.points[i].triangle);
    EXPECT_EQ(c.points[i].lss, cxx.points[i].lss);
    EXPECT_EQ(c.points[i].link_triangle, cxx.points[i].linkTriangle);
  }
}

int expectSameDetails(ft_query* query, std::int32_t list, const std::vector<LinkContact>& contacts,
                      const Query& question, const ChainMotion& motion) {
  Scratch scratch;
  int touches = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    ft_contact_details details{};
    details.size = sizeof details;
    const Verdict verdict = contacts[i].verdict;
    const bool isTouch = verdict == Verdict::Contact || verdict == Verdict::StartsInContact;
    EXPECT_EQ(ft_query_details(query, list, i, &details), isTouch ? FT_OK : FT_ERROR_MISMATCH);
    if (isTouch) expectSame(details, question.details(motion, contacts[i], scratch));
    touches += isTouch;
  }
  return touches;
}

void expectSamePose(ft_query* query, const ChainMotion& motion, double t) {
  Pose pose;
  motion.poseAt(t, pose);
  std::vector<double> rotations(4 * pose.rotations.size()), translations(3 * pose.rotations.size());
  std::size_t joints = 0;
  ASSERT_EQ(ft_motion_pose(query, t, rotations.data(), translations.data(), pose.rotations.size(),
                           &joints),
            FT_OK);
  ASSERT_EQ(joints, pose.rotations.size());
  const PoseArrays expected(pose);
  EXPECT_EQ(rotations, expected.rotations);
  EXPECT_EQ(translations, expected.translations);
}

}  // namespace foretouch::test
