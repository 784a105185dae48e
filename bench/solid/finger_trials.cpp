#include "bench/solid/finger_trials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "articulated/pair_rules.h"
#include "articulated/try.h"
#include "bench/judged.h"
#include "bench/machine.h"
#include "bench/solid/figure.h"
#include "middleware/solid/solid_avatar.h"

namespace foretouch::tools {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr int kFingers = 5, kFineTable = 220;
constexpr double kApproachS = 0.5, kFromAbove = 0.15;
constexpr double kHalfApart = 0.1, kFullTurn = 6.283185307179586;

/// A finger from the wrist outwards; the thumb has one bone less.
struct Finger {
  const char* name;
  Vector3d base;  ///< From the wrist, for a right hand.
  double yaw;     ///< The first bone's, about y.
  std::array<double, 4> bones;
};
const std::array<Finger, kFingers> kHand{{
    {"Thumb", {-0.02, -0.005, -0.02}, 0.9, {0.045, 0.035, 0.028, 0.0}},
    {"Index", {-0.016, 0, -0.02}, 0.12, {0.07, 0.042, 0.026, 0.022}},
    {"Middle", {-0.003, 0, -0.02}, 0.02, {0.07, 0.045, 0.029, 0.023}},
    {"Ring", {0.009, 0, -0.02}, -0.1, {0.066, 0.042, 0.027, 0.023}},
    {"Little", {0.02, 0, -0.018}, -0.22, {0.06, 0.034, 0.02, 0.02}},
}};
constexpr std::array<double, 4> kThick{0.010, 0.009, 0.008, 0.007};
constexpr double kTip = 0.006, kPalm = 0.016;

double sideOf(std::size_t hand) {
  return hand == 0 ? 1.0 : -1.0;
}

/// How the joints of one finger bend: its first two bones by the knuckle, then each by its own.
struct Bend {
  double knuckle = 0.0, middle = 0.0, end = 0.0;
};

/// What both hands do at a time: the left one as in a mirror.
struct Gesture {
  Vector3d wrist = Vector3d::Zero();  ///< The right hand's, beside its place at rest.
  double roll = 0.0;                  ///< The palm's, about z.
  std::array<Bend, kFingers> bends;
};

/// The joints of a hand, in the avatar's order: wrist, palm, then each finger's.
Pose posed(const Skeleton& skeleton, const Gesture& gesture) {
  Pose pose = restPose(skeleton);
  std::size_t j = 0;
  for (std::size_t hand = 0; hand < 2; ++hand) {
    const double side = sideOf(hand);
    pose.translations[j] +=
        Vector3d(side * gesture.wrist.x(), gesture.wrist.y(), gesture.wrist.z());
    pose.rotations[j] = AngleAxisd(side * gesture.roll, Vector3d::UnitZ());
    j += 2;
    for (std::size_t finger = 0; finger < kFingers; ++finger) {
      const Bend& bend = gesture.bends[finger];
      const std::array<double, 3> angles{bend.knuckle, bend.middle, bend.end};
      const std::size_t bones = finger == 0 ? 3 : 4;
      for (std::size_t bone = 1; bone < bones; ++bone) {
        pose.rotations[j + bone] = AngleAxisd(-angles[bone + 3 - bones], Vector3d::UnitX());
      }
      j += bones + 1;
    }
  }
  return pose;
}

Gesture all(const Bend& bend) {
  Gesture gesture;
  gesture.bends.fill(bend);
  return gesture;
}

/// 0 to 1 and back in a period, smoothly.
double wave(double t, double period) {
  return 0.5 - 0.5 * std::cos(kFullTurn * t / period);
}

struct Task {
  const char* name;
  double seconds;
  RawScene scene;
  Gesture (*at)(double t);
  bool areHandsSolid = false;  ///< For each other.
};

/// Palms above a bar of 3 cm; the fists close through it.
Gesture grasp(double t) {
  const double closed = wave(t, 2.0);
  Gesture gesture = all({1.4 * closed, 1.5 * closed, 1.0 * closed});
  gesture.bends[0] = {0.0, 0.6 * closed, 0.8 * closed};
  gesture.wrist = {0, 0.042, 0.075};
  return gesture;
}

/// A button, by the index, which is tracked 1.5 cm in it.
Gesture press(double t) {
  Gesture gesture = all({1.3, 1.5, 0.9});
  gesture.bends[0] = {0.0, 0.3, 0.3};
  gesture.bends[1] = {0.5, 0.1, 0.1};
  gesture.wrist = {0, 0.14 - 0.05 * wave(t, 0.8), 0.11};
  return gesture;
}

/// Finger after finger on a table, 1.5 cm into it, four times per second.
Gesture drum(double t) {
  Gesture gesture;
  for (std::size_t finger = 0; finger < kFingers; ++finger) {
    const double down = wave(t + 0.05 * static_cast<double>(finger), 0.25);
    gesture.bends[finger] = {0.1 + 0.35 * down, 0.25, 0.15};
  }
  gesture.wrist = {0, 0.045, 0.05};
  return gesture;
}

/// Palms along a table's edge, half in it.
Gesture slide(double t) {
  Gesture gesture = all({0.35, 0.3, 0.2});
  gesture.wrist = {0.25 * wave(t, 2.0), 0.02, 0.06};
  return gesture;
}

/// Palm to palm, 3 cm into each other.
Gesture clap(double t) {
  Gesture gesture;
  gesture.roll = -kFullTurn / 4;
  gesture.wrist = {-0.115 * wave(t, 0.7), 0.3, 0};
  return gesture;
}

RawScene table(double height = 0.0) {
  RawScene raw;
  addSheet(raw, {-1, height, -1}, {2, 0, 0}, {0, 0, 1}, kFineTable);
  addSheet(raw, {-1, height, 0}, {2, 0, 0}, {0, -0.03, 0}, 40);
  return raw;
}

std::vector<Task> tasks() {
  RawScene bar = table(-0.075), button = table();
  addBox(bar, {-0.4, -0.015, -0.015}, {0.4, 0.015, 0.015});
  for (const double side : {-1.0, 1.0}) {
    const double x = side * (kHalfApart - 0.032);
    addBox(button, {x - 0.012, 0, -0.06}, {x + 0.012, 0.05, -0.02});
  }
  return {{"grasp a bar", 6.0, std::move(bar), grasp},
          {"press a button", 4.0, std::move(button), press},
          {"drum on a table", 4.0, table(), drum},
          {"slide along an edge", 6.0, table(), slide},
          {"clap", 4.0, table(), clap, true}};
}

Result<SolidOptions> optionsFor(const Task& task, const Avatar& avatar, SolidOptions options) {
  if (!task.areHandsSolid) return options;
  std::vector<LinkPair> between;
  const LinkId half = avatar.numLinks() / 2;
  for (LinkId right = 0; right < half; ++right) {
    for (LinkId left = half; left < avatar.numLinks(); ++left) {
      if (!avatar.lss(right).empty() && !avatar.lss(left).empty()) between.push_back({right, left});
    }
  }
  FORETOUCH_TRY(options.self, PairRules::asking(avatar, between));
  return options;
}

void look(const SolidTick& tick, double us, FingerTally& tally) {
  ++tally.ticks;
  tally.queries += tick.counters.queries;
  tally.offM.push_back(tick.deviation);
  if (tick.state == SolidState::Equal) {
    ++tally.equal;
  } else {
    tally.contactUs.push_back(us);
  }
}

/// The gesture; its first half second leads from above, where nothing is.
Gesture approaching(const Task& task, double t) {
  Gesture gesture = task.at(std::max(0.0, t - kApproachS));
  gesture.wrist.y() += kFromAbove * std::max(0.0, 1.0 - t / kApproachS);
  return gesture;
}

Result<FingerTally> tryTask(Task task, const SolidOptions& options) {
  const Avatar avatar = handPair();
  FORETOUCH_TRY(const auto asked, optionsFor(task, avatar, options));
  const oracle::Scene judged(plain(task.scene.triangles));
  FingerTally tally;
  tally.task = task.name;
  tally.links = static_cast<std::size_t>(avatar.numLinks());
  tally.triangles = task.scene.triangles.size();
  FORETOUCH_TRY(const auto scene, Scene::build(std::move(task.scene)));
  FORETOUCH_TRY(auto solid, SolidAvatar::build(avatar, scene, asked));
  WayAudit audit(judged, avatar,
                 asked.self ? askedPairs(avatar, *asked.self) : std::vector<std::array<int, 2>>());
  audit.begin(task.name);
  SolidTick tick;
  const int ticks = static_cast<int>(std::lround(task.seconds * kTrialRateHz));
  for (int i = 0; i < ticks; ++i) {
    const Pose tracked = posed(avatar.skeleton(), approaching(task, i / kTrialRateHz));
    const ThreadStopwatch watch;
    FORETOUCH_CHECK(solid.follow({tracked, 1.0 / kTrialRateHz, nullptr}, tick));
    look(tick, watch.us(), tally);
    audit.look(tick);
  }
  tally.way = audit.tally();
  return tally;
}

}  // namespace

Avatar handPair() {
  RawSkeleton raw;
  std::vector<std::vector<Lss>> lss;
  const auto link = [&](const std::string& name, JointId parent, const Vector3d& offset,
                        const Quaternion& turn, std::vector<Lss> of) {
    raw.joints.push_back({name, parent, offset, turn});
    lss.push_back(std::move(of));
    return static_cast<JointId>(raw.joints.size()) - 1;
  };
  const Quaternion straight = Quaternion::Identity();
  for (std::size_t hand = 0; hand < 2; ++hand) {
    const double side = sideOf(hand);
    const std::string of = hand == 0 ? "Right" : "Left";
    const JointId wrist =
        link(of + "HandWrist", kNoParent, {side * kHalfApart, 0, 0}, straight, {});
    link(of + "HandPalm", wrist, {0, 0, -0.045}, straight,
         {{{-0.02 * side, 0, 0.02}, {0.02 * side, 0, 0.02}, kPalm}});
    for (std::size_t finger = 0; finger < kFingers; ++finger) {
      const Finger& one = kHand[finger];
      const std::size_t bones = finger == 0 ? 3 : 4;
      JointId parent = wrist;
      Vector3d offset(side * one.base.x(), one.base.y(), one.base.z());
      Quaternion turn(AngleAxisd(side * one.yaw, Vector3d::UnitY()));
      for (std::size_t bone = 0; bone < bones; ++bone) {
        const double length = one.bones[bone];
        const double radius = kThick[bone + 4 - bones];
        parent = link(of + "Hand" + one.name + std::to_string(bone), parent, offset, turn,
                      {{{0, 0, 0}, {0, 0, -length}, radius}});
        offset = {0, 0, -length};
        turn = straight;
      }
      link(of + "Hand" + one.name + "Tip", parent, offset, straight,
           {{{0, 0, 0}, {0, 0, 0}, kTip}});
    }
  }
  return Avatar::build(Skeleton::build(raw).value(), lss).value();
}

Result<std::vector<FingerTally>> tryFingers(const SolidOptions& options) {
  std::vector<FingerTally> tallies;
  for (Task& task : tasks()) {
    FORETOUCH_TRY(auto tally, tryTask(std::move(task), options));
    tallies.push_back(std::move(tally));
  }
  return tallies;
}

}  // namespace foretouch::tools
