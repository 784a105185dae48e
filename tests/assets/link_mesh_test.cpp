// Link meshes: what is written is read back bit for bit, and nothing bad is taken.
#include "assets/mesh/link_mesh.h"

#include <cmath>
#include <cstdlib>
#include <fcntl.h>
#include <limits>
#include <stdexcept>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "assets/model/model_avatar.h"
#include "lss/single.h"
#include "tests/assets/import_files.h"
#include "tests/assets/model_files.h"
#include "tests/support/random_geometry.h"
#include "tests/support/shared_data.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;
using Surfaces = std::vector<std::vector<Triangle>>;

struct Body {
  RawSkeleton raw;
  Surfaces surfaces;
};

/// Some links have a surface; one in three bodies has several roots.
Body randomBody(std::uint64_t seed) {
  Random random(seed);
  Body body;
  const int links = 1 + random.below(12);
  for (int i = 0; i < links; ++i) {
    const bool root = i == 0 || (seed % 3 == 0 && random.chance(0.3));
    body.raw.joints.push_back({i == 0 ? "ROOT" : "link " + std::to_string(i),
                               root ? kNoParent : random.below(i), random.inBox(2),
                               random.rotation()});
    body.surfaces.emplace_back();
    for (int t = i == 0 ? 1 : random.below(50); t > 0; --t) {
      Triangle triangle;
      for (Vector3d& v : triangle.vertices) {
        v = nearestFloat(random.inBox(1) * random.magnitude(1e-30, 1e6));
        if (random.chance(0.1)) v.y() = -0.0;
      }
      body.surfaces.back().push_back(triangle);
    }
  }
  return body;
}

Avatar avatarOf(const Skeleton& skeleton, const Surfaces& surfaces, const std::string& file) {
  std::vector<std::vector<Lss>> lss(surfaces.size(), {Lss{{0, 0, 0}, {1, 0, 0}, 1}});
  std::vector<MeshReference> meshes(surfaces.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (!surfaces[i].empty()) meshes[i] = {file, skeleton.name(static_cast<JointId>(i))};
  }
  return Avatar::build(skeleton, lss, meshes).value();
}

/// One link that refers to a node of a file.
Avatar avatarWith(const std::string& file, const std::string& node) {
  RawSkeleton raw;
  raw.joints.push_back({"only", kNoParent, {0, 0, 0}, Quaternion::Identity()});
  return Avatar::build(Skeleton::build(raw).value(), {{Lss{}}}, {{file, node}}).value();
}

bool sameBits(const Vector3d& a, const Vector3d& b) {
  for (int k = 0; k < 3; ++k) {
    if (a[k] != b[k] || std::signbit(a[k]) != std::signbit(b[k])) return false;
  }
  return true;
}

class LinkMeshes : public testing::Test {
 protected:
  Error failureOf(const Avatar& avatar) {
    const auto result = loadLinkMeshes(avatar, folder_ / "a.avatar.json", withModelImporter());
    if (result.ok()) {
      ADD_FAILURE() << "loaded";
      return {};
    }
    return result.error();
  }
  TempFolder folder_;
};

TEST_F(LinkMeshes, ComeBackBitForBit) {
  std::size_t triangles = 0, severalRoots = 0, empty = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const Body body = randomBody(seed);
    const Skeleton skeleton = Skeleton::build(body.raw).value();
    const auto written = writeLinkMeshes(skeleton, body.surfaces, folder_ / "body.glb");
    ASSERT_TRUE(written.ok()) << describe(written.error());
    const auto loaded = loadLinkMeshes(avatarOf(skeleton, body.surfaces, "body.glb"),
                                       folder_ / "a.avatar.json", withModelImporter());
    ASSERT_TRUE(loaded.ok()) << seed << ' ' << describe(loaded.error());
    ASSERT_EQ(loaded.value().size(), body.surfaces.size());
    int roots = 0;
    for (std::size_t i = 0; i < body.surfaces.size(); ++i) {
      roots += body.raw.joints[i].parent == kNoParent;
      empty += body.surfaces[i].empty();
      triangles += body.surfaces[i].size();
      ASSERT_EQ(loaded.value()[i].size(), body.surfaces[i].size()) << seed << ' ' << i;
      for (std::size_t t = 0; t < body.surfaces[i].size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
          ASSERT_TRUE(sameBits(loaded.value()[i][t].vertices[k], body.surfaces[i][t].vertices[k]))
              << seed << ' ' << i << ' ' << t;
        }
      }
    }
    severalRoots += roots > 1;
  }
  EXPECT_GT(triangles, 1000U);
  EXPECT_GT(severalRoots, 3U);
  EXPECT_GT(empty, 2U);
}

TEST_F(LinkMeshes, OfSomeLinksAreTheirsAlone) {
  int wanted = 0, others = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Body body = randomBody(seed);
    const Skeleton skeleton = Skeleton::build(body.raw).value();
    ASSERT_TRUE(writeLinkMeshes(skeleton, body.surfaces, folder_ / "body.glb").ok());
    const Avatar avatar = avatarOf(skeleton, body.surfaces, "body.glb");
    const std::string path = folder_ / "a.avatar.json";
    const auto all = loadLinkMeshes(avatar, path, withModelImporter());
    std::vector<LinkId> even;
    for (LinkId link = 0; link < avatar.numLinks(); link += 2) even.push_back(link);
    const auto some = loadLinkMeshes(avatar, path, even, withModelImporter());
    ASSERT_TRUE(all.ok() && some.ok());
    ASSERT_EQ(some.value().size(), all.value().size());
    for (std::size_t i = 0; i < all.value().size(); ++i) {
      EXPECT_EQ(some.value()[i].size(), i % 2 == 0 ? all.value()[i].size() : 0u);
      (i % 2 == 0 ? wanted : others) += !all.value()[i].empty();
    }
    // Of no link, no file is read.
    EXPECT_TRUE(loadLinkMeshes(avatar, folder_ / "nowhere/a.json", std::vector<LinkId>{}).ok());
  }
  EXPECT_GT(wanted, 5);
  EXPECT_GT(others, 5);
}

TEST_F(LinkMeshes, ShowTheBodyInItsRestPose) {
  RawSkeleton raw;
  const Quaternion quarter(std::sqrt(0.5), 0, 0, std::sqrt(0.5));
  raw.joints.push_back({"upper", kNoParent, {0, 2, 0}, quarter});
  raw.joints.push_back({"lower", 0, {1, 0, 0}, Quaternion::Identity()});
  const Triangle triangle{{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 0, 1)}};
  ASSERT_TRUE(
      writeLinkMeshes(Skeleton::build(raw).value(), {{triangle}, {triangle}}, folder_ / "arm.glb")
          .ok());
  const auto scene = importScene(folder_ / "arm.glb", withImporter());
  ASSERT_TRUE(scene.ok()) << describe(scene.error());
  ASSERT_EQ(scene.value().scene.objectNames, (std::vector<std::string>{"upper", "lower"}));
  EXPECT_TRUE(cornersOf(scene.value(), 0).isApprox(rows({0, 2, 0}, {0, 3, 0}, {0, 2, 1}), 1e-6));
  EXPECT_TRUE(cornersOf(scene.value(), 1).isApprox(rows({0, 3, 0}, {0, 4, 0}, {0, 3, 1}), 1e-6));
}

TEST_F(LinkMeshes, AreNotWrittenWhereTheyCouldNotComeBack) {
  RawSkeleton raw;
  raw.joints.push_back({"a", kNoParent, {0, 0, 0}, Quaternion::Identity()});
  const Skeleton skeleton = Skeleton::build(raw).value();
  const std::string path = folder_ / "bad.glb";
  const auto codeOf = [&](const Skeleton& bones, const Surfaces& surfaces) {
    return writeLinkMeshes(bones, surfaces, path).error().code;
  };
  Triangle triangle{{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 0, 1)}};
  EXPECT_EQ(codeOf(skeleton, {}), ErrorCode::Mismatch);
  EXPECT_EQ(codeOf(skeleton, {{}}), ErrorCode::Empty);
  triangle.vertices[1].x() = 0.1;  // no float
  EXPECT_EQ(codeOf(skeleton, {{triangle}}), ErrorCode::OutOfRange);
  triangle.vertices[1].x() = 1e300;
  EXPECT_EQ(codeOf(skeleton, {{triangle}}), ErrorCode::OutOfRange);
  triangle.vertices[1].x() = std::nan("");
  EXPECT_EQ(codeOf(skeleton, {{triangle}}), ErrorCode::NonFinite);
  triangle.vertices[1].x() = 1;
  raw.joints.push_back({" a", 0, {0, 0, 0}, Quaternion::Identity()});  // a blank is all between
  EXPECT_EQ(codeOf(Skeleton::build(raw).value(), {{triangle}, {}}), ErrorCode::DuplicateName);
  raw.joints[1].name = std::string(1024, 'n');
  EXPECT_EQ(codeOf(Skeleton::build(raw).value(), {{triangle}, {}}), ErrorCode::LimitExceeded);
  raw.joints[1].name = std::string(1023, 'n');
  EXPECT_TRUE(writeLinkMeshes(Skeleton::build(raw).value(), {{triangle}, {triangle}}, path).ok());
  EXPECT_EQ(writeLinkMeshes(skeleton, {{triangle}}, folder_ / "absent/x.glb").error().file,
            folder_ / "absent/x.glb");
  EXPECT_EQ(folder_.names(), (std::set<std::string>{"bad.glb"}));
}

TEST_F(LinkMeshes, KeepTheLongestNamesThatAreTaken) {
  RawSkeleton raw;
  raw.joints.push_back({std::string(1023, 'n'), kNoParent, {0, 0, 0}, Quaternion::Identity()});
  const Skeleton skeleton = Skeleton::build(raw).value();
  const Surfaces surfaces{{Triangle{{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 0, 1)}}}};
  ASSERT_TRUE(writeLinkMeshes(skeleton, surfaces, folder_ / "long.glb").ok());
  EXPECT_TRUE(loadLinkMeshes(avatarOf(skeleton, surfaces, "long.glb"), folder_ / "a.avatar.json",
                             withModelImporter())
                  .ok());
}

TEST_F(LinkMeshes, TakeAllMeshesOfANodeInItsFrame) {
  folder_.write("m.gltf", gltfWithNodes(R"([{"name":"top","translation":[1,1,1],"children":[1]},
{"name":"arm","mesh":0,"translation":[5,0,0],"rotation":[0,0.6,0,0.8]}])",
                                        4));
  const auto loaded =
      loadLinkMeshes(avatarWith("m.gltf", "arm"), folder_ / "a.avatar.json", withModelImporter());
  ASSERT_TRUE(loaded.ok()) << describe(loaded.error());
  ASSERT_EQ(loaded.value()[0].size(), 4U);
  EXPECT_EQ(loaded.value()[0][3].vertices[1], Vector3d(1, 0, 0));
}

TEST_F(LinkMeshes, NeedNodesThatAreThereOnce) {
  folder_.write("m.gltf", gltfWithNodes(R"([{"name":"top","mesh":0,"children":[1,2,3]},
{"name":"twin","mesh":0},{"name":"twin"},{"name":"bare"}])"));
  EXPECT_EQ(failureOf(avatarWith("m.gltf", "absent")).code, ErrorCode::UnknownName);
  EXPECT_EQ(failureOf(avatarWith("m.gltf", "twin")).code, ErrorCode::DuplicateName);
  EXPECT_EQ(failureOf(avatarWith("m.gltf", "bare")).code, ErrorCode::Empty);
  EXPECT_EQ(failureOf(avatarWith("m.gltf", "TOP")).code, ErrorCode::UnknownName);
  EXPECT_EQ(failureOf(avatarWith("absent.glb", "top")).code, ErrorCode::FileNotFound);
  EXPECT_EQ(failureOf(avatarWith("absent.glb", "top")).file, folder_ / "absent.glb");
}

TEST_F(LinkMeshes, RefuseTrianglesThatAreNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  folder_.write("nan.ply", binaryPly({{0, 0, 0}, {1, 0, 0}, {0, nan, 0}}, {{0, 1, 2}}));
  const auto model = importModel(folder_ / "nan.ply", withModelImporter());
  ASSERT_TRUE(model.ok()) << describe(model.error());
  const Error error =
      failureOf(avatarWith("nan.ply", model.value().nodes[model.value().meshes[0].node].name));
  EXPECT_EQ(error.code, ErrorCode::NonFinite);
  EXPECT_EQ(error.index, 0);
}

TEST_F(LinkMeshes, ImportEachFileOnce) {
  const Triangle triangle{{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 0, 1)}};
  const Surfaces surfaces(20, {triangle});
  RawSkeleton raw;
  for (int i = 0; i < 20; ++i) {
    raw.joints.push_back({"l" + std::to_string(i), i - 1, {0, 0, 0}, Quaternion::Identity()});
  }
  const Skeleton skeleton = Skeleton::build(raw).value();
  ASSERT_TRUE(writeLinkMeshes(skeleton, surfaces, folder_ / "b.glb").ok());
  // An importer that works once: it takes a line from a pipe that holds one good one.
  const std::string recorded = std::string(FORETOUCH_TEST_IMPORTER) + " --model '" +
                               (folder_ / "b.glb") + "' > '" + (folder_ / "answer") + "'";
  ASSERT_EQ(std::system(recorded.c_str()), 0);
  const std::string tickets = folder_ / "tickets";
  ASSERT_EQ(mkfifo(tickets.c_str(), 0600), 0);
  const int held = ::open(tickets.c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(::write(held, "good\nused\n", 10), 10);
  ModelImportOptions options;
  options.import.importer = folder_.script(
      "once", "read ticket < '" + tickets + "'; [ \"$ticket\" = good ] || exit 1; exec cat '" +
                  (folder_ / "answer") + "'");
  const Avatar avatar = avatarOf(skeleton, surfaces, "b.glb");
  const auto loaded = loadLinkMeshes(avatar, folder_ / "a.avatar.json", options);
  EXPECT_TRUE(loaded.ok()) << describe(loaded.error());
  EXPECT_FALSE(loadLinkMeshes(avatar, folder_ / "a.avatar.json", options).ok());
  ::close(held);
}

/// The avatar of a model that refers to the model itself.
ModelAvatar avatarOfFile(const std::string& path) {
  const auto model = importModel(path, withModelImporter());
  if (!model.ok()) throw std::runtime_error(describe(model.error()));
  ModelAvatarOptions options;
  options.meshFile = path;
  return avatarFromModel(model.value(), options).value();
}

/// Vertices within `slack` metres; 0: the same bits.
void expectTheSame(const Surfaces& loaded, const Surfaces& made, double slack = 0.0) {
  ASSERT_EQ(loaded.size(), made.size());
  for (std::size_t link = 0; link < made.size(); ++link) {
    ASSERT_EQ(loaded[link].size(), made[link].size()) << link;
    for (std::size_t t = 0; t < made[link].size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector3d &a = loaded[link][t].vertices[k], &b = made[link][t].vertices[k];
        ASSERT_TRUE(sameBits(a, b) || (a - b).norm() < slack) << link;
      }
    }
  }
}

TEST_F(LinkMeshes, FollowTheAvatarsRuleForBones) {
  const std::string path = folder_.write("leg.gltf", skinnedGltf());
  const ModelAvatar made = avatarOfFile(path);
  const auto loaded = loadLinkMeshes(made.avatar, folder_ / "a.json", withModelImporter());
  ASSERT_TRUE(loaded.ok()) << describe(loaded.error());
  expectTheSame(loaded.value(), made.surface);
  EXPECT_EQ(made.report.triangles, 1U);
  EXPECT_EQ(failureOf(avatarWith("leg.gltf", "elbow")).code, ErrorCode::UnknownName);
}

TEST_F(LinkMeshes, FollowTheAvatarsRuleForScaledNodes) {
  const std::string path =
      folder_.write("scaled.gltf", gltfWithNodes(R"([{"name":"top","scale":[3,3,3],"children":[1]},
{"name":"arm","mesh":0,"translation":[5,0,0]}])"));
  const ModelAvatar made = avatarOfFile(path);
  const auto loaded = loadLinkMeshes(made.avatar, folder_ / "a.json", withModelImporter());
  ASSERT_TRUE(loaded.ok()) << describe(loaded.error());
  expectTheSame(loaded.value(), made.surface);
  // In metres: the link's frame does not scale, so its triangles do.
  double longest = 0;
  for (const auto& surface : loaded.value()) {
    for (const Triangle& t : surface) {
      longest = std::max(longest, (t.vertices[1] - t.vertices[0]).norm());
    }
  }
  EXPECT_NEAR(longest, 3.0, 1e-5);
}

class LinkMeshesOfRealModels : public testing::TestWithParam<const char*> {};

TEST_P(LinkMeshesOfRealModels, AreThoseOfTheirAvatars) {
  FORETOUCH_REQUIRE_SHARED(path, GetParam());
  const ModelAvatar made = avatarOfFile(*path);
  const auto loaded = loadLinkMeshes(made.avatar, "", withModelImporter());
  ASSERT_TRUE(loaded.ok()) << describe(loaded.error());
  // The frames of a robot's links are rotations up to rounding, which the avatar takes off.
  const bool isRobot = std::string(GetParam()).find("urdf") != std::string::npos;
  expectTheSame(loaded.value(), made.surface, isRobot ? 1e-13 : 0.0);
  // And once more by way of a file of our own.
  const TempFolder folder;
  const auto written = writeLinkMeshes(made.avatar.skeleton(), made.surface, folder / "links.glb");
  ASSERT_TRUE(written.ok()) << describe(written.error());
  const auto again = loadLinkMeshes(avatarOf(made.avatar.skeleton(), made.surface, "links.glb"),
                                    folder / "a.json", withModelImporter());
  ASSERT_TRUE(again.ok()) << describe(again.error());
  expectTheSame(again.value(), made.surface);
}

INSTANTIATE_TEST_SUITE_P(SharedData, LinkMeshesOfRealModels,
                         testing::Values("avatars/cesium_man.gltf", "avatars/robot_expressive.glb",
                                         "avatars/greenman.glb", "avatars/Fox.glb",
                                         "avatars/Testwuson.X",
                                         "avatars/kaykit_manny/manny_med_mod.gltf",
                                         "robots/kuka_iiwa/model.urdf",
                                         "robots/franka_panda/panda.urdf"));

TEST_F(LinkMeshes, RefuseAHostileFile) {
  folder_.write("deep.bvh", bvhThatCrashesTheReader());
  EXPECT_EQ(failureOf(avatarWith("deep.bvh", "n")).code, ErrorCode::ImportCrashed);
}

}  // namespace
}  // namespace foretouch::test
