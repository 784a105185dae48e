#include "tools/report/swept_views.h"

#include <gtest/gtest.h>

#include "tests/tools/small_inputs.h"
#include "tools/report/track_builder.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

ReportProgress onward() {
  return [](std::int64_t, std::int64_t) { return true; };
}

/// The small avatar through the wall, over and over, with a contact of the hips in every step;
/// every third is not missed by the poses.
ViewDocument document(const ReplayInputs& inputs) {
  ViewAvatar avatar;
  avatar.avatar = &inputs.avatar;
  TrackBuilder track(inputs.avatar, std::nullopt);
  for (std::int64_t i = 0; i <= inputs.steps.count; ++i) {
    track.addPose(inputs.timeOfStep(i), poseAtFrame(inputs, i).value());
  }
  for (std::uint32_t i = 0; i < inputs.steps.count; ++i) {
    track.addStep(i, i + 1);
    ReportedContact contact;
    contact.step = i;
    contact.contact.verdict = Verdict::Contact;
    contact.contact.triangle = 0;
    contact.timeS = inputs.timeOfStep(i) + 0.05;
    contact.missedByPoses = i % 3 != 0;
    avatar.contacts.push_back(contact);
  }
  avatar.track = track.finish();
  ViewDocument made;
  made.avatars.push_back(std::move(avatar));
  return made;
}

std::vector<double> swingOf(int poses) {
  std::vector<double> places;
  for (int i = 0; i < poses; ++i) places.push_back(i % 2 == 0 ? -0.5 : 0.5 + 0.01 * i);
  return places;
}

double distanceFromSegment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d along = b - a;
  const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (a + t * along - p).norm();
}

TEST(AddSwept, ShowsTheSweepOfEveryContact) {
  const ReplayInputs inputs = test::smallInputs(swingOf(7));
  ViewDocument made = document(inputs);
  addSwept({}, made, onward());
  EXPECT_TRUE(made.notes.empty());
  ASSERT_EQ(made.avatars[0].swept.size(), 6u);
  for (const ViewSwept& swept : made.avatars[0].swept) {
    EXPECT_EQ(swept.link, 0);
    EXPECT_GT(swept.mesh.triangles(), 20u);
    EXPECT_GT(swept.error, 0.0);
    EXPECT_LE(swept.error, 0.1 / 8.0);
    const Vector3d a(inputs.clip.frames[swept.step].translations[0]),
        b(inputs.clip.frames[swept.step + 1].translations[0]);
    // The hips' sphere sweeps a segment's surroundings: the surface lies just outside of them.
    for (std::size_t v = 0; v < swept.mesh.vertices(); ++v) {
      const float* const p = swept.mesh.positions.data() + 3 * v;
      const Vector3d vertex =
          swept.origin +
          Vector3d(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
      EXPECT_LE(distanceFromSegment(vertex, a, b), 0.1 + swept.error + 1e-9);
    }
    for (const std::uint32_t index : swept.mesh.indices) {
      ASSERT_LT(index, swept.mesh.vertices());
    }
  }
}

TEST(AddSwept, ShowsWhatPosesMissFirstAndSaysWhatIsLeftOut) {
  const ReplayInputs inputs = test::smallInputs(swingOf(31));
  ViewDocument made = document(inputs);
  SweptRequest request;
  request.maxTriangles = 3000;
  addSwept(request, made, onward());
  const auto& swept = made.avatars[0].swept;
  ASSERT_GE(swept.size(), 1u);
  ASSERT_LT(swept.size(), 20u);
  std::size_t triangles = 0;
  std::uint32_t before = 0;
  for (const ViewSwept& one : swept) {
    EXPECT_NE(one.step % 3, 0u);
    EXPECT_GE(one.step, before);
    before = one.step;
    triangles += one.mesh.triangles();
  }
  EXPECT_LE(triangles, 3000u);
  ASSERT_EQ(made.notes.size(), 1u);
  EXPECT_NE(made.notes[0].find("of 30 contacts"), std::string::npos) << made.notes[0];
}

TEST(AddSwept, LeavesOutSurfacesThatAreTooLarge) {
  const ReplayInputs inputs = test::smallInputs({0, 1, 0, 5000, 0, 1});
  ViewDocument made = document(inputs);
  SweptRequest request;
  request.maxTrianglesOfOne = 300;
  request.errorShare = 0.01;
  request.leastErrorM = 1e-4;
  addSwept(request, made, onward());
  EXPECT_TRUE(made.avatars[0].swept.empty());
  ASSERT_EQ(made.notes.size(), 1u);
  EXPECT_NE(made.notes[0].find("more than 300 triangles"), std::string::npos) << made.notes[0];
}

TEST(AddSwept, SweepsNothingWithoutContacts) {
  const ReplayInputs inputs = test::smallInputs({0, 1});
  ViewDocument made = document(inputs);
  made.avatars[0].contacts.clear();
  addSwept({}, made, onward());
  EXPECT_TRUE(made.avatars[0].swept.empty());
  EXPECT_TRUE(made.notes.empty());
}

}  // namespace
}  // namespace foretouch::tools
