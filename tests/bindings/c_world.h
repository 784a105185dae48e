// tests/bindings/c_world.h: the inputs of the C++ API in C's form.
#pragma once

#include <cstddef>
#include <cstring>
#include <foretouch/foretouch.h>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "articulated/avatar.h"
#include "articulated/skeleton.h"
#include "middleware/scene/scene.h"

namespace foretouch::test {

struct Release {
  void operator()(ft_scene* scene) const { ft_scene_destroy(scene); }
  void operator()(ft_avatar* avatar) const { ft_avatar_destroy(avatar); }
  void operator()(ft_clip* clip) const { ft_clip_destroy(clip); }
  void operator()(ft_pair_rules* rules) const { ft_pair_rules_destroy(rules); }
  void operator()(ft_query* query) const { ft_query_destroy(query); }
};
using SceneHandle = std::unique_ptr<ft_scene, Release>;
using AvatarHandle = std::unique_ptr<ft_avatar, Release>;
using ClipHandle = std::unique_ptr<ft_clip, Release>;
using RulesHandle = std::unique_ptr<ft_pair_rules, Release>;
using QueryHandle = std::unique_ptr<ft_query, Release>;

/// The arrays of ft_scene_arrays: a separate vertex for every corner.
struct SceneArrays {
  explicit SceneArrays(const RawScene& raw);
  [[nodiscard]] ft_scene_arrays view() const;
  std::vector<double> positions;
  std::vector<std::uint32_t> indices;
  std::vector<std::int32_t> objects;
  std::vector<std::string> names;
  std::vector<const char*> namePointers;
};

/// The arrays of ft_avatar_arrays.
struct AvatarArrays {
  explicit AvatarArrays(const Avatar& avatar,
                        const std::vector<std::vector<Triangle>>& surface = {});
  [[nodiscard]] ft_avatar_arrays view() const;
  std::vector<std::string> names;
  std::vector<const char*> namePointers;
  std::vector<std::int32_t> parents, lssLinks, triangleLinks;
  std::vector<double> offsets, rotations;
  std::vector<ft_lss> lss;
  std::vector<ft_triangle> triangles;
};

/// The arrays of ft_pose.
struct PoseArrays {
  explicit PoseArrays(const Pose& pose);
  [[nodiscard]] ft_pose view() const;
  std::vector<double> rotations, translations;
};

/// Fails the test if they cannot be made.
[[nodiscard]] SceneHandle makeScene(const RawScene& raw);
[[nodiscard]] AvatarHandle makeAvatar(const Avatar& avatar,
                                      const std::vector<std::vector<Triangle>>& surface = {});
[[nodiscard]] QueryHandle makeQuery(const SceneHandle& scene, const AvatarHandle& avatar,
                                    const ft_query_options* options = nullptr);

/// One link, an LSS of 30 cm, 1 m above a floor of two triangles; `lowered` dips it below.
struct SmallWorld {
  SmallWorld();
  [[nodiscard]] static ft_pose poseOf(const double (&rotation)[4], const double (&translation)[3]);
  [[nodiscard]] ft_pose up() const { return poseOf(kIdentity, kUp); }
  [[nodiscard]] ft_pose lowered() const { return poseOf(kIdentity, kLowered); }
  SceneHandle scene;
  AvatarHandle avatar;
  static constexpr double kIdentity[4] = {1, 0, 0, 0};
  static constexpr double kUp[3] = {0, 1, 0}, kLowered[3] = {0, -0.5, 0};
};

/// A struct of C with its size and defaults.
template <typename Struct>
[[nodiscard]] Struct initialised(ft_status (*init)(Struct*, std::size_t)) {
  Struct made;
  std::memset(&made, 0xa5, sizeof made);
  EXPECT_EQ(init(&made, sizeof made), FT_OK) << ft_last_error();
  return made;
}

/// All that `read` lists: a function of C with an array, its capacity and the required number.
template <typename Struct, typename Read>
std::vector<Struct> listed(const Read& read) {
  std::size_t count = 0;
  EXPECT_EQ(read(static_cast<Struct*>(nullptr), 0, &count), FT_OK) << ft_last_error();
  std::vector<Struct> all(count);
  if (count == 0) return all;
  all[0].size = sizeof(Struct);
  EXPECT_EQ(read(all.data(), all.size(), &count), FT_OK) << ft_last_error();
  return all;
}

/// Expects the status, and a message with the function's name and all of `words`.
void expectRefused(ft_status got, ft_status expected, const std::vector<std::string>& words);

/// Legal arguments after a change.
template <typename Legal, typename Change>
void refuse(const Change& change, ft_status status, const std::vector<std::string>& words) {
  Legal arguments;
  change(arguments);
  expectRefused(arguments.make(), status, words);
}

}  // namespace foretouch::test
