// Clips from a model's animation: what the sampled joints carry is where an evaluation of the keys
// with 4x4 matrices puts it.
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "assets/avatar/joint_match.h"
#include "assets/model/model_avatar.h"
#include "tests/assets/model_samples.h"

namespace foretouch {
namespace {

using test::addMesh;
using test::addNode;
using test::at;
using test::Matrix3d;
using test::Matrix4d;
using test::oneTriangle;
using test::Vector3d;

const double kNotANumber = std::numeric_limits<double>::quiet_NaN();

bool isNoted(const Clip& clip, const std::string& part) {
  return std::any_of(clip.notes.begin(), clip.notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

/// Value of the keys at a time, by a walk along them; `mix` blends two values.
template <typename Key, typename Mix>
auto valueAt(const std::vector<Key>& keys, double t, const Mix& mix) {
  if (t <= keys.front().timeS) return keys.front().value;
  for (std::size_t i = 1; i < keys.size(); ++i) {
    if (t > keys[i].timeS) continue;
    const double s = (t - keys[i - 1].timeS) / (keys[i].timeS - keys[i - 1].timeS);
    return mix(keys[i - 1].value, keys[i].value, s);
  }
  return keys.back().value;
}

Vector3d mixed(const Vector3d& a, const Vector3d& b, double s) {
  return (1 - s) * a + s * b;
}

/// The turn from a to b as an angle about an axis, a share of it.
Quaternion mixed(const Quaternion& a, const Quaternion& b, double s) {
  Eigen::AngleAxisd turn(a.toRotationMatrix().transpose() * b.toRotationMatrix());
  turn.angle() *= s;
  return a * Quaternion(turn);
}

/// The nodes' frames in their parents' at a time. `scale`: of each animated node, as its keys say.
std::vector<Matrix4d> framesAt(const Model& model, const ModelAnimation& animation, double t) {
  std::vector<Matrix4d> local = test::restMatrices(model);
  const auto mix = [](const auto& a, const auto& b, double s) { return mixed(a, b, s); };
  for (const ModelTrack& track : animation.tracks) {
    Affine frame;
    frame.translation = valueAt(track.positions, t, mix);
    frame.linear = valueAt(track.rotations, t, mix).toRotationMatrix() *
                   valueAt(track.scales, t, mix).asDiagonal();
    local[at(track.node)] = test::matrixOf(frame);
  }
  return local;
}

struct Animated {
  Model model;
  int mirrored = 0, pivots = 0, deep = 0;
};

/// Every scale is the same along all axes but for mirroring, so that what moves stays rigid.
Animated randomAnimated(test::Random& random) {
  Animated made;
  Model& model = made.model;
  ModelAnimation animation;
  animation.name = "dance";
  animation.durationS = 1.0;
  const auto add = [&](const std::string& name, std::int32_t parent, test::RandomScale kind) {
    const Vector3d scale = test::randomScale(random, kind);
    const Quaternion rest = random.rotation();
    const auto node = addNode(model, name, parent, random.inBox(0.5),
                              rest.toRotationMatrix() * scale.asDiagonal());
    if (random.chance(0.3)) return node;
    ModelTrack track;
    track.node = node;
    track.scales = {{0.0, scale}};
    for (double t = random.uniform(0, 0.1); t < 1.0; t += random.uniform(0.05, 0.5)) {
      track.positions.push_back({t, random.inBox(0.5)});
    }
    for (double t = random.uniform(0, 0.1); t < 1.0; t += random.uniform(0.05, 0.5)) {
      track.rotations.push_back({t, random.rotation()});
    }
    animation.tracks.push_back(track);
    return node;
  };
  for (int i = 0, n = 2 + random.below(8); i < n; ++i) {
    std::int32_t parent = i == 0 ? -1 : random.below(static_cast<int>(model.nodes.size()));
    const std::string name = "n" + std::to_string(i);
    if (random.chance(0.3)) {
      parent = add(name + "_$AssimpFbx$_Rotation", parent, test::RandomScale::None);
      ++made.pivots;
    }
    const auto kind = static_cast<test::RandomScale>(random.below(3));
    made.mirrored += kind == test::RandomScale::Mirrored;
    const auto node = add(name, parent, kind);
    addMesh(model, node, {random.inBox(0.1), random.inBox(0.1), random.inBox(0.1)});
  }
  model.animations.push_back(animation);
  return made;
}

TEST(ClipFromModel, CarriesTheSurfaceWhereTheKeysDo) {
  int mirrored = 0, pivots = 0, moved = 0;
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const Animated made = randomAnimated(random);
    const Model& model = made.model;
    mirrored += made.mirrored;
    pivots += made.pivots;
    const auto avatar = avatarFromModel(model).value();
    const auto clip = clipFromModel(model, {"dance", 17.0});
    ASSERT_TRUE(clip.ok()) << describe(clip.error());
    ASSERT_EQ(clip.value().frames.size(), 18u);
    ASSERT_FALSE(isNoted(clip.value(), "links are rigid"));
    for (std::size_t f = 0; f < clip.value().frames.size(); ++f) {
      const auto local = framesAt(model, model.animations[0], static_cast<double>(f) / 17.0);
      const auto states = test::statesIn(clip.value().skeleton, clip.value().frames[f]);
      for (std::size_t link = 0; link < avatar.surface.size(); ++link) {
        for (const ModelMesh& mesh : model.meshes) {
          if (mesh.node != avatar.nodeOfLink[link]) continue;
          for (std::size_t k = 0; k < 3; ++k) {
            const Vector3d p_L = avatar.surface[link][0].vertices[k];
            const Vector3d expected =
                test::transformed(test::worldOf(model, local, mesh.node), mesh.vertices[k]);
            const double size = 1.0 + p_L.norm() + expected.norm();
            ASSERT_LT((states[link].pointAt(p_L) - expected).norm(), 1e-6 * size);
            ++moved;
          }
        }
      }
    }
  }
  EXPECT_GT(moved, 10000);
  EXPECT_GT(std::min(mirrored, pivots), 150);
}

TEST(ClipFromModel, HasTheJointsOfTheAvatarOfTheSameModel) {
  for (int i = 0; i < 50; ++i) {
    test::Random random(static_cast<std::uint64_t>(i) + 700);
    const Model model = randomAnimated(random).model;
    const Skeleton avatar = avatarFromModel(model).value().avatar.skeleton();
    const Skeleton clip = clipFromModel(model).value().skeleton;
    ASSERT_EQ(avatar.numJoints(), clip.numJoints());
    for (JointId j = 0; j < avatar.numJoints(); ++j) {
      EXPECT_EQ(avatar.name(j), clip.name(j));
      EXPECT_EQ(avatar.parent(j), clip.parent(j));
      EXPECT_EQ(avatar.restOffset(j), clip.restOffset(j));
      EXPECT_EQ(avatar.restRotation(j).coeffs(), clip.restRotation(j).coeffs());
    }
  }
}

/// A hip that shifts from 0 to 1 m in x over a second, with a leg below it.
Model shifting() {
  Model model;
  const auto hip = addNode(model, "hip", -1), leg = addNode(model, "leg", hip, {0, -1, 0});
  addMesh(model, leg, oneTriangle());
  ModelAnimation walk;
  walk.name = "walk";
  walk.durationS = 1.0;
  walk.tracks.push_back({hip, {{0.0, {0, 0, 0}}, {1.0, {1, 0, 0}}}, {}, {}});
  model.animations.push_back(walk);
  return model;
}

TEST(ClipFromModel, SamplesFromZeroToTheLastKeyAndClampsOutside) {
  Model model = shifting();
  Clip clip = clipFromModel(model, {"", 4.0}).value();
  ASSERT_EQ(clip.frames.size(), 5u);
  EXPECT_EQ(clip.frameTimeS, 0.25);
  EXPECT_NEAR(clip.frames[1].translations[0].x(), 0.25, 1e-15);
  EXPECT_EQ(clip.frames[4].translations[0].x(), 1.0);
  clip = clipFromModel(model, {"", 3.5}).value();  // the last frame lies past the last key
  ASSERT_EQ(clip.frames.size(), 5u);
  EXPECT_EQ(clip.frames[4].translations[0].x(), 1.0);
  model.animations[0].tracks[0].positions[0].timeS = 0.5;
  clip = clipFromModel(model, {"", 4.0}).value();
  EXPECT_EQ(clip.frames[1].translations[0].x(), 0.0);
  model.animations[0].durationS = 2.0;
  clip = clipFromModel(model, {"", 4.0}).value();
  ASSERT_EQ(clip.frames.size(), 9u);
  EXPECT_EQ(clip.frames[8].translations[0].x(), 1.0);
  for (const double duration : {0.0, -1.0, kNotANumber}) {
    model.animations[0].durationS = duration;
    EXPECT_EQ(clipFromModel(model, {"", 4.0}).value().frames.size(), 5u);
  }
}

TEST(ClipFromModel, SaysWhichJointsItMoves) {
  Model model = shifting();
  const Quaternion turn(Eigen::AngleAxisd(0.5, Vector3d::UnitZ()));
  // The leg's position keys only repeat its offset, as exporters write them.
  model.animations[0].tracks.push_back(
      {1, {{0.0, {0, -1 + 1e-8, 0}}}, {}, {{0.0, Quaternion::Identity()}, {1.0, turn}}});
  const Clip clip = clipFromModel(model).value();
  EXPECT_EQ(clip.hasTranslation, (std::vector<bool>{true, false}));
  EXPECT_EQ(clip.hasRotation, (std::vector<bool>{false, true}));
  EXPECT_EQ(clip.endSites.size(), 2u);
}

TEST(ClipFromModel, ALegOfOtherLengthKeepsItsLength) {
  Model model = shifting(), tall = shifting();
  model.animations[0].tracks.push_back({1, {{0.0, {0, -1, 0}}}, {}, {}});
  tall.nodes[1].toParent.translation.y() = -2;
  const Clip clip = clipFromModel(model).value();
  const auto avatar = avatarFromModel(tall).value().avatar;
  const auto match = matchJoints(avatar.skeleton(), clip.skeleton).value();
  EXPECT_EQ(poseOfAvatar(avatar.skeleton(), clip, match, 30).translations[1], Vector3d(0, -2, 0));
  EXPECT_EQ(poseOfAvatar(avatar.skeleton(), clip, match, 30).translations[0], Vector3d(1, 0, 0));
}

/// One file holds the body, another the motion, and only the motion moves the rig's root.
TEST(ClipFromModel, DrivesTheAvatarOfAnotherFileOfTheSameRig) {
  const Matrix3d turn = Eigen::AngleAxisd(1.5, Vector3d::UnitX()).toRotationMatrix();
  Model body;
  const auto rig = addNode(body, "rig", -1, {0, 0.5, 0}, turn);
  const auto hips = addNode(body, "hips", rig, {0, 0, 1}, turn.transpose());
  addMesh(body, hips, oneTriangle());
  Model motion = body;
  motion.meshes.clear();
  ModelAnimation animation;
  animation.tracks.push_back({rig, {{0.0, {3, 0.5, 0}}}, {}, {{0.0, Quaternion(turn)}}});
  animation.tracks.push_back({hips, {}, {}, {{0.0, Quaternion(turn.transpose())}}});
  motion.animations.push_back(animation);

  const auto made = avatarFromModel(body).value();
  const Skeleton& skeleton = made.avatar.skeleton();
  const Clip clip = clipFromModel(motion).value();
  const auto match = matchJoints(skeleton, clip.skeleton).value();
  EXPECT_TRUE(match.unmatchedAvatar.empty() && match.unmatchedClip.empty());
  const auto states = test::statesIn(skeleton, poseOfAvatar(skeleton, clip, match, 0));
  const Vector3d expected = Vector3d(3, 0.5, 0) + turn * Vector3d(0, 0, 1);
  EXPECT_LT((states[1].p_WL - expected).norm(), 1e-12);
  EXPECT_LT((states[1].R_WL - Matrix3d::Identity()).norm(), 1e-12);
}

TEST(ClipFromModel, SortsKeysAndLeavesOutWhatIsNone) {
  Model model = shifting();
  auto& track = model.animations[0].tracks[0];
  track.positions = {
      {1.0, {1, 0, 0}}, {kNotANumber, {9, 9, 9}}, {0.0, {0, 0, 0}}, {0.5, {kNotANumber, 0, 0}}};
  track.rotations = {{0.0, Quaternion(0, 0, 0, 0)}, {0.0, Quaternion(2, 0, 0, 0)}};
  const Clip clip = clipFromModel(model, {"", 2.0}).value();
  ASSERT_EQ(clip.frames.size(), 3u);
  EXPECT_EQ(clip.frames[1].translations[0].x(), 0.5);
  EXPECT_EQ(clip.frames[1].rotations[0].coeffs(), Quaternion::Identity().coeffs());
  EXPECT_TRUE(isNoted(clip, "3 keys"));
  // Who knows when the first was meant; the second comes after the key at 0 s, and none after it.
  ASSERT_EQ(clip.gaps.size(), 2u);
  EXPECT_EQ(clip.gaps[0].first, 1);
  EXPECT_EQ(clip.gaps[0].last, 1);
  EXPECT_EQ(clip.gaps[1].first, 1);
  EXPECT_EQ(clip.gaps[1].last, 2);
}

TEST(ClipFromModel, IgnoresAnimatedScaleAndSaysSo) {
  Model model = shifting();
  model.animations[0].tracks[0].scales = {{0.0, {1, 1, 1}}};
  EXPECT_FALSE(isNoted(clipFromModel(model).value(), "scale"));
  model.animations[0].tracks[0].scales.push_back({1.0, {2, 2, 2}});
  const Clip clip = clipFromModel(model).value();
  EXPECT_TRUE(isNoted(clip, "animated scale of 1 nodes is ignored: 'hip'"));
  EXPECT_EQ(clip.frames.back().translations[1], Vector3d(0, -1, 0));
}

TEST(ClipFromModel, NotesJointsThatShear) {
  Model model = shifting();
  model.nodes[0].toParent.linear = Vector3d(1, 3, 1).asDiagonal();
  const Quaternion turn(Eigen::AngleAxisd(1.0, Vector3d::UnitZ()));
  model.animations[0].tracks.push_back({1, {}, {}, {{0.0, turn}}});
  EXPECT_TRUE(isNoted(clipFromModel(model).value(), "'leg'"));
}

TEST(ClipFromModel, FindsAnimationsByNameThenByNumber) {
  Model model = shifting();
  ModelAnimation run = model.animations[0];
  run.name = "0";
  run.tracks[0].positions[1].value = {5, 0, 0};
  model.animations.push_back(run);
  const auto reach = [&](const std::string& name) {
    return clipFromModel(model, {name, 30.0}).value().frames.back().translations[0].x();
  };
  EXPECT_EQ(reach(""), 1.0);
  EXPECT_EQ(reach("walk"), 1.0);
  EXPECT_EQ(reach("0"), 5.0);
  EXPECT_EQ(reach("1"), 5.0);
  model.animations[0].name = "Rig|walk";
  EXPECT_EQ(reach("walk"), 1.0) << "exporters put the rig before it";
  const auto misspelt = clipFromModel(model, {"wolk", 30.0});
  ASSERT_FALSE(misspelt.ok());
  EXPECT_NE(misspelt.error().message.find("did you mean 'walk'"), std::string::npos);
  model.animations.push_back(model.animations[0]);
  model.animations.back().name = "Other|walk";
  EXPECT_FALSE(clipFromModel(model, {"walk", 30.0}).ok()) << "either may be meant";
  const auto unnamed = clipFromModel(model, {"", 30.0}).value().notes;
  EXPECT_TRUE(std::any_of(unnamed.begin(), unnamed.end(), [](const std::string& note) {
    return note.find("holds 3 animations, and the first, 'Rig|walk', is played") == 0;
  }));
  model.animations[0].name = "walk";
  const auto unknown = clipFromModel(model, {"jump", 30.0});
  ASSERT_FALSE(unknown.ok());
  EXPECT_EQ(unknown.error().code, ErrorCode::UnknownName);
  EXPECT_NE(unknown.error().message.find("'walk'"), std::string::npos);
}

TEST(ClipFromModel, RefusesWhatHasNoMotionAndWhatIsTooMuch) {
  const auto codeOf = [](const Model& model, double rateHz = 30.0) {
    const auto clip = clipFromModel(model, {"", rateHz});
    EXPECT_FALSE(clip.ok());
    return clip.ok() ? ErrorCode::Syntax : clip.error().code;
  };
  Model model = shifting();
  for (const double rate : {0.0, -1.0, 1e7, 1e-4, kNotANumber}) {
    EXPECT_EQ(codeOf(model, rate), ErrorCode::OutOfRange);
  }
  model.animations[0].durationS = 1e9;
  EXPECT_EQ(codeOf(model), ErrorCode::LimitExceeded);
  model.animations[0].durationS = 1e6;
  EXPECT_EQ(codeOf(model), ErrorCode::LimitExceeded);
  model.animations[0].durationS = 1.0;
  model.animations[0].tracks[0].positions[1].value.x() = 1e8;
  EXPECT_EQ(codeOf(model), ErrorCode::OutOfRange);
  model.animations.clear();
  EXPECT_EQ(codeOf(model), ErrorCode::Empty);
}

}  // namespace
}  // namespace foretouch
