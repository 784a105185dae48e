// Avatars from rigged models: which nodes are links, who owns which triangle, and where it is.
#include "assets/model/model_avatar.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "judge/plain_motion.h"
#include "tests/assets/model_samples.h"

namespace foretouch {
namespace {

using test::addBone;
using test::addMesh;
using test::addNode;
using test::at;
using test::Matrix3d;
using test::Matrix4d;
using test::oneTriangle;
using test::Vector3d;

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInf = std::numeric_limits<double>::infinity();

std::vector<std::string> namesOf(const Skeleton& skeleton) {
  std::vector<std::string> names;
  for (JointId j = 0; j < skeleton.numJoints(); ++j) names.push_back(skeleton.name(j));
  return names;
}

bool isNoted(const ModelAvatarReport& report, const std::string& part) {
  return std::any_of(report.notes.begin(), report.notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

struct Tally {
  int skins = 0, mirrored = 0, uneven = 0, pivots = 0;
};

/// A tree with turns, scales of all kinds and pivots; rigid meshes and skins whose bind pose is not
/// the rest pose.
Model randomModel(test::Random& random, Tally& tally) {
  Model model;
  const int nodes = 2 + random.below(12);
  for (int i = 0; i < nodes; ++i) {
    const auto kind = static_cast<test::RandomScale>(random.below(4));
    tally.mirrored += kind == test::RandomScale::Mirrored;
    tally.uneven += kind == test::RandomScale::Uneven;
    std::int32_t parent = i == 0 ? -1 : random.below(static_cast<int>(model.nodes.size()));
    const std::string name = "node" + std::to_string(i);
    if (random.chance(0.3)) {
      parent = addNode(model, name + "_$AssimpFbx$_Rotation", parent, random.inBox(0.3),
                       random.rotation().toRotationMatrix());
      ++tally.pivots;
    }
    addNode(model, name, parent, random.inBox(0.5),
            random.rotation().toRotationMatrix() * test::randomScale(random, kind).asDiagonal());
  }
  for (int m = 1 + random.below(3); m-- > 0;) {
    std::vector<Vector3d> vertices;
    for (int v = 3 * (1 + random.below(5)); v-- > 0;) vertices.push_back(random.inBox(0.2));
    const auto node = [&] { return random.below(static_cast<int>(model.nodes.size())); };
    ModelMesh& mesh = addMesh(model, node(), vertices);
    if (random.chance(0.4)) continue;
    ++tally.skins;
    for (int b = 1 + random.below(4); b-- > 0;) {
      std::vector<ModelBone::Weight> weights;
      for (std::int32_t v = 0; at(v) < vertices.size(); ++v) {
        if (random.chance(0.6)) weights.push_back({v, random.uniform(0.1, 1.0)});
      }
      const std::int32_t bone = node();
      const bool isRepeated = std::any_of(mesh.bones.begin(), mesh.bones.end(),
                                          [&](const ModelBone& o) { return o.node == bone; });
      if (isRepeated) continue;
      addBone(
          mesh, bone, weights,
          {random.rotation().toRotationMatrix() * random.magnitude(0.2, 5.0), random.inBox(1.0)});
    }
  }
  return model;
}

/// Owner of each triangle and its corners in the world at rest, straight from the model.
struct Placed {
  std::int32_t owner;
  std::array<Vector3d, 3> corners;
};

std::vector<Placed> placedTriangles(const Model& model) {
  std::vector<Placed> all;
  const auto local = test::restMatrices(model);
  for (const ModelMesh& mesh : model.meshes) {
    for (const auto& triangle : mesh.triangles) {
      std::map<std::int32_t, double> shares;
      for (const std::int32_t v : triangle) {
        std::map<std::int32_t, double> weights;
        double sum = 0.0;
        for (const ModelBone& bone : mesh.bones) {
          for (const auto& w : bone.weights) {
            if (w.vertex != v) continue;
            weights[bone.node] += w.weight;
            sum += w.weight;
          }
        }
        if (weights.empty()) weights[mesh.node] = sum = 1.0;
        for (const auto& [node, weight] : weights) shares[node] += weight / sum;
      }
      Placed placed{-1, {}};
      for (const auto& [node, share] : shares) {
        if (placed.owner < 0 || share > shares[placed.owner]) placed.owner = node;
      }
      Matrix4d map = test::worldOf(model, local, placed.owner);
      for (const ModelBone& bone : mesh.bones) {
        if (bone.node == placed.owner) map = map * test::matrixOf(bone.meshToBone);
      }
      for (std::size_t k = 0; k < 3; ++k) {
        placed.corners[k] = test::transformed(map, mesh.vertices[at(triangle[k])]);
      }
      all.push_back(placed);
    }
  }
  return all;
}

TEST(AvatarFromModel, PutsTheSurfaceAtRestWhereTheModelDoes) {
  Tally tally;
  std::size_t triangles = 0;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const Model model = randomModel(random, tally);
    const auto made = avatarFromModel(model);
    ASSERT_TRUE(made.ok()) << describe(made.error());
    const Skeleton& skeleton = made.value().avatar.skeleton();
    const auto states = test::statesIn(skeleton, restPose(skeleton));
    std::vector<std::size_t> next(states.size(), 0);
    for (const Placed& placed : placedTriangles(model)) {
      const auto& links = made.value().nodeOfLink;
      const auto link = static_cast<std::size_t>(
          std::find(links.begin(), links.end(), placed.owner) - links.begin());
      ASSERT_LT(link, links.size());
      ASSERT_LT(next[link], made.value().surface[link].size());
      const Triangle& triangle = made.value().surface[link][next[link]++];
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector3d p_W = states[link].pointAt(triangle.vertices[k]);
        ASSERT_LT((p_W - placed.corners[k]).norm(),
                  3e-7 * (1.0 + triangle.vertices[k].norm()) + 1e-12 * placed.corners[k].norm());
      }
      ++triangles;
    }
    for (std::size_t link = 0; link < next.size(); ++link) {
      ASSERT_EQ(next[link], made.value().surface[link].size());
    }
  }
  EXPECT_GT(triangles, 1000u);
  EXPECT_GT(std::min({tally.skins, tally.mirrored, tally.uneven, tally.pivots}), 100);
}

TEST(AvatarFromModel, KeepsEveryTriangleInsideOneLssOfItsLink) {
  Tally tally;
  int several = 0;
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i) + 5000);
    const auto made = avatarFromModel(randomModel(random, tally)).value();
    for (LinkId link = 0; link < made.avatar.numLinks(); ++link) {
      const auto& lss = made.avatar.lss(link);
      several += lss.size() > 1;
      ASSERT_LE(lss.size(), 4u);
      for (const Triangle& triangle : made.surface[at(link)]) {
        const bool isInside = std::any_of(lss.begin(), lss.end(), [&](const Lss& l) {
          return std::all_of(
              triangle.vertices.begin(), triangle.vertices.end(), [&](const auto& v) {
                const oracle::Precise3 p(v);
                return oracle::preciseDistance(oracle::Precise3(l.a), oracle::Precise3(l.b),
                                               {p, p, p}) <= oracle::Precise(l.radius);
              });
        });
        ASSERT_TRUE(isInside);
      }
    }
  }
  EXPECT_GT(several, 30);
}

TEST(AvatarFromModel, RoundsTheSurfaceToFloat) {
  Model model;
  addMesh(model, addNode(model, "body", -1), {{0.1, 0.2, 0.3}, {1.1, 0, 0}, {0, 1e-3, 7}});
  const auto made = avatarFromModel(model).value();
  const auto& [p, q, r] = made.surface[0][0].vertices;
  EXPECT_EQ(p, Vector3d(0x1.99999ap-4, 0x1.99999ap-3, 0x1.333334p-2));  // 0.1f, 0.2f, 0.3f
  EXPECT_EQ(q, Vector3d(0x1.19999ap+0, 0, 0));
  EXPECT_EQ(r, Vector3d(0, 0x1.0624dep-10, 7));
}

TEST(AvatarFromModel, GivesATriangleToTheHeaviestNodeAndTiesToTheLowest) {
  Model model;
  const auto root = addNode(model, "root", -1);
  const auto a = addNode(model, "a", root), b = addNode(model, "b", a);
  ModelMesh& mesh = addMesh(model, root, [] {
    auto v = oneTriangle();
    const auto w = oneTriangle();
    v.insert(v.end(), w.begin(), w.end());
    return v;
  }());
  // The first: 1.0 + 0.25 against 1.75. The second: a tie, listed in the wrong order.
  addBone(mesh, b, {{0, 3.0}, {1, 0.75}, {3, 1.0}, {4, 0.5}, {5, 0.0}});
  addBone(mesh, a, {{1, 0.25}, {2, 7.0}, {4, 0.5}, {5, 2.0}});
  const auto made = avatarFromModel(model).value();
  EXPECT_EQ(namesOf(made.avatar.skeleton()), (std::vector<std::string>{"root", "a", "b"}));
  EXPECT_EQ(made.surface[1].size(), 1u);
  EXPECT_EQ(made.surface[2].size(), 1u);
  EXPECT_EQ(made.report.shared, 2u);
  EXPECT_EQ(made.report.unweighted, 0u);
  EXPECT_EQ(made.report.badWeights, 0u);
}

TEST(AvatarFromModel, CountsWeightsThatAreNoneAndGivesUnweightedVerticesToTheMeshsNode) {
  Model model;
  const auto root = addNode(model, "root", -1);
  const auto own = addNode(model, "own", root), bone = addNode(model, "bone", root);
  auto vertices = oneTriangle();
  for (const Vector3d& v : oneTriangle()) vertices.push_back(v);
  ModelMesh& mesh = addMesh(model, own, vertices);
  addBone(mesh, bone, {{0, kNan}, {1, kInf}, {2, -1.0}, {6, 1.0}, {-1, 1.0}, {3, 1.0}, {4, 1e300}});
  addBone(mesh, -1, {{0, 1.0}, {5, 1.0}});
  mesh.bones.back().name = "Ghost";
  const auto made = avatarFromModel(model).value();
  EXPECT_EQ(made.report.badWeights, 5u);
  EXPECT_EQ(made.report.unweighted, 1u);
  EXPECT_EQ(made.report.triangles, 2u);
  EXPECT_EQ(namesOf(made.avatar.skeleton()), (std::vector<std::string>{"root", "own", "bone"}));
  EXPECT_EQ(made.surface[1].size(), 1u);
  EXPECT_EQ(made.surface[2].size(), 1u);
  EXPECT_TRUE(isNoted(made.report, "'Ghost'"));
  EXPECT_EQ(made.report.shared, 1u);  // the second's last vertex follows its own node
}

TEST(AvatarFromModel, DropsTrianglesWithoutAPlaceAndKeepsAllOthers) {
  Model model;
  const auto node = addNode(model, "body", -1);
  const Vector3d p(0.1, 0.2, 0.3), q(1, 0, 0), r(0, 1, 0);
  addMesh(model, node, {p, q, Vector3d(kNan, 0, 0),
                        p, q, Vector3d(0, kInf, 0),
                        p, q, Vector3d(0, 0, 2e7),
                        p, q, r,
                        p, q, r,
                        r, q, p,
                        p, p, p,
                        p, q, q});
  const auto made = avatarFromModel(model).value();
  EXPECT_EQ(made.report.droppedNonFinite, 3u);
  EXPECT_EQ(made.report.triangles, 5u);
  ASSERT_EQ(made.surface[0].size(), 5u);
  EXPECT_EQ(made.surface[0][2].vertices[0], r);
  EXPECT_EQ(made.skin.triangles.size(), 5u);
}

TEST(AvatarFromModel, KeepsWhatIsAboveALinkAndNothingThatIsBesideOrBelow) {
  Model model;
  const auto scene = addNode(model, "Scene", -1);
  const auto armature = addNode(model, "Armature", scene, {1, 0, 0});
  const auto hips = addNode(model, "Hips", armature), spine = addNode(model, "Spine", hips);
  addNode(model, "Tip", spine);
  addNode(model, "Lamp", scene);
  ModelMesh& mesh = addMesh(model, scene, oneTriangle());
  addBone(mesh, spine, {{0, 1}, {1, 1}, {2, 1}});
  addBone(mesh, hips, {});
  const auto made = avatarFromModel(model).value();
  EXPECT_EQ(namesOf(made.avatar.skeleton()),
            (std::vector<std::string>{"Scene", "Armature", "Hips", "Spine"}));
  EXPECT_EQ(made.report.bonesWithoutTriangles, (std::vector<std::string>{"Hips"}));
  EXPECT_EQ(made.avatar.skeleton().parent(0), kNoParent);
  EXPECT_EQ(made.avatar.skeleton().restOffset(1), Vector3d(1, 0, 0));
  EXPECT_EQ(made.nodeOfLink, (std::vector<std::int32_t>{scene, armature, hips, spine}));
}

TEST(AvatarFromModel, FoldsPivotsIntoTheNodeTheyServe) {
  Model model;
  const auto root = addNode(model, "Hips", -1);
  const auto translation = addNode(model, "Leg_$AssimpFbx$_Translation", root, {0, -1, 0});
  const auto rotation = addNode(model, "Leg_$AssimpFbx$_Rotation", translation, {0, 0, 0},
                                Eigen::AngleAxisd(0.5, Vector3d::UnitX()).toRotationMatrix());
  const auto leg = addNode(model, "Leg", rotation, {0, 0, 0.25});
  const auto inverse =
      addNode(model, "Leg_$AssimpFbx$_GeometricTranslationInverse", leg, {0, 0, -0.25});
  const auto foot = addNode(model, "Foot", inverse, {0, -0.5, 0});
  addMesh(model, foot, oneTriangle());
  addMesh(model, root, oneTriangle());
  ModelAnimation animation;
  animation.tracks.push_back({rotation, {}, {}, {{0.0, Quaternion::Identity()}}});
  model.animations.push_back(animation);
  const auto made = avatarFromModel(model).value();
  EXPECT_EQ(namesOf(made.avatar.skeleton()), (std::vector<std::string>{"Hips", "Leg", "Foot"}));
  EXPECT_EQ(made.nodeOfLink[1], leg);
  EXPECT_EQ(made.avatar.skeleton().parent(2), 1);
  EXPECT_LT((made.avatar.skeleton().restOffset(2) - Vector3d(0, -0.5, -0.25)).norm(), 1e-12);
}

TEST(AvatarFromModel, NamesTwinsAndNamelessNodesAndSaysSo) {
  Model model;
  const auto root = addNode(model, "a", -1);
  for (const char* name : {"a", "a#2", "a", "", "with\nnewline"}) {
    addMesh(model, addNode(model, name, root), oneTriangle());
  }
  addMesh(model, root, oneTriangle());
  const auto made = avatarFromModel(model).value();
  EXPECT_EQ(namesOf(made.avatar.skeleton()),
            (std::vector<std::string>{"a", "a#3", "a#2", "a#4", "unnamed", "unnamed#2"}));
  EXPECT_TRUE(isNoted(made.report, "'a#3', 'a#4'"));
  EXPECT_TRUE(isNoted(made.report, "2 links have no usable name"));
}

TEST(AvatarFromModel, NotesScaledAndMirroredNodes) {
  Model model;
  const auto root = addNode(model, "hundred", -1, {0, 0, 0}, 100 * Matrix3d::Identity());
  const auto plain =
      addNode(model, "mirror", root, {0.01, 0, 0}, Vector3d(-0.01, 0.01, 0.01).asDiagonal());
  addMesh(model, root, {{0.01, 0, 0}, {0, 0.01, 0}, {0, 0, 0.01}});
  addMesh(model, plain, oneTriangle());
  const auto made = avatarFromModel(model).value();
  EXPECT_TRUE(isNoted(made.report, "'hundred'"));
  EXPECT_TRUE(isNoted(made.report, "1 nodes mirror"));
  EXPECT_LT((made.avatar.skeleton().restOffset(1) - Vector3d(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((made.surface[0][0].vertices[0] - Vector3d(1, 0, 0)).norm(), 1e-6);
}

TEST(AvatarFromModel, KeepsStatedLssBesidesFittedOnes) {
  Model model;
  const auto a = addNode(model, "capsule", -1), b = addNode(model, "both", a, {0, 1, 0});
  const auto c = addNode(model, "stretched", a, Vector3d::Zero(), Vector3d(1, 2, 1).asDiagonal());
  const Lss stated{{0, 0, 0}, {0, 0.5, 0}, 0.1};
  for (const auto node : {a, b, c}) model.nodes[at(node)].lss = {stated};
  addMesh(model, b, {{1, 0, 0}, {1, 1, 0}, {1, 0, 1}});
  const auto made = avatarFromModel(model).value();
  ASSERT_EQ(made.avatar.lss(0).size(), 1u);
  EXPECT_EQ(made.avatar.lss(0)[0].b, stated.b);
  EXPECT_EQ(made.avatar.lss(0)[0].radius, stated.radius);
  ASSERT_EQ(made.avatar.lss(1).size(), 2u);
  EXPECT_EQ(made.avatar.lss(1)[0].radius, stated.radius);
  ASSERT_EQ(made.avatar.lss(2).size(), 1u);
  EXPECT_NEAR(made.avatar.lss(2)[0].b.y(), 1.0, 1e-12);
  EXPECT_NEAR(made.avatar.lss(2)[0].radius, 0.2, 1e-12);  // contains what the stretch makes of it
}

TEST(AvatarFromModel, GivesASkinThatFollowsTheSameTriangles) {
  Tally tally;
  std::size_t blended = 0;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i) + 9000);
    const auto made = avatarFromModel(randomModel(random, tally)).value();
    std::size_t next = 0;
    for (std::size_t link = 0; link < made.surface.size(); ++link) {
      for (const Triangle& triangle : made.surface[link]) {
        const auto& corners = made.skin.triangles.at(next++);
        for (std::size_t k = 0; k < 3; ++k) {
          const auto& influences = made.skin.vertices.at(at(corners[k]));
          ASSERT_FALSE(influences.empty());
          double sum = 0.0, before = 1.0 + 1e-12;
          for (const SkinInfluence& influence : influences) {
            ASSERT_GT(influence.weight, 0.0);
            ASSERT_LE(influence.weight, before);
            before = influence.weight;
            sum += influence.weight;
            if (static_cast<std::size_t>(influence.link) == link) {
              ASSERT_EQ(influence.p_L, triangle.vertices[k]);
            }
          }
          ASSERT_NEAR(sum, 1.0, 1e-12);
          blended += influences.size() > 1;
        }
      }
    }
    ASSERT_EQ(next, made.skin.triangles.size());
  }
  EXPECT_GT(blended, 150u);
}

TEST(AvatarFromModel, ReportsVolumesAndRefersToTheMeshFile) {
  Model model;
  const auto node = addNode(model, "cube", -1);
  addNode(model, "end", node);
  std::vector<Vector3d> corners;
  for (int a = 0; a < 8; ++a) {
    for (int b = 0; b < 3; ++b) {
      const int c = (a + b) % 8;
      corners.emplace_back(c & 1, c >> 1 & 1, c >> 2 & 1);
    }
  }
  addMesh(model, node, corners);
  ModelAvatarOptions options;
  options.meshFile = "body.mesh.glb";
  options.maxLssPerLink = 1;
  const auto made = avatarFromModel(model, options).value();
  EXPECT_NEAR(made.report.hullVolume, 1.0, 1e-9);
  EXPECT_NEAR(made.report.excessVolume, volume(made.avatar.lss(0)[0]) - 1.0, 1e-9);
  EXPECT_GT(made.report.excessVolume, 0.5);
  EXPECT_EQ(made.avatar.mesh(0).file, "body.mesh.glb");
  EXPECT_EQ(made.avatar.mesh(0).node, "cube");
}

ErrorCode codeOf(const Model& model, const ModelAvatarOptions& options = {}) {
  const auto made = avatarFromModel(model, options);
  EXPECT_FALSE(made.ok());
  return made.ok() ? ErrorCode::Syntax : made.error().code;
}

TEST(AvatarFromModel, RefusesModelsWithoutSurfaceAndBeyondLimits) {
  Model model;
  EXPECT_EQ(codeOf(model), ErrorCode::Empty);
  const auto root = addNode(model, "root", -1);
  EXPECT_EQ(codeOf(model), ErrorCode::Empty);
  addMesh(model, root, {{kNan, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  EXPECT_EQ(codeOf(model), ErrorCode::Empty);
  model.meshes[0].vertices = oneTriangle();
  EXPECT_TRUE(avatarFromModel(model).ok());
  EXPECT_EQ(codeOf(model, {"", 0}), ErrorCode::OutOfRange);
  EXPECT_EQ(codeOf(model, {"", 5000}), ErrorCode::OutOfRange);

  Model wide = model, deep = model;
  for (int i = 0; i < 4096; ++i)
    addMesh(wide, addNode(wide, "n" + std::to_string(i), 0), oneTriangle());
  EXPECT_EQ(codeOf(wide), ErrorCode::LimitExceeded);
  for (int i = 0; i < 256; ++i) addNode(deep, "n" + std::to_string(i), i);
  EXPECT_TRUE(avatarFromModel(deep).ok());  // idle leaves are no links
  addMesh(deep, 256, oneTriangle());
  EXPECT_EQ(codeOf(deep), ErrorCode::LimitExceeded);
}

TEST(AvatarFromModel, RefusesIndicesAndFramesThatAreNone) {
  Model good;
  addNode(good, "root", -1);
  addMesh(good, addNode(good, "child", 0), oneTriangle());
  ASSERT_TRUE(avatarFromModel(good).ok());
  Model bad = good;
  bad.nodes[1].parent = 1;
  EXPECT_EQ(codeOf(bad), ErrorCode::BadHierarchy);
  bad = good;
  bad.nodes[0].toParent.linear(1, 1) = kNan;
  EXPECT_EQ(codeOf(bad), ErrorCode::NonFinite);
  bad = good;
  bad.nodes[0].toParent.linear *= 1e6;
  bad.nodes[1].toParent.linear *= 1e6;
  EXPECT_EQ(codeOf(bad), ErrorCode::OutOfRange);
  bad = good;
  bad.meshes[0].triangles[0][2] = 3;
  EXPECT_EQ(codeOf(bad), ErrorCode::OutOfRange);
  bad = good;
  bad.meshes[0].node = 2;
  EXPECT_EQ(codeOf(bad), ErrorCode::OutOfRange);
  bad = good;
  addBone(bad.meshes[0], 2, {});
  EXPECT_EQ(codeOf(bad), ErrorCode::OutOfRange);
  bad = good;
  bad.animations.push_back({"a", 1.0, {{2, {}, {}, {}}}});
  EXPECT_EQ(codeOf(bad), ErrorCode::OutOfRange);
  bad = good;
  bad.nodes[0].toParent.linear.setZero();  // flat, but somewhere
  EXPECT_TRUE(avatarFromModel(bad).ok());
}

}  // namespace
}  // namespace foretouch
