#include "middleware/scene/scene.h"

#include <limits>

#include <gtest/gtest.h>

namespace foretouch {
namespace {

using Eigen::Vector3d;

RawScene oneTriangle() {
  return {{{{Vector3d(1, 0, 0), Vector3d(0, 0, 0), Vector3d(0, 1, 0)}}}, {0}, {"thing"}};
}

TEST(BuildScene, RefusesAnEmptyScene) {
  const auto scene = Scene::build({});
  ASSERT_FALSE(scene.ok());
  EXPECT_EQ(scene.error().code, ErrorCode::Empty);
}

TEST(BuildScene, DropsWhatHasNoPlaceAndKeepsItsNumber) {
  RawScene raw = oneTriangle();
  Triangle bad = raw.triangles[0];
  bad.vertices[1].y() = std::numeric_limits<double>::quiet_NaN();
  raw.triangles.insert(raw.triangles.begin(), bad);
  raw.objectOf = {0, 0};
  const auto scene = Scene::build(raw);
  ASSERT_TRUE(scene.ok());
  EXPECT_EQ(scene.value().numTriangles(), 2u);
  EXPECT_EQ(scene.value().audit().triangles, 1u);
  EXPECT_EQ(scene.value().audit().droppedNonFinite, 1u);
  EXPECT_EQ(scene.value().triangle(1).vertices[0], Vector3d(0, 0, 0));
}

TEST(BuildScene, RefusesASceneOfNothingFinite) {
  RawScene raw = oneTriangle();
  raw.triangles[0].vertices[0].x() = std::numeric_limits<double>::infinity();
  const auto scene = Scene::build(raw);
  ASSERT_FALSE(scene.ok());
  EXPECT_EQ(scene.error().code, ErrorCode::Empty);
}

TEST(BuildScene, RefusesObjectsThatDoNotExist) {
  for (const ObjectId object : {-1, 1}) {
    RawScene raw = oneTriangle();
    raw.objectOf[0] = object;
    const auto scene = Scene::build(raw);
    ASSERT_FALSE(scene.ok());
    EXPECT_EQ(scene.error().code, ErrorCode::OutOfRange);
    EXPECT_EQ(scene.error().index, 0);
  }
}

TEST(BuildScene, RefusesMissingObjectIndices) {
  RawScene raw = oneTriangle();
  raw.objectOf.clear();
  const auto scene = Scene::build(raw);
  ASSERT_FALSE(scene.ok());
  EXPECT_EQ(scene.error().code, ErrorCode::Mismatch);
}

TEST(BuildScene, RefusesCoordinatesBeyondWhatDoublesResolve) {
  RawScene raw = oneTriangle();
  raw.triangles[0].vertices[2].z() = 1.1e7;
  const auto scene = Scene::build(raw);
  ASSERT_FALSE(scene.ok());
  EXPECT_EQ(scene.error().code, ErrorCode::OutOfRange);
}

TEST(BuildScene, SortsVerticesSoThatSharedFeaturesAreEvaluatedAlike) {
  const Scene scene = Scene::build(oneTriangle()).value();
  EXPECT_EQ(scene.triangle(0).vertices[0], Vector3d(0, 0, 0));
  EXPECT_EQ(scene.triangle(0).vertices[1], Vector3d(0, 1, 0));
  EXPECT_EQ(scene.triangle(0).vertices[2], Vector3d(1, 0, 0));
}

}  // namespace
}  // namespace foretouch
