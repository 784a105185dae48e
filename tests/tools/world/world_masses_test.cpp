// tests/tools/world/world_masses_test.cpp: what the masses of a world file do to the strength of
// its events, computed by hand: an avatar, a mesh, both.
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/world/followed_stage.h"

namespace foretouch::test {
namespace {

using WorldMasses = FollowedStage;
constexpr double kPi = 3.14159265358979323846;

/// How the middle of the man's hips answers an impulse along x, per newton second. The hips are a
/// ball of 0.1 m; the arm is a capsule of 0.05 m, 0.5 m long, on a joint 0.3 m above. The impulse
/// and the joint's reaction lie in one plane, so each has one speed and one turn:
///   at the joint the two have one speed,
///   (P - Q) / hips - 0.3^2 Q / Ih = Q / arm + 0.25^2 Q / Ia.
double answerOfTheHips(double kg) {
  const double r = 0.1, s = 0.05, length = 0.5;
  const double ofHips = 4.0 / 3.0 * kPi * r * r * r;
  const double ofEnds = 4.0 / 3.0 * kPi * s * s * s, ofShaft = kPi * s * s * length;
  const double density = kg / (ofHips + ofEnds + ofShaft);
  const double hips = density * ofHips, ends = density * ofEnds, shaft = density * ofShaft;
  const double turnOfHips = 0.4 * hips * r * r;
  const double turnOfArm = shaft * (length * length / 12.0 + s * s / 4.0) +
                           ends * (0.4 * s * s + length * length / 4.0 + 3.0 / 8.0 * length * s);
  const double atJoint = 1.0 / hips + 0.09 / turnOfHips;
  const double ofArm = 1.0 / (ends + shaft) + 0.0625 / turnOfArm;
  const double reaction = 1.0 / hips / (atJoint + ofArm);
  return (1.0 - reaction) / hips;
}

std::string manOf(const std::string& mass) {
  return "[[body]]\nname = \"man\"\navatar = \"man.json\"\n" + mass +
         "[body.clip]\nfile = \"clip.bvh\"\n";
}

TEST_F(WorldMasses, OfAnAvatarAreThoseOfItsLinks) {
  const std::string ball = "position = [-0.3, 0, 0]\n";
  const auto massOf = [&](const std::string& man, const std::string& thing) {
    const EventsFile file = follow(stage_.write(manOf(man) + sphereNamed("ball", thing)));
    return find(file.events, "enter", "man Hips, ball  ")["effective_mass"];
  };
  const double man = answerOfTheHips(60.0);
  EXPECT_NEAR(massOf("mass = 60\n", ball).get<double>(), 1.0 / man, 1e-6);
  EXPECT_NEAR(massOf("mass = 60\n", "mass = 0.4\n" + ball).get<double>(), 1.0 / (man + 1.0 / 0.4),
              1e-9);
  EXPECT_NEAR(massOf("", "mass = 0.4\n" + ball).get<double>(), 0.4, 1e-9);
  EXPECT_TRUE(massOf("", ball).is_null());
  EXPECT_GT(1.0 / man, 29.0);  // of more than the hips alone
  EXPECT_LT(1.0 / man, 60.0);  // and of less than the whole man
}

/// A box of 0.4 m x 2 m x 1 m, whose middle is half a metre above where the man meets it.
TEST_F(WorldMasses, OfAMeshAreThoseOfItsBox) {
  const double kg = 8.0, arm = 0.5, turn = kg / 12.0 * (0.4 * 0.4 + 2.0 * 2.0);
  const double ofBox = 1.0 / kg + arm * arm / turn;
  const std::string box =
      "[[body]]\nname = \"box\"\nbox = {low = [-0.2, -0.5, -0.5], high = [0.2, 1.5, 0.5]}\n"
      "position = [0, 0, 0]\n";
  const auto massOf = [&](const std::string& man, const std::string& thing) {
    const EventsFile file = follow(stage_.write(manOf(man) + box + thing));
    return find(file.events, "enter", "man Hips, box box box")["effective_mass"];
  };
  EXPECT_NEAR(massOf("", "mass = 8\n").get<double>(), 1.0 / ofBox, 1e-3);
  EXPECT_NEAR(massOf("mass = 60\n", "mass = 8\n").get<double>(),
              1.0 / (ofBox + answerOfTheHips(60.0)), 1e-3);
  EXPECT_TRUE(massOf("", "").is_null());
}

}  // namespace
}  // namespace foretouch::test
