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
/// A link so deep in another, beyond the tracked one (m), is seen.
constexpr double kSeen = 0.05;
constexpr double kDegrees = 180.0 / 3.14159265358979;
constexpr std::size_t kMostFindings = 20;

double angleBetween(const std::array<double, 4>& one, const std::array<double, 4>& other) {
  double cosine = 0.0;
  for (std::size_t i = 0; i < 4; ++i) cosine += one[i] * other[i];
  return 2.0 * std::acos(std::min(1.0, std::abs(cosine)));
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
      "{} ticks: {} in which a point outran the tracked ones, {} in which the lift jumped, {} with "
      "a link {:g} m deeper in another than tracked\n{:24} {:>8} {:>8} {:>8} {:>9} {:>9} {:>8} "
      "{:>8}\n",
      ticks, outrun, liftJumped, deeper, kSeen, "link, at worst", "beyond", "turned", "unseen",
      "turning", "in itself", "m/s2", "tracked");
  for (const auto& [name, link] : links) {
    text += fmt::format("{:24} {:>8.2f} {:>8.0f} {:>8.0f} {:>9.0f} {:>9.0f} {:>8.0f} {:>8.0f}\n",
                        name, link.beyond, kDegrees * link.turn, kDegrees * link.unseen,
                        kDegrees * link.turnSpeed, 1e3 * link.ownDepth, link.acceleration,
                        link.tracked);
  }
  return text + fmt::format(
                    "head, m/s2: shown p99 {:.1f}, p99.9 {:.1f}, most {:.1f}; tracked p99 "
                    "{:.1f}, p99.9 {:.1f}, most {:.1f}\n",
                    quantile(head, 0.99), quantile(head, 0.999), quantile(head, 1.0),
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
  const Body shown = placed(tick.shown), there = placed(tracked);
  seen_.push_back(there.turns);
  if (tick.hasAppeared || tick.state == SolidState::Placing) {
    shown_.clear();
    tracked_.clear();
  }
  if (!shown_.empty()) {
    lookAtSpeed(shown, there, dtS);
    lookAtTurns(shown, there, dtS);
    lookAtDepth(shown, there);
    const double change = std::abs(tick.lift - lift_) / dtS;
    if (change > kLiftSpeed * (1.0 + kRounding)) {
      ++tally_.liftJumped;
      find(fmt::format("the lift changes by {:.3g} m/s", change));
    }
  }
  if (shown_.size() == 2) lookAtHead(shown, there, dtS);
  lift_ = tick.lift;
  if (shown_.size() == 2) {
    shown_.erase(shown_.begin());
    tracked_.erase(tracked_.begin());
  }
  shown_.push_back(shown);
  tracked_.push_back(there);
}

void MotionAudit::lookAtSpeed(const Body& shown, const Body& tracked, double dtS) {
  const Body &shownBefore = shown_.back(), &trackedBefore = tracked_.back();
  double fastest = 0.0;
  for (std::size_t i = 0; i < tracked.axes.size(); ++i) {
    for (std::size_t end = 0; end < 2; ++end) {
      fastest = std::max(fastest, norm(tracked.axes[i][end] - trackedBefore.axes[i][end]) / dtS);
    }
  }
  double worst = 0.0;
  std::size_t link = 0;
  for (std::size_t i = 0; i < shown.axes.size(); ++i) {
    for (std::size_t end = 0; end < 2; ++end) {
      const double beyond = norm(shown.axes[i][end] - shownBefore.axes[i][end]) / dtS - fastest;
      of(linkOf_[i]).beyond = std::max(of(linkOf_[i]).beyond, beyond);
      if (beyond > worst) link = linkOf_[i];
      worst = std::max(worst, beyond);
    }
  }
  if (worst <= catchUp_ + kRounding) return;
  ++tally_.outrun;
  find(fmt::format("{} outruns the tracked ones, which move at {:.2f} m/s, by {:.3f} m/s",
                   names_[link], fastest, worst));
}

void MotionAudit::lookAtTurns(const Body& shown, const Body& tracked, double dtS) {
  for (std::size_t j = 0; j < shown.turns.size(); ++j) {
    if (body_.capsules[j].empty()) continue;
    LinkMotion& own = of(j);
    const double turn = angleBetween(shown.turns[j], tracked.turns[j]);
    own.turn = std::max(own.turn, turn);
    own.turnSpeed =
        std::max(own.turnSpeed, angleBetween(shown.turns[j], shown_.back().turns[j]) / dtS);
    double unseen = turn;
    for (std::size_t i = 0; i < seen_.size() && unseen > own.unseen; ++i) {
      unseen = std::min(unseen, angleBetween(shown.turns[j], seen_[i][j]));
    }
    own.unseen = std::max(own.unseen, unseen);
  }
}

double MotionAudit::ownDepth(const Body& body, std::size_t i, std::size_t k) const {
  const auto &one = body.axes[i], &other = body.axes[k];
  const double apart =
      oracle::closestPoints<double>(one[0], one[1], {other[0], other[1], other[1]}).distance;
  return radii_[i] + radii_[k] - apart;
}

void MotionAudit::lookAtDepth(const Body& shown, const Body& tracked) {
  double worst = 0.0;
  for (const auto& [i, k] : pairs_) {
    const double depth = ownDepth(shown, i, k);
    if (!(depth > 0.0)) continue;
    const double deeper = depth - std::max(0.0, ownDepth(tracked, i, k));
    for (const std::size_t lss : {i, k}) {
      of(linkOf_[lss]).ownDepth = std::max(of(linkOf_[lss]).ownDepth, deeper);
    }
    worst = std::max(worst, deeper);
  }
  if (worst > kSeen) ++tally_.deeper;
}

void MotionAudit::lookAtHead(const Body& shown, const Body& tracked, double dtS) {
  const auto acceleration = [dtS](const Vec& before, const Vec& then, const Vec& now) {
    return norm(now - 2.0 * then + before) / (dtS * dtS);
  };
  double head = 0.0, trackedHead = 0.0;
  for (std::size_t i = 0; i < shown.axes.size(); ++i) {
    for (std::size_t end = 0; end < 2; ++end) {
      const double here =
          acceleration(shown_[0].axes[i][end], shown_[1].axes[i][end], shown.axes[i][end]);
      const double there =
          acceleration(tracked_[0].axes[i][end], tracked_[1].axes[i][end], tracked.axes[i][end]);
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

}  // namespace foretouch::test
