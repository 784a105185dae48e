#include "middleware/solid/pace.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lss/index.h"
#include "middleware/solid/near_rows.h"
#include "middleware/solid/tree_pose.h"

namespace foretouch::internal {
namespace {

/// The catch-up speed is reached in so long, from rest, and left in as long (s): 2 m/s with 5 g.
constexpr double kSpeedUpS = 0.04;
/// Nearer than this (m), the avatar need not brake: what returns by turning some joints against
/// others leaves its place a little on the way.
constexpr double kNear = 2e-3;
/// A joint turns by what moves a hand so far away from it (m).
constexpr double kTurnLever = 0.2;
/// Along a motion of which no link turns farther than this (rad), a chord is as good as a path: it
/// is shorter by the turn's square over 24, a hundredth.
constexpr double kChordTurn = 0.5;
constexpr int kMostPieces = 32;
/// How often the end of what is left is looked for, and how near to it.
constexpr int kMostTries = 8;
constexpr double kWithin = 0.999;
/// Below this share of a path no chord's rounding is the reason.
constexpr double kNearlyAll = 1.0 - 1e-6;
/// Joints of a limb and a trunk: where none turns farther than a share of kChordTurn, no link does.
constexpr double kDepth = 8.0;

/// How fast to catch up, if it was so fast before and is so far away.
double speedFor(double before, double far, double dtS, double most) {
  const double speedUp = most / kSpeedUpS;
  return std::min({most, before + speedUp * dtS, std::sqrt(2.0 * speedUp * std::max(far, kNear))});
}

/// More than 1 where that is more.
double roomFor(double asked, double left) {
  return asked > 0.0 ? std::max(0.0, left) / asked : std::numeric_limits<double>::infinity();
}

double shareWithin(double left, double asked) {
  return std::min(1.0, roomFor(asked, left));
}

/// The largest turn of a joint, of those that are counted (null: all).
double largestTurn(const Pose& from, const Pose& to,
                   const std::vector<std::uint8_t>* isUncounted = nullptr) {
  double least = 1.0;
  for (std::size_t j = 0; j < from.rotations.size(); ++j) {
    if (isUncounted != nullptr && (*isUncounted)[j] != 0) continue;
    least = std::min(least, std::abs(from.rotations[j].dot(to.rotations[j])));
  }
  return 2.0 * std::acos(least);
}

}  // namespace

Pace::Pace(const Avatar& avatar, const VisualBody& body, const SolidOptions& options)
    : skeleton_(avatar.skeleton()),
      body_(body),
      catchUp_(options.catchUp),
      isUncounted_(countOf(avatar.numLinks()), 0) {
  const std::vector<bool> heads = headsByName(avatar);
  for (const VisualBody::Point& point : body.points()) {
    isHead_.push_back(heads[slotOf(point.link)] ? 1 : 0);
  }
}

Moved Pace::chords(const Places& one, const Places& other) const {
  Moved most;
  for (std::size_t k = 0; k < one.size(); ++k) {
    const double squared = (one[k] - other[k]).squaredNorm();
    most.all = std::max(most.all, squared);
    if (isHead_[k] != 0) most.head = std::max(most.head, squared);
  }
  most.all = std::sqrt(most.all);
  most.head = std::sqrt(most.head);
  return most;
}

/// The tracker's joints that it has not seen in both ticks have not moved: they were found.
void Pace::findUncounted(const TargetPose& target) {
  const std::vector<JointId>& parents = skeleton_.parents();
  for (std::size_t j = 0; j < parents.size(); ++j) {
    const auto joint = static_cast<JointId>(j);
    const bool isBelow = parents[j] != kNoParent && isUncounted_[slotOf(parents[j])] != 0;
    isUncounted_[j] = isBelow || target.isLost(joint) || target.wasLost(joint) ? 1 : 0;
  }
}

void Pace::begin(const TargetPose& target, const Begin& places, double lift, double dtS) {
  const Places &wanted = places.wanted, &lastWanted = places.lastWanted;
  dtS_ = dtS;
  goesAlong_ = places.goesAlong;
  tracked_ = spent_ = {};
  if (!lastWanted.empty()) {
    findUncounted(target);
    const auto& points = body_.points();
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (isUncounted_[slotOf(points[k].link)] != 0) continue;
      const double step = (wanted[k] - lastWanted[k]).norm();
      tracked_.all = std::max(tracked_.all, step);
      if (isHead_[k] != 0) tracked_.head = std::max(tracked_.head, step);
    }
    tracked_.turn = std::max(largestTurn(target.last(), target.pose(), &isUncounted_),
                             tracked_.all / kTurnLever);
  }
  // The lift moves the target, and what is tracked stands below it.
  const double lifted = std::min(lift, catchUp_ * dtS);
  const Moved far = chords(places.shown, wanted);
  left_.all = tracked_.all + speedFor(speed_, far.all, dtS, catchUp_) * dtS - lifted;
  left_.head = tracked_.head + speedFor(headSpeed_, far.head, dtS, catchUp_) * dtS - lifted;
  left_.all = std::max(0.0, left_.all);
  left_.head = std::max(0.0, left_.head);
  left_.turn = tracked_.turn + catchUp_ * dtS / kTurnLever;
}

void Pace::end() {
  const auto beyond = [this](double moved, double tracked) {
    return std::max(0.0, moved - tracked) / dtS_;
  };
  speed_ = beyond(spent_.all, tracked_.all);
  headSpeed_ = beyond(spent_.head, tracked_.head);
}

bool Pace::isSpent() const {
  return !(left_.all > kSettled && left_.turn > 0.0);
}

double Pace::shareOf(const Moved& step) const {
  return std::min({roomFor(step.all, left_.all), roomFor(step.head, left_.head),
                   roomFor(step.turn, left_.turn)});
}

bool Pace::mayGo(const Places& here, const Places& there) const {
  if (goesAlong_) return true;
  const Moved chord = chords(here, there);
  return kNearlyAll * chord.all <= left_.all && kNearlyAll * chord.head <= left_.head;
}

int Pace::piecesOf(const Pose& from, const Pose& to) {
  motion_.assign(skeleton_, from, to);
  const double pieces = std::ceil(motion_.largestSums().angularSpeed / kChordTurn);
  return static_cast<int>(std::clamp(pieces, 1.0, static_cast<double>(kMostPieces)));
}

void Pace::placeAt(double t, Places& places) {
  motion_.statesAt(t, states_);
  body_.place(states_, places);
}

double Pace::shareOf(const Pose& from, const Pose& to, Pose& part) {
  if (goesAlong_) return 1.0;
  const int pieces = piecesOf(from, to);
  const double mostTurn = shareWithin(left_.turn, largestTurn(from, to));
  Moved moved;
  double share = 0.0;
  placeAt(0.0, before_);
  for (int i = 1; i <= pieces && share < mostTurn; ++i) {
    const double next = std::min(mostTurn, static_cast<double>(i) / pieces);
    placeAt(next, after_);
    Moved step = chords(before_, after_);
    const auto fits = [&] {
      return std::min(shareWithin(left_.all - moved.all, step.all),
                      shareWithin(left_.head - moved.head, step.head));
    };
    if (fits() < 1.0) {
      // A share of an arc is longer than that share of its chord.
      double more = next - share;
      for (int tries = 0; tries < kMostTries && fits() < 1.0; ++tries) {
        more *= kWithin * fits();
        placeAt(share + more, after_);
        step = chords(before_, after_);
      }
      share += more;
      break;
    }
    moved.all += step.all;
    moved.head += step.head;
    share = next;
    std::swap(before_, after_);
  }
  if (share > 0.0 && share < 1.0) motion_.poseAt(share, part);
  return share;
}

Moved Pace::measure(const Pose& from, const Pose& to, const Places& here, const Places& there) {
  Moved moved = chords(here, there);
  moved.turn = largestTurn(from, to);
  if (moved.turn * kDepth <= kChordTurn) return moved;
  const int pieces = piecesOf(from, to);
  if (pieces == 1) return moved;
  moved.all = moved.head = 0.0;
  before_ = here;
  for (int i = 1; i <= pieces; ++i) {
    placeAt(static_cast<double>(i) / pieces, after_);
    const Moved step = chords(before_, after_);
    moved.all += step.all;
    moved.head += step.head;
    std::swap(before_, after_);
  }
  return moved;
}

void Pace::spend(const Pose& from, const Pose& to, const Places& here, const Places& there) {
  const Moved moved = measure(from, to, here, there);
  goesAlong_ = false;
  left_.all -= moved.all;
  left_.head -= moved.head;
  left_.turn -= moved.turn;
  spent_.all += moved.all;
  spent_.head += moved.head;
}

void Pace::spend(const Pose& from, const Pose& to) {
  placeLinks(skeleton_, from, states_);
  body_.place(states_, here_);
  placeLinks(skeleton_, to, states_);
  body_.place(states_, there_);
  spend(from, to, here_, there_);
}

}  // namespace foretouch::internal
