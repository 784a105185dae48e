#include "bench/solid/feel.h"

#include <algorithm>
#include <cmath>

#include "articulated/try.h"
#include "bench/machine.h"
#include "lss/index.h"
#include "middleware/query/query.h"

namespace foretouch::tools {
namespace {

using Ends = std::vector<std::array<oracle::Vec3d, 2>>;

void append(std::vector<double>& to, const std::vector<double>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

class FeelMeter {
 public:
  FeelMeter(const SolidStage& stage, const SolidActor& actor, const FeelRun& run)
      : actor_(actor),
        run_(run),
        links_(solidLinks(actor.avatar)),
        judge_(stage.judged, plainBody(actor.avatar)),
        trunk_(stage.judged, plainBody(actor.avatar, links_.trunk)),
        hands_(stage.judged, plainBody(actor.avatar, links_.hands)),
        audit_(stage.judged, actor.avatar) {
    audit_.begin(run.name);
  }

  void look(const Pose& tracked, const SolidTick& tick) {
    const oracle::PlainPose wanted = lifted(plainPose(tracked), tick.lift),
                            shown = plainPose(tick.shown);
    audit_.look(tick);
    const bool isFree = judge_.at(wanted, 0.0).link < 0;
    const bool isEqual = wanted == shown;
    ++tally_.ticks;
    (isFree ? tally_.free : tally_.inside) += 1;
    const bool mayBeEqual = isDirectlyFree(wanted, isFree);
    Ends track = judge_.endsAt(wanted), show = judge_.endsAt(shown);
    const bool isTrunkFree = trunk_.at(wanted, 0.0).link < 0;
    const bool areHandsFree = hands_.at(wanted, 0.0).link < 0;
    const double most = lookAtDeviation(track, show, isTrunkFree, areHandsFree);
    tally_.lift.push_back(tick.lift);
    if (isFree) {
      tally_.equal += isEqual ? 1 : 0;
      tally_.away += most > kAway ? 1 : 0;
    }
    if (mayBeEqual && !isEqual && isWithinReach(track)) ++tally_.late;
    lookAtReturn(isFree, isEqual);
    lookAtMotion(track, tracked_, tally_.trackedAcceleration, nullptr);
    lookAtMotion(show, shownEnds_, tally_.acceleration, &tally_.fastest);
    last_ = shown;
  }

  FeelTally finish() {
    if (waiting_ > 0) leaveUnreached();
    tally_.way = audit_.tally();
    return std::move(tally_);
  }
  FeelTally& tally() { return tally_; }

 private:
  bool isDirectlyFree(const oracle::PlainPose& wanted, bool isFree) {
    if (!isFree || last_.rotations.empty()) return false;
    return judge_.along(last_, wanted, run_.tolerance * 1.01).link < 0;
  }

  /// Could the shown body have come here from where it was? The catch-up speed allows it on top of
  /// what the tracked one moved.
  [[nodiscard]] bool isWithinReach(const Ends& track) const {
    if (shownEnds_.empty() || tracked_.empty()) return true;
    double wanted = 0.0, moved = 0.0;
    for (std::size_t c = 0; c < track.size(); ++c) {
      for (std::size_t end = 0; end < 2; ++end) {
        wanted = std::max(wanted, norm(track[c][end] - shownEnds_.back()[c][end]));
        moved = std::max(moved, norm(track[c][end] - tracked_.back()[c][end]));
      }
    }
    return wanted <= moved + run_.catchUp / run_.rateHz;
  }

  /// The floor policy moves the target, along y: that is reported apart from what keeps it away.
  [[nodiscard]] oracle::PlainPose lifted(oracle::PlainPose pose, double lift) const {
    for (LinkId link = 0; link < actor_.avatar.numLinks(); ++link) {
      if (actor_.avatar.skeleton().parent(link) == kNoParent)
        pose.translations[slotOf(link)].y += lift;
    }
    return pose;
  }

  double lookAtDeviation(const Ends& track, const Ends& show, bool isTrunkFree, bool areHandsFree) {
    perLink_.assign(countOf(actor_.avatar.numLinks()), -1.0);
    for (std::size_t c = 0; c < track.size(); ++c) {
      double& link = perLink_[static_cast<std::size_t>(judge_.linkOf()[c])];
      for (std::size_t end = 0; end < 2; ++end) {
        link = std::max(link, norm(show[c][end] - track[c][end]));
      }
    }
    double most = 0.0;
    for (std::size_t link = 0; link < perLink_.size(); ++link) {
      const double deviation = perLink_[link];
      if (deviation < 0.0) continue;
      most = std::max(most, deviation);
      tally_.deviation.push_back(deviation);
      if (links_.hands[link]) {
        tally_.hands.push_back(deviation);
        if (isTrunkFree && areHandsFree) tally_.handsAlone.push_back(deviation);
      }
      if (!links_.heads[link]) continue;
      tally_.head.push_back(deviation);
      if (isTrunkFree) tally_.headAlone.push_back(deviation);
    }
    return most;
  }

  void leaveUnreached() {
    tally_.back.push_back(waiting_);
    ++tally_.neverBack;
    waiting_ = 0;
  }

  void lookAtReturn(bool isFree, bool isEqual) {
    if (!isFree) {
      if (waiting_ > 0) leaveUnreached();
      wasInside_ = true;
      return;
    }
    if (wasInside_) waiting_ = 1;
    wasInside_ = false;
    if (waiting_ == 0) return;
    if (isEqual) {
      tally_.back.push_back(waiting_ - 1);
      waiting_ = 0;
    } else {
      ++waiting_;
    }
  }

  /// `before`: those of the last two ticks, at most.
  void lookAtMotion(const Ends& now, std::vector<Ends>& before, std::vector<double>& acceleration,
                    double* fastest) const {
    const double rate = run_.rateHz;
    for (std::size_t c = 0; c < now.size() && !before.empty(); ++c) {
      for (std::size_t end = 0; end < 2; ++end) {
        const oracle::Vec3d step = now[c][end] - before.back()[c][end];
        if (fastest != nullptr) *fastest = std::max(*fastest, norm(step) * rate);
        if (before.size() < 2) continue;
        const oracle::Vec3d last = before[1][c][end] - before[0][c][end];
        acceleration.push_back(norm(step - last) * rate * rate);
      }
    }
    if (before.size() == 2) before.erase(before.begin());
    before.push_back(now);
  }

  const SolidActor& actor_;
  const FeelRun& run_;
  SolidLinks links_;
  oracle::WayJudge judge_, trunk_, hands_;
  WayAudit audit_;
  FeelTally tally_;
  oracle::PlainPose last_;
  std::vector<Ends> tracked_, shownEnds_;
  std::vector<double> perLink_;
  int waiting_ = 0;  ///< Ticks since the tracked pose came free, this one counted; 0: none.
  bool wasInside_ = false;
};

/// The query that a tick cannot do without: from one tracked pose to the next, or from the shown
/// one. The least of three, as the tick that is compared with it ran once.
class BareQuery {
 public:
  explicit BareQuery(Query query) : query_(std::move(query)) {}
  double timeUs(const Pose& from, const Pose& to) {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
      const ThreadStopwatch watch;
      motion_.assign(query_.avatar().skeleton(), from, to);
      query_.answer(motion_, scratch_, step_);
      least = std::min(least, watch.us());
    }
    return least;
  }

 private:
  Query query_;
  ChainMotion motion_;
  Scratch scratch_;
  StepContacts step_;
};

}  // namespace

void FeelTally::add(const FeelTally& other) {
  append(deviation, other.deviation);
  append(hands, other.hands);
  append(head, other.head);
  append(lift, other.lift);
  append(headAlone, other.headAlone);
  append(handsAlone, other.handsAlone);
  append(acceleration, other.acceleration);
  append(trackedAcceleration, other.trackedAcceleration);
  append(us, other.us);
  append(freeUs, other.freeUs);
  append(contactUs, other.contactUs);
  append(queries, other.queries);
  append(iterations, other.iterations);
  append(aroundQueries, other.aroundQueries);
  append(overBareUs, other.overBareUs);
  append(bareUs, other.bareUs);
  append(back, other.back);
  ticks += other.ticks;
  inside += other.inside;
  free += other.free;
  equal += other.equal;
  away += other.away;
  late += other.late;
  neverBack += other.neverBack;
  fastest = std::max(fastest, other.fastest);
  way.add(other.way);
}

Result<FeelTally> feel(const SolidStage& stage, const SolidActor& actor,
                       const std::vector<Pose>& tracked, const FeelRun& run, Follower& follower) {
  FeelMeter meter(stage, actor, run);
  FeelTally& tally = meter.tally();
  QueryOptions options;
  options.tolerance = run.tolerance;
  FORETOUCH_TRY(auto query, Query::build(actor.avatar, stage.scene, options));
  BareQuery bare(std::move(query));
  SolidTick tick;
  Pose before;
  for (std::size_t i = 0; i < tracked.size(); ++i) {
    const ThreadStopwatch watch;
    FORETOUCH_CHECK(follower.follow(tracked[i], 1.0 / run.rateHz, tick));
    const double us = watch.us();
    if (i > 0) {
      const bool isFree = isFreeTick(tick);
      tally.us.push_back(us);
      (isFree ? tally.freeUs : tally.contactUs).push_back(us);
      tally.queries.push_back(tick.counters.queries);
      tally.iterations.push_back(tick.counters.iterations);
      tally.aroundQueries.push_back(tick.counters.aroundQueries);
      tally.bareUs.push_back(bare.timeUs(tracked[i - 1], tracked[i]));
      if (isFree) tally.overBareUs.push_back(us - bare.timeUs(before, tracked[i]));
    }
    before = tick.shown;
    meter.look(tracked[i], tick);
  }
  return meter.finish();
}

}  // namespace foretouch::tools
