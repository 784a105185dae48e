#include "tests/oracle/motion_audit.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "articulated/pair_rules.h"
#include "bench/solid/plain_body.h"
#include "judge/distance.h"

namespace foretouch::test {
namespace {

/// What the documents promise of the lift (m/s), and how far rounding may be off.
constexpr double kLiftSpeed = 0.05, kRounding = 1e-6;
/// And of joints: they turn as a hand so far away from them (m) moves. An arc cosine loses half of
/// the digits of a small turn, in each step of a tick (rad/s).
constexpr double kTurnLever = 0.2, kTurnRounding = 1e-4;
/// A link so deep in another, beyond the tracked one (m), is seen.
constexpr double kSeen = 0.05;
constexpr double kDegrees = 180.0 / 3.14159265358979;
constexpr std::size_t kMostFindings = 20, kHistory = 3;

double cosineBetween(const std::array<double, 4>& one, const std::array<double, 4>& other) {
  return one[0] * other[0] + one[1] * other[1] + one[2] * other[2] + one[3] * other[3];
}

double angleBetween(const std::array<double, 4>& one, const std::array<double, 4>& other) {
  const double sign = cosineBetween(one, other) < 0.0 ? -1.0 : 1.0;
  double squared = 0.0;
  for (std::size_t i = 0; i < 4; ++i) squared += std::pow(one[i] - sign * other[i], 2);
  return 4.0 * std::asin(std::min(1.0, 0.5 * std::sqrt(squared)));
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

}  // namespace

void MotionTally::add(const MotionTally& other) {
  ticks += other.ticks;
  outrun += other.outrun;
  headOutrun += other.headOutrun;
  lifted = std::max(lifted, other.lifted);
  headBeyond = std::max(headBeyond, other.headBeyond);
  turnBeyond = std::max(turnBeyond, other.turnBeyond);
  overturned += other.overturned;
  liftJumped += other.liftJumped;
  deeper += other.deeper;
  head.insert(head.end(), other.head.begin(), other.head.end());
  trackedHead.insert(trackedHead.end(), other.trackedHead.begin(), other.trackedHead.end());
  for (const auto& [name, link] : other.links) {
    LinkMotion& own = links[name];
    own.beyond = std::max(own.beyond, link.beyond);
    own.turn = std::max(own.turn, link.turn);
    own.unseen = std::max(own.unseen, link.unseen);
    own.turnSpeed = std::max(own.turnSpeed, link.turnSpeed);
    own.ownDepth = std::max(own.ownDepth, link.ownDepth);
    own.acceleration = std::max(own.acceleration, link.acceleration);
    own.tracked = std::max(own.tracked, link.tracked);
  }
  for (const std::string& finding : other.findings) {
    if (findings.size() < kMostFindings) findings.push_back(finding);
  }
}

std::string MotionTally::table() const {
  std::string text = fmt::format(
      "{} ticks: {} in which a point outran the tracked ones, {} in which the head outran the "
      "tracked head, {} in which a joint turned faster than it may (at most {:.2f} rad/s beyond "
      "the "
      "tracked ones), {} in which the lift (at most {:.3f} m) jumped, {} with a link {:g} m deeper "
      "in another than tracked\n{:24} {:>8} {:>8} {:>8} {:>9} {:>9} {:>8} {:>8}\n",
      ticks, outrun, headOutrun, overturned, turnBeyond, liftJumped, lifted, deeper, kSeen,
      "link, at worst", "beyond", "turned", "unseen", "turning", "in itself", "m/s2", "tracked");
  for (const auto& [name, link] : links) {
    text += fmt::format("{:24} {:>8.2f} {:>8.0f} {:>8.0f} {:>9.0f} {:>9.0f} {:>8.0f} {:>8.0f}\n",
                        name, link.beyond, kDegrees * link.turn, kDegrees * link.unseen,
                        kDegrees * link.turnSpeed, 1e3 * link.ownDepth, link.acceleration,
                        link.tracked);
  }
  return text + fmt::format(
                    "head: faster than tracked by {:.2f} m/s at most; m/s2: shown p99 {:.1f}, "
                    "p99.9 {:.1f}, most {:.1f}; tracked p99 {:.1f}, p99.9 {:.1f}, most {:.1f}\n",
                    headBeyond, quantile(head, 0.99), quantile(head, 0.999), quantile(head, 1.0),
                    quantile(trackedHead, 0.99), quantile(trackedHead, 0.999),
                    quantile(trackedHead, 1.0));
}

MotionAudit::MotionAudit(const oracle::Scene& scene, const Avatar& avatar,
                         const SolidOptions& options)
    : judge_(scene, tools::plainBody(avatar)),
      body_(tools::plainBody(avatar)),
      catchUp_(options.catchUp),
      isHead_(headsByName(avatar)) {
  for (std::size_t link = 0; link < body_.capsules.size(); ++link) {
    names_.push_back(avatar.skeleton().name(static_cast<LinkId>(link)));
    for (const auto& capsule : body_.capsules[link]) {
      linkOf_.push_back(link);
      radii_.push_back(capsule.radius);
    }
  }
  const auto rules = PairRules::derive(avatar);
  for (std::size_t i = 0; rules.ok() && i < linkOf_.size(); ++i) {
    for (std::size_t k = i + 1; k < linkOf_.size(); ++k) {
      if (linkOf_[i] == linkOf_[k]) continue;
      const auto one = static_cast<LinkId>(linkOf_[i]), other = static_cast<LinkId>(linkOf_[k]);
      const PairReason reason = rules.value().reasonOf(one, other);
      const bool isKept = reason == PairReason::Asked || reason == PairReason::RestOverlap;
      if (isKept) pairs_.push_back({i, k});
    }
  }
}

void MotionAudit::begin(std::string name) {
  name_ = std::move(name);
  tickOfRun_ = 0;
  seen_.clear();
  shown_.clear();
  tracked_.clear();
}

MotionAudit::Body MotionAudit::placed(const Pose& pose) {
  const oracle::PlainPose plain = tools::plainPose(pose);
  return {judge_.endsAt(plain), plain.rotations};
}

void MotionAudit::find(const std::string& what) {
  if (tally_.findings.size() >= kMostFindings) return;
  tally_.findings.push_back(fmt::format("{}, tick {}: {}", name_, tickOfRun_, what));
}

void MotionAudit::look(const Pose& tracked, const SolidTick& tick, double dtS) {
  ++tickOfRun_;
  ++tally_.ticks;
  ugly_ = {};
  const Body shown = placed(tick.shown), there = placed(tracked);
  seen_.push_back(there.turns);
  if (tick.hasAppeared || tick.state == SolidState::Placing) {
    shown_.clear();
    tracked_.clear();
  }
  if (!shown_.empty()) {
    lookAtSpeed(shown, there, dtS);
    lookAtTurns(shown, there, std::abs(tick.lift - lift_), dtS);
    lookAtDepth(shown, there);
    const double change = std::abs(tick.lift - lift_) / dtS;
    if (change > kLiftSpeed * (1.0 + kRounding)) {
      ++tally_.liftJumped;
      find(fmt::format("the lift changes by {:.3g} m/s", change));
    }
  }
  if (shown_.size() >= 2) lookAtHead(shown, there, dtS);
  if (shown_.size() == kHistory) lookAtJerk(shown, there, dtS);
  lift_ = tick.lift;
  tally_.lifted = std::max(tally_.lifted, tick.lift);
  if (shown_.size() == kHistory) {
    shown_.erase(shown_.begin());
    tracked_.erase(tracked_.begin());
  }
  shown_.push_back(shown);
  tracked_.push_back(there);
}

MotionAudit::Fastest MotionAudit::fastest(const Body& before, const Body& now, double dtS,
                                          bool ofHead) const {
  Fastest most;
  for (std::size_t i = 0; i < now.axes.size(); ++i) {
    if (ofHead && !isHead_[linkOf_[i]]) continue;
    for (std::size_t end = 0; end < 2; ++end) {
      const double speed = norm(now.axes[i][end] - before.axes[i][end]) / dtS;
      if (speed > most.speed) most = {speed, linkOf_[i]};
    }
  }
  return most;
}

MotionAudit::Fastest MotionAudit::fastestTurn(const Body& before, const Body& now, double dtS) {
  Fastest most;
  for (std::size_t j = 0; j < now.turns.size(); ++j) {
    const double speed = angleBetween(now.turns[j], before.turns[j]) / dtS;
    if (speed > most.speed) most = {speed, j};
  }
  return most;
}

void MotionAudit::lookAtSpeed(const Body& shown, const Body& tracked, double dtS) {
  const double most = fastest(tracked_.back(), tracked, dtS, false).speed;
  for (std::size_t i = 0; i < shown.axes.size(); ++i) {
    for (std::size_t end = 0; end < 2; ++end) {
      const double speed = norm(shown.axes[i][end] - shown_.back().axes[i][end]) / dtS;
      of(linkOf_[i]).beyond = std::max(of(linkOf_[i]).beyond, speed - most);
    }
  }
  const Fastest worst = fastest(shown_.back(), shown, dtS, false);
  if (worst.speed - most > catchUp_ + kRounding) {
    ++tally_.outrun;
    find(fmt::format("{} outruns the tracked ones, which move at {:.2f} m/s, by {:.3f} m/s",
                     names_[worst.link], most, worst.speed - most));
  }
  // So what it accelerates by is at most the sum of two such speeds over the tick.
  const double head = fastest(shown_.back(), shown, dtS, true).speed;
  const double beyond = head - fastest(tracked_.back(), tracked, dtS, true).speed;
  tally_.headBeyond = std::max(tally_.headBeyond, beyond);
  if (beyond <= catchUp_ + kRounding) return;
  ++tally_.headOutrun;
  find(fmt::format("the head outruns the tracked one, which moves at {:.2f} m/s, by {:.3f} m/s",
                   head - beyond, beyond));
}

void MotionAudit::lookAtTurns(const Body& shown, const Body& tracked, double lifted, double dtS) {
  for (std::size_t j = 0; j < shown.turns.size(); ++j) {
    if (body_.capsules[j].empty()) continue;
    LinkMotion& own = of(j);
    const double turn = angleBetween(shown.turns[j], tracked.turns[j]);
    own.turn = std::max(own.turn, turn);
    own.turnSpeed =
        std::max(own.turnSpeed, angleBetween(shown.turns[j], shown_.back().turns[j]) / dtS);
    double nearest = 0.0;
    for (const auto& turns : seen_) {
      nearest = std::max(nearest, std::abs(cosineBetween(shown.turns[j], turns[j])));
    }
    const double unseen = 2.0 * std::acos(std::min(1.0, nearest));
    own.unseen = std::max(own.unseen, unseen);
    ugly_.unseen.take(unseen, j);
  }
  const double byEnds =
      (fastest(tracked_.back(), tracked, dtS, false).speed + lifted / dtS) / kTurnLever;
  const Fastest worst = fastestTurn(shown_.back(), shown, dtS);
  const double beyond =
      worst.speed - std::max(byEnds, fastestTurn(tracked_.back(), tracked, dtS).speed);
  tally_.turnBeyond = std::max(tally_.turnBeyond, beyond);
  if (beyond <= catchUp_ / kTurnLever + kTurnRounding) return;
  ++tally_.overturned;
  find(fmt::format("the joint of {} turns at {:.2f} rad/s, {:.2f} beyond what is tracked",
                   names_[worst.link], worst.speed, beyond));
}

double MotionAudit::ownDepth(const Body& body, std::size_t i, std::size_t k) const {
  const auto &one = body.axes[i], &other = body.axes[k];
  // Most are far apart: no more is asked of them than that.
  const double middles = 0.5 * norm((one[0] + one[1]) - (other[0] + other[1]));
  const double reach = 0.5 * (norm(one[1] - one[0]) + norm(other[1] - other[0]));
  if (middles - reach > radii_[i] + radii_[k]) return radii_[i] + radii_[k] - middles + reach;
  const double apart =
      oracle::closestPoints<double>(one[0], one[1], {other[0], other[1], other[1]}).distance;
  return radii_[i] + radii_[k] - apart;
}

void MotionAudit::lookAtDepth(const Body& shown, const Body& tracked) {
  for (const auto& [i, k] : pairs_) {
    const double depth = ownDepth(shown, i, k);
    if (!(depth > 0.0)) continue;
    const double deeper = depth - std::max(0.0, ownDepth(tracked, i, k));
    for (const std::size_t lss : {i, k}) {
      of(linkOf_[lss]).ownDepth = std::max(of(linkOf_[lss]).ownDepth, deeper);
    }
    ugly_.ownDepth.take(deeper, linkOf_[k]);  // a limb comes after its trunk
  }
  if (ugly_.ownDepth.value > kSeen) ++tally_.deeper;
}

void MotionAudit::lookAtHead(const Body& shown, const Body& tracked, double dtS) {
  const auto acceleration = [dtS](const Vec& before, const Vec& then, const Vec& now) {
    return norm(now - 2.0 * then + before) / (dtS * dtS);
  };
  double head = 0.0, trackedHead = 0.0;
  const std::size_t then = shown_.size() - 1, before = then - 1;
  for (std::size_t i = 0; i < shown.axes.size(); ++i) {
    for (std::size_t end = 0; end < 2; ++end) {
      const double here =
          acceleration(shown_[before].axes[i][end], shown_[then].axes[i][end], shown.axes[i][end]);
      const double there = acceleration(tracked_[before].axes[i][end], tracked_[then].axes[i][end],
                                        tracked.axes[i][end]);
      LinkMotion& own = of(linkOf_[i]);
      own.acceleration = std::max(own.acceleration, here);
      own.tracked = std::max(own.tracked, there);
      if (!isHead_[linkOf_[i]]) continue;
      head = std::max(head, here);
      trackedHead = std::max(trackedHead, there);
    }
  }
  tally_.head.push_back(head);
  tally_.trackedHead.push_back(trackedHead);
}

void MotionAudit::lookAtJerk(const Body& shown, const Body& tracked, double dtS) {
  const auto jerk = [dtS](const std::vector<Body>& before, const Body& now, std::size_t i,
                          std::size_t end) {
    const Vec &x0 = before[0].axes[i][end], &x1 = before[1].axes[i][end],
              &x2 = before[2].axes[i][end];
    return norm((now.axes[i][end] - x0) + 3.0 * (x1 - x2)) / (dtS * dtS * dtS);
  };
  for (std::size_t i = 0; i < shown.axes.size(); ++i) {
    for (std::size_t end = 0; end < 2; ++end) {
      ugly_.jerk.take(jerk(shown_, shown, i, end) - jerk(tracked_, tracked, i, end), linkOf_[i]);
    }
  }
}

}  // namespace foretouch::test
