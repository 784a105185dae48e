// tools/feet/field_metrics.h: the figures that papers on human motion give about feet, under their
// own names and by their own rules, so that they can be compared. By poses; metres and seconds.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace foretouch::tools {

/// The skating ratio of guided-motion-diffusion (calculate_skating_ratio() of its
/// data_loaders/humanml/utils/metrics.py): below this height (m) in two frames of a twentieth of a
/// second, and faster than this over the ground (m/s: 2.5 cm per frame), by itself and in the mean
/// of so many frames.
inline constexpr double kSkateHeight = 0.05, kSkateSpeed = 0.5, kSkateHz = 20.0;
inline constexpr std::size_t kSkateWindow = 5;
/// The usual rule of thumb: a joint below this height (m) and slower than this (m/s) is in contact.
inline constexpr double kRuleHeight = 0.05, kRuleSpeed = 0.3;

struct FieldMetrics {
  double skatingRatio = 0.0;     ///< Share of frames at 20 Hz in which a foot skates.
  double meanPenetration = 0.0;  ///< Mean depth of the feet's lowest point, over all poses.
  double mostPenetration = 0.0;
  double meanFloating = 0.0;  ///< The same for its height above the ground.
};

/// Takes the poses in order.
class FieldMeter {
 public:
  /// `feet`: their number.
  FieldMeter(std::size_t feet, double poseS) : poseS_(poseS), places_(feet) {}

  /// `height`: the height of the feet's lowest point above the ground.
  void addPose(double height) { heights_.push_back(height); }
  /// `p_W`: the foot's front joint, with its height above the ground in place of y.
  void addFoot(std::size_t foot, const Eigen::Vector3d& p_W) { places_[foot].push_back(p_W); }

  [[nodiscard]] FieldMetrics finish() const;

 private:
  [[nodiscard]] std::vector<bool> skates(const std::vector<Eigen::Vector3d>& places) const;

  double poseS_;
  std::vector<double> heights_;
  std::vector<std::vector<Eigen::Vector3d>> places_;
};

}  // namespace foretouch::tools
