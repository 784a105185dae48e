#include "middleware/solid/way_around.h"

#include <algorithm>
#include <cmath>

#include "lss/index.h"
#include "middleware/solid/tree_pose.h"

namespace foretouch::internal {
namespace {

/// A target that has moved farther than this (m) is another one; one that goes on, farther than
/// this share of its distance; and so is a begin that has moved farther than this (m).
constexpr double kSameTarget = 0.05, kSameShare = 0.25, kSameStart = 0.01;
/// Poses of the trail are so far apart at first (m), and twice as far where they become too many.
constexpr double kSpacing = 1e-3;
constexpr std::size_t kMostTrail = 128;
/// Before it: poses where it is tracked, so far apart (m), looked at so rarely (s), and so many.
constexpr double kFreeSpacing = 0.05, kFreeEveryS = 0.05;
constexpr std::size_t kMostFree = 32;
/// The share of trials that grow straight towards the other tree.
constexpr double kStraight = 0.2;
/// How far a joint turns from where it is shown or tracked (rad), nearest the trunk and farther
/// out.
constexpr double kTurnOfFirst = 2.0, kTurnOfOthers = 1.2;
/// How far the whole body moves aside (m), where it is the body that looks for a way.
constexpr double kFarthestAside = 0.6;
/// Joints of a limb whose turn is tried: turns of fingers and toes change little.
constexpr int kMostJoints = 4;
/// A limb's largest share of what is seen of the avatar: more belongs to the trunk.
constexpr double kShareOfLimb = 0.25;
/// Nodes of one tree.
constexpr std::size_t kMostNodes = 400;
/// Corners that are tried to be cut in a tick while it is walked, and by what share a cut must be
/// shorter.
constexpr int kShortcutsPerTick = 16;
constexpr double kShorter = 0.98;
/// A cut that advances less than this (m) is not worth a node.
constexpr double kLeastAdvance = 0.01;

Quaternion turned(const Quaternion& q, const Eigen::Vector3d& by) {
  const double angle = by.norm();
  if (!(angle > 1e-9)) return q;
  return (Eigen::Quaterniond(Eigen::AngleAxisd(angle, by / angle)) * Eigen::Quaterniond(q))
      .normalized();
}

}  // namespace

WayAround::WayAround(const Avatar& avatar, const SolidOptions& options)
    : skeleton_(avatar.skeleton()),
      perTick_(static_cast<std::uint32_t>(options.aroundPerTick)),
      most_(static_cast<std::uint32_t>(options.aroundInAll)) {
  const Pose rest = restPose(skeleton_);
  free_.reserve(kMostFree, rest);
  trail_.reserve(kMostTrail, rest);
}

void WayAround::reset() {
  isBegun_ = hasFailed_ = false;
  way_.clear();
  next_ = 0;
}

bool WayAround::isStale(const std::vector<Eigen::Vector3d>& places,
                        const std::vector<Eigen::Vector3d>& wanted) const {
  if (!isBegun_) return false;
  const double moved = VisualBody::farthest(wanted, wanted_);
  if (moved > (goesOn_ ? std::max(kSameTarget, kSameShare * far_) : kSameTarget)) return true;
  const double same = goesOn_ ? kSameStart : 0.0;
  return way_.empty() && VisualBody::farthest(places, trees_[0].nodes[0].places) > same;
}

void WayAround::rememberFree(const VisualBody& body, const Pose& shown, double dtS) {
  sinceFreeS_ += dtS;
  if (sinceFreeS_ < kFreeEveryS && !free_.empty()) return;
  sinceFreeS_ = 0.0;
  if (!free_.empty() && !(length(body, free_.back(), shown) > kFreeSpacing)) return;
  if (free_.size() == kMostFree) free_.dropFirst(kMostFree / 2);
  free_.push(shown);
}

void WayAround::rememberBegin(const VisualBody& body, const Pose& shown, bool isFree) {
  if (isFree) trail_.clear();
  remember(body, shown);
  atTick_ = trail_.size();
}

void WayAround::remember(const VisualBody& body, const Pose& shown) {
  if (trail_.empty()) spacing_ = kSpacing;
  if (!trail_.empty() && !(length(body, trail_.back(), shown) > spacing_)) return;
  trail_.push(shown);
  if (trail_.size() < kMostTrail) return;
  trail_.thin();
  spacing_ *= 2.0;
}

void WayAround::forgetTrail() {
  trail_.clear();
  free_.clear();
}

const Pose& WayAround::trailAt(std::size_t i) const {
  return i < free_.size() ? free_[i] : trail_[i - free_.size()];
}

/// splitmix64 (Steele, Lea, Flood, OOPSLA 2014): the standard's distributions differ.
double WayAround::uniform(double low, double high) {
  random_ += 0x9E3779B97F4A7C15u;
  std::uint64_t z = random_;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  z ^= z >> 31;
  return low + (high - low) * static_cast<double>(z >> 11) * 0x1p-53;
}

void WayAround::begin(const VisualBody& body, const Pose& shown, const Pose& target,
                      const std::vector<Eigen::Vector3d>& wanted, LinkId farthest) {
  isBegun_ = true;
  hasFailed_ = goesOn_ = false;
  spent_ = 0;
  random_ = 0;
  turn_ = 0;
  way_.clear();
  next_ = 0;
  wanted_ = wanted;
  chooseLimb(body, farthest);
  for (Tree& tree : trees_) tree.count = 0;
  tip_ = add(body, trees_[0], -1, shown);
  add(body, trees_[1], -1, target);
  trailLeft_ = free_.size() + trail_.size();
  stride_ = 1;
  far_ = VisualBody::farthest(trees_[0].nodes[0].places, wanted);
}

/// The joints that lead to the farthest link, up to the trunk; for the trunk itself: the root.
void WayAround::chooseLimb(const VisualBody& body, LinkId farthest) {
  const std::vector<JointId>& parents = skeleton_.parents();
  std::vector<double> below(parents.size(), 0.0);
  for (const VisualBody::Point& point : body.points()) below[slotOf(point.link)] += point.weight;
  for (std::size_t j = parents.size(); j-- > 0;) {
    if (parents[j] != kNoParent) below[slotOf(parents[j])] += below[j];
  }
  isMoved_.assign(parents.size(), 0);
  JointId root = farthest;
  for (JointId j = farthest; j != kNoParent; j = parents[slotOf(j)]) {
    root = j;
    if (below[slotOf(j)] < kShareOfLimb) isMoved_[slotOf(j)] = 1;
  }
  if (below[slotOf(farthest)] >= kShareOfLimb) isMoved_[slotOf(root)] = 1;
}

std::size_t WayAround::add(const VisualBody& body, Tree& tree, std::int32_t parent,
                           const Pose& pose) {
  if (tree.nodes.size() == tree.count) tree.nodes.emplace_back();
  Node& node = tree.nodes[tree.count];
  node.pose = pose;
  node.parent = parent;
  placeLinks(skeleton_, pose, states_);
  body.place(states_, node.places);
  return tree.count++;
}

/// A pose between the shown one and the target, but for the limb, which is anywhere.
void WayAround::sample(const Pose& shown, const Pose& target) {
  const double share = uniform(0.0, 1.0);
  part_.assign(skeleton_, shown, target);
  part_.poseAt(share, sampled_);
  const bool isOfTarget = uniform(0.0, 1.0) < 0.5;
  int turns = 0;
  for (std::size_t j = 0; j < isMoved_.size() && turns < kMostJoints; ++j) {
    if (isMoved_[j] == 0) continue;
    const double most = turns == 0 ? kTurnOfFirst : kTurnOfOthers;
    const double x = uniform(-most, most), y = uniform(-most, most), z = uniform(-most, most);
    const Quaternion& base = isOfTarget ? target.rotations[j] : shown.rotations[j];
    ++turns;
    if (skeleton_.parents()[j] != kNoParent) {
      sampled_.rotations[j] = turned(base, {x, y, z});
      continue;
    }
    sampled_.translations[j] += Eigen::Vector3d(x, y, z) * (kFarthestAside / most);
  }
}

/// Never one of the trail between its ends: what is beside it was tried, as a rule.
std::size_t WayAround::nearest(const Tree& tree) const {
  const std::size_t first = &tree == &trees_[0] ? std::max<std::size_t>(tip_, 1) : 1;
  std::size_t best = 0;
  double least = distanceOf(tree.nodes[0]);
  for (std::size_t i = first; i < tree.count; ++i) {
    const double distance = distanceOf(tree.nodes[i]);
    if (distance >= least) continue;
    least = distance;
    best = i;
  }
  return best;
}

/// How far it is from what was sampled (m^2, of all points).
double WayAround::distanceOf(const Node& node) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < sampledPlaces_.size(); ++k) {
    sum += (node.places[k] - sampledPlaces_[k]).squaredNorm();
  }
  return sum;
}

void WayAround::search(const VisualBody& body, const Pose& shown, const Pose& target,
                       const std::vector<Eigen::Vector3d>& wanted, LinkId farthest, bool goesOn,
                       Certifier& certifier) {
  if (hasFailed_ || hasWay()) return;
  if (!isBegun_) begin(body, shown, target, wanted, farthest);
  goesOn_ = goesOn_ || goesOn;
  const std::uint32_t before = certifier.queries();
  const std::uint64_t workBefore = certifier.workDone();
  while (certifier.queries() - before < perTick_ && certifier.workLeft() > 0 &&
         certifier.workDone() - workBefore < kSearchWork) {
    const Tree& from = trees_[turn_];
    if (from.count >= kMostNodes || spent_ >= most_) {
      hasFailed_ = true;
      return;
    }
    const std::uint32_t asked = certifier.queries();
    if (trailLeft_ > 0) {
      const bool isBack = goBack(body, certifier);
      spent_ += certifier.queries() - asked;
      if (isBack) return;
      continue;
    }
    // The target may have moved a little: the way leads to where it was.
    const std::size_t begin = uniform(0.0, 1.0) < 0.5 ? 0 : tip_;
    sample(trees_[0].nodes[begin].pose, trees_[1].nodes[0].pose);
    if (uniform(0.0, 1.0) < kStraight) sampled_ = trees_[1 - turn_].nodes[0].pose;
    placeLinks(skeleton_, sampled_, states_);
    body.place(states_, sampledPlaces_);
    const bool isDone = grow(body, certifier);
    spent_ += certifier.queries() - asked;
    if (isDone) return;
    turn_ = 1 - turn_;
  }
}

/// Goes back along the trail, in longer steps as long as they are free; true: from there the way to
/// the target is free.
bool WayAround::goBack(const VisualBody& body, Certifier& certifier) {
  Tree& tree = trees_[0];
  const std::size_t step = std::min(stride_, trailLeft_);
  const Pose& back = trailAt(trailLeft_ - step);
  if (!certifier.isClear(tree.nodes[tip_].pose, back)) {
    if (certifier.workLeft() == 0) return false;  // perhaps it is
    if (step == 1) trailLeft_ = 0;
    stride_ = std::max<std::size_t>(1, step / 2);
    return false;
  }
  trailLeft_ -= step;
  stride_ = 2 * step;
  tip_ = add(body, tree, static_cast<std::int32_t>(tip_), back);
  if (!certifier.isClear(back, trees_[1].nodes[0].pose)) return false;
  finish(tip_, 0, certifier);
  return true;
}

/// Grows one tree to the sample, the other to what the first one has reached; true: they met.
bool WayAround::grow(const VisualBody& body, Certifier& certifier) {
  Tree &one = trees_[turn_], &other = trees_[1 - turn_];
  const auto extend = [&](Tree& tree, std::size_t from, const Pose& to, bool& isThere) {
    const Certified answer = certifier.certify(tree.nodes[from].pose, to, reached_);
    isThere = answer.isClear;
    if (!(answer.share > 0.0) || tree.count >= kMostNodes) return from;
    const std::size_t added = add(body, tree, static_cast<std::int32_t>(from), reached_);
    const double advance = VisualBody::farthest(tree.nodes[from].places, tree.nodes[added].places);
    if (isThere || advance > kLeastAdvance) return added;
    --tree.count;
    return from;
  };
  bool isThere = false;
  const std::size_t here = extend(one, nearest(one), sampled_, isThere);
  if (here + 1 != one.count || here == 0) return false;  // nothing new
  sampled_ = one.nodes[here].pose;
  sampledPlaces_ = one.nodes[here].places;
  const std::size_t there = extend(other, nearest(other), sampled_, isThere);
  if (!isThere) return false;
  finish(turn_ == 0 ? here : there, turn_ == 0 ? there : here, certifier);
  return true;
}

/// The way from root to root, then made shorter.
void WayAround::finish(std::size_t here, std::size_t there, Certifier& certifier) {
  way_.clear();
  for (auto i = static_cast<std::int32_t>(here); i >= 0; i = trees_[0].nodes[slotOf(i)].parent) {
    way_.push(trees_[0].nodes[slotOf(i)].pose);
  }
  way_.reverse();
  // The other tree's end is the same pose.
  for (auto i = trees_[1].nodes[there].parent; i >= 0; i = trees_[1].nodes[slotOf(i)].parent) {
    way_.push(trees_[1].nodes[slotOf(i)].pose);
  }
  skipPoses(certifier);
  next_ = 1;
}

void WayAround::tighten(const VisualBody& body, const Pose& shown, const Pose& target,
                        const std::vector<Eigen::Vector3d>& wanted, Certifier& certifier) {
  // Where the target goes on freely, the way goes on to it.
  if (!isSamePose(way_.back(), target) && certifier.isClear(way_.back(), target)) {
    way_.push(target);
    wanted_ = wanted;
  }
  if (next_ + 1 == way_.size()) return;  // straight to its end
  short_.clear();
  short_.push(shown);
  short_.push(way_, next_, way_.size());
  way_.swap(short_);
  next_ = 1;
  const std::uint64_t left = certifier.workLeft();
  const std::uint64_t kept = certifier.keepBack(left - std::min(left, kSearchWork));
  shorten(body, kShortcutsPerTick, certifier);
  skipPoses(certifier);
  certifier.giveBack(kept);
}

/// Goes on to a far pose to which the motion is clear.
void WayAround::skipPoses(Certifier& certifier) {
  short_.clear();
  short_.push(way_[0]);
  for (std::size_t i = 0; i + 1 < way_.size();) {
    std::size_t to = way_.size() - 1;
    while (to > i + 1 && !certifier.isClear(way_[i], way_[to])) to = i + (to - i) / 2;
    short_.push(way_[to]);
    i = to;
  }
  way_.swap(short_);
}

/// Cuts corners: from somewhere on one motion straight to somewhere on a later one, where that is
/// clear and shorter. Random trees wander, and whoever waits for the avatar sees it.
void WayAround::shorten(const VisualBody& body, int tries, Certifier& certifier) {
  for (int i = 0; i < tries && way_.size() > 2 && certifier.workLeft() > 0; ++i) {
    const auto last = static_cast<double>(way_.size() - 1);
    double from = uniform(0.0, last), to = uniform(0.0, last);
    if (from > to) std::swap(from, to);
    const auto in = static_cast<std::size_t>(from), out = static_cast<std::size_t>(to);
    if (in == out) continue;
    part_.assign(skeleton_, way_[in], way_[in + 1]);
    part_.poseAt(from - static_cast<double>(in), cornerIn_);
    part_.assign(skeleton_, way_[out], way_[out + 1]);
    part_.poseAt(to - static_cast<double>(out), cornerOut_);
    double before = length(body, cornerIn_, way_[in + 1]) + length(body, way_[out], cornerOut_);
    for (std::size_t k = in + 1; k < out; ++k) before += length(body, way_[k], way_[k + 1]);
    if (!(length(body, cornerIn_, cornerOut_) < kShorter * before)) continue;
    if (!certifier.isClear(cornerIn_, cornerOut_)) continue;
    short_.clear();
    short_.push(way_, 0, in + 1);
    short_.push(cornerIn_);
    short_.push(cornerOut_);
    short_.push(way_, out + 1, way_.size());
    way_.swap(short_);
  }
}

double WayAround::length(const VisualBody& body, const Pose& from, const Pose& to) {
  return body.farthestMove(skeleton_, from, to, states_, statesThere_);
}

void WayAround::arrived(const Pose& shown) {
  if (isSamePose(shown, way_[next_])) ++next_;
}

}  // namespace foretouch::internal
