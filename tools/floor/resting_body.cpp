#include "tools/floor/resting_body.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <Eigen/Eigenvalues>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/bvh/bvh_roles.h"
#include "assets/near_names.h"
#include "lss/index.h"
#include "tools/inputs/name_pattern.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;
using internal::BodyRole;

/// A foot shorter than this (m) has no heel and no ball of its own.
constexpr double kShortestFoot = 0.02;

/// The direction along which a foot is long; zero if it is a sphere.
Vector3d lengthOf(const std::vector<Lss>& foot) {
  if (foot.size() == 1) return foot.front().b - foot.front().a;
  Vector3d mean = Vector3d::Zero();
  for (const Lss& lss : foot) mean += lss.a + lss.b;
  mean /= 2.0 * static_cast<double>(std::max<std::size_t>(1, foot.size()));
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Lss& lss : foot) {
    for (const Vector3d& end : {lss.a, lss.b}) spread += (end - mean) * (end - mean).transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  const Vector3d longest = axes.eigenvectors().col(2);
  return axes.eigenvalues()[2] > 0.0 ? longest : Vector3d(Vector3d::Zero());
}

/// The parts under construction.
class Builder {
 public:
  explicit Builder(const Avatar& avatar)
      : avatar_(avatar),
        roles_(internal::bodyRoles(avatar.skeleton())),
        lss_(countOf(avatar.numLinks())) {
    for (LinkId link = 0; link < avatar.numLinks(); ++link) {
      const Skeleton& skeleton = avatar.skeleton();
      raw_.joints.push_back({skeleton.name(link), skeleton.parent(link), skeleton.restOffset(link),
                             skeleton.restRotation(link)});
    }
  }

  Result<Done> takeFeet(const std::vector<std::string>& feet);
  Result<RestingBody> build();

 private:
  [[nodiscard]] BodyRole roleOf(JointId joint) const {
    return joint == kNoParent ? BodyRole::Unknown : roles_[slotOf(joint)];
  }
  [[nodiscard]] std::vector<JointId> belowWith(JointId top, BodyRole role) const;
  [[nodiscard]] Vector3d restPlaceIn(JointId top, JointId joint) const;
  void addFoot(JointId ankle);
  void addHand(JointId hand);
  void addHalves(JointId link, std::size_t limb, const Vector3d& forward_L, double middle);
  RestingPart& partOf(PartOfLimb part, std::size_t limb, JointId joint);
  void put(RestingPart& part, LinkId link, const Lss& lss);

  const Avatar& avatar_;
  std::vector<BodyRole> roles_;
  std::vector<std::vector<Lss>> lss_;
  RawSkeleton raw_;
  std::vector<RestingLimb> limbs_;
  std::vector<RestingPart> parts_;
};

/// `top` and all below it that have this role.
std::vector<JointId> Builder::belowWith(JointId top, BodyRole role) const {
  std::vector<JointId> found;
  for (JointId joint = top; joint < avatar_.numLinks(); ++joint) {
    if (roleOf(joint) != role) continue;
    JointId above = joint;
    while (above > top) above = avatar_.skeleton().parent(above);
    if (above == top) found.push_back(joint);
  }
  return found;
}

/// Where the joint is at rest, in the frame of one above it.
Vector3d Builder::restPlaceIn(JointId top, JointId joint) const {
  const Skeleton& skeleton = avatar_.skeleton();
  Vector3d place = Vector3d::Zero();
  for (JointId at = joint; at != top; at = skeleton.parent(at)) {
    if (at != joint) place = skeleton.restRotation(at) * place;
    place += skeleton.restOffset(at);
  }
  return place;
}

RestingPart& Builder::partOf(PartOfLimb part, std::size_t limb, JointId joint) {
  const auto found = std::find_if(parts_.begin(), parts_.end(), [&](const RestingPart& known) {
    return known.part == part && known.limb == limb;
  });
  if (found != parts_.end()) return *found;
  parts_.push_back({part, limb, joint, {}, {}});
  return parts_.back();
}

void Builder::put(RestingPart& part, LinkId link, const Lss& lss) {
  lss_[slotOf(link)].push_back(lss);
  if (part.links.empty() || part.links.back() != link) part.links.push_back(link);
  part.corners.push_back({link, lss.a, lss.radius});
  if (lss.a != lss.b) part.corners.push_back({link, lss.b, lss.radius});
}

/// Cuts the LSS of a link where `forward_L` reaches `middle`.
void Builder::addHalves(JointId link, std::size_t limb, const Vector3d& forward_L, double middle) {
  const LinkId heel = static_cast<LinkId>(raw_.joints.size()), ball = heel + 1;
  for (const char* const word : {" heel", " ball"}) {
    raw_.joints.push_back(
        {avatar_.skeleton().name(link) + word, link, Vector3d::Zero(), Quaternion::Identity()});
    lss_.emplace_back();
  }
  for (Lss lss : avatar_.lss(link)) {
    double a = forward_L.dot(lss.a) - middle, b = forward_L.dot(lss.b) - middle;
    if (a > b) std::swap(lss.a, lss.b), std::swap(a, b);
    Lss rear = lss, front = lss;
    if (a < 0.0 && b > 0.0) rear.b = front.a = lss.a + (lss.b - lss.a) * (a / (a - b));
    if (a < 0.0) put(partOf(PartOfLimb::Heel, limb, link), heel, rear);
    if (b > 0.0 || a >= 0.0) put(partOf(PartOfLimb::Ball, limb, link), ball, front);
  }
}

void Builder::addFoot(JointId ankle) {
  const std::size_t limb = limbs_.size();
  const std::vector<JointId> feet = belowWith(ankle, BodyRole::Foot);
  const std::vector<JointId> toes = belowWith(ankle, BodyRole::Toe);
  limbs_.push_back({avatar_.skeleton().name(ankle), false, ankle,
                    toes.empty() ? std::nullopt : std::optional<JointId>(toes.front())});
  for (const JointId foot : feet) {
    Vector3d forward = toes.empty() ? Vector3d::Zero() : restPlaceIn(ankle, toes.front());
    if (foot != ankle) forward = Vector3d::Zero();  // its frame may be turned
    double least = std::numeric_limits<double>::infinity(), most = -least;
    const bool isGuessed = forward.isZero(0.0) && avatar_.lss(foot).size() > 1;
    if (forward.isZero(0.0)) forward = lengthOf(avatar_.lss(foot));
    if (forward.norm() > 0.0) forward.normalize();
    for (const Lss& lss : avatar_.lss(foot)) {
      least = std::min({least, forward.dot(lss.a), forward.dot(lss.b)});
      most = std::max({most, forward.dot(lss.a), forward.dot(lss.b)});
    }
    if (isGuessed && least + most < 0.0) {
      forward = -forward;
      std::swap(least, most);
      least = -least, most = -most;
    }
    if (most - least >= kShortestFoot) {
      addHalves(foot, limb, forward, 0.5 * (least + most));
    } else {
      for (const Lss& lss : avatar_.lss(foot)) put(partOf(PartOfLimb::Foot, limb, foot), foot, lss);
    }
  }
  for (const JointId toe : toes) {
    for (const Lss& lss : avatar_.lss(toe)) put(partOf(PartOfLimb::Toe, limb, toe), toe, lss);
  }
}

void Builder::addHand(JointId hand) {
  if (avatar_.lss(hand).empty()) return;
  const std::size_t limb = limbs_.size();
  limbs_.push_back({avatar_.skeleton().name(hand), true, hand, std::nullopt});
  for (const Lss& lss : avatar_.lss(hand)) put(partOf(PartOfLimb::Hand, limb, hand), hand, lss);
}

Result<Done> Builder::takeFeet(const std::vector<std::string>& feet) {
  if (feet.empty()) return Done{};
  std::vector<std::string> names;
  for (JointId joint = 0; joint < avatar_.numLinks(); ++joint) {
    names.push_back(avatar_.skeleton().name(joint));
  }
  for (BodyRole& role : roles_) {
    if (role == BodyRole::Foot) role = BodyRole::Unknown;
  }
  for (const std::string& foot : feet) {
    const auto found = matching(foot, names);
    if (found.empty()) {
      return Error::of(ErrorCode::UnknownName,
                       "has no link " + inQuotes(foot) + didYouMean(foot, names));
    }
    for (const std::int32_t joint : found) roles_[slotOf(joint)] = BodyRole::Foot;
  }
  return Done{};
}

Result<RestingBody> Builder::build() {
  const Skeleton& skeleton = avatar_.skeleton();
  const auto isFirstOf = [&](JointId joint, BodyRole role) {
    return roleOf(joint) == role && roleOf(skeleton.parent(joint)) != role;
  };
  for (JointId joint = 0; joint < avatar_.numLinks(); ++joint) {
    if (isFirstOf(joint, BodyRole::Foot)) addFoot(joint);
  }
  if (limbs_.empty()) {
    return Error::of(ErrorCode::UnknownName,
                     "no joint is called a foot or an ankle, so nothing says what rests");
  }
  if (parts_.empty()) {
    return Error::of(ErrorCode::Empty, "no foot has a volume (LSS), so none touches anything");
  }
  for (JointId joint = 0; joint < avatar_.numLinks(); ++joint) {
    if (isFirstOf(joint, BodyRole::Hand)) addHand(joint);
  }
  FORETOUCH_TRY(auto whole, Skeleton::build(raw_));
  FORETOUCH_TRY(auto resting, Avatar::build(std::move(whole), std::move(lss_)));
  std::stable_sort(parts_.begin(), parts_.end(), [](const RestingPart& x, const RestingPart& y) {
    return std::make_pair(x.limb, x.part) < std::make_pair(y.limb, y.part);
  });
  return RestingBody{std::move(resting), std::move(limbs_), std::move(parts_), avatar_.numLinks()};
}

}  // namespace

const char* toString(PartOfLimb part) {
  switch (part) {
    case PartOfLimb::Foot: return "foot";
    case PartOfLimb::Heel: return "heel";
    case PartOfLimb::Ball: return "ball";
    case PartOfLimb::Toe: return "toe";
    case PartOfLimb::Hand: return "hand";
  }
  return "";
}

std::string RestingBody::nameOf(const RestingPart& part) const {
  return limbs[part.limb].name + " " + toString(part.part);
}

Pose RestingBody::poseOf(Pose pose) const {
  const auto joints = countOf(avatar.numLinks());
  pose.rotations.resize(joints, Quaternion::Identity());
  pose.translations.resize(joints, Vector3d::Zero());
  return pose;
}

Result<RestingBody> restingBodyOf(const Avatar& avatar, const std::vector<std::string>& feet) {
  Builder builder(avatar);
  FORETOUCH_CHECK(builder.takeFeet(feet));
  return builder.build();
}

LowestCorner lowestOf(const RestingPart& part, const std::vector<LinkState>& states,
                      const Vector3d& up) {
  LowestCorner lowest{std::numeric_limits<double>::infinity(), 0};
  for (std::size_t i = 0; i < part.corners.size(); ++i) {
    const PartCorner& corner = part.corners[i];
    const double height =
        up.dot(states[slotOf(corner.link)].pointAt(corner.center_L)) - corner.radius;
    if (height < lowest.height) lowest = {height, i};
  }
  return lowest;
}

}  // namespace foretouch::tools
