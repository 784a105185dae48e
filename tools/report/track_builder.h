// tools/report/track_builder.h: an avatar's poses, one by one, as the track of a view.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/skeleton.h"
#include "middleware/query/query.h"
#include "middleware/scene/scene.h"
#include "tools/report/view_document.h"

namespace foretouch::tools {

/// Asks which links touch at each pose. Nothing if the options are refused, as the replay that is
/// reported then is.
[[nodiscard]] std::optional<Query> touchQuestion(const Avatar& avatar, const Scene& scene,
                                                 const QueryOptions& options);

class TrackBuilder {
 public:
  /// `avatar` must outlive it. Without a question it tests nothing.
  TrackBuilder(const Avatar& avatar, std::optional<Query> question);

  /// Number of this avatar's poses whose rotations fit in `numbers` numbers.
  [[nodiscard]] std::size_t capacity(std::size_t numbers) const;

  /// `timeS` is later than that of the pose before. Cost: one instant query per link.
  void addPose(double timeS, const Pose& pose);
  /// Both indices are of added poses. All steps have a latency, or none has.
  void addStep(std::uint32_t from, std::uint32_t to, std::optional<double> latencyUs = {});

  [[nodiscard]] std::size_t poses() const { return track_.poses(); }
  [[nodiscard]] double timeS(std::size_t pose) const { return track_.poseTimesS[pose]; }
  /// Precondition: there is a pose.
  [[nodiscard]] double lastTimeS() const { return track_.poseTimesS.back(); }
  [[nodiscard]] std::size_t steps() const { return track_.stepFrom.size(); }
  /// Does the link touch anything at this pose? False without a question.
  [[nodiscard]] bool touches(std::size_t pose, LinkId link) const;
  /// The box around all LSS at all poses.
  [[nodiscard]] const Eigen::AlignedBox3d& box() const { return box_; }

  /// The builder is unusable afterwards.
  [[nodiscard]] ViewTrack finish();

 private:
  void addTranslations(const Pose& pose);
  void askWhatTouches(const ChainMotion& motion);
  void growBox(const ChainMotion& motion);

  const Avatar& avatar_;
  std::optional<Query> question_;
  Scratch scratch_;
  ChainMotion motion_;
  std::vector<LinkState> states_;
  Eigen::AlignedBox3d box_;
  ViewTrack track_;
  std::map<LinkId, std::vector<double>> moving_;  // x, y, z per pose
};

/// A pose of the track, bit for bit as added.
[[nodiscard]] Pose poseOf(const ViewTrack& track, std::size_t pose);

}  // namespace foretouch::tools
