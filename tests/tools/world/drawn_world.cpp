#include "tests/tools/world/drawn_world.h"

#include <algorithm>
#include <cstdio>
#include <numeric>

namespace foretouch::test {
namespace {

constexpr double kSegmentS = 0.5;

template <typename... Numbers>
std::string printed(const char* format, Numbers... numbers) {
  char text[160];
  std::snprintf(text, sizeof text, format, numbers...);
  return text;
}

}  // namespace

DrawnWorld::DrawnWorld(unsigned seed, bool areRolesKept, bool hasTrigger) : random_(seed) {
  for (Actor& actor : actors_) {
    actor.stands = chance(0.4);
    actor.place = somewhere();
  }
  actors_.back().isTrigger = hasTrigger;
  std::vector<int> rank(kBodies);
  std::iota(rank.begin(), rank.end(), 0);
  for (int i = 0; i < kSegments; ++i) {
    if (i == 0 || !areRolesKept) std::shuffle(rank.begin(), rank.end(), random_);
    drawSegment(i, rank);
  }
}

Eigen::Isometry3d DrawnWorld::Place::frame() const {
  constexpr double kRadPerDeg = 3.14159265358979323846 / 180.0;
  return Eigen::Translation3d(position) *
         Eigen::AngleAxisd(yawDeg * kRadPerDeg, Eigen::Vector3d::UnitY());
}

std::string DrawnWorld::Place::keys() const {
  return printed("position = [%.17g, %.17g, %.17g]\n", position.x(), position.y(), position.z()) +
         printed("yaw = %.17g\n", yawDeg);
}

bool DrawnWorld::chance(double p) {
  return std::uniform_real_distribution<double>(0.0, 1.0)(random_) < p;
}

DrawnWorld::Place DrawnWorld::somewhere() {
  std::uniform_real_distribution<double> metres(-0.7, 0.7), degrees(-170.0, 170.0);
  return {{metres(random_), metres(random_), metres(random_)}, degrees(random_)};
}

/// Whoever carries comes earlier in the rank: so there are no circles.
void DrawnWorld::drawSegment(int i, const std::vector<int>& rank) {
  for (int place = 0; place < kBodies; ++place) {
    Actor& actor = actors_[static_cast<std::size_t>(rank[static_cast<std::size_t>(place)])];
    Segment& now = actor.segments[static_cast<std::size_t>(i)];
    if (place > 0 && chance(0.6)) {
      now.carrier =
          rank[static_cast<std::size_t>(std::uniform_int_distribution<int>(0, place - 1)(random_))];
    }
    now.moves = now.carrier >= 0 && chance(0.3);
    now.first = somewhere();
    now.middle = somewhere();
    now.last = somewhere();
    drawBegin(actor, i, now);
  }
}

void DrawnWorld::drawBegin(const Actor& actor, int i, Segment& now) {
  const Segment* const before = i > 0 ? &actor.segments[static_cast<std::size_t>(i) - 1] : nullptr;
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

std::string DrawnWorld::text(const std::vector<int>& order) const {
  std::string all;
  for (const int body : order) all += tableOf(body);
  return all;
}

std::string DrawnWorld::tableOf(int body) const {
  const Actor& actor = actors_[static_cast<std::size_t>(body)];
  std::string all = actor.isTrigger ? "[[trigger]]\n" : "[[body]]\n", poses;
  const std::string table = actor.isTrigger ? "[[trigger." : "[[body.";
  all += "name = \"" + nameOf(body) + "\"\nsphere = 0.2\n";
  if (actor.stands) all += actor.place.keys();
  const auto pose = [&](double timeS, const Place& where) {
    poses += table + "pose]]\n" + printed("time = %.3f\n", timeS) + where.keys();
  };
  if (!actor.stands && at(body, 0).begin == Begin::GoesOn) pose(0.0, actor.place);
  for (int i = 0; i < kSegments; ++i) {
    const Segment& now = at(body, i);
    const double timeS = kSegmentS * i;
    if (now.begin != Begin::GoesOn) {
      all += table + (now.carrier >= 0 ? "attach]]\n" : "detach]]\n") +
             printed("time = %.3f\n", timeS);
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

int DrawnWorld::sameInstantChains() const {
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

Eigen::Isometry3d DrawnWorld::frameAt(int body, int quarter) const {
  const int segment = std::min(quarter / 2, kSegments - 1);
  return worldFrame(body, segment, quarter - 2 * segment);
}

Eigen::Isometry3d DrawnWorld::ownFrame(int body, int i, int part) const {
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

Eigen::Isometry3d DrawnWorld::worldFrame(int body, int i, int part) const {
  const int carrier = at(body, i).carrier;
  const Eigen::Isometry3d own = ownFrame(body, i, part);
  return carrier < 0 ? own : worldFrame(carrier, i, part) * own;
}

}  // namespace foretouch::test
