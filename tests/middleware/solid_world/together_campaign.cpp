#include "tests/middleware/solid_world/together_campaign.h"

#include <cmath>
#include <memory>
#include <sstream>
#include <utility>

#include <gtest/gtest.h>

#include "bench/solid/figure.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

RawScene randomRoom(Random& random) {
  RawScene room;
  tools::addSheet(room, {-6, -0.1, -6}, {12, 0, 0}, {0, 0, 12});
  if (random.chance(0.6)) tools::addSheet(room, {-3, -0.1, -1.0}, {6, 0, 0}, {0, 3, 0});
  if (random.chance(0.4)) tools::addSheet(room, {-1.2, -0.1, -3}, {0, 0, 6}, {0, 3, 0});
  if (random.chance(0.3)) tools::addSheet(room, {-3, 2.1, -3}, {6, 0, 0}, {0, 0, 6});
  const int boxes = random.below(4);
  for (int i = 0; i < boxes; ++i) {
    const Vector3d low(random.uniform(-1.5, 1.5), 0.0, random.uniform(-1.5, 1.5));
    tools::addBox(room, low, low + Vector3d(0.3, random.uniform(0.3, 1.2), 0.3));
  }
  return room;
}

Avatar ofOneLss(const Lss& lss) {
  RawSkeleton raw;
  raw.joints = {{"body", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
  return Avatar::build(Skeleton::build(raw).value(), {{lss}}).value();
}

Scene boxOf(const Vector3d& low, const Vector3d& high) {
  RawScene raw;
  tools::addBox(raw, low, high);
  return Scene::build(raw).value();
}

/// What moves by itself: a place as a function of time.
struct Actor {
  enum class Kind { Door, Lift, Ball, Rod, Press } kind = Kind::Ball;
  BodyId body = 0;
  Vector3d middle, way;
  double rate = 1.0, phase = 0.0, turn = 0.0;
  Vector3d axis = Vector3d::UnitY();

  [[nodiscard]] Pose at(double s) const {
    const double wave = std::sin(2.0 * kPi * rate * s + phase);
    // A triangle wave: a ball comes straight and fast.
    const double line = 2.0 / kPi * std::asin(wave);
    const bool isStraight = kind == Kind::Ball || kind == Kind::Press;
    const double angle = kind == Kind::Rod ? turn * s : turn * wave;
    const Vector3d place = middle + (isStraight ? line : wave) * way;
    return {{Quaternion(Eigen::AngleAxisd(angle, axis))}, {place}};
  }
};

Actor randomActor(Random& random, TogetherRunner& run) {
  Actor actor;
  actor.kind = static_cast<Actor::Kind>(random.below(5));
  actor.middle = Vector3d(random.uniform(-0.8, 0.8), 0.0, random.uniform(-0.8, 0.8));
  actor.phase = random.uniform(0.0, 2.0 * kPi);
  actor.way = Vector3d::Zero();
  switch (actor.kind) {
    case Actor::Kind::Door:
      actor.body = run.addMover(boxOf({0, -0.05, -0.02}, {0.8, 2.0, 0.02}));
      actor.turn = random.uniform(0.5, 1.6);
      actor.rate = random.uniform(0.1, 0.8);
      break;
    case Actor::Kind::Lift:
      actor.body = run.addMover(boxOf({-0.6, -0.08, -0.6}, {0.6, 0.0, 0.6}));
      actor.way = Vector3d(0, random.uniform(0.1, 0.8), 0);
      actor.rate = random.uniform(0.05, 0.4);
      break;
    case Actor::Kind::Ball: {
      actor.body = run.addMover(ofOneLss({{0, 0, 0}, {0, 0, 0}, random.uniform(0.03, 0.15)}));
      actor.middle.y() = random.uniform(0.2, 1.6);
      actor.way = random.uniform(1.0, 3.0) * Vector3d(random.direction());
      actor.rate = random.uniform(0.1, 1.2);
      break;
    }
    case Actor::Kind::Rod:
      actor.body = run.addMover(ofOneLss({{-0.4, 0, 0}, {0.4, 0, 0}, 0.03}));
      actor.middle.y() = random.uniform(0.3, 1.6);
      actor.turn = random.uniform(0.5, 8.0);
      actor.axis = random.direction();
      actor.way = 0.5 * Vector3d(random.direction());
      actor.rate = random.uniform(0.1, 0.5);
      break;
    case Actor::Kind::Press:
      actor.body = run.addMover(boxOf({-1.0, 0.0, -0.03}, {1.0, 1.8, 0.03}));
      actor.way = Vector3d(0, 0, random.uniform(0.3, 1.5));
      actor.rate = random.uniform(0.05, 0.3);
      break;
  }
  return actor;
}

/// Where one tracker says that its user is.
class Tracked {
 public:
  Tracked(std::uint64_t seed, const Vector3d& at)
      : random_(seed), rest_(restPose(tools::figure().skeleton())), at_(at) {
    from_ = next_ = calm();
    isTracked_.assign(rest_.rotations.size(), 1);
  }

  Pose step(double dtS) {
    std::fill(isTracked_.begin(), isTracked_.end(), std::uint8_t{1});
    share_ += dtS / kOfTarget;
    if (share_ >= 1.0) {
      share_ = 0.0;
      from_ = next_;
      isHostile_ = random_.chance(0.25);
      isStill_ = random_.chance(0.2);
      if (!isStill_) at_ = Vector3d(random_.uniform(-1.2, 1.2), 0, random_.uniform(-1.2, 1.2));
      next_ = isStill_ ? from_ : calm();
    }
    Pose pose = next_;
    for (std::size_t j = 0; j < pose.rotations.size(); ++j) {
      pose.rotations[j] = from_.rotations[j].slerp(share_, next_.rotations[j]).normalized();
      pose.translations[j] =
          (1.0 - share_) * from_.translations[j] + share_ * next_.translations[j];
    }
    if (isHostile_) spoil(pose);
    return pose;
  }
  [[nodiscard]] const std::vector<std::uint8_t>& isTracked() const { return isTracked_; }

 private:
  static constexpr double kOfTarget = 0.7;

  Pose calm() {
    Pose pose = rest_;
    const double most = random_.chance(0.3) ? 1.5 : 0.5;
    for (Quaternion& q : pose.rotations) q = random_.turn(random_.uniform(0.0, most));
    pose.rotations[0] =
        Quaternion(Eigen::AngleAxisd(random_.uniform(-kPi, kPi), Vector3d::UnitY()));
    pose.translations[0] += at_;
    return pose;
  }

  void spoil(Pose& pose) {
    const auto joint =
        static_cast<std::size_t>(random_.below(static_cast<int>(rest_.rotations.size())));
    switch (random_.below(8)) {
      case 0: pose.translations[0] += random_.magnitude(0.1, 50.0) * random_.direction(); break;
      case 1: pose.rotations[0] = pose.rotations[0] * random_.turn(kPi); break;
      case 2:
        isTracked_[joint] = 0;
        pose.rotations[joint] = random_.rotation();
        break;
      default:
        for (Quaternion& q : pose.rotations) q = q * random_.turn(random_.magnitude(1e-6, 0.05));
    }
    for (Quaternion& q : pose.rotations) q.normalize();
  }

  Random random_;
  Pose rest_, from_, next_;
  Vector3d at_;
  std::vector<std::uint8_t> isTracked_;
  double share_ = 0.0;
  bool isHostile_ = false, isStill_ = false;
};

/// A stick or a small box that hands take and let go of.
struct Tool {
  BodyId body = 0;
  bool isHeld = false;
};

}  // namespace

std::string summaryOf(const TogetherTally& t) {
  std::ostringstream text;
  text << t.ticks << " frames (" << t.moved << " moved, " << t.equal << " equal, " << t.pushed
       << " in contact with what moves, " << t.crushed << " crushed, " << t.placing << " placing), "
       << t.instants << " instants, " << t.inside << " inside, " << t.broken << " broken, "
       << t.overclaimed << " clearances too high, " << t.uncertified << " without a word, least "
       << t.least << " m";
  return text.str();
}

TogetherTally judgeTogether(const TogetherCampaign& campaign) {
  Random random(campaign.seed);
  TogetherRunner run(randomRoom(random), campaign.instants);
  run.tamper = campaign.tamper;
  struct Person {
    BodyId body;
    Tracked tracked;
  };
  std::vector<Person> people;
  const int numPeople = 1 + random.below(3);
  for (int i = 0; i < numPeople; ++i) {
    SolidOptions options;
    options.skin = random.chance(0.5) ? 2e-3 : 1e-3;
    options.tolerance = options.skin / 4;
    const Vector3d at(random.uniform(-1.2, 1.2), 0, random.uniform(-1.2, 1.2));
    people.push_back({run.addSolid(tools::figure(), options), Tracked(random.below(1 << 30), at)});
  }
  std::vector<Actor> actors;
  const int numActors = 1 + random.below(4);
  for (int i = 0; i < numActors; ++i) actors.push_back(randomActor(random, run));
  std::vector<Tool> held;
  if (random.chance(0.6)) {
    const bool isMesh = random.chance(0.5);
    held.push_back({isMesh ? run.addMover(boxOf({0, -0.05, -0.05}, {0.3, 0.05, 0.05}))
                           : run.addMover(ofOneLss({{0, 0, 0}, {0.5, 0, 0}, 0.02})),
                    false});
    run.moveTo(held[0].body, RigidPose{Quaternion::Identity(), {3, 1, 3}});
  }
  const auto dtUs = static_cast<std::int64_t>(1e6 / campaign.rateHz);
  const double dtS = 1e-6 * static_cast<double>(dtUs);
  const auto hand = static_cast<LinkId>(*tools::figure().skeleton().find("RightHand"));
  for (int i = 0; i < campaign.ticks && !testing::Test::HasFatalFailure(); ++i) {
    const double s = i * dtS;
    for (const Actor& actor : actors) {
      if (i == 0) run.moveTo(actor.body, actor.at(0.0));
      if (i > 0 && random.chance(0.3)) {
        // A clock of its own.
        const std::int64_t viaUs = 1 + random.below(static_cast<int>(dtUs) - 1);
        run.goVia(actor.body, viaUs, actor.at(s - dtS + 1e-6 * static_cast<double>(viaUs)));
      }
      run.moveTo(actor.body, actor.at(s));
    }
    for (Person& person : people) {
      const Pose target = person.tracked.step(dtS);
      run.follow(person.body, target, person.tracked.isTracked());
    }
    if (!held.empty() && i > 5 && random.chance(0.02)) {
      Tool& tool = held[0];
      const BodyId holder = people[0].body;
      if (tool.isHeld) {
        run.letGo(tool.body);
        tool.isHeld = false;
      } else if (run.of(holder).tick.state != SolidState::Placing) {
        run.take(tool.body, holder, hand, {random.turn(0.5), {-0.1, 0, 0}});
        tool.isHeld = true;
      }
    }
    run.tick(dtUs);
  }
  for (std::string& finding : run.tally.findings) {
    finding = "seed " + std::to_string(campaign.seed) + " at " + std::to_string(campaign.rateHz) +
              " Hz: " + finding;
  }
  return run.tally;
}

}  // namespace foretouch::test
