#include "assets/model/model_tracks.h"

#include <algorithm>
#include <cmath>

#include "assets/model/model_frames.h"

namespace foretouch::internal {
namespace {

constexpr double kScaleNote = 1e-3;  // of the scale; exporters round to float

/// Of the sorted keys, those before and after `timeS`, and the share of the way between them.
template <typename Key>
struct Between {
  const Key& before;
  const Key& after;
  double share;
};

template <typename Key>
Between<Key> between(const std::vector<Key>& keys, double timeS) {
  const auto after = std::upper_bound(keys.begin(), keys.end(), timeS,
                                      [](double t, const Key& key) { return t < key.timeS; });
  if (after == keys.begin()) return {keys.front(), keys.front(), 0.0};
  if (after == keys.end()) return {keys.back(), keys.back(), 0.0};
  const Key& before = *(after - 1);
  return {before, *after, (timeS - before.timeS) / (after->timeS - before.timeS)};
}

bool isUsable(const Eigen::Vector3d& value) {
  return value.allFinite();
}

bool isUsable(const Quaternion& value) {
  return value.coeffs().allFinite() && value.coeffs().cwiseAbs().maxCoeff() > 1e-100;
}

}  // namespace

SampledTrack::SampledTrack(const ModelTrack& track, const Affine& rest)
    : track_(track), rest_(rest) {
  clean(track_.positions);
  clean(track_.scales);
  clean(track_.rotations);
  for (auto& key : track_.rotations) key.value.coeffs().stableNormalize();
  findScale();
}

template <typename Keys>
void SampledTrack::clean(Keys& keys) {
  const auto bad = std::remove_if(keys.begin(), keys.end(), [](const auto& key) {
    return !std::isfinite(key.timeS) || !isUsable(key.value);
  });
  leftOut_ += static_cast<std::size_t>(keys.end() - bad);
  keys.erase(bad, keys.end());
  std::stable_sort(keys.begin(), keys.end(),
                   [](const auto& a, const auto& b) { return a.timeS < b.timeS; });
  if (!keys.empty()) lastKeyS_ = std::max(lastKeyS_, keys.back().timeS);
}

/// A matrix that mirrors does not show which of its axes the file mirrored; the keys do.
void SampledTrack::findScale() {
  scale_ = nearestRotation(rest_.linear).transpose() * rest_.linear;
  if (track_.scales.empty()) return;
  const Eigen::Vector3d sizes = rest_.linear.colwise().norm();
  const Eigen::Vector3d& first = track_.scales.front().value;
  if ((first.array() < 0.0).any()) {
    const Eigen::Vector3d signs =
        (first.array() < 0.0).select(-Eigen::Vector3d::Ones(), Eigen::Vector3d::Ones());
    scale_ = sizes.cwiseProduct(signs).asDiagonal();
  }
  for (const auto& key : track_.scales) {
    const Eigen::Vector3d off = key.value.cwiseAbs() - sizes;
    if (off.cwiseAbs().maxCoeff() > kScaleNote * sizes.maxCoeff()) scalesAnew_ = true;
  }
}

Affine SampledTrack::at(double timeS) const {
  Affine frame = rest_;
  if (!track_.positions.empty()) {
    const auto [before, after, share] = between(track_.positions, timeS);
    frame.translation = before.value + share * (after.value - before.value);
  }
  if (!track_.rotations.empty()) {
    const auto [before, after, share] = between(track_.rotations, timeS);
    frame.linear = before.value.slerp(share, after.value).toRotationMatrix() * scale_;
  }
  return frame;
}

}  // namespace foretouch::internal
