#include "assets/model/model_tracks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assets/model/model_frames.h"

namespace foretouch::internal {
namespace {

constexpr double kScaleNote = 1e-3;  // of the scale; exporters round to float

/// The sorted keys before and after `timeS`, and the share of the way between them.
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

/// The Hermite cubic from p to q, with tangents per second and `durationS` between them.
template <typename Vector>
Vector onCubic(const Vector& p, const Vector& out, const Vector& q, const Vector& in,
               double durationS, double share) {
  const double t = share, t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * p + durationS * (t3 - 2 * t2 + t) * out + (3 * t2 - 2 * t3) * q +
         durationS * (t3 - t2) * in;
}

bool isUsable(const Eigen::Vector3d& value) {
  return value.allFinite();
}

bool isUsable(const Quaternion& value) {
  return value.coeffs().allFinite() && value.coeffs().cwiseAbs().maxCoeff() > 1e-100;
}

}  // namespace

SampledTrack::SampledTrack(const ModelTrack& track, const Affine& rest)
    : node_(track.node),
      positionsAreCubic_(!track.positionTangents.empty()),
      rotationsAreCubic_(!track.rotationTangents.empty()),
      rest_(rest) {
  positions_ = cleaned<PositionKey>(track.positions, track.positionTangents);
  rotations_ = cleaned<RotationKey>(track.rotations, track.rotationTangents);
  // The format joins what a spline's file holds, and makes the result unit.
  for (auto& key : rotations_) {
    if (!rotationsAreCubic_) key.value.coeffs().stableNormalize();
  }
  findScale(cleaned<PositionKey>(track.scales, decltype(track.positionTangents){}));
}

template <typename CleanKey, typename From, typename Tangents>
std::vector<CleanKey> SampledTrack::cleaned(const From& keys, const Tangents& tangents) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  std::vector<CleanKey> clean;
  clean.reserve(keys.size());
  double lastS = -kNever;
  std::size_t closed = unknown_.size();  // these end
  for (std::size_t i = 0; i < keys.size(); ++i) {
    CleanKey key{keys[i].timeS, keys[i].value, {}, {}};
    key.in.setZero();
    key.out.setZero();
    if (!tangents.empty()) {
      key.in = tangents[i].in;
      key.out = tangents[i].out;
    }
    if (std::isfinite(key.timeS) && isUsable(key.value) && key.in.allFinite() &&
        key.out.allFinite()) {
      clean.push_back(key);
      lastS = key.timeS;
      for (; closed < unknown_.size(); ++closed) {
        Unknown& unknown = unknown_[closed];  // in a file whose keys are in no order, wherever
        unknown = {std::min(unknown.fromS, lastS), std::max(unknown.fromS, lastS)};
      }
    } else {
      ++leftOut_;
      if (closed == unknown_.size()) unknown_.push_back({lastS, kNever});
    }
  }
  std::stable_sort(clean.begin(), clean.end(),
                   [](const auto& a, const auto& b) { return a.timeS < b.timeS; });
  if (!clean.empty()) lastKeyS_ = std::max(lastKeyS_, clean.back().timeS);
  return clean;
}

/// A matrix that mirrors does not show which of its axes the file mirrored; the keys do.
void SampledTrack::findScale(const std::vector<PositionKey>& scales) {
  scale_ = nearestRotation(rest_.linear).transpose() * rest_.linear;
  if (scales.empty()) return;
  const Eigen::Vector3d sizes = rest_.linear.colwise().norm();
  const Eigen::Vector3d& first = scales.front().value;
  if ((first.array() < 0.0).any()) {
    const Eigen::Vector3d signs =
        (first.array() < 0.0).select(-Eigen::Vector3d::Ones(), Eigen::Vector3d::Ones());
    scale_ = sizes.cwiseProduct(signs).asDiagonal();
  }
  for (const auto& key : scales) {
    const Eigen::Vector3d off = key.value.cwiseAbs() - sizes;
    if (off.cwiseAbs().maxCoeff() > kScaleNote * sizes.maxCoeff()) scalesAnew_ = true;
  }
}

Affine SampledTrack::at(double timeS) const {
  Affine frame = rest_;
  if (!positions_.empty()) {
    const auto [before, after, share] = between(positions_, timeS);
    frame.translation = positionsAreCubic_
                            ? onCubic(before.value, before.out, after.value, after.in,
                                      after.timeS - before.timeS, share)
                            : Eigen::Vector3d(before.value + share * (after.value - before.value));
  }
  if (!rotations_.empty()) {
    const auto [before, after, share] = between(rotations_, timeS);
    Quaternion turned = before.value;
    if (rotationsAreCubic_) {
      const Eigen::Vector4d mixed =
          onCubic<Eigen::Vector4d>(before.value.coeffs(), before.out, after.value.coeffs(),
                                   after.in, after.timeS - before.timeS, share);
      // A spline through nothing, at this instant no rotation: that of the key holds on.
      if (isUsable(Quaternion(mixed))) turned = Quaternion(mixed);
      turned.coeffs().stableNormalize();
    } else {
      turned = before.value.slerp(share, after.value);
    }
    frame.linear = turned.toRotationMatrix() * scale_;
  }
  return frame;
}

}  // namespace foretouch::internal
