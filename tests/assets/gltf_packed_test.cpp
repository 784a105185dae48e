// Models as gltfpack ships them against the models that they were made of: quantised, compressed,
// instanced, simplified. What it writes shares no code with the reader.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "articulated/motion.h"
#include "assets/import/model_import.h"
#include "assets/model/model_avatar.h"
#include "tests/assets/gltf_writer.h"
#include "tests/assets/import_files.h"
#include "tests/assets/model_files.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

/// Skips the test, by name, where it is not installed.
#define FORETOUCH_REQUIRE_GLTFPACK()                              \
  if (std::system("gltfpack -v > /dev/null 2> /dev/null") != 0) { \
    GTEST_SKIP() << "gltfpack is not installed";                  \
  }

struct Packed {
  const char* model;  ///< Of the shared data; empty: one that the test writes.
  const char* options;
  double quantum;  ///< Of the size of the model: the step of 14 bits unless it says otherwise.
};

std::string nameOf(const testing::TestParamInfo<Packed>& info) {
  std::string name = std::string(info.param.model) + info.param.options;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

/// All corners of the links' triangles in a pose, in the world.
std::vector<Vector3d> cornersIn(const ModelAvatar& made, const Pose& pose) {
  std::vector<LinkState> states;
  ChainMotion(made.avatar.skeleton(), pose, pose).statesAt(0.0, states);
  std::vector<Vector3d> corners;
  for (std::size_t link = 0; link < made.surface.size(); ++link) {
    for (const Triangle& triangle : made.surface[link]) {
      for (const Vector3d& vertex : triangle.vertices) {
        corners.push_back(states[link].p_WL + states[link].R_WL * vertex);
      }
    }
  }
  return corners;
}

/// How far the corners of `a` are from the nearest of `b`, at most: by a scan along x.
double farthest(const std::vector<Vector3d>& a, std::vector<Vector3d> b) {
  std::sort(b.begin(), b.end(), [](const Vector3d& p, const Vector3d& q) { return p.x() < q.x(); });
  double worst = 0.0;
  for (const Vector3d& p : a) {
    double best = std::numeric_limits<double>::max();
    const auto from = std::lower_bound(b.begin(), b.end(), p.x(),
                                       [](const Vector3d& q, double x) { return q.x() < x; });
    for (auto at = from; at != b.end() && at->x() - p.x() < best; ++at) {
      best = std::min(best, (*at - p).norm());
    }
    for (auto at = from; at != b.begin() && p.x() - (at - 1)->x() < best; --at) {
      best = std::min(best, (*(at - 1) - p).norm());
    }
    worst = std::max(worst, best);
  }
  return worst;
}

double sizeOf(const std::vector<Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& point : points) box.extend(point);
  return box.diagonal().norm();
}

class PackedModels : public testing::TestWithParam<Packed> {
 protected:
  struct Read {
    Model model;
    ModelAvatar made;
  };
  Read read(const std::string& path) {
    auto model = importModel(path, withModelImporter());
    EXPECT_TRUE(model.ok()) << describe(model.error());
    auto made = avatarFromModel(model.value());
    EXPECT_TRUE(made.ok()) << describe(made.error());
    return {std::move(model).value(), std::move(made).value()};
  }
  std::string packed(const std::string& path, const std::string& options) {
    const std::string output = folder_ / "packed.glb";
    const std::string command =
        "gltfpack -i '" + path + "' -o '" + output + "' " + options + " > /dev/null 2> /dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return output;
  }
  TempFolder folder_;
};

TEST_P(PackedModels, StandAndMoveAsTheirOriginals) {
  FORETOUCH_REQUIRE_GLTFPACK();
  const Packed& asked = GetParam();
  FORETOUCH_REQUIRE_SHARED(path, std::string("avatars/") + asked.model);
  const Read from = read(*path), to = read(packed(*path, asked.options));
  const Pose fromRest = restPose(from.made.avatar.skeleton());
  const Pose toRest = restPose(to.made.avatar.skeleton());
  const auto fromCorners = cornersIn(from.made, fromRest);
  const auto toCorners = cornersIn(to.made, toRest);
  const double size = sizeOf(fromCorners);
  ASSERT_GT(size, 0.0);
  EXPECT_LT(farthest(toCorners, fromCorners), asked.quantum * size);
  const bool isSimplified = std::string(asked.options).find("-si") != std::string::npos;
  if (isSimplified) {
    EXPECT_LT(toCorners.size(), fromCorners.size());
  }
  EXPECT_LT(farthest(fromCorners, toCorners), (isSimplified ? 0.2 : asked.quantum) * size);
  // Fewer triangles, other links: each moves as a whole with the link of most of its weights.
  if (isSimplified) return;
  // Rotations have 12 bits, keys are taken anew 30 times per second.
  ASSERT_EQ(to.model.animations.size(), from.model.animations.size());
  for (std::size_t i = 0; i < std::min<std::size_t>(2, from.model.animations.size()); ++i) {
    ModelClipOptions options;
    options.animation = std::to_string(i);
    const auto fromClip = clipFromModel(from.model, options);
    const auto toClip = clipFromModel(to.model, options);
    ASSERT_TRUE(fromClip.ok() && toClip.ok());
    const std::size_t frames =
        std::min(fromClip.value().frames.size(), toClip.value().frames.size());
    for (const std::size_t f : {std::size_t{0}, frames / 3, frames / 2, frames - 1}) {
      const auto moved = cornersIn(to.made, toClip.value().frames[f]);
      const auto expected = cornersIn(from.made, fromClip.value().frames[f]);
      EXPECT_LT(farthest(moved, expected), (asked.quantum + 2e-2) * size) << i << ", frame " << f;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    SharedData, PackedModels,
    testing::Values(Packed{"Fox.glb", "", 1e-4}, Packed{"Fox.glb", "-noq", 1e-6},
                    Packed{"Fox.glb", "-cc", 1e-4}, Packed{"Fox.glb", "-c -vpn", 1e-4},
                    Packed{"Fox.glb", "-kn -vp 16", 3e-5},
                    // Half of the triangles: their corners are among the old ones, not the reverse.
                    Packed{"Fox.glb", "-si 0.5", 1e-4}, Packed{"greenman.glb", "-cc -si 0.5", 2e-4},
                    Packed{"greenman.glb", "-cc", 2e-4}, Packed{"greenman.glb", "-noq", 1e-6},
                    Packed{"greenman.glb", "-vpn", 2e-4}, Packed{"cesium_man.gltf", "", 2e-4},
                    Packed{"cesium_man.gltf", "-cc", 2e-4}, Packed{"cesium_man.gltf", "-cf", 2e-4},
                    Packed{"robot_expressive.glb", "-noq", 1e-6},
                    Packed{"robot_expressive.glb", "-cc -kn", 1e-3},
                    Packed{"kaykit_manny/manny_med_mod.gltf", "-cc", 2e-4}),
    nameOf);

}  // namespace
}  // namespace foretouch::test
