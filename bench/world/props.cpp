#include "bench/world/props.h"

#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "bench/world/timed_world.h"
#include "lss/index.h"
#include "tools/portable_random.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

constexpr double kFullTurn = 6.283185307179586;
constexpr int kAround = 100, kAcross = 50;                             // 10,000 triangles
constexpr int kThrows = 12, kWarmThrows = 3;                           // per clip
constexpr double kThrowSeconds = 0.6, kThrowSpeed = 3.0, kSpin = 6.0;  // m/s, rad/s

/// A torus about z.
Scene torus(double radius, double thickness) {
  const auto at = [&](int i, int j) {
    const double u = kFullTurn * i / kAround, v = kFullTurn * j / kAcross;
    const double out = radius + thickness * std::cos(v);
    return Vector3d(out * std::cos(u), out * std::sin(u), thickness * std::sin(v));
  };
  RawScene raw;
  raw.objectNames = {"ring"};
  for (int i = 0; i < kAround; ++i) {
    for (int j = 0; j < kAcross; ++j) {
      raw.triangles.push_back({{at(i, j), at(i + 1, j), at(i + 1, j + 1)}});
      raw.triangles.push_back({{at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
    }
  }
  raw.objectOf.assign(raw.triangles.size(), 0);
  return Scene::build(std::move(raw)).value();
}

/// Where the prop is.
using PropAt = std::function<foretouch::RigidPose(double s)>;

/// One stretch of a person and the prop; its windows count from the second one on.
struct Stretch {
  Person person;
  double rateHz = 30.0, seconds = kThrowSeconds;
  PropAt at;            ///< Not for a prop that is held.
  bool isHeld = false;  ///< In the right hand, or in the last link.
  bool hasProp = true;
};

/// A person and, with it, the prop, again and again in one world, so that what is made once for the
/// two is there. Long gaps lie between two stretches, and nothing is asked about them.
class PropStage {
 public:
  PropStage(const Stretch& first, const Scene& prop)
      : body_(world_.add(first.person, false)),
        thing_(first.hasProp ? world_.world().add(prop).value() : -1) {}

  void run(const Stretch& stretch, bool isCounted, WindowFigures& figures) {
    constexpr std::int64_t kGapUs = 10'000'000;
    const auto periodUs = static_cast<std::int64_t>(std::llround(1e6 / stretch.rateHz));
    const int windows = static_cast<int>(std::lround(stretch.seconds * stretch.rateHz));
    world_.figures = std::move(figures);
    beginUs_ += kGapUs;
    for (int k = 0; k <= windows; ++k) {
      const std::int64_t us = beginUs_ + periodUs * k;
      world_.push(body_, us, stretch.person.pose(k));
      if (stretch.hasProp) move(stretch, us);
      if (k > 0) world_.ask(us - periodUs, us, isCounted && k > 1);
    }
    beginUs_ += periodUs * windows;
    figures = std::move(world_.figures);
  }

 private:
  void move(const Stretch& stretch, std::int64_t us) {
    if (!stretch.isHeld) {
      const foretouch::RigidPose pose = stretch.at(1e-6 * static_cast<double>(us - beginUs_));
      world_.push(thing_, us, Pose{{pose.rotation}, {pose.translation}});
      return;
    }
    if (std::exchange(isTaken_, true)) return;
    const Skeleton& skeleton = stretch.person.clip->actor->avatar.skeleton();
    const auto hand = skeleton.find("RightHand");
    const Carrier holding{body_, hand ? *hand : skeleton.numJoints() - 1, false};
    const foretouch::RigidPose grip{Quaternion::Identity(), Vector3d(0.0, 0.15, 0.0)};
    static_cast<void>(world_.world().attach(thing_, holding, us, grip).value());
  }

  TimedWorld world_;
  BodyId body_, thing_;
  std::int64_t beginUs_ = 0;
  bool isTaken_ = false;
};

struct PropFigures {
  WindowFigures with, without;
};

PropFigures figuresOf(const std::vector<ClipPoses>& clips, double rateHz, const Scene& prop,
                      const std::function<void(int, Stretch&)>& prepare) {
  PropFigures figures;
  for (const ClipPoses& clip : clips) {
    Stretch stretch;
    stretch.person.clip = &clip;
    stretch.rateHz = rateHz;
    PropStage with(stretch, prop);
    stretch.hasProp = false;
    PropStage without(stretch, prop);
    for (int i = 0; i < kThrows; ++i) {
      stretch.person.phase = static_cast<std::size_t>(7 * i) % (2 * clip.poses.size() - 2);
      prepare(i, stretch);
      const bool isCounted = i >= kWarmThrows;
      stretch.hasProp = true;
      with.run(stretch, isCounted, figures.with);
      stretch.hasProp = false;
      without.run(stretch, isCounted, figures.without);
    }
  }
  return figures;
}

/// Throws the prop from one side through the chest to the other, turning.
void throwIt(int number, Stretch& stretch) {
  PortableRandom random(static_cast<std::uint64_t>(number));
  const double turn = random.uniform(0.0, 6.28), high = random.uniform(0.8, 1.4);
  const Vector3d along(std::cos(turn), 0.0, std::sin(turn));
  const Vector3d axis = random.inBox(1.0).normalized();
  stretch.at = [=](double s) -> foretouch::RigidPose {
    return {Quaternion(Eigen::AngleAxisd(kSpin * s, axis)),
            Vector3d(0.0, high, 0.0) + (kThrowSpeed * (s - 0.5 * kThrowSeconds)) * along};
  };
}

void putFarOff(int, Stretch& stretch) {
  stretch.at = [](double) -> foretouch::RigidPose {
    return {Quaternion::Identity(), Vector3d(3.0, 1.0, 0.0)};
  };
}

void hold(int, Stretch& stretch) {
  stretch.isHeld = true;
}

}  // namespace

BenchTable propTable(const Cast& cast) {
  BenchTable table{"prop",
                   "A person and a ring of 10,000 triangles; per window, beside the person alone",
                   {{"prop", "prop"},
                    {"rate_hz", "Hz", 0},
                    {"windows", "windows", 0},
                    {"with_us", "with us", 2},
                    {"alone_us", "alone us", 2},
                    {"prop_us", "prop us", 2},
                    {"with_p99_us", "with p99", 1},
                    {"contacts", "contacts", 2},
                    {"starts", "go on", 2},
                    {"leaves", "leaves", 0},
                    {"part_steps", "pairs in lanes", 0},
                    {"advancements", "advancements", 0}},
                   {}};
  const Scene wide = torus(0.25, 0.02), small = torus(0.1, 0.015);
  struct Case {
    const char* name;
    double rateHz;
    const Scene& prop;
    void (*prepare)(int, Stretch&);
  };
  for (const Case& one :
       {Case{"far", 30.0, wide, putFarOff}, Case{"thrown, spinning", 30.0, wide, throwIt},
        Case{"thrown, spinning", 5.0, wide, throwIt}, Case{"held", 30.0, small, hold}}) {
    const auto clips = clipPosesOf(cast, one.rateHz);
    const PropFigures figures = figuresOf(clips, one.rateHz, one.prop, one.prepare);
    const Percentiles with = percentilesOf(figures.with.answerUs),
                      alone = percentilesOf(figures.without.answerUs);
    const WindowFigures& own = figures.with;
    table.rows.push_back(
        {std::string(one.name), one.rateHz, static_cast<std::int64_t>(own.windows()), with.mean,
         alone.mean, with.mean - alone.mean, with.p99, own.perWindow(own.contacts),
         own.perWindow(own.starts), own.perWindow(own.sum.queries.leaves),
         own.perWindow(own.sum.queries.partSteps), own.perWindow(own.sum.queries.advancements)});
  }
  return table;
}

}  // namespace foretouch::tools
