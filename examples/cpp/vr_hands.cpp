// A head and two controllers, as OpenXR reports them: the player stands on a lift that rises,
// leans with one hand on its rail, catches a ball with the other, and a sliding door pushes that
// hand. Prints what the hands meet and leave; with an argument, also each place on every shown
// way.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <foretouch/middleware/solid_world/solid_world.h>

#include "stage.h"

using namespace foretouch;
using stage::checked;
using stage::Located;
using stage::smoothly;

using XrTime = std::int64_t;  // nanoseconds, as openxr.h has it
constexpr XrTime kFirst = 5'000'000'000'000, kPeriod = 11'111'111;
constexpr LinkId kRight = 2;

/// What xrLocateSpace() says at the predicted time, in the play space. Yours; here the left hand is
/// pressed 10 cm too deep on the rail, and let go of it again.
std::array<Located, 3> locate(double s) {
  const auto down = static_cast<float>(0.3 * (smoothly(s, 0.2, 1.0) - smoothly(s, 2.6, 3.2)));
  const bool isLost = s > 2.0 && s < 2.1;  // its camera does not see the right one
  return {{{{{0, 0, 0, 1}, {0, 1.7F, 0}}, true},
           {{{0, 0, 0, 1}, {-0.45F, 1.19F - down, -0.45F}}, true},
           {{{0, 0, 0, 1}, {0.4F, 1.3F, -0.55F}}, !isLost}}};
}
/// Where the others are: the lift rises, the door slides along and back, the ball is thrown, and is
/// in the right hand at 0.8 s.
RigidPose liftAt(double s) {
  return stage::at(0, 1.2 * smoothly(s, 1.8, 3.6), 0);
}
RigidPose doorAt(double s) {
  return stage::at(1.1 - 0.8 * (smoothly(s, 1.4, 2.4) - smoothly(s, 3, 4)), 0, 0);
}
RigidPose ballAt(double s) {
  const double t = s - 0.8;
  return stage::at(0.4, 1.3 + 0.6 * t - 4.905 * t * t, -0.67 + 2.5 * t);
}

int main(int argc, char**) {
  const Lss head{{0, 0, 0}, {0, 0, 0}, 0.12}, hand{{0, 0, 0.03}, {0, 0, -0.06}, 0.04};
  const Avatar player = stage::avatarOf({{"Head", head}, {"LeftHand", hand}, {"RightHand", hand}});
  const Scene still = stage::sceneOf({{"floor", {-3, -1, -3}, {3, -0.9, 3}}});
  const Scene platform = stage::sceneOf({{"platform", {-0.9, -0.1, -0.9}, {0.9, 0, 0.9}},
                                         {"rail", {-0.6, 0.9, -0.5}, {-0.3, 0.95, -0.4}}});
  const Scene panel = stage::sceneOf({{"door", {0, 0, -0.6}, {1, 4, -0.5}}});
  const Avatar sphere = stage::avatarOf({{"ball", {{0, 0, 0}, {0, 0, 0}, 0.035}}});
  stage::Screen screen{player, kFirst / 1000, argc > 1};

  SolidWorld world = checked(SolidWorld::build(still, kFirst / 1000));  // the first tick is later
  const BodyId user = checked(world.add(player));            // solid: follows its targets
  const BodyId lift = checked(world.world().add(platform));  // these move as they are told
  const BodyId door = checked(world.world().add(panel));
  const BodyId ball = checked(world.world().add(sphere));
  Pose tracked = restPose(player.skeleton());
  std::vector<std::uint8_t> isTracked(3);
  std::vector<SolidBodyTick> ticks;
  WorldEvents happened;
  bool isCaught = false;
  for (int frame = 0; frame <= 360; ++frame) {
    const std::int64_t us = (kFirst + frame * kPeriod) / 1000;  // of predictedDisplayTime
    const double s = 1e-6 * static_cast<double>(us - kFirst / 1000);
    const RigidPose playSpace = liftAt(s);  // who stands on the lift goes along with it
    checked(world.world().push(lift, us, playSpace));
    checked(world.world().push(door, us, doorAt(s)));
    screen.place(us, "lift", playSpace);
    screen.place(us, "door", doorAt(s));
    if (!isCaught) {
      checked(world.world().push(ball, us, ballAt(s)));
      screen.place(us, "ball", ballAt(s));
    }
    if (frame == 0) continue;  // where they begin
    const std::array<Located, 3> located = locate(s);
    for (std::size_t link = 0; link < located.size(); ++link) {
      const RigidPose pose = stage::rigidPoseOf(located[link].pose);
      tracked.rotations[link] = (playSpace.rotation * pose.rotation).normalized();
      tracked.translations[link] = playSpace.rotation * pose.translation + playSpace.translation;
      isTracked[link] = located[link].isTracked;
    }
    checked(world.tick(us, {{user, &tracked, &isTracked}}, ticks));
    screen.draw(us, ticks[0]);
    checked(world.follow(happened));  // from enter to leave
    for (const WorldEvent& event : happened.events) {
      if (event.a.body != user) continue;
      const Scene& met = event.b.body == lift ? platform : event.b.body == door ? panel : still;
      screen.tell(event, event.b.body == ball ? "ball" : met.objectNames()[event.object]);
      if (event.b.body != ball || event.kind != EventKind::Enter) continue;
      isCaught = true;  // the hand closes, where both are at the tick's end
      const Eigen::Vector3d palm = ticks[0].tick.shown.translations[kRight];
      checked(world.world().attach(ball, {user, kRight}, us,
                                   {Quaternion::Identity(), ballAt(s).translation - palm}));
    }
    world.world().forgetBefore(us);
  }
  return screen.met == 3 && screen.left == 3 && screen.proven == 360 ? 0 : 1;
}
