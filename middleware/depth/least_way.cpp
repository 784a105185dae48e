#include "middleware/depth/least_way.h"

#include <algorithm>
#include <cmath>

namespace foretouch::internal {
namespace {

constexpr int kMostRounds = 400;
/// The share of what a plane needs that may be missing at the end; the proposal is stretched by it.
constexpr double kMissing = 1e-10;

}  // namespace

std::optional<Eigen::Vector3d> leastWay(const std::vector<PartingPlane>& planes, double most,
                                        std::vector<double>& weights) {
  weights.assign(planes.size(), 0.0);
  Eigen::Vector3d way = Eigen::Vector3d::Zero();
  for (int round = 0; round < kMostRounds; ++round) {
    double missing = 0.0;
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const double lacks = planes[i].need - planes[i].nhat.dot(way);
      const double next = std::max(0.0, weights[i] + lacks);
      way += (next - weights[i]) * planes[i].nhat;
      weights[i] = next;
      missing = std::max(missing, lacks);
    }
    if (!(way.norm() <= most)) return std::nullopt;
    if (missing <= kMissing * way.norm()) return Eigen::Vector3d((1.0 + 2.0 * kMissing) * way);
  }
  return std::nullopt;
}

}  // namespace foretouch::internal
