#include "middleware/solid/visual_body.h"

#include <algorithm>
#include <cmath>

#include "lss/index.h"
#include "middleware/solid/tree_pose.h"

namespace foretouch::internal {
namespace {

constexpr double kPi = 3.14159265358979323846;
/// What counts for an LSS that is a point or a line, and has no area (m^2).
constexpr double kLeastArea = 1e-6;
/// For joints without a surface (m^2 per rad^2): far below what counts, far above rounding.
constexpr double kLeastStiffness = 1e-6;

double areaOf(const Lss& lss) {
  return 2.0 * kPi * lss.radius * ((lss.b - lss.a).norm() + 2.0 * lss.radius) + kLeastArea;
}

}  // namespace

VisualBody::VisualBody(const Avatar& avatar, const std::vector<double>& visibility) {
  double sum = 0.0;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    for (const Lss& lss : avatar.lss(link)) {
      const double weight = 0.5 * areaOf(lss) * visibility[slotOf(link)];
      points_.push_back({link, lss.a, weight});
      points_.push_back({link, lss.b, weight});
      sum += 2.0 * weight;
    }
  }
  stiffness_.assign(countOf(avatar.numLinks()), kLeastStiffness);
  for (Point& point : points_) {
    point.weight /= sum;
    stiffness_[slotOf(point.link)] += 2.0 * point.weight * kTwistLever * kTwistLever;
  }
}

void VisualBody::place(const std::vector<LinkState>& states,
                       std::vector<Eigen::Vector3d>& places) const {
  places.resize(points_.size());
  for (std::size_t k = 0; k < points_.size(); ++k) {
    places[k] = states[slotOf(points_[k].link)].pointAt(points_[k].p_L);
  }
}

double VisualBody::cost(const std::vector<Eigen::Vector3d>& places,
                        const std::vector<Eigen::Vector3d>& wanted,
                        const std::vector<Eigen::Vector3d>& turns) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    sum += points_[k].weight * (places[k] - wanted[k]).squaredNorm();
  }
  for (std::size_t j = 0; j < stiffness_.size(); ++j) {
    sum += stiffness_[j] * turns[j].squaredNorm();
  }
  return sum;
}

double VisualBody::farthest(const std::vector<Eigen::Vector3d>& one,
                            const std::vector<Eigen::Vector3d>& other) {
  double most = 0.0;
  for (std::size_t k = 0; k < one.size(); ++k) {
    most = std::max(most, (one[k] - other[k]).squaredNorm());
  }
  return std::sqrt(most);
}

double VisualBody::farthestMove(const Skeleton& skeleton, const Pose& one, const Pose& other,
                                std::vector<LinkState>& atOne,
                                std::vector<LinkState>& atOther) const {
  placeLinks(skeleton, one, atOne);
  placeLinks(skeleton, other, atOther);
  double most = 0.0;
  for (const Point& point : points_) {
    const auto link = slotOf(point.link);
    most =
        std::max(most, (atOne[link].pointAt(point.p_L) - atOther[link].pointAt(point.p_L)).norm());
  }
  return most;
}

}  // namespace foretouch::internal
