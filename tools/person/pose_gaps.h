// tools/person/pose_gaps.h: where the given poses of a person do not know some of the links. Such a
// link is open in every step that one of these poses bends; from the last pose before these steps
// to the first one behind them only its largest speed says where it was.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/motion_model.h"
#include "middleware/bracket/bracket.h"
#include "tools/inputs/lost_frames.h"
#include "tools/inputs/step_selection.h"

namespace foretouch::tools {

/// The steps between two poses, and the links that are open in them and in no step beside them.
struct PoseGap {
  std::int64_t from = 0, to = 0;
  bool isBounded = false;  ///< Both poses know the links: it is not the begin or end of the clip.
  std::vector<LinkId> links;

  [[nodiscard]] bool has(LinkId link) const;
};

class PoseGaps {
 public:
  /// `lost` outlives it.
  PoseGaps(std::size_t numLinks, const LostFrames& lost, const StepSelection& steps)
      : lost_(lost), steps_(steps), openSince_(numLinks, kClosed) {}

  /// The bounds without those of links that are open in the step. Steps come one after the other;
  /// `around`: the step with the poses that bend it.
  const std::vector<LinkBound>& claimed(std::int64_t step, const PosedStep& around,
                                        const std::vector<LinkBound>& bounds);
  [[nodiscard]] bool isOpen(LinkId link) const { return openSince_[slotOf(link)] != kClosed; }
  [[nodiscard]] bool isAllOpen() const;
  /// The gaps that ended where the last step begins; each is returned once.
  [[nodiscard]] std::vector<PoseGap> ended();
  /// Ends all gaps, as the clip ends at this pose.
  [[nodiscard]] std::vector<PoseGap> endAll(std::int64_t pose);

  /// The bounds of those links that both poses of a gap know.
  [[nodiscard]] std::vector<LinkBound> across(const PoseGap& gap,
                                              const std::vector<LinkBound>& bounds) const;

 private:
  static constexpr std::int64_t kClosed = -1;
  void end(LinkId link, std::int64_t pose);
  [[nodiscard]] bool isLost(LinkId link, std::int64_t pose) const {
    return lost_.isLost(link, steps_.frameOf(pose));
  }

  const LostFrames& lost_;
  StepSelection steps_;
  std::vector<std::int64_t> openSince_;  // per link: the step
  std::vector<PoseGap> ended_;
  std::vector<LinkBound> claimed_;
};

}  // namespace foretouch::tools
