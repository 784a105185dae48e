// tools/inputs/clip_options.h: the options of every command that plays a clip: how it is read, and
// where it stands.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "assets/avatar/joint_match.h"
#include "tools/settling.h"

namespace CLI {
class App;
}

namespace foretouch::tools {

/// Values as typed in.
struct ClipTexts {
  std::string animation, robot, map;
  std::string rate =
      "all";  ///< Each command has an option of its own for it: what is kept differs.
  std::string scale = "1", motionUp = "y", place = "0,0,0,0";
  std::vector<std::string> packages;
};

/// All but --rate. `texts` must outlive `command`.
void addClipOptions(CLI::App& command, ClipTexts& texts);

[[nodiscard]] Result<Placement> placementOf(const ClipTexts& texts);
[[nodiscard]] Result<double> scaleOf(const ClipTexts& texts);
/// None: every frame.
[[nodiscard]] Result<std::optional<double>> rateOf(const ClipTexts& texts);

/// For a ReplayRequest, a SweepRequest or a PublishRequest.
template <typename Request>
void settleClip(const ClipTexts& texts, Settling& settle, Request& request) {
  request.animation = texts.animation;
  request.robotPath = texts.robot;
  request.packagePaths = texts.packages;
  request.mapPath = texts.map;
  settle.into(request.placement, placementOf(texts));
  settle.into(request.motionScale, scaleOf(texts));
  settle.into(request.rateHz, rateOf(texts));
}

}  // namespace foretouch::tools
