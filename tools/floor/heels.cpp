#include "tools/floor/heels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// Up in a foot's frame differs by less than this between its rests (cosine of 15 degrees, of the
/// mean): a person who walks on tiptoe and on the heels has no usual way to stand.
constexpr double kAlike = 0.966;
/// A bone begins at its joint, up to rounding (m).
constexpr double kAtAnkle = 1e-9;
/// No heel is farther below its ankle (m).
constexpr double kFarthestDown = 0.15;

const RestingPart* partOf(const RestingBody& body, std::size_t limb, PartOfLimb part) {
  const auto found = std::find_if(body.parts.begin(), body.parts.end(), [&](const RestingPart& of) {
    return of.limb == limb && of.part == part;
  });
  return found == body.parts.end() ? nullptr : &*found;
}

/// The mean, over the foot's rests, of what is up in its frame; nothing if they differ too much.
Result<std::optional<Vector3d>> usualUp(const RestingBody& body, std::size_t limb,
                                        const std::vector<FootRest>& rests,
                                        const RestingPoses& poses) {
  Vector3d sum = Vector3d::Zero();
  double weight = 0.0;
  std::vector<LinkState> states;
  for (const FootRest& rest : rests) {
    if (rest.limb != limb) continue;
    FORETOUCH_TRY(const auto pose, poses((rest.firstStep + rest.lastStep) / 2));
    ChainMotion(body.avatar.skeleton(), pose, pose).statesAt(0.0, states);
    sum += rest.durationS * states[slotOf(body.limbs[limb].ankle)].R_WL.row(1).transpose();
    weight += rest.durationS;
  }
  if (!(weight > 0.0) || sum.norm() < kAlike * weight) return std::optional<Vector3d>();
  return std::optional<Vector3d>(sum.normalized());
}

double bottomOf(const RestingPart& part, const Vector3d& up_L) {
  double bottom = std::numeric_limits<double>::infinity();
  for (const PartCorner& corner : part.corners) {
    bottom = std::min(bottom, up_L.dot(corner.center_L) - corner.radius);
  }
  return bottom;
}

/// Lets the rear end of the heel's LSS down; true if it was above the ball's level.
bool letDown(Lss& heel, double bottom, const Vector3d& up_L) {
  const double down = up_L.dot(heel.a) - heel.radius - bottom;
  if (!(down > 0.0) || down > kFarthestDown) return false;
  heel.a -= down * up_L;
  return true;
}

}  // namespace

Result<RestingBody> withHeelsDown(RestingBody body, const std::vector<FootRest>& rests,
                                  const RestingPoses& poses, std::size_t* lowered) {
  std::vector<std::vector<Lss>> lss = body.avatar.lss();
  std::size_t count = 0;
  for (std::size_t limb = 0; limb < body.limbs.size(); ++limb) {
    const RestingPart* const heel = partOf(body, limb, PartOfLimb::Heel);
    const RestingPart* const ball = partOf(body, limb, PartOfLimb::Ball);
    const bool isOne = heel != nullptr && ball != nullptr && heel->links.size() == 1 &&
                       lss[slotOf(heel->links.front())].size() == 1;
    if (!isOne) continue;
    Lss& only = lss[slotOf(heel->links.front())].front();
    if (!only.a.isZero(kAtAnkle)) continue;  // not a bone: it has a heel already
    FORETOUCH_TRY(const auto up_L, usualUp(body, limb, rests, poses));
    if (!up_L || !letDown(only, bottomOf(*ball, *up_L), *up_L)) continue;
    body.parts[static_cast<std::size_t>(heel - body.parts.data())].corners = {
        {heel->links.front(), only.a, only.radius}, {heel->links.front(), only.b, only.radius}};
    ++count;
  }
  if (lowered != nullptr) *lowered = count;
  FORETOUCH_TRY(body.avatar, Avatar::build(body.avatar.skeleton(), std::move(lss)));
  return body;
}

Result<Avatar> avatarWithHeels(const Avatar& avatar, const RestingBody& body) {
  std::vector<std::vector<Lss>> lss = avatar.lss();
  for (const RestingPart& heel : body.parts) {
    if (heel.part != PartOfLimb::Heel) continue;
    std::vector<Lss>& foot = lss[slotOf(heel.joint)];
    foot.clear();
    for (const RestingPart& part : body.parts) {
      if (part.limb != heel.limb || part.joint != heel.joint) continue;
      for (const LinkId link : part.links) {
        const std::vector<Lss>& more = body.avatar.lss(link);
        foot.insert(foot.end(), more.begin(), more.end());
      }
    }
  }
  return Avatar::build(avatar.skeleton(), std::move(lss));
}

}  // namespace foretouch::tools
