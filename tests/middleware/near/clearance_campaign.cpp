#include "tests/middleware/near/clearance_campaign.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "judge/first_touch.h"
#include "judge/motion.h"
#include "judge/scene.h"
#include "tests/middleware/random_scene.h"
#include "tests/support/judged.h"

namespace foretouch::test {
namespace {

constexpr int kInstants = 48;
/// Of the judge's distances, in double, within some ten metres (m).
constexpr double kJudgeRounding = 1e-12;
constexpr double kFar = 100.0;

/// The motion by the judge.
class JudgedMotion {
 public:
  JudgedMotion(const Avatar& avatar, const Pose& from, const Pose& to, const oracle::Scene& scene,
               const std::vector<LinkId>& left)
      : avatar_(avatar),
        motion_(plainJoints(avatar.skeleton(), from, to)),
        scene_(scene),
        left_(left) {}

  /// Of all links, at an instant; and at any within `around` of it, no less than `bound`.
  struct Least {
    double there = kFar, bound = kFar;
  };
  [[nodiscard]] Least leastAt(double t, double around = 0.0) {
    motion_.framesAt(static_cast<oracle::Real>(t), frames_);
    Least least;
    for (LinkId link = 0; link < avatar_.numLinks(); ++link) {
      if (std::find(left_.begin(), left_.end(), link) != left_.end()) continue;
      for (const Lss& lss : avatar_.lss(link)) {
        const double separation = separationOf(link, lss);
        const double rho = std::max(lss.a.norm(), lss.b.norm());
        const double moves = around * static_cast<double>(motion_.bounds(link).speedAt(rho));
        least.there = std::min(least.there, separation);
        least.bound = std::min(least.bound, separation - moves);
      }
    }
    return least;
  }

 private:
  [[nodiscard]] double separationOf(LinkId link, const Lss& lss) const {
    const auto placed = [&](const Eigen::Vector3d& p) {
      const auto at = frames_[static_cast<std::size_t>(link)].at(plain(p).as<oracle::Real>());
      return oracle::Vec3d(static_cast<double>(at.x), static_cast<double>(at.y),
                           static_cast<double>(at.z));
    };
    return oracle::distanceTo(scene_, placed(lss.a), placed(lss.b), kFar) - lss.radius;
  }

  const Avatar& avatar_;
  oracle::Motion motion_;
  const oracle::Scene& scene_;
  const std::vector<LinkId>& left_;
  std::vector<oracle::MovingFrame<oracle::Real>> frames_;
};

/// Between two poses of one body, a part of the way: far and near motions, and some that rest.
Pose between(const Avatar& avatar, const RandomBody& body, double share) {
  if (share == 0.0) return body.from;
  Pose pose;
  ChainMotion(avatar.skeleton(), body.from, body.to).poseAt(share, pose);
  return validatedPose(avatar.skeleton(), pose).value();
}

struct Case {
  const RandomBody& body;
  const oracle::Scene& scene;
  const ClearanceOptions& options;
  std::vector<LinkId> left;
};

void judge(const Case& c, const Pose& from, const Pose& to, const Clearance& answer,
           ClearanceTally& tally, const std::string& name) {
  JudgedMotion motion(c.body.avatar, from, to, c.scene, c.left);
  const auto wrong = [&](const char* what, double told, double truth) {
    std::ostringstream out;
    out.precision(17);
    out << name << ": " << what << ": " << told << ", the judge has " << truth;
    tally.problems.push_back(out.str());
  };
  // Seen from the instants in between: the true least lies between these two.
  double least = kFar, bound = kFar;
  for (int k = 0; k <= kInstants; ++k) {
    const double t = static_cast<double>(k) / kInstants;
    const auto at = motion.leastAt(t, 0.5 / kInstants);
    least = std::min(least, at.there);
    bound = std::min(bound, at.bound);
  }
  tally.instants += kInstants + 1;
  if (answer.lower > std::max(0.0, least) + kJudgeRounding) {
    wrong("lower bound too high", answer.lower, least);
  }
  if (answer.upper < bound - kJudgeRounding) wrong("upper bound too low", answer.upper, bound);
  const bool isFound = answer.triangle >= 0;
  if (!isFound && !(answer.lower >= std::min(c.options.within, kFar))) {
    wrong("nothing found, but nothing proven", answer.lower, least);
  }
  if (!isFound) return;
  const double there = std::max(0.0, motion.leastAt(answer.t).there);
  if (there > answer.upper + kJudgeRounding) wrong("not so near at its time", answer.upper, there);
  if (answer.upper - answer.lower > c.options.tolerance * 1.0001) {
    wrong("bounds too far apart", answer.upper - answer.lower, c.options.tolerance);
  }
  tally.widest = std::max(tally.widest, (answer.upper - answer.lower) / c.options.tolerance);
}

}  // namespace

void ClearanceTally::add(const ClearanceTally& more) {
  asked += more.asked;
  touching += more.touching;
  farther += more.farther;
  alone += more.alone;
  instants += more.instants;
  widest = std::max(widest, more.widest);
  problems.insert(problems.end(), more.problems.begin(), more.problems.end());
}

ClearanceTally judgeClearances(std::uint64_t seed, int count,
                               const std::function<void(Clearance&)>& tamper) {
  Random random(seed);
  const Eigen::Vector3d center =
      random.chance(0.2) ? random.inBox(1000.0) : Eigen::Vector3d::Zero();
  const RawScene raw = clutter(random, 1 + random.below(12), 2, center);
  const auto scene = Scene::build(raw);
  ClearanceTally tally;
  if (!scene.ok()) return tally;
  const oracle::Scene judged(plain(tools::finiteTriangles(scene.value())));
  const RandomBody body = bodyInClutter(random, 1 + random.below(5), center);
  ClearanceOptions options;
  options.tolerance = random.magnitude(1e-7, 1e-2);
  if (random.chance(0.2)) options.within = random.uniform(0.01, 0.5);
  Case c{body, judged, options, {}};
  if (body.avatar.numLinks() > 1 && random.chance(0.2)) {
    c.left.push_back(random.below(body.avatar.numLinks()));
    options.ignored.push_back({c.left.back()});
  }
  const auto query = ClearanceQuery::build(body.avatar, scene.value(), options).value();
  Scratch scratch;
  for (int i = 0; i < count; ++i) {
    const double begin = random.uniform(0.0, 1.0), end = random.uniform(0.0, 1.0);
    const Pose from = between(body.avatar, body, begin), to = between(body.avatar, body, end);
    Clearance answer = query.answer(ChainMotion(body.avatar.skeleton(), from, to), scratch);
    if (tamper) tamper(answer);
    ++tally.asked;
    tally.touching += answer.upper == 0.0 ? 1 : 0;
    tally.farther += answer.triangle < 0 ? 1 : 0;
    tally.alone += answer.isAlone ? 1 : 0;
    judge(c, from, to, answer, tally,
          "clearance: seed " + std::to_string(seed) + ", motion " + std::to_string(i));
  }
  return tally;
}

std::string summaryOf(const ClearanceTally& tally) {
  std::ostringstream out;
  out << "clearances: " << tally.asked << " motions, " << tally.touching << " touch, "
      << tally.farther << " farther than was looked, " << tally.alone << " alone; "
      << tally.instants << " instants judged, bounds at most " << tally.widest
      << " tolerances apart, " << tally.problems.size() << " wrong\n";
  return out.str();
}

}  // namespace foretouch::test
