// Tests tools/world/world_maker.h: where bodies are depends on what a world file says, not on the
// order of its tables. Random worlds, in which who carries whom changes for many at one instant,
// are held against places that are composed here by hand, and against themselves in another order.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/support/holds.h"
#include "tests/tools/world/small_stage.h"
#include "tools/world/followed_world.h"
#include "tools/world/world_maker.h"

namespace foretouch::test {
namespace {

using tools::BodyPlaces;
using tools::LoadedWorld;

constexpr int kBodies = 6, kSegments = 4;
constexpr double kSegmentS = 0.5;

/// A place as a file says it.
struct Place {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double yawDeg = 0.0;

  [[nodiscard]] Eigen::Isometry3d frame() const {
    constexpr double kRadPerDeg = 3.14159265358979323846 / 180.0;
    return Eigen::Translation3d(position) *
           Eigen::AngleAxisd(yawDeg * kRadPerDeg, Eigen::Vector3d::UnitY());
  }
  [[nodiscard]] std::string keys() const {
    return fmt("position = [%.17g, %.17g, %.17g]\n", position.x(), position.y(), position.z()) +
           fmt("yaw = %.17g\n", yawDeg);
  }
  template <typename... Numbers>
  static std::string fmt(const char* format, Numbers... numbers) {
    char text[160];
    std::snprintf(text, sizeof text, format, numbers...);
    return text;
  }
};

/// How a segment of half a second begins: as the one before ends; as the change of carrier says; by
/// a pose of that very instant; where the body was.
enum class Begin { GoesOn, Said, Posed, Stays };

struct Segment {
  int carrier = -1;  // nobody
  bool moves = false;
  Begin begin = Begin::GoesOn;
  Place first, middle, last;  // in the carrier's frame, where they are told
};

struct Actor {
  bool stands = false, isTrigger = false;
  Place place;  // of who stands
  std::array<Segment, kSegments> segments;

  [[nodiscard]] bool isHeld(int segment) const {
    const Segment& now = segments[static_cast<std::size_t>(segment)];
    return now.carrier >= 0 && !now.moves;
  }
};

class Drawn {
 public:
  /// `areRolesKept`: nobody ever carries who carries him at another time.
  Drawn(unsigned seed, bool areRolesKept) : random_(seed) {
    for (Actor& actor : actors_) {
      actor.stands = chance(0.4);
      actor.place = place();
    }
    actors_.back().isTrigger = true;
    std::vector<int> rank(kBodies);
    std::iota(rank.begin(), rank.end(), 0);
    for (int i = 0; i < kSegments; ++i) {
      if (i == 0 || !areRolesKept) std::shuffle(rank.begin(), rank.end(), random_);
      drawSegment(i, rank);
    }
  }

  [[nodiscard]] static std::string nameOf(int body) { return std::string(1, "feacdb"[body]); }

  /// The tables in this order.
  [[nodiscard]] std::string text(const std::vector<int>& order) const {
    std::string all;
    for (const int body : order) all += tableOf(body);
    return all;
  }

  /// In W, at a quarter of a second: after the changes of that instant. This file's own
  /// composition.
  [[nodiscard]] Eigen::Isometry3d frameAt(int body, int quarter) const {
    const int segment = std::min(quarter / 2, kSegments - 1);
    return worldFrame(body, segment, quarter - 2 * segment);
  }

  [[nodiscard]] int sameInstantChains() const {
    int found = 0;
    for (const Actor& actor : actors_) {
      for (int i = 0; i < kSegments; ++i) {
        const Segment& now = actor.segments[static_cast<std::size_t>(i)];
        if (now.begin == Begin::GoesOn || now.carrier < 0) continue;
        found += at(now.carrier, i).begin != Begin::GoesOn ? 1 : 0;
      }
    }
    return found;
  }

 private:
  [[nodiscard]] bool chance(double p) {
    return std::uniform_real_distribution<double>(0.0, 1.0)(random_) < p;
  }
  [[nodiscard]] Place place() {
    std::uniform_real_distribution<double> metres(-0.7, 0.7), degrees(-170.0, 170.0);
    return {{metres(random_), metres(random_), metres(random_)}, degrees(random_)};
  }
  [[nodiscard]] const Segment& at(int body, int segment) const {
    return actors_[static_cast<std::size_t>(body)].segments[static_cast<std::size_t>(segment)];
  }

  /// Whoever carries comes earlier in the rank: so there are no circles.
  void drawSegment(int i, const std::vector<int>& rank) {
    for (int place = 0; place < kBodies; ++place) {
      Actor& actor = actors_[static_cast<std::size_t>(rank[static_cast<std::size_t>(place)])];
      Segment& now = actor.segments[static_cast<std::size_t>(i)];
      if (place > 0 && chance(0.6)) {
        now.carrier = rank[static_cast<std::size_t>(
            std::uniform_int_distribution<int>(0, place - 1)(random_))];
      }
      now.moves = now.carrier >= 0 && chance(0.3);
      now.first = this->place();
      now.middle = this->place();
      now.last = this->place();
      drawBegin(actor, i, now);
    }
  }

  void drawBegin(const Actor& actor, int i, Segment& now) {
    const Segment* const before =
        i > 0 ? &actor.segments[static_cast<std::size_t>(i) - 1] : nullptr;
    if (before != nullptr && before->carrier == now.carrier) {
      now.moves = before->moves;
      return;
    }
    if (before == nullptr && now.carrier < 0) return;
    // A pose of the instant is in the frame before it, but of who was held, or not there.
    const bool mayBePosed = !actor.stands && (before == nullptr || actor.isHeld(i - 1));
    const bool mayStay = actor.stands || before != nullptr;
    now.begin = mayStay && chance(0.5) ? Begin::Stays : Begin::Said;
    if (mayBePosed && chance(0.3)) now.begin = Begin::Posed;
  }

  [[nodiscard]] std::string tableOf(int body) const {
    const Actor& actor = actors_[static_cast<std::size_t>(body)];
    std::string all = actor.isTrigger ? "[[trigger]]\n" : "[[body]]\n", poses;
    const std::string table = actor.isTrigger ? "[[trigger." : "[[body.";
    all += "name = \"" + nameOf(body) + "\"\nsphere = 0.2\n";
    if (actor.stands) all += actor.place.keys();
    const auto pose = [&](double timeS, const Place& where) {
      poses += table + "pose]]\n" + Place::fmt("time = %.3f\n", timeS) + where.keys();
    };
    if (!actor.stands && at(body, 0).begin == Begin::GoesOn) pose(0.0, actor.place);
    for (int i = 0; i < kSegments; ++i) {
      const Segment& now = at(body, i);
      const double timeS = kSegmentS * i;
      if (now.begin != Begin::GoesOn) {
        all += table + (now.carrier >= 0 ? "attach]]\n" : "detach]]\n") +
               Place::fmt("time = %.3f\n", timeS);
        if (now.carrier >= 0) all += "to = \"" + nameOf(now.carrier) + "\"\n";
        if (now.moves) all += "moves = true\n";
        if (now.begin == Begin::Said) all += now.first.keys();
        if (now.begin == Begin::Posed) pose(timeS, now.first);
      }
      if (actor.stands || actor.isHeld(i)) continue;
      pose(timeS + 0.5 * kSegmentS, now.middle);
      pose(timeS + kSegmentS, now.last);
    }
    return all + poses;
  }

  /// `part`: 0, 1 or 2: where the segment begins, in its middle, where it ends.
  [[nodiscard]] Eigen::Isometry3d ownFrame(int body, int i, int part) const {
    const Actor& actor = actors_[static_cast<std::size_t>(body)];
    const Segment& now = at(body, i);
    const bool isTold = !actor.stands && !actor.isHeld(i);
    if (isTold && part > 0) return (part == 1 ? now.middle : now.last).frame();
    if (now.begin == Begin::Said || now.begin == Begin::Posed) return now.first.frame();
    const auto before = [&] { return i == 0 ? actor.place.frame() : worldFrame(body, i - 1, 2); };
    if (now.begin == Begin::GoesOn) {
      return i == 0 ? actor.place.frame() : ownFrame(body, i - 1, 2);
    }
    return now.carrier < 0 ? before() : worldFrame(now.carrier, i, 0).inverse() * before();
  }
  [[nodiscard]] Eigen::Isometry3d worldFrame(int body, int i, int part) const {
    const int carrier = at(body, i).carrier;
    const Eigen::Isometry3d own = ownFrame(body, i, part);
    return carrier < 0 ? own : worldFrame(carrier, i, part) * own;
  }

  std::mt19937 random_;
  std::array<Actor, kBodies> actors_;
};

BodyId numberOf(const LoadedWorld& world, const std::string& name) {
  BodyId body = 0;
  while (world.nameOf(body) != name) ++body;
  return body;
}

/// What a replay tells, by names.
std::map<std::string, double> toldOf(const SmallStage& stage, LoadedWorld& world, bool isFollowed) {
  std::map<std::string, double> told;
  std::map<std::string, int> counts;
  const auto pair = [&](BodyId a, BodyId b) {
    return std::min(world.nameOf(a), world.nameOf(b)) + std::max(world.nameOf(a), world.nameOf(b));
  };
  const auto tell = [&](const std::string& what, const WorldTime& time) {
    told[what + " " + std::to_string(counts[what]++)] = secondsOf(time);
  };
  for (const WorldContact& contact : stage.contactsOf(world)) {
    tell(pair(contact.a.body, contact.b.body) + " " + toString(contact.verdict), contact.time);
  }
  if (!isFollowed) return told;
  const auto followed =
      tools::followWorld(world, world.beginUs, world.endUs, [&](const auto& stretch) {
        for (const WorldEvent& event : stretch.contacts.events) {
          tell(pair(event.a.body, event.b.body) + " " + toString(event.kind), event.time);
        }
        return true;
      });
  EXPECT_TRUE(followed.ok()) << describe(followed.error());
  return told;
}

TEST(TableOrder, DoesNotCountAndBodiesAreWhereTheFileSays) {
  const SmallStage stage;
  int chains = 0;
  std::size_t told = 0;
  constexpr unsigned kWorlds = 200;
  for (unsigned seed = 0; seed < kWorlds; ++seed) {
    const bool areRolesKept = seed % 2 == 0;
    const Drawn drawn(seed, areRolesKept);
    chains += drawn.sameInstantChains();
    std::vector<int> order{0, 1, 2, 3, 4, 5};
    auto world = stage.load(drawn.text(order));
    ASSERT_TRUE(world.ok()) << seed << describe(world.error());
    std::mt19937 random(seed);
    std::shuffle(order.begin(), order.end(), random);
    auto other = stage.load(drawn.text(order));
    ASSERT_TRUE(other.ok()) << seed << describe(other.error());
    EXPECT_EQ(world.value().beginUs, other.value().beginUs);
    EXPECT_EQ(world.value().endUs, other.value().endUs);
    const auto stretches = world.value().stretches(), otherStretches = other.value().stretches();
    const BodyPlaces places(stretches), otherPlaces(otherStretches);
    for (int body = 0; body < kBodies; ++body) {
      const BodyId here = numberOf(world.value(), Drawn::nameOf(body));
      const BodyId there = numberOf(other.value(), Drawn::nameOf(body));
      for (int quarter = 0; quarter <= 2 * kSegments; ++quarter) {
        SCOPED_TRACE(std::to_string(seed) + Drawn::nameOf(body) + std::to_string(quarter));
        const RigidPose found = places.linkAt(here, 0, quarter * 250'000);
        const RigidPose again = otherPlaces.linkAt(there, 0, quarter * 250'000);
        EXPECT_EQ(found.translation, again.translation);
        EXPECT_EQ(found.rotation.coeffs(), again.rotation.coeffs());
        const Eigen::Isometry3d right = drawn.frameAt(body, quarter);
        EXPECT_LT((found.translation - right.translation()).norm(), 1e-9);
        EXPECT_LT((found.rotation.toRotationMatrix() - right.linear()).norm(), 1e-9);
      }
    }
    const auto ofWorld = toldOf(stage, world.value(), areRolesKept);
    const auto ofOther = toldOf(stage, other.value(), areRolesKept);
    told += ofWorld.size();
    ASSERT_EQ(ofWorld.size(), ofOther.size()) << seed;
    for (const auto& [what, timeS] : ofWorld) {
      ASSERT_EQ(ofOther.count(what), 1U) << seed << what;
      EXPECT_NEAR(timeS, ofOther.at(what), 1e-9) << seed << what;
    }
  }
  EXPECT_GT(chains, 2 * static_cast<int>(kWorlds));
  EXPECT_GT(told, std::size_t{8} * kWorlds);
}

}  // namespace
}  // namespace foretouch::test
