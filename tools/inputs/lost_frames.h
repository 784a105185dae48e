// tools/inputs/lost_frames.h: which links of an avatar the frames of its clip do not know, because
// the clip has gaps.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/clip.h"
#include "assets/avatar/joint_match.h"

namespace foretouch::tools {

class LostFrames {
 public:
  LostFrames(const Avatar& avatar, const Clip& clip, const JointMatch& match);

  /// True if the frame's pose of the link is made up. O(log gaps).
  [[nodiscard]] bool isLost(LinkId link, std::int64_t frame) const;
  [[nodiscard]] bool isAllLost(std::int64_t frame) const;
  [[nodiscard]] std::vector<LinkId> linksAt(std::int64_t frame) const;
  [[nodiscard]] bool isAny() const { return isAny_; }

 private:
  using Spans = std::vector<std::pair<std::int64_t, std::int64_t>>;  // from first to last
  static void join(Spans& spans);

  std::vector<Spans> spans_;  // per link, apart and in order
  bool isAny_ = false;
};

}  // namespace foretouch::tools
