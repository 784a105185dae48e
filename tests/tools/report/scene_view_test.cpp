#include "tools/report/scene_view.h"

#include <set>

#include <gtest/gtest.h>

#include "tests/support/random_geometry.h"

namespace foretouch::tools {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

/// Bumpy squares in the plane y = 0, `side` x `side` cells of a metre each, side by side along x.
RawScene plates(int objects, int side, const Vector3d& at = Vector3d::Zero()) {
  RawScene raw;
  for (int object = 0; object < objects; ++object) {
    raw.objectNames.push_back("plate " + std::to_string(object));
    const auto corner = [&](int x, int z) {
      return Vector3d(at + Vector3d(x + object * side, 0.1 * ((x * 7 + z * 3) % 5), z));
    };
    for (int x = 0; x < side; ++x) {
      for (int z = 0; z < side; ++z) {
        raw.triangles.push_back({{corner(x, z), corner(x + 1, z), corner(x, z + 1)}});
        raw.triangles.push_back({{corner(x + 1, z), corner(x + 1, z + 1), corner(x, z + 1)}});
        raw.objectOf.insert(raw.objectOf.end(), {object, object});
      }
    }
  }
  return raw;
}

Vector3d vertexOf(const ViewScene& view, std::size_t corner) {
  const std::size_t vertex = view.mesh.indices[corner];
  const float* const p = view.mesh.positions.data() + 3 * vertex;
  return view.origin +
         Vector3d(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
}

void expectWellFormed(const ViewScene& view) {
  for (const std::uint32_t index : view.mesh.indices) ASSERT_LT(index, view.mesh.vertices());
  std::set<std::array<float, 3>> places;
  for (std::size_t v = 0; v < view.mesh.vertices(); ++v) {
    const float* const p = view.mesh.positions.data() + 3 * v;
    places.insert({p[0], p[1], p[2]});
  }
  EXPECT_EQ(places.size(), view.mesh.vertices());  // what is equal is one vertex
  std::uint32_t next = 0;
  for (const ViewObject& object : view.objects) {
    EXPECT_EQ(object.first, next);
    next += object.count;
  }
  EXPECT_EQ(next, view.mesh.triangles());
}

/// Every shown triangle is the scene's of that id, to within `tolerance`.
void expectTheScenesOwn(const ViewScene& view, const Scene& scene, double tolerance) {
  ASSERT_EQ(view.triangleIds.size(), view.mesh.triangles());
  for (std::size_t i = 0; i < view.triangleIds.size(); ++i) {
    const Triangle& own = scene.triangle(static_cast<TriangleId>(view.triangleIds[i]));
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_LE((vertexOf(view, 3 * i + k) - own.vertices[k]).norm(), tolerance) << i;
    }
  }
}

bool shows(const ViewScene& view, const Triangle& triangle) {
  for (std::size_t i = 0; i < view.mesh.triangles(); ++i) {
    bool isIt = true;
    for (std::size_t k = 0; k < 3; ++k) {
      isIt = isIt && (vertexOf(view, 3 * i + k) - triangle.vertices[k]).norm() < 1e-4;
    }
    if (isIt) return true;
  }
  return false;
}

TEST(SceneView, ShowsALightSceneAsItIs) {
  const Scene scene = Scene::build(plates(3, 4)).value();
  std::vector<std::string> notes;
  const ViewScene view = viewOf(scene, {"plates", 96, {}, {}}, notes);
  EXPECT_EQ(view.reduction, SceneReduction::None);
  EXPECT_TRUE(notes.empty());
  EXPECT_EQ(view.mesh.triangles(), 96u);
  EXPECT_EQ(view.trianglesInFile, 96u);
  ASSERT_EQ(view.objects.size(), 3u);
  EXPECT_EQ(view.objects[1].name, "plate 1");
  expectWellFormed(view);
  expectTheScenesOwn(view, scene, 1e-6);
}

TEST(SceneView, LeavesOutTrianglesThatAreNotFinite) {
  RawScene raw = plates(1, 2);
  raw.triangles[3].vertices[1].x() = std::numeric_limits<double>::quiet_NaN();
  const Scene scene = Scene::build(raw).value();
  std::vector<std::string> notes;
  const ViewScene view = viewOf(scene, {"plates", 96, {}, {}}, notes);
  EXPECT_EQ(view.triangleIds, (std::vector<std::uint32_t>{0, 1, 2, 4, 5, 6, 7}));
  EXPECT_EQ(view.reduction, SceneReduction::None);
}

TEST(SceneView, ClipsToWhatIsNearTheAction) {
  const Scene scene = Scene::build(plates(10, 10)).value();  // 100 m along x
  std::vector<std::string> notes;
  SceneRequest request{
      "plates", 700, AlignedBox3d(Vector3d(40, 0, 4), Vector3d(41, 2, 5)), {3}, 0.0};
  const ViewScene view = viewOf(scene, request, notes);
  EXPECT_EQ(view.reduction, SceneReduction::Clipped);
  expectWellFormed(view);
  expectTheScenesOwn(view, scene, 1e-5);
  const std::set<std::uint32_t> shown(view.triangleIds.begin(), view.triangleIds.end());
  EXPECT_EQ(shown.count(3), 1u);  // contacted, though far away
  // Whatever is within four metres of the action is there, and nothing else.
  const AlignedBox3d near(Vector3d(36, -4, 0), Vector3d(45, 6, 9));
  for (std::uint32_t id = 0; id < scene.numTriangles(); ++id) {
    AlignedBox3d own;
    for (const Vector3d& v : scene.triangle(static_cast<TriangleId>(id)).vertices) own.extend(v);
    EXPECT_EQ(shown.count(id) > 0, near.intersects(own) || id == 3) << id;
  }
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("2000 triangles"), std::string::npos) << notes[0];
  EXPECT_NE(notes[0].find("within 4 m"), std::string::npos) << notes[0];
}

TEST(SceneView, RatherHidesDetailsThatNobodySeesThanLeavesOutWhatIsFarther) {
  const Scene scene = Scene::build(plates(10, 10)).value();
  std::vector<std::string> notes;
  SceneRequest request{
      "plates", 700, AlignedBox3d(Vector3d(40, 0, 4), Vector3d(41, 2, 5)), {3}, 0.5};
  const ViewScene view = viewOf(scene, request, notes);
  EXPECT_EQ(view.reduction, SceneReduction::Simplified);
  EXPECT_LE(view.mesh.triangles(), 701u);
  EXPECT_EQ(view.objects.size(), 10u);
  EXPECT_TRUE(shows(view, scene.triangle(3)));
  expectWellFormed(view);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].find("within"), std::string::npos) << notes[0];
  // Nine times too many: not even tried.
  request.maxTriangles = 220;
  EXPECT_EQ(viewOf(scene, request, notes).reduction, SceneReduction::Clipped);
}

TEST(SceneView, KeepsALargeFloorThatTheActionStandsOn) {
  RawScene raw = plates(10, 10, {500, 0, 500});
  raw.triangles.push_back({{Vector3d(-900, 0, -900), Vector3d(900, 0, -900), Vector3d(0, 0, 900)}});
  raw.objectOf.push_back(10);
  raw.objectNames.push_back("floor");
  const Scene scene = Scene::build(raw).value();
  std::vector<std::string> notes;
  const ViewScene view =
      viewOf(scene, {"s", 100, AlignedBox3d(Vector3d(0, 1, 0), Vector3d(1, 2, 1)), {}, 0.0}, notes);
  EXPECT_EQ(view.triangleIds, std::vector<std::uint32_t>{2000});
}

TEST(SceneView, SimplifiesWhatIsStillTooMuchAndKeepsWhatIsTouched) {
  for (int i = 0; i < 20; ++i) {
    test::Random random(static_cast<std::uint64_t>(i));
    const Scene scene =
        Scene::build(plates(4, 30, 10.0 * random.direction())).value();  // 7,200 triangles
    SceneRequest request{"plates", 1000, {}, {}};
    if (i % 2 == 0) request.action = AlignedBox3d(Vector3d(-9, -9, -9), Vector3d(200, 9, 99));
    for (int k = 0; k < 20; ++k) {
      request.contacted.push_back(static_cast<TriangleId>(random.uniform(0, 7199.9)));
    }
    std::vector<std::string> notes;
    const ViewScene view = viewOf(scene, request, notes);
    EXPECT_EQ(view.reduction, SceneReduction::Simplified);
    EXPECT_TRUE(view.triangleIds.empty());
    EXPECT_LE(view.mesh.triangles(), 1100u);
    EXPECT_GE(view.mesh.triangles(), 300u);
    expectWellFormed(view);
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_NE(notes[0].find("7200 triangles"), std::string::npos) << notes[0];
    const AlignedBox3d bounds(view.boundsMin - Vector3d::Constant(1e-4),
                              view.boundsMax + Vector3d::Constant(1e-4));
    for (std::size_t corner = 0; corner < view.mesh.indices.size(); ++corner) {
      ASSERT_TRUE(bounds.contains(vertexOf(view, corner)));
    }
    for (const TriangleId id : request.contacted) {
      EXPECT_TRUE(shows(view, scene.triangle(id))) << "case " << i << " triangle " << id;
    }
  }
}

TEST(SceneView, SimplifiesASceneOfCrumbs) {
  const Scene scene = Scene::build(plates(3000, 1)).value();  // two triangles each
  std::vector<std::string> notes;
  const ViewScene view = viewOf(scene, {"crumbs", 500, {}, {4}}, notes);
  EXPECT_EQ(view.reduction, SceneReduction::Simplified);
  EXPECT_LE(view.mesh.triangles(), 600u);
  EXPECT_GE(view.mesh.triangles(), 50u);
  ASSERT_EQ(view.objects.size(), 1u);
  EXPECT_EQ(view.objects[0].name, "3000 small objects");
  EXPECT_TRUE(shows(view, scene.triangle(4)));
}

TEST(SceneView, StaysExactFarFromTheOrigin) {
  const Vector3d far(1e6, -2e5, 3e6);
  const Scene scene = Scene::build(plates(3, 20, far)).value();
  for (const std::size_t most : {100'000u, 1500u}) {
    std::vector<std::string> notes;
    const AlignedBox3d action(far, far + Vector3d::Ones());
    const ViewScene view = viewOf(scene, {"far", most, action, {}, 0.0}, notes);
    EXPECT_NE(view.reduction, SceneReduction::Simplified);
    expectTheScenesOwn(view, scene, 1e-5);
  }
}

TEST(SceneView, ShowsTheSceneWhereTheActionIsElsewhere) {
  const Scene scene = Scene::build(plates(2, 30)).value();
  std::vector<std::string> notes;
  const AlignedBox3d action(Vector3d(1e5, 0, 0), Vector3d(1e5 + 1, 1, 1));
  const ViewScene view = viewOf(scene, {"elsewhere", 1000, action, {}}, notes);
  EXPECT_EQ(view.reduction, SceneReduction::Simplified);
  EXPECT_GE(view.mesh.triangles(), 300u);
}

}  // namespace
}  // namespace foretouch::tools
