// Tests tools/world/world_file.h: what a world file may say, and where each error points.
#include "tools/world/world_file.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/holds.h"

namespace foretouch::test {
namespace {

using tools::FileBody;
using tools::parseWorldFile;
using tools::WorldFile;

const std::string kHead = "format = \"foretouch-world\"\nversion = 1\n";
const std::string kBall = "[[body]]\nname = \"ball\"\nsphere = 0.1\n";

TEST(WorldFile, ReadsAllThatABodyMaySay) {
  const auto parsed = parseWorldFile(kHead + R"(
[scene]
file = "room.obj"
up = "z"
[query]
tolerance = 1e-5
[[body]]
name = "anna"
avatar = "anna.json"
group = "dancers"
mass = 60
when_silent = "hold-still"
self = true
pairs = "anna.pairs.json"
[body.clip]
file = "dance.bvh"
scale = 0.01
place = "1,0,2,90"
rate = 30
start = 2
from = 0.5
until = 3.5
speed = 2
[[body]]
name = "stick"
lss = [{a = [0, 0, 0], b = [0, 1, 0], radius = 0.02}, {a = [0, 1, 0], b = [0, 1, 0], radius = 0.05}]
[[body.pose]]
time = -1
position = [1, 2, 3]
[[body.pose]]
time = 0.5
yaw = 90
[[body.detach]]
time = 4
[[body.attach]]
time = 3
to = "anna"
link = "RightHand"
moves = true
position = [0, 0.1, 0]
[[body]]
name = "door"
box = { low = [0, 0, -0.02], high = [0.9, 2, 0.02] }
position = [0, 0, 1]
rotation = [0.7071, 0, 0.7071, 0]
[[body]]
name = "chair"
mesh = "sub/chair.glb"
node = "Seat"
scale = 0.5
poses = "chair.csv"
[[ask]]
group = "dancers"
with = "scene"
asked = false
)",
                                     "some/world.toml");
  ASSERT_TRUE(parsed.ok()) << describe(parsed.error());
  const WorldFile& world = parsed.value();
  EXPECT_EQ(world.scene.scenePath, "some/room.obj");
  EXPECT_EQ(world.scene.sceneImport.up, UpAxis::Z);
  EXPECT_EQ(world.tolerance, 1e-5);
  ASSERT_EQ(world.bodies.size(), 4u);
  const FileBody& anna = world.bodies[0];
  EXPECT_EQ(anna.shape.avatarPath, "some/anna.json");
  EXPECT_EQ(anna.group, "dancers");
  EXPECT_EQ(anna.massKg, 60.0);
  EXPECT_EQ(anna.whenSilent, WhenSilent::HoldStill);
  EXPECT_TRUE(anna.asksSelf);
  EXPECT_EQ(anna.pairsPath, "some/anna.pairs.json");
  EXPECT_EQ(anna.clip.motionPath, "some/dance.bvh");
  EXPECT_EQ(anna.clip.motionScale, 0.01);
  EXPECT_EQ(anna.clip.placement.yawDeg, 90.0);
  EXPECT_EQ(anna.clip.rateHz, 30.0);
  EXPECT_EQ(anna.timing.startUs, 2'000'000);
  EXPECT_EQ(anna.timing.fromUs, 500'000);
  EXPECT_EQ(anna.timing.untilUs, 3'500'000);
  EXPECT_EQ(anna.timing.speed, 2.0);
  const FileBody& stick = world.bodies[1];
  ASSERT_EQ(stick.shape.lss.size(), 2u);
  EXPECT_EQ(stick.shape.lss[1].radius, 0.05);
  ASSERT_EQ(stick.poses.size(), 2u);
  EXPECT_EQ(stick.poses[0].utimeUs, -1'000'000);
  EXPECT_EQ(stick.poses[0].pose.translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR((stick.poses[1].pose.rotation * Eigen::Vector3d::UnitX()).z(), -1.0, 1e-12);
  ASSERT_EQ(stick.changes.size(), 2u);  // by time, not as written
  EXPECT_TRUE(stick.changes[0].isAttached);
  EXPECT_EQ(stick.changes[0].utimeUs, 3'000'000);
  EXPECT_EQ(stick.changes[0].carrier, "anna");
  EXPECT_EQ(stick.changes[0].link, "RightHand");
  EXPECT_TRUE(stick.changes[0].movesInFrame);
  EXPECT_EQ(stick.changes[0].pose->translation.y(), 0.1);
  EXPECT_FALSE(stick.changes[1].isAttached);
  EXPECT_FALSE(stick.changes[1].pose.has_value());
  const FileBody& door = world.bodies[2];
  ASSERT_TRUE(door.shape.box.has_value());
  EXPECT_EQ((*door.shape.box)[1].y(), 2.0);
  EXPECT_NEAR(door.place->rotation.norm(), 1.0, 1e-15);
  const FileBody& chair = world.bodies[3];
  EXPECT_EQ(chair.shape.meshPath, "some/sub/chair.glb");
  EXPECT_EQ(chair.shape.node, "Seat");
  EXPECT_EQ(chair.shape.meshImport.scale, 0.5);
  EXPECT_EQ(chair.posesPath, "some/chair.csv");
  ASSERT_EQ(world.asks.size(), 1u);
  EXPECT_TRUE(world.asks[0].with.empty());
  EXPECT_FALSE(world.asks[0].isAsked);
}

/// A broken file: its text behind the head's two lines, the line that the error names, and what the
/// error says.
struct Broken {
  std::string text;
  int line;
  std::string says;
};

TEST(WorldFile, SaysWhereItIsBrokenAndWhatItExpected) {
  const std::string sphere = "[[body]]\nname = \"a\"\nsphere = 0.1\n";
  const std::vector<Broken> cases{
      {"", -1, "expected at least one [[body]]"},
      {"[[bodies]]\n", 3, "unknown key 'bodies'"},
      {"[scene]\n", 3, "expected a file"},
      {"[query]\ntolerance = 1e-9\n" + sphere, 4, "expected a finite number of metres from 1e-8"},
      {"[[body]]\nsphere = 0.1\n", 3, "expected a name"},
      {"[[body]]\nname = \"a\"\n", 3, "exactly one of avatar, mesh, sphere, lss and box, found 0"},
      {sphere + "mesh = \"a.obj\"\n", 3, "lss and box, found 2"},
      {"[[body]]\nname = \"a\"\nsphere = 0\n", 5, "a radius in metres greater than 0"},
      {"[[body]]\nname = \"a\"\nsphere = nan\n", 5, "a radius in metres"},
      {"[[body]]\nname = \"a\"\nlss = []\n", 3, "expected at least one LSS"},
      {"[[body]]\nname = \"a\"\nlss = [{a = [0, 0], b = [0, 0, 0], radius = 1}]\n", 5,
       "[[body.lss]] a: expected 3 numbers from -1e7 to 1e7, found 2 values"},
      {"[[body]]\nname = \"a\"\nlss = [{a = [0, 0, 0], b = [0, 0, 0]}]\n", 5,
       "expected a, b and radius"},
      {"[[body]]\nname = \"a\"\nbox = {low = [0, 0, 0], high = [1, 0, 1]}\n", 3,
       "every number of box high above that of low"},
      {sphere + "node = \"Seat\"\n", 3, "expected a mesh beside node"},
      {sphere + "mass = 0\n", 6, "[[body]] mass: expected a finite number of kilograms"},
      {sphere + "mass = -2\n", 6, "kilograms greater than 0"},
      {sphere + "mass = inf\n", 6, "kilograms greater than 0"},
      {sphere + "mass = \"heavy\"\n", 6, "found a text"},
      {sphere + "when_silent = \"guess\"\n", 6, "\"wait\", \"hold-still\" or \"undecided\""},
      {sphere + "group = \"scene\"\n", 6, "another word"},
      {sphere + "self = true\n", 3, "expected an avatar beside self"},
      {sphere + "pairs = \"p.json\"\n", 3, "expected self = true beside pairs"},
      {sphere + "position = [0, 0, 1e9]\n", 6, "found 1e+09"},
      {sphere + "rotation = [1, 1, 0, 0]\n", 6, "norm 1 within 0.001"},
      {sphere + "rotation = [1, 0, 0, 0]\nyaw = 3\n", 3, "rotation or yaw, found both"},
      {sphere + "poses = \"a.csv\"\nyaw = 3\n", 3,
       "expected one of clip, poses, pose and position"},
      {sphere + "[[body.pose]]\nposition = [0, 0, 0]\n", 6, "expected a time"},
      {sphere + "[[body.pose]]\ntime = 1\n", 6, "expected a position, rotation or yaw"},
      {sphere + "[[body.pose]]\ntime = 1\nyaw = 0\n[[body.pose]]\ntime = 1\nyaw = 1\n", 9,
       "expected a time after that of the pose before it"},
      {sphere + "[[body.pose]]\ntime = 1e10\nyaw = 0\n", 7, "within 285 years"},
      {sphere + "[body.clip]\nrate = 30\n", 6, "[clip]: expected a file"},
      {sphere + "[body.clip]\nfile = \"a.bvh\"\nspeed = 0\n", 8, "from 0.001 to 1000"},
      {sphere + "[body.clip]\nfile = \"a.bvh\"\nfrom = 2\nuntil = 1\n", 6,
       "until at or after from"},
      {sphere + "[[body.attach]]\ntime = 1\n", 6, "expected to, the name of a body"},
      {sphere + "[[body.attach]]\ntime = 1\nto = \"b\"\n[[body.detach]]\ntime = 1\n", 9,
       "one attach or detach at an instant"},
      {"[[body]]\nname = \"a\"\navatar = \"a.json\"\nposes = \"a.csv\"\n", 3,
       "expected a clip for an avatar"},
      {sphere + sphere, 6, "expected one that no other body has, found 'a'"},
      {sphere + "fidelity = \"exact\"\n", 3, "expected an avatar beside fidelity"},
      {"[[body]]\nname = \"a\"\navatar = \"a.json\"\nfidelity = \"limb\"\n", 6, "exact"},
      {sphere + "[[ask]]\ngroup = \"g\"\n", 6, "expected group, with and asked"},
  };
  for (const Broken& broken : cases) {
    const auto parsed = parseWorldFile(kHead + broken.text, "w.toml");
    ASSERT_FALSE(parsed.ok()) << broken.text;
    EXPECT_EQ(parsed.error().file, "w.toml");
    EXPECT_EQ(parsed.error().line, broken.line) << broken.text << describe(parsed.error());
    EXPECT_TRUE(holds(parsed.error().message, broken.says)) << describe(parsed.error());
  }
}

TEST(WorldFile, SaysWhoTouchesByTriangles) {
  const auto parsed =
      parseWorldFile(kHead +
                         "ask_meshes = true\n[[body]]\nname = \"a\"\navatar = \"a.json\"\n"
                         "fidelity = \"exact\"\n",
                     "w.toml");
  ASSERT_TRUE(parsed.ok()) << describe(parsed.error());
  EXPECT_TRUE(parsed.value().askMeshes);
  EXPECT_EQ(parsed.value().bodies[0].fidelity, Fidelity::Exact);
  const auto usual = parseWorldFile(kHead + kBall, "w.toml");
  EXPECT_FALSE(usual.value().askMeshes);
  EXPECT_EQ(usual.value().bodies[0].fidelity, Fidelity::Link);
}

TEST(WorldFile, IsOfItsFormatAndVersion) {
  EXPECT_TRUE(parseWorldFile(kHead + kBall, "w.toml").ok());
  for (const std::string& head :
       {std::string(), std::string("version = 1\n"), std::string("format = \"foretouch-world\"\n"),
        std::string("format = \"foretouch-avatar\"\nversion = 1\n"),
        std::string("format = \"foretouch-world\"\nversion = 2\n")}) {
    EXPECT_FALSE(parseWorldFile(head + kBall, "w.toml").ok()) << head;
  }
}

TEST(WorldFile, BoundsHowMuchItHolds) {
  std::string text = kHead;
  for (std::size_t i = 0; i <= tools::kMaxFileBodies; ++i) {
    text += "[[body]]\nname = \"b" + std::to_string(i) + "\"\nsphere = 1\n";
  }
  const auto many = parseWorldFile(text, "w.toml");
  ASSERT_FALSE(many.ok());
  EXPECT_EQ(many.error().code, ErrorCode::LimitExceeded) << describe(many.error());
}

}  // namespace
}  // namespace foretouch::test
