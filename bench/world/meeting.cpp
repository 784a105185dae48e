#include "bench/world/meeting.h"

#include <utility>

#include "tools/portable_random.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// The distance of two segments, in doubles [Ericson05] 5.1.9.
double segmentDistance(const Vector3d& p1, const Vector3d& q1, const Vector3d& p2,
                       const Vector3d& q2) {
  const Vector3d d1 = q1 - p1, d2 = q2 - p2, r = p1 - p2;
  const double a = d1.squaredNorm(), e = d2.squaredNorm(), f = d2.dot(r), c = d1.dot(r);
  constexpr double kPoint = 1e-18;
  double s = 0.0, t = 0.0;
  if (a <= kPoint && e > kPoint) {
    t = std::clamp(f / e, 0.0, 1.0);
  } else if (a > kPoint && e <= kPoint) {
    s = std::clamp(-c / a, 0.0, 1.0);
  } else if (a > kPoint) {
    const double b = d1.dot(d2), denominator = a * e - b * b;
    s = denominator > 0.0 ? std::clamp((b * f - c * e) / denominator, 0.0, 1.0) : 0.0;
    t = (b * s + f) / e;
    if (t < 0.0) s = std::clamp(-c / a, 0.0, 1.0);
    if (t > 1.0) s = std::clamp((b - c) / a, 0.0, 1.0);
    t = std::clamp(t, 0.0, 1.0);
  }
  return (p1 + s * d1 - p2 - t * d2).norm();
}

MetWalker walkerOf(const ClipPoses& clip, const Placement& place, const Vector3d& speed,
                   std::size_t phase, std::int64_t offsetUs, std::int64_t untilUs) {
  MetWalker walker{&clip, offsetUs, {}};
  Person person;
  person.clip = &clip;
  person.place = place;
  person.phase = phase;
  for (std::int64_t k = 0; k == 0 || offsetUs + clip.periodUs * (k - 1) < untilUs; ++k) {
    Pose pose = person.pose(k);
    pose.translations[0] += 1e-6 * static_cast<double>(offsetUs + clip.periodUs * k) * speed;
    walker.samples.push_back(std::move(pose));
  }
  return walker;
}

}  // namespace

Meeting::Meeting(MetWalker one, MetWalker other) : one_(std::move(one)), other_(std::move(other)) {
  for (const MetWalker* walker : {&one_, &other_}) {
    judge_.bodies.push_back(judgedBody(walker->avatar()));
    for (std::size_t k = 0; k < walker->samples.size(); ++k) {
      pushJudged(judge_.bodies.back(), walker->instant(k), walker->samples[k]);
    }
  }
}

oracle::OracleTouch Meeting::firstTouch(std::size_t pair, std::int64_t fromUs,
                                        std::int64_t toUs) const {
  return judge_.firstTouch(0, static_cast<int>(pair / linksOfOther()), 1,
                           static_cast<int>(pair % linksOfOther()), fromUs, toUs);
}

double Meeting::gapAt(std::size_t pair, std::int64_t fromUs, double us) const {
  return static_cast<double>(judge_.separationAt(0, static_cast<int>(pair / linksOfOther()), 1,
                                                 static_cast<int>(pair % linksOfOther()), fromUs,
                                                 static_cast<oracle::Real>(us)));
}

void Meeting::overlapsAt(std::int64_t us, std::vector<bool>& overlaps) const {
  const Pose &a = one_.newestAt(us), &b = other_.newestAt(us);
  std::vector<LinkState> ofOne, ofOther;
  ChainMotion(one_.avatar().skeleton(), a, a).statesAt(0.0, ofOne);
  ChainMotion(other_.avatar().skeleton(), b, b).statesAt(0.0, ofOther);
  overlaps.assign(pairs(), false);
  for (LinkId i = 0; i < one_.avatar().numLinks(); ++i) {
    for (LinkId j = 0; j < other_.avatar().numLinks(); ++j) {
      overlaps[pairOf(i, j)] = overlap(i, ofOne[slotOf(i)], j, ofOther[slotOf(j)]);
    }
  }
}

bool Meeting::overlap(LinkId i, const LinkState& atI, LinkId j, const LinkState& atJ) const {
  for (const Lss& x : one_.avatar().lss(i)) {
    for (const Lss& y : other_.avatar().lss(j)) {
      if (segmentDistance(atI.pointAt(x.a), atI.pointAt(x.b), atJ.pointAt(y.a), atJ.pointAt(y.b)) <=
          x.radius + y.radius) {
        return true;
      }
    }
  }
  return false;
}

Meeting meetingOf(const std::vector<ClipPoses>& slow, const std::vector<ClipPoses>& quick, int n,
                  std::int64_t untilUs) {
  PortableRandom random(static_cast<std::uint64_t>(n));
  const auto k = static_cast<std::size_t>(n);
  Placement beside;
  beside.yawDeg = random.uniform(0.0, 360.0);
  beside.origin = Vector3d(random.uniform(0.4, 0.9), 0.0, random.uniform(-0.3, 0.3));
  const Vector3d speed(random.uniform(-1.5, -0.3), 0.0, random.uniform(-0.4, 0.4));
  const auto offsetUs = -static_cast<std::int64_t>(random.uniform(0.0, 11'000.0));
  return {walkerOf(slow[k % slow.size()], {}, Vector3d::Zero(), 11 * k, 0, untilUs),
          walkerOf(quick[(k / slow.size() + k) % quick.size()], beside, speed, 29 * k, offsetUs,
                   untilUs)};
}

}  // namespace foretouch::tools
