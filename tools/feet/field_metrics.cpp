#include "tools/feet/field_metrics.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// Places at 20 Hz, or as they are if they are slower.
std::vector<Vector3d> resampled(const std::vector<Vector3d>& places, double poseS) {
  const double stride = std::max(1.0, 1.0 / (kSkateHz * poseS));
  std::vector<Vector3d> taken;
  for (std::size_t i = 0;; ++i) {
    const auto at = static_cast<std::size_t>(std::lround(static_cast<double>(i) * stride));
    if (at >= places.size()) return taken;
    taken.push_back(places[at]);
  }
}

/// The mean of five around each, with zeros beyond the ends.
std::vector<double> smoothed(const std::vector<double>& values) {
  constexpr auto kHalf = static_cast<std::ptrdiff_t>(kSkateWindow / 2);
  const auto count = static_cast<std::ptrdiff_t>(values.size());
  std::vector<double> means;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    double sum = 0.0;
    for (std::ptrdiff_t j = std::max<std::ptrdiff_t>(0, i - kHalf);
         j <= std::min(count - 1, i + kHalf); ++j) {
      sum += values[static_cast<std::size_t>(j)];
    }
    means.push_back(sum / static_cast<double>(kSkateWindow));
  }
  return means;
}

}  // namespace

std::vector<bool> FieldMeter::skates(const std::vector<Vector3d>& all) const {
  const std::vector<Vector3d> places = resampled(all, poseS_);
  const double hz = std::min(kSkateHz, 1.0 / poseS_);
  std::vector<double> speeds;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const Vector3d way = places[i + 1] - places[i];
    speeds.push_back(std::hypot(way.x(), way.z()) * hz);
  }
  const std::vector<double> means = smoothed(speeds);
  std::vector<bool> skating;
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    const bool isLow = places[i].y() < kSkateHeight && places[i + 1].y() < kSkateHeight;
    skating.push_back(isLow && speeds[i] > kSkateSpeed && means[i] > kSkateSpeed);
  }
  return skating;
}

FieldMetrics FieldMeter::finish() const {
  FieldMetrics metrics;
  std::vector<bool> any;
  for (const auto& places : places_) {
    const std::vector<bool> skating = skates(places);
    any.resize(skating.size(), false);
    for (std::size_t i = 0; i < skating.size(); ++i) any[i] = any[i] || skating[i];
  }
  const auto skated = static_cast<double>(std::count(any.begin(), any.end(), true));
  if (!any.empty()) metrics.skatingRatio = skated / static_cast<double>(any.size());
  for (const double height : heights_) {
    metrics.meanPenetration += std::max(0.0, -height);
    metrics.mostPenetration = std::max(metrics.mostPenetration, -height);
    metrics.meanFloating += std::max(0.0, height);
  }
  const auto poses = static_cast<double>(std::max<std::size_t>(1, heights_.size()));
  metrics.meanPenetration /= poses;
  metrics.meanFloating /= poses;
  return metrics;
}

}  // namespace foretouch::tools
