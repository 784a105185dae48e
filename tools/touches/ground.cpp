#include "tools/touches/ground.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lss/index.h"

namespace foretouch::tools {
namespace {

constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;

}  // namespace

GroundTest::GroundTest(const Avatar& avatar, const Scene& scene, const GroundRule& rule)
    : avatar_(avatar),
      scene_(scene),
      isAsked_(rule.use != GroundUse::Keep),
      leastUp_(std::cos(rule.angleDeg * kRadiansPerDegree)),
      heightM_(rule.heightM) {}

void GroundTest::beginStep(const ChainMotion& motion) {
  motion_ = &motion;
  lowestAtStartM_.reset();
}

bool GroundTest::isGround(const LinkContact& contact) {
  if (!isAsked_ || contact.verdict == Verdict::Undecided) return false;
  if (upOf(contact) < leastUp_) return false;
  return contact.p_WScene.y() - lowestAt(contact.toi) <= heightM_;
}

/// How much of the contact's normal is up. The normal of a foot that has sunk in deep lies across
/// the foot, or points down, once its axis meets the floor: then it is the triangle that is level.
double GroundTest::upOf(const LinkContact& contact) const {
  if (contact.verdict != Verdict::StartsInContact) return contact.nhat_SL_W.y();
  const auto& v = scene_.triangle(contact.triangle).vertices;
  const Eigen::Vector3d normal = (v[1] - v[0]).cross(v[2] - v[0]);
  const double length = normal.norm();
  return length > 0.0 ? std::abs(normal.y()) / length : std::abs(contact.nhat_SL_W.y());
}

double GroundTest::lowestAt(double t) {
  const bool isStart = !(t > 0.0);
  if (isStart && lowestAtStartM_) return *lowestAtStartM_;
  motion_->statesAt(t, states_);
  double lowest = std::numeric_limits<double>::infinity();
  for (LinkId link = 0; link < avatar_.numLinks(); ++link) {
    const LinkState& state = states_[slotOf(link)];
    for (const Lss& lss : avatar_.lss(link)) {
      const double low = std::min(state.pointAt(lss.a).y(), state.pointAt(lss.b).y());
      lowest = std::min(lowest, low - lss.radius);
    }
  }
  if (isStart) lowestAtStartM_ = lowest;
  return lowest;
}

}  // namespace foretouch::tools
