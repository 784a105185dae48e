#include "middleware/solid/placing.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace foretouch::internal {
namespace {

/// The grid (m), to the sides and up; and how far the asked pose may move before the search begins
/// anew.
constexpr double kAside = 0.1, kUp = 0.05, kSameStart = 0.1;

}  // namespace

Placing::Placing(const Skeleton& skeleton, const SolidOptions& options)
    : skeleton_(skeleton), unfolding_(skeleton), up_(options.up), reach_(options.placingReach) {}

/// Nearest first; at equal distances the lower one.
void Placing::listOffsets() {
  const Eigen::Vector3d& up = up_;
  Eigen::Index least = 0;
  up.cwiseAbs().minCoeff(&least);
  const Eigen::Vector3d side = up.cross(Eigen::Vector3d::Unit(least)).normalized();
  const Eigen::Vector3d front = up.cross(side);
  const double reach = reach_;
  const int aside = static_cast<int>(std::floor(reach / kAside));
  const int upward = static_cast<int>(std::floor(reach / kUp));
  struct Offset {
    std::int64_t squared;  // in units of the finer grid
    int x, y, z;
  };
  std::vector<Offset> sorted;
  constexpr std::int64_t kRatio = 2;  // kAside / kUp
  for (int x = -aside; x <= aside; ++x) {
    for (int y = -aside; y <= aside; ++y) {
      for (int z = 0; z <= upward; ++z) {
        const std::int64_t squared =
            kRatio * kRatio * (std::int64_t{x} * x + std::int64_t{y} * y) + std::int64_t{z} * z;
        if (static_cast<double>(squared) * kUp * kUp <= reach * reach) {
          sorted.push_back({squared, x, y, z});
        }
      }
    }
  }
  std::sort(sorted.begin(), sorted.end(), [](const Offset& a, const Offset& b) {
    return std::tie(a.squared, a.z, a.x, a.y) < std::tie(b.squared, b.z, b.x, b.y);
  });
  offsets_.reserve(sorted.size());
  for (const Offset& offset : sorted) {
    offsets_.push_back(kAside * (offset.x * side + offset.y * front) + kUp * offset.z * up);
  }
}

bool Placing::search(const Pose& asked, Certifier& certifier, Pose& place, PlaceJudge* judge) {
  const auto isFree = [&] {
    return certifier.isClear(place, place) && (judge == nullptr || judge->isFree(place));
  };
  const Eigen::Vector3d at = asked.translations[0];
  if (next_ == 0 || (at - begunAt_).norm() > kSameStart) {
    next_ = 0;
    begunAt_ = at;
  }
  place = asked;
  // Moving all of it does not take own links apart.
  if (certifier.asksOwnLinks() && !unfolding_.unfold(asked, certifier, place)) return false;
  if (next_ == 0) {
    if (isFree()) return true;
    if (offsets_.empty()) listOffsets();
    next_ = 1;  // the first one is no offset
  }
  for (; certifier.workLeft() > 0; ++next_) {
    if (next_ == offsets_.size()) {
      next_ = 0;
      return false;
    }
    for (std::size_t j = 0; j < place.translations.size(); ++j) {
      if (skeleton_.parents()[j] != kNoParent) continue;
      place.translations[j] = asked.translations[j] + offsets_[next_];
    }
    if (isFree()) {
      next_ = 0;
      return true;
    }
  }
  return false;
}

}  // namespace foretouch::internal
