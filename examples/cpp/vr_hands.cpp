// A head and two controllers, as OpenXR tells of them: the player stands on a lift that rises,
// leans with one hand on its rail and reaches through the wall with the other. Prints what the
// hands meet and leave, and what holds them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <foretouch/foretouch.hpp>
#include <foretouch/middleware/solid_world/solid_world.h>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

using namespace foretouch;

template <typename T>
T checked(Result<T> result) {
  if (!result.ok()) {
    std::cerr << describe(result.error()) << '\n';
    std::exit(1);
  }
  return std::move(result).value();
}

/// As openxr.h has them. The axes are ours: metres, +Y up; the quaternion's order is not.
struct XrPosef {
  struct {
    float x, y, z, w;
  } orientation;
  struct {
    float x, y, z;
  } position;
};
struct Located {
  XrPosef pose;
  bool isTracked;  // XR_SPACE_LOCATION_POSITION_TRACKED_BIT, and that of the orientation
};
using XrTime = std::int64_t;  // nanoseconds

constexpr XrTime kFirst = 5'000'000'000'000, kPeriod = 11'111'111;
constexpr LinkId kLeft = 1, kRight = 2;

/// Corners of a board with its sides along the axes.
void addBoard(RawScene& raw, const char* name, const Eigen::Vector3d& low,
              const Eigen::Vector3d& high) {
  const auto corner = [&](int i) {
    return Eigen::Vector3d((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                           (i & 4) != 0 ? high.z() : low.z());
  };
  constexpr int kFaces[6][4] = {{0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2},
                                {4, 5, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
  const auto object = static_cast<ObjectId>(raw.objectNames.size());
  raw.objectNames.push_back(name);
  for (const auto& f : kFaces) {
    raw.triangles.push_back({{{corner(f[0]), corner(f[1]), corner(f[2])}}});
    raw.triangles.push_back({{{corner(f[0]), corner(f[2]), corner(f[3])}}});
    raw.objectOf.insert(raw.objectOf.end(), {object, object});
  }
}

/// What never moves, and the lift in its own frame.
Scene shaft() {
  RawScene raw;
  addBoard(raw, "wall", {-2, -1, -1.1}, {2, 6, -1});
  return checked(Scene::build(raw));
}
Scene liftWithRail() {
  RawScene raw;
  addBoard(raw, "platform", {-0.9, -0.1, -0.9}, {0.9, 0, 0.9});
  addBoard(raw, "rail", {-0.6, 0.9, -0.5}, {-0.3, 0.95, -0.4});
  return checked(Scene::build(raw));
}

/// 0 before `begin`, 1 after `end` (seconds), smoothly.
double smoothly(double s, double begin, double end) {
  const double t = std::clamp((s - begin) / (end - begin), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// What xrLocateSpace() says at the predicted time, in the play space. Yours; here the left hand is
/// pressed 10 cm too deep on the rail, and the right one goes 25 cm behind the wall.
std::array<Located, 3> locate(double s) {
  const auto down = static_cast<float>(0.3 * smoothly(s, 0.2, 1.0));
  const auto forward = static_cast<float>(0.7 * smoothly(s, 0.5, 1.5));
  const bool isLost = s > 2.0 && s < 2.1;  // its camera does not see it
  return {{{{{0, 0, 0, 1}, {0, 1.7F, 0}}, true},
           {{{0, 0, 0, 1}, {-0.45F, 1.19F - down, -0.45F}}, true},
           {{{0, 0.7071068F, 0, 0.7071068F}, {0.4F, 1.3F, -0.55F - forward}}, !isLost}}};
}

/// Where the lift is.
RigidPose liftAt(double s) {
  return {Quaternion::Identity(), {0.0, 1.2 * smoothly(s, 1.8, 3.8), 0.0}};
}

/// Three links, each with a place of its own in the world: so three roots.
Avatar headAndHands() {
  RawSkeleton bones;
  for (const char* name : {"Head", "LeftHand", "RightHand"}) {
    bones.joints.push_back({name, kNoParent, {0, 0, 0}, Quaternion::Identity()});
  }
  const Lss head{{0, 0, 0}, {0, 0, 0}, 0.12}, hand{{0, 0, 0.03}, {0, 0, -0.06}, 0.04};
  return checked(Avatar::build(checked(Skeleton::build(bones)), {{head}, {hand}, {hand}}));
}

/// What holds a hand, by name.
std::string holderOf(LinkId hand, const SolidBodyTick& user, const Scene& still, BodyId lift) {
  for (const SolidContact& contact : user.tick.contacts) {  // what stands still
    if (contact.link != hand || contact.triangle < 0) continue;
    return still.objectNames()[static_cast<std::size_t>(still.object(contact.triangle))];
  }
  for (const SolidBodyContact& contact : user.contacts) {  // what moves
    if (contact.link == hand && contact.body == lift) return "lift";
  }
  return "nothing";
}

/// In place of a picture: says now and then where the hands are shown, and what holds them.
class Screen {
 public:
  void draw(const SolidBodyTick& user, const Pose& tracked, const std::string& left,
            const std::string& right) {
    leaning_ += left == "lift";
    reaching_ += right == "wall";
    proven_ += user.tick.isCertified;
    if (++frames_ % 45 != 0) return;
    const Pose& shown = user.tick.shown;
    std::printf("%.1f s: left hand at y = %.2f, tracked at %.2f, on %s; ", frames_ / 90.0,
                shown.translations[kLeft].y(), tracked.translations[kLeft].y(), left.c_str());
    std::printf("right hand at z = %.2f, tracked at %.2f, at %s\n", shown.translations[kRight].z(),
                tracked.translations[kRight].z(), right.c_str());
  }
  /// What a hand meets, or leaves: the time for a sound, or for a button.
  void tell(const WorldEvent& event, const Avatar& avatar, const Scene& still, const Scene& lift) {
    const bool isEnter = event.kind == EventKind::Enter;
    if (!isEnter && event.kind != EventKind::Leave) return;
    const Scene& met = event.b.body == kStillScene ? still : lift;
    std::printf("%.3f s: %s %s %s, at %.2f m/s\n",
                1e-6 * static_cast<double>(event.time.us - kFirst / 1000),
                avatar.skeleton().name(event.a.link).c_str(), isEnter ? "meets" : "leaves",
                met.objectNames()[static_cast<std::size_t>(event.object)].c_str(),
                std::abs(event.approachSpeed));
    met_ += isEnter;
  }
  /// Whether all was as it is meant to be.
  bool end() const {
    std::printf(
        "leaned on the lift in %d of %d frames, reached the wall in %d, proven free in %d\n",
        leaning_, frames_, reaching_, proven_);
    return leaning_ > 180 && reaching_ > 180 && proven_ == frames_ && met_ == 2;
  }

 private:
  int leaning_ = 0, reaching_ = 0, proven_ = 0, frames_ = 0, met_ = 0;
};

int main() {
  const Avatar avatar = headAndHands();
  const Scene still = shaft(), rail = liftWithRail();
  Screen screen;

  SolidWorld world = checked(SolidWorld::build(still, kFirst / 1000));  // the first tick is later
  const BodyId user = checked(world.add(avatar));        // solid: follows its targets
  const BodyId lift = checked(world.world().add(rail));  // moves as it is told
  checked(world.world().push(lift, kFirst / 1000, liftAt(0.0)));
  Pose tracked = restPose(avatar.skeleton());
  std::vector<std::uint8_t> isTracked(3);
  std::vector<SolidBodyTick> ticks;
  WorldEvents happened;
  for (int frame = 1; frame <= 360; ++frame) {
    const XrTime time = kFirst + frame * kPeriod;  // predictedDisplayTime
    const std::int64_t us = time / 1000;           // when what is drawn is seen
    const double s = 1e-9 * static_cast<double>(time - kFirst);
    const RigidPose playSpace = liftAt(s);  // who stands on the lift goes along with it
    checked(world.world().push(lift, us, playSpace));
    const std::array<Located, 3> located = locate(s);
    for (std::size_t link = 0; link < located.size(); ++link) {
      const auto& [q, p] = located[link].pose;
      const Quaternion turn(q.w, q.x, q.y, q.z);  // OpenXR has w last
      tracked.rotations[link] = (playSpace.rotation * turn).normalized();
      tracked.translations[link] =
          playSpace.rotation * Eigen::Vector3d(p.x, p.y, p.z) + playSpace.translation;
      isTracked[link] = located[link].isTracked;
    }
    checked(world.tick(us, {{user, &tracked, &isTracked}}, ticks));
    checked(world.follow(happened));  // from enter to leave
    for (const WorldEvent& event : happened.events) screen.tell(event, avatar, still, rail);
    world.world().forgetBefore(us);
    screen.draw(ticks[0], tracked, holderOf(kLeft, ticks[0], still, lift),
                holderOf(kRight, ticks[0], still, lift));
  }

  return screen.end() ? 0 : 1;
}
