// articulated/clip.h: a mocap clip: a skeleton, and its parent-relative poses at a fixed rate.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "articulated/skeleton.h"

namespace foretouch {

/// Frames that the file has no pose for: they are made up from those around them.
struct ClipGap {
  std::int64_t first = 0, last = 0;  ///< The first and the last such frame.
  JointId joint = kNoParent;         ///< Only it and what it carries have the gap; kNoParent: all.
};

/// Poses at constant spacing. Lengths are in metres once the reader's scale has been applied.
struct Clip {
  Skeleton skeleton;         ///< Rest offsets are the file's OFFSETs times the scale.
  double frameTimeS = 0.0;   ///< Seconds between frames, finite and > 0.
  std::vector<Pose> frames;  ///< Validated poses, in the joints' order of `skeleton`.
  /// Per joint: does the file animate its translation (position channels)?
  std::vector<bool> hasTranslation;
  /// Per joint: does the file give it rotation channels? One without keeps its rest rotation.
  std::vector<bool> hasRotation;
  /// Per joint: the End Site offsets below it (metres, in the joint's frame); usually none or one.
  std::vector<std::vector<Eigen::Vector3d>> endSites;
  /// Faults that the reader tolerated, one sentence each, for the user (renamed duplicates, a wrong
  /// frame count, ...). At most kMaxClipNotes; if there were more, the last one says how many.
  std::vector<std::string> notes;
  std::vector<ClipGap> gaps = {};  ///< In no order; they may overlap.

  /// For a table of joint positions: a row of the table every so many frames. The frames between
  /// lie on the straight line in joint coordinates, so that the shorter arc from each frame to the
  /// next is the way that the numbers say. 1: every frame is one of the file's.
  std::int64_t framesPerRow = 1;
  /// The most that a joint turns from one frame to the next by its coordinate (rad); 0: the file
  /// says poses, and the shorter arc is what it means.
  double mostTurn = 0.0;

  [[nodiscard]] double durationS() const {
    return frames.empty() ? 0.0 : static_cast<double>(frames.size() - 1) * frameTimeS;
  }
};

inline constexpr std::size_t kMaxClipNotes = 32;

}  // namespace foretouch
