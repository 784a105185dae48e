// bindings/c/handles.h: the structs behind the opaque handles. Each begins with the mark of its
// kind, so that every function refuses a handle of another kind.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/clip.h"
#include "articulated/motion.h"
#include "articulated/pair_rules.h"
#include "articulated/skeleton.h"
#include "assets/avatar/joint_match.h"
#include "bindings/c/status.h"
#include "middleware/near/near_features.h"
#include "middleware/query/query.h"
#include "middleware/scene/scene.h"
#include "middleware/surface/avatar_surface.h"

namespace foretouch::c {

/// Shared by the handle of the avatar and those of its queries and clips.
struct AvatarParts {
  Avatar avatar;
  std::optional<AvatarSurface> surface;
  std::optional<SkinnedSurface> skin = std::nullopt;
};

/// Eight bytes that no other kind begins with, nor memory by chance.
enum class Mark : std::uint64_t {
  Gone = 0,
  Scene = 0x656e656353746600u,
  Avatar = 0x6174617641746600u,
  Clip = 0x0070696c43746600u,
  Query = 0x0079726575746600u,
  PairRules = 0x0072696170746600u,
  Near = 0x007261656e746600u,
  Solid = 0x0064696c6f746600u,
  World = 0x646c726f57746600u,
  Robot = 0x00746f626f526600u,
  Edges = 0x0073656764456600u,
  Brackets = 0x6b63617242746600u,
};

}  // namespace foretouch::c

struct ft_scene {
  static constexpr auto kMark = foretouch::c::Mark::Scene;
  static constexpr const char* kName = "scene";
  foretouch::c::Mark mark = kMark;
  foretouch::Scene scene;
};

struct ft_avatar {
  static constexpr auto kMark = foretouch::c::Mark::Avatar;
  static constexpr const char* kName = "avatar";
  foretouch::c::Mark mark = kMark;
  std::shared_ptr<const foretouch::c::AvatarParts> parts;
};

struct ft_clip {
  static constexpr auto kMark = foretouch::c::Mark::Clip;
  static constexpr const char* kName = "clip";
  foretouch::c::Mark mark = kMark;
  std::shared_ptr<const foretouch::c::AvatarParts> avatar;
  foretouch::Clip clip;
  foretouch::JointMatch match;
  foretouch::Placement placement;
};

struct ft_pair_rules {
  static constexpr auto kMark = foretouch::c::Mark::PairRules;
  static constexpr const char* kName = "rules";
  foretouch::c::Mark mark = kMark;
  foretouch::PairRules rules;
};

/// For one thread. Computes a step beside the last one, which it replaces once done.
struct ft_query {
  static constexpr auto kMark = foretouch::c::Mark::Query;
  static constexpr const char* kName = "query";
  explicit ft_query(std::shared_ptr<const foretouch::c::AvatarParts> ofAvatar)
      : avatar(std::move(ofAvatar)) {}

  struct Step {
    foretouch::ChainMotion motion;
    foretouch::StepContacts answer;
    std::vector<foretouch::LinkId> reported;  // those not clear, the earliest first
  };

  foretouch::c::Mark mark = kMark;
  std::shared_ptr<const foretouch::c::AvatarParts> avatar;
  std::optional<foretouch::PairRules> self;  // stay when the options change
  std::optional<foretouch::Query> question;  // from ft_query_create() on
  foretouch::Scratch scratch;
  bool isScratchSuspect = false;  // an exception left it half written
  foretouch::Pose from, to;       // of the current step
  foretouch::Pose last;           // where the last step ended
  bool hasLast = false;
  Step step, next;
  bool hasStep = false;
  std::vector<foretouch::LinkState> states;
  foretouch::Pose pose;
};

/// For one thread.
struct ft_near {
  static constexpr auto kMark = foretouch::c::Mark::Near;
  static constexpr const char* kName = "near_query";
  foretouch::c::Mark mark = kMark;
  std::shared_ptr<const foretouch::c::AvatarParts> avatar;
  foretouch::NearQuery question;
  foretouch::NearDetail detail = foretouch::NearDetail::Reduced;
  foretouch::Scratch scratch;
  foretouch::ChainMotion still;  // holds the pose that is asked
  foretouch::Pose pose;
  std::vector<foretouch::LinkState> states;
  std::vector<double> reach;
  foretouch::NearFeatures near;
  bool hasAnswer = false;
};

namespace foretouch::c {

/// Refuses NULL and handles of another kind.
template <typename Handle>
[[nodiscard]] ft_status checked(const Handle* handle) {
  if (const ft_status status = needed(handle, Handle::kName); status != FT_OK) return status;
  if (handle->mark == Handle::kMark) return FT_OK;
  return failure(FT_ERROR_WRONG_HANDLE, kNoIndex,
                 "expected a handle of a %s, found that of something else, or of one destroyed",
                 Handle::kName);
}

/// Checks the place for a new handle and clears it.
template <typename Handle>
[[nodiscard]] ft_status cleared(Handle** handle) {
  if (const ft_status status = needed(handle, Handle::kName); status != FT_OK) return status;
  *handle = nullptr;
  return FT_OK;
}

template <typename Handle>
void destroy(const char* function, Handle* handle) noexcept {
  enter(function);
  if (handle == nullptr || checked(handle) != FT_OK) return;
  handle->mark = Mark::Gone;
  delete handle;
}

/// Copies a pose from C arrays; checks only its number of joints. `name`: the argument's.
/// Reuses `pose`: allocates nothing once it has grown.
[[nodiscard]] ft_status copyPose(const ft_pose* given, const char* name, const Skeleton& skeleton,
                                 Pose& pose);
/// The same, and checks it.
[[nodiscard]] ft_status readPose(const ft_pose* given, const char* name, const Skeleton& skeleton,
                                 Pose& pose);
/// Writes a validated pose to C arrays; either may be NULL.
[[nodiscard]] ft_status writePose(const Pose& pose, double* rotations, double* translations,
                                  std::size_t capacity, std::size_t* required);

}  // namespace foretouch::c
