// tools/world/body_knots.h: where a world file says that its bodies are: poses with instants of
// world time, read from clips, animations, tables and the file itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "articulated/pair_rules.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "tools/inputs/motion_file.h"
#include "tools/world/body_shapes.h"
#include "tools/world/world_file.h"

namespace foretouch::tools {

/// Poses times joints, for all bodies together: 1.9 GB.
inline constexpr std::size_t kMostJointPoses = std::size_t{1} << 25;

struct BodyKnot {
  std::int64_t utimeUs = 0;
  Pose pose;               ///< Validated.
  std::int64_t line = -1;  ///< In the file that it comes from, if it has lines.
};

struct BodyKnots {
  std::string file;                  ///< Where the poses come from.
  std::vector<BodyKnot> knots;       ///< By time; none: the body stands.
  std::optional<PairRules> self;     ///< Where own links are asked.
  std::vector<std::string> remarks;  ///< What a user should know, a sentence each.
  /// By the instants of knots: links whose pose is made up because the clip has gaps.
  std::map<std::int64_t, std::vector<LinkId>> lostLinks = {};
  /// For a body with bounds: poses of its clip between two knots, which hold the bounds to account.
  std::vector<BodyKnot> leftOut = {};
};

class KnotLoader {
 public:
  /// `world`: the world's file. Errors name the file and the place.
  [[nodiscard]] Result<BodyKnots> load(const FileBody& body, const BodyShape& shape,
                                       const std::string& world);

 private:
  [[nodiscard]] Result<BodyKnots> ofAvatar(const FileBody& body, const Avatar& avatar,
                                           const std::string& world);
  [[nodiscard]] Result<BodyKnots> ofProp(const FileBody& body, const BodyShape& shape,
                                         const std::string& world);
  [[nodiscard]] Result<std::shared_ptr<const Motion>> motionOf(const ClipRequest& request);
  [[nodiscard]] Result<Done> countPoses(const FileBody& body, std::size_t joints, std::size_t poses,
                                        const std::string& world);

  std::map<std::string, std::shared_ptr<const Motion>> motions_;
  std::size_t jointPoses_ = 0;
};

}  // namespace foretouch::tools
