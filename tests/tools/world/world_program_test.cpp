// tests/tools/world/world_program_test.cpp: `foretouch world check|replay|view`, on small worlds
// and on the bundled one.
#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/holds.h"
#include "tests/tools/glb/glb_reader.h"
#include "tests/tools/inputs/arms_bvh.h"
#include "tests/tools/program_run.h"
#include "tests/tools/small_inputs.h"
#include "tests/tools/world/small_stage.h"

namespace foretouch::test {
namespace {

using nlohmann::json;

const std::string kExample = std::string(FORETOUCH_EXAMPLE_FOLDER) + "/stage.toml";

std::vector<json> linesOf(const std::string& path) {
  std::vector<json> lines;
  std::istringstream stream(contentOf(path));
  for (std::string line; std::getline(stream, line);) lines.push_back(json::parse(line));
  return lines;
}

std::string withoutLatencies(const std::string& path) {
  std::string text;
  std::istringstream stream(contentOf(path));
  for (std::string line; std::getline(stream, line);) text += withoutLatency(line) + "\n";
  return text;
}

/// The document of a page.
json documentOf(const std::string& path) {
  const std::string page = contentOf(path);
  const std::string mark = "id=\"foretouch-view\">";
  const std::size_t begin = page.find(mark) + mark.size();
  return json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

TEST(WorldProgram, ChecksAWorld) {
  const SmallStage stage;
  const std::string path =
      stage.write("[scene]\nfile = \"wall.obj\"\n" + kManWalks +
                  sphereNamed("ball", "mass = 0.4\ngroup = \"toys\"\nposition = [-0.75, 0, 0]\n"));
  const Ended ended = runForetouch({"world", "check", path});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  for (const char* part :
       {"wall.obj, 4 triangles", "0.000 s to 0.300 s", "man ", "10 Hz", "0.4 kg", "toys",
        "an overlap where a body appears", "'man' Hips and 'ball', at 0.000 s, 150.0 mm deep"}) {
    EXPECT_TRUE(holds(ended.out, part)) << part << "\n" << ended.out;
  }
  const Ended asJson = runForetouch({"world", "check", path, "--json"});
  ASSERT_EQ(asJson.exitCode, 0) << asJson.err;
  const json found = json::parse(asJson.out);
  EXPECT_EQ(found["bodies"].size(), 2u);
  EXPECT_EQ(found["bodies"][1]["mass"], 0.4);
  EXPECT_EQ(found["overlaps"][0]["b"]["body"], "ball");
}

TEST(WorldProgram, ReplaysAWorldIntoLines) {
  const SmallStage stage;
  const std::string path = stage.write("[scene]\nfile = \"wall.obj\"\n" + kManWalks +
                                       sphereNamed("ball", "position = [-0.3, 0, 0]\n"));
  const std::string out = stage.folder / "out.jsonl";
  const Ended ended = runForetouch({"world", "replay", path, "-o", out});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_TRUE(holds(ended.out, "man and ball")) << ended.out;
  EXPECT_TRUE(holds(ended.out, "man and the scene")) << ended.out;
  const std::vector<json> lines = linesOf(out);
  const json& header = lines.front();
  EXPECT_EQ(header["format"], "foretouch-world-results");
  EXPECT_EQ(header["version"], 1);
  EXPECT_EQ(header["world"], "world.toml");
  EXPECT_EQ(header["scene"], "wall.obj");
  EXPECT_TRUE(header["rate"].is_null());
  EXPECT_EQ(header["windows"], 3);
  EXPECT_EQ(header["bodies"][0]["links"], (std::vector<std::string>{"Hips", "Arm"}));
  // Hips of 0.1 m and a ball of 0.05 meet at x = -0.45, 0.06 s on the way.
  const json& met = lines[1]["contacts"][0];
  EXPECT_EQ(met["a"]["body"], "man");
  EXPECT_EQ(met["a"]["link"], "Hips");
  EXPECT_EQ(met["b"]["body"], "ball");
  EXPECT_EQ(met["b"].count("link"), 0u);
  EXPECT_EQ(met["verdict"], "contact");
  EXPECT_NEAR(met["time"].get<double>(), 0.06, 2.1e-4);
  EXPECT_LE(met["time"].get<double>(), 0.06 + 1e-12);
  EXPECT_EQ(met["utime"], met["time"].get<double>() * 1e6 - met["fraction"].get<double>());
  EXPECT_NEAR(met["a"]["point"][0].get<double>(), -0.35, 2e-3);
  EXPECT_NEAR(met["b"]["point"][0].get<double>(), -0.35, 2e-3);
  EXPECT_NEAR(met["normal"][0].get<double>(), -1.0, 1e-9);  // from the ball to the man
  // Both links go through the wall at x = 0 in the next window.
  const json& wall = lines[2]["contacts"].back();
  EXPECT_EQ(wall["b"].count("body"), 0u);
  EXPECT_EQ(wall["b"]["object"], "wall");
  std::vector<std::string> touched;
  for (const json& line : lines) {
    if (line.count("touch") == 0) continue;
    const json& touch = line["touch"];
    touched.push_back(touch["a"]["link"].get<std::string>() + " " +
                      touch["b"].value("body", touch["b"].value("object", "")));
  }
  EXPECT_EQ(touched, (std::vector<std::string>{"Hips ball", "Hips wall", "Arm wall"}));
  EXPECT_EQ(lines.back()["summary"]["touches_bodies"], 1);
  EXPECT_EQ(lines.back()["summary"]["touches_scene"], 2);
}

/// Two who follow one file, each as its own table says.
TEST(WorldProgram, BodiesTakeTheirPartOfAClipAndTheirOwnRate) {
  const SmallStage stage;
  stage.folder.write("arms.bvh", armsBvh(40, 101));
  stage.folder.write("bot.urdf",
                     "<robot name=\"bot\"><link name=\"base\"><collision><geometry>"
                     "<sphere radius=\"0.1\"/></geometry></collision></link></robot>");
  stage.folder.write("bot.csv",
                     "root_x,root_y,root_z,root_qx,root_qy,root_qz,root_qw\n"
                     "0,0,1,0,0,0,1\n1,0,1,0,0,0,1\n");
  const auto led = [](const char* name, const std::string& clip) {
    return sphereNamed(name, "[body.clip]\n" + clip);
  };
  const std::string bot = "file = \"bot.csv\"\nrobot = \"bot.urdf\"\nrow_rate = ";
  const std::string path = stage.write(
      led("arms", "file = \"arms.bvh\"\nskip_t_pose = true\nstart = 2\njoint = \"Hips\"\n") +
      led("slow", bot + "1\n") + led("quick", bot + "4\n"));
  const Ended ended = runForetouch({"world", "check", path, "--json"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const json bodies = json::parse(ended.out)["bodies"];
  EXPECT_EQ(bodies[0]["poses"], 61);
  EXPECT_EQ(bodies[0]["from"], 2.0);
  EXPECT_EQ(bodies[1]["until"], 1.0);
  EXPECT_EQ(bodies[2]["until"], 0.25);
}

TEST(WorldProgram, SaysWhatIsWrongWithAFileAndItsLine) {
  const SmallStage stage;
  const std::string path = stage.write(sphereNamed("a", "masses = 3\n"));
  for (const std::string& command : {std::string("check"), std::string("view")}) {
    const Ended ended = runForetouch({"world", command, path});
    EXPECT_EQ(ended.exitCode, 2);
    EXPECT_TRUE(holds(ended.err,
                      "world.toml:6: unknown key 'masses' in [[body]]; did you mean "
                      "'mass'"))
        << ended.err;
  }
  const std::string good = stage.write(kManWalks);
  for (const char* input : {"world.toml", "man.json", "clip.bvh"}) {
    const Ended over = runForetouch({"world", "replay", good, "-o", stage.folder / input});
    EXPECT_EQ(over.exitCode, 2) << input;
  }
  EXPECT_EQ(runForetouch({"world", "replay", good, "-o", stage.folder / "o.jsonl", "--until", "9"})
                .exitCode,
            2);
}

TEST(WorldProgram, ShowsOnItsPageWhatPersonsTouched) {
  const SmallStage stage;
  std::string man = kManWalks;
  man.insert(man.find("[body.clip]"), "bounds = \"preset:sara-shield\"\n");
  const std::string path = stage.write(man + sphereNamed("post", "position = [0.3, 0, 0]\n"));
  const std::string report = stage.folder / "report.html";
  const Ended ended =
      runForetouch({"world", "replay", path, "-o", stage.folder / "o.jsonl", "--report", report});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const json person = documentOf(report)["person"];
  EXPECT_EQ(person["bounds"], "preset:sara-shield");
  EXPECT_EQ(person["between"], "constant-rate");
  EXPECT_EQ(person.count("rate_hz"), 0u);
  std::set<std::string> objects;
  for (const json& touch : person["touches"]) {
    objects.insert(touch["object"].get<std::string>());
    EXPECT_EQ(touch.count("avatar"), 0u);
    EXPECT_LE(touch["begins"][0].get<double>(), touch["ends"][1].get<double>());
    EXPECT_GT(touch["growth"].get<double>(), 0.0);
  }
  EXPECT_EQ(objects, std::set<std::string>{"post"});
}

TEST(WorldProgram, WritesPagesInWhichTheCarriedGoAlong) {
  const SmallStage stage;
  const std::string path = stage.write(
      kManWalks +
      sphereNamed("cup",
                  "[[body.attach]]\ntime = 0\nto = \"man\"\nlink = \"Hips\"\nposition = [0, "
                  "-0.3, 0]\n[[body.detach]]\ntime = 0.2\n") +
      "[[body]]\nname = \"door\"\nbox = {low = [-0.2, -1, -1], high = [0.2, 1, 1]}\n"
      "position = [0.5, 0, 0]\n");
  const std::string page = stage.folder / "world.html", report = stage.folder / "report.html";
  ASSERT_EQ(runForetouch({"world", "view", path, "-o", page}).exitCode, 0);
  const json shown = documentOf(page);
  EXPECT_EQ(shown["kind"], "world");
  EXPECT_EQ(shown.count("touches"), 0u);
  ASSERT_EQ(shown["avatars"].size(), 3u);
  const json& carried = shown["avatars"][1]["carried"];
  ASSERT_EQ(carried.size(), 1u);
  EXPECT_EQ(carried[0]["avatar"], 0);
  EXPECT_EQ(carried[0]["link"], 0);
  EXPECT_EQ(carried[0]["from"], 0.0);
  EXPECT_EQ(carried[0]["until"], 0.2);
  EXPECT_EQ(shown["avatars"][2]["lss"].size(), 0u);
  EXPECT_EQ(shown["avatars"][2]["meshes"].size(), 1u);

  ASSERT_EQ(
      runForetouch({"world", "replay", path, "-o", stage.folder / "o.jsonl", "--report", report})
          .exitCode,
      0);
  const json found = documentOf(report);
  EXPECT_EQ(found["kind"], "world");
  ASSERT_FALSE(found["touches"].empty());
  std::set<std::string> met;
  for (const json& touch : found["touches"]) {
    const json& avatar = found["avatars"][touch.value("avatar", 0)];
    ASSERT_EQ(touch.count("other_avatar"), 1u);
    met.insert(avatar["links"][touch["link"].get<std::size_t>()]["name"].get<std::string>() + " " +
               touch["object"].get<std::string>());
    ASSERT_FALSE(touch["rows"].empty());
    for (const json& row : touch["rows"]) {
      const json& contact = avatar["contacts"][row.get<std::size_t>()];
      EXPECT_EQ(contact["link"], touch["link"]);
      EXPECT_EQ(contact["object"], touch["object"]);
      EXPECT_EQ(contact.count("missed_by_poses"), 0u);
    }
  }
  EXPECT_EQ(met, (std::set<std::string>{"Hips door", "Arm door", "cup door"}));
}

/// One triangle in the plane z = 0 from the node's origin, 5 m along x in the file.
constexpr char kSeatGltf[] =
    R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)"
    R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],)"
    R"("bufferViews":[{"buffer":0,"byteLength":36}],)"
    R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],)"
    R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
    R"("nodes":[{"name":"Seat","mesh":0,"translation":[5,0,0]}],"scenes":[{"nodes":[0]}],"scene":0})";

TEST(WorldProgram, TakesAPropFromAFileOrFromOneOfItsNodes) {
  const SmallStage stage;
  stage.folder.write("chair.gltf", kSeatGltf);
  const std::string ball = sphereNamed("ball", "position = [5.2, 0.2, 0]\n");
  const std::string chair = "[[body]]\nname = \"chair\"\nmesh = \"chair.gltf\"\n";
  const auto overlapsOf = [&](const std::string& text) {
    const Ended ended = runForetouch({"world", "check", stage.write(text), "--json"});
    EXPECT_EQ(ended.exitCode, 0) << ended.err;
    return json::parse(ended.out)["overlaps"].size();
  };
  EXPECT_EQ(overlapsOf(chair + ball), 1u);  // as the file has it
  EXPECT_EQ(overlapsOf(chair + "node = \"Seat\"\n" + ball), 0u);
  EXPECT_EQ(overlapsOf(chair + "node = \"Seat\"\nposition = [5, 0, 0]\n" + ball), 1u);
  const Ended gone =
      runForetouch({"world", "check", stage.write(chair + "node = \"Sit\"\n" + ball)});
  EXPECT_EQ(gone.exitCode, 2);
  EXPECT_TRUE(holds(gone.err, "chair.gltf: no node is named 'Sit'")) << gone.err;
}

TEST(WorldProgram, WritesAGlbWithEveryBodyBelowWhoCarriesIt) {
  const SmallStage stage;
  const std::string path = stage.write(
      "[scene]\nfile = \"wall.obj\"\n" + kManWalks +
      sphereNamed("cup",
                  "[[body.attach]]\ntime = 0\nto = \"man\"\nlink = \"Hips\"\nposition = [0, "
                  "-0.3, 0]\n[[body.detach]]\ntime = 0.2\n"));
  const std::string glb = stage.folder / "world.glb";
  const Ended ended =
      runForetouch({"world", "replay", path, "-o", stage.folder / "o.jsonl", "--glb", glb});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const GlbReader read(contentOf(glb));
  read.check();
  const json& nodes = read.root()["nodes"];
  std::map<std::string, std::vector<std::string>> parentsOf;
  for (const json& node : nodes) {
    for (const json& child : node.value("children", json::array())) {
      parentsOf[nodes[child.get<std::size_t>()]["name"]].push_back(node["name"]);
    }
  }
  // Held in one pair of nodes, free in another.
  std::sort(parentsOf["cup"].begin(), parentsOf["cup"].end());
  EXPECT_EQ(parentsOf["cup"], (std::vector<std::string>{"Hips", "bodies", "cup", "cup"}));
  EXPECT_EQ(parentsOf["Arm"], std::vector<std::string>{"Hips"});
  EXPECT_EQ(parentsOf["wall"], std::vector<std::string>{"scene"});
  int markers = 0;
  for (const json& node : nodes) {
    if (node.count("extras") == 0 || node["extras"].count("touch") == 0) continue;
    ++markers;
    EXPECT_EQ(node["extras"]["touch"]["b"]["object"], "wall");
  }
  EXPECT_EQ(markers, 3);  // hips, arm and cup go through the wall
}

/// Where the nodes of a GLB are over time, as glTF defines its animations.
class NodeMotion {
 public:
  explicit NodeMotion(const GlbReader& glb) : glb_(glb), parents_(glb.parents()) {
    for (const json& channel : glb.root()["animations"][0]["channels"]) {
      const json& sampler = glb.root()["animations"][0]["samplers"][channel["sampler"].get<int>()];
      channels_[{channel["target"]["node"], channel["target"]["path"]}] = {
          glb.floats(sampler["input"]), glb.floats(sampler["output"]),
          sampler["interpolation"] == "STEP"};
    }
  }

  [[nodiscard]] Eigen::Affine3d frameAt(int node, double timeS) const {
    Eigen::Affine3d frame = Eigen::Affine3d::Identity();
    for (; node >= 0; node = parents_[static_cast<std::size_t>(node)]) {
      const json& own = glb_.root()["nodes"][static_cast<std::size_t>(node)];
      const auto p = valuesAt(own, node, "translation", {0, 0, 0}, timeS);
      const auto q = valuesAt(own, node, "rotation", {0, 0, 0, 1}, timeS);
      frame = Eigen::Translation3d(p[0], p[1], p[2]) *
              Eigen::Quaterniond(q[3], q[0], q[1], q[2]).normalized() * frame;
    }
    return frame;
  }
  [[nodiscard]] bool isShownAt(int node, double timeS) const {
    for (; node >= 0; node = parents_[static_cast<std::size_t>(node)]) {
      const json& own = glb_.root()["nodes"][static_cast<std::size_t>(node)];
      if (valuesAt(own, node, "scale", {1, 1, 1}, timeS)[0] == 0.0) return false;
    }
    return true;
  }

 private:
  struct Channel {
    std::vector<float> times, values;
    bool isStep = false;
  };
  [[nodiscard]] std::vector<double> valuesAt(const json& own, int node, const std::string& path,
                                             const std::vector<double>& none, double timeS) const {
    const auto found = channels_.find({node, path});
    if (found == channels_.end()) return own.value(path, none);
    const Channel& channel = found->second;
    const std::size_t width = none.size(), last = channel.times.size() - 1;
    const auto after = std::upper_bound(channel.times.begin(), channel.times.end(), timeS);
    const auto next = static_cast<std::size_t>(after - channel.times.begin());
    const std::size_t from = next == 0 ? 0 : next - 1, to = std::min(next, last);
    const auto row = [&](std::size_t key) {
      const auto begin = channel.values.begin() + static_cast<std::ptrdiff_t>(key * width);
      return Eigen::VectorXd(
          Eigen::Map<const Eigen::VectorXf>(&*begin, static_cast<Eigen::Index>(width))
              .cast<double>());
    };
    const double t = channel.isStep || to == from ? 0.0
                                                  : (timeS - channel.times[from]) /
                                                        (channel.times[to] - channel.times[from]);
    Eigen::VectorXd value = row(from) + t * (row(to) - row(from));
    if (path == "rotation") {
      const Eigen::Quaterniond a(Eigen::Vector4d(row(from))), b(Eigen::Vector4d(row(to)));
      value = a.slerp(t, b).coeffs();
    }
    return {value.data(), value.data() + value.size()};
  }

  const GlbReader& glb_;
  std::vector<int> parents_;
  std::map<std::pair<int, std::string>, Channel> channels_;
};

/// Its corners are where coordinates end, so that an LSS around it ends beyond.
TEST(WorldProgram, RefusesByNameABodyThatIsTooLarge) {
  const SmallStage stage;
  const std::string path = stage.write(
      "[[body]]\nname = \"crate\"\nbox = {low = [0, 0, 0], high = [1, 1, 1]}\n"
      "[[body]]\nname = \"gate\"\nbox = {low = [-1e7, -1e7, -1e7], high = [1e7, 1e7, 1e7]}\n");
  for (const char* const command : {"check", "replay", "view"}) {
    std::vector<std::string> arguments{"world", command, path};
    if (command != std::string("check")) {
      arguments.insert(arguments.end(), {"-o", stage.folder / "out"});
    }
    const Ended ended = runForetouch(arguments);
    EXPECT_EQ(ended.exitCode, 2) << command << ended.err;
    EXPECT_TRUE(holds(ended.err, "world.toml:6: [[body]] 'gate': ")) << ended.err;
  }
}

class BundledStage : public testing::Test {
 protected:
  TempFolder folder_;
};

TEST_F(BundledStage, IsCheckedAndReplayedAlikeEveryTime) {
  const Ended check = runForetouch({"world", "check", kExample});
  ASSERT_EQ(check.exitCode, 0) << check.err;
  EXPECT_TRUE(holds(check.out, "'ball' is held by 'anna' RightHand")) << check.out;
  const std::string first = folder_ / "first.jsonl", again = folder_ / "again.jsonl";
  ASSERT_EQ(runForetouch({"world", "replay", kExample, "-o", first}).exitCode, 0);
  ASSERT_EQ(runForetouch({"world", "replay", kExample, "-o", again}).exitCode, 0);
  EXPECT_EQ(withoutLatencies(first), withoutLatencies(again));
}

TEST_F(BundledStage, ShowsWhatItIsThereToShow) {
  const std::string out = folder_ / "out.jsonl";
  ASSERT_EQ(runForetouch({"world", "replay", kExample, "-o", out}).exitCode, 0);
  std::map<std::string, int> touches;
  double thrownAtS = 0.0;
  for (const json& line : linesOf(out)) {
    if (line.count("touch") == 0) continue;
    const json& touch = line["touch"];
    const std::string a = touch["a"]["body"], b = touch["b"].value("body", "scene");
    ++touches[a + " " + b];
    if (a == "ben" && b == "ball" && thrownAtS == 0.0) thrownAtS = touch["begin"].get<double>();
  }
  EXPECT_GE(touches["anna ben"], 5);    // they meet
  EXPECT_GE(touches["anna door"], 5);   // the door swings into her
  EXPECT_GE(touches["ball scene"], 3);  // the ball bounces
  EXPECT_GE(touches["ben ball"], 1);    // and hits him, a third of a second after the throw
  EXPECT_GT(thrownAtS, 5.5);
  EXPECT_LT(thrownAtS, 5.9);
}

/// Where the GLB has the ball when it is met, in a hand and free, its surface is at the contact.
TEST_F(BundledStage, HasItsBallInTheGlbWhereItIsMet) {
  const std::string glb = folder_ / "stage.glb";
  ASSERT_EQ(runForetouch({"world", "replay", kExample, "-o", folder_ / "out.jsonl", "--glb", glb})
                .exitCode,
            0);
  const GlbReader read(contentOf(glb));
  read.check();
  const NodeMotion motion(read);
  const json& nodes = read.root()["nodes"];
  int inHand = 0, free = 0;
  for (const json& marker : nodes) {
    if (marker.count("extras") == 0 || marker["extras"].count("touch") == 0) continue;
    const json& contact = marker["extras"];
    if (contact["verdict"] != "contact") continue;
    for (const char* side : {"a", "b"}) {
      if (contact[side].value("body", "") != "ball") continue;
      const double timeS = contact["time"];
      std::vector<Eigen::Vector3d> places;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const int node = static_cast<int>(i);
        if (nodes[i]["name"] != "ball" || nodes[i].count("mesh") == 0) continue;
        if (motion.isShownAt(node, timeS))
          places.push_back(motion.frameAt(node, timeS).translation());
      }
      ASSERT_EQ(places.size(), 1u) << timeS;  // one of the two pairs of nodes is shown
      const auto point = contact[side]["point"].get<std::vector<double>>();
      const Eigen::Vector3d met(point[0], point[1], point[2]);
      EXPECT_NEAR((places[0] - met).norm(), 0.07, 2e-5) << timeS;
      ++(timeS < 5.5 ? inHand : free);
    }
  }
  EXPECT_GE(inHand, 1);
  EXPECT_GE(free, 5);
}

}  // namespace
}  // namespace foretouch::test
