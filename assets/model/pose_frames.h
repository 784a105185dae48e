// assets/model/pose_frames.h: clip frames from moving nodes, instant by instant. Internal to
// model_clip.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "articulated/clip.h"
#include "articulated/result.h"
#include "assets/model/model.h"
#include "assets/model/model_links.h"

namespace foretouch::internal {

/// Collects the frames of a clip of a model's links.
class FrameCollector {
 public:
  /// Error if the model makes no links, or if `frames` of it would take more memory than the
  /// largest clip may.
  static Result<FrameCollector> create(const Model& model, std::size_t frames);

  [[nodiscard]] const ModelLinks& links() const { return links_; }
  /// Marks that the node moves, and with it the link that it serves.
  void moves(std::int32_t node, bool turns);

  /// Error, naming the frame, if the pose is not valid (validatedPose()).
  [[nodiscard]] Result<Done> add(const std::vector<Affine>& toParent);

  /// The clip, with `notes` for the user. Frames are `frameTimeS` apart.
  [[nodiscard]] Clip take(double frameTimeS, std::vector<std::string> notes);

 private:
  FrameCollector(const Model& model, ModelLinks links);

  const Model* model_;
  ModelLinks links_;
  std::vector<Pose> frames_;
  std::vector<bool> isTurned_, isMoved_;
  std::vector<double> farthestFromRest_;  ///< Per link, metres: of its parent-relative translation.
  std::vector<double> worstShear_;
};

}  // namespace foretouch::internal
