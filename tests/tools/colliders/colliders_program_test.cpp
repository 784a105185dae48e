// foretouch avatar colliders, as a user would run it: what each format's own reader has of the
// file, beside the avatar's LSS.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#ifdef FORETOUCH_TEST_MUJOCO
#include <mujoco/mujoco.h>
#endif

#include "articulated/motion.h"
#include "assets/avatar/avatar_file.h"
#include "assets/model/model_avatar.h"
#include "lss/index.h"
#include "tests/assets/model_files.h"
#include "tests/assets/vrm_writer.h"
#include "tests/support/holds.h"
#include "tests/support/random_geometry.h"
#include "tests/tools/program_run.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

/// What the reader's own sums lose, in metres; the colliders here are within 2 m of their joints.
constexpr double kReaders = 1e-14;
/// How much thicker a collider may be, in metres.
constexpr double kFloats = 1e-6, kDoubles = 1e-11;

/// Links with names that files escape, several LSS, spheres, thin ones and none at all; two roots.
Avatar drawnAvatar(std::uint64_t seed) {
  Random random(seed);
  RawSkeleton raw;
  std::vector<std::vector<Lss>> lss;
  for (int i = 0; i < 12; ++i) {
    RawJoint joint;
    joint.name = (i % 3 == 0 ? "a<b & \"c\":" : "joint.") + std::to_string(i);
    joint.parent = i == 0 || i == 7 ? kNoParent : random.below(i);
    joint.offset = random.inBox(0.7);
    joint.rotation = random.rotation();
    raw.joints.push_back(joint);
    lss.emplace_back();
    const int count = i == 4 ? 0 : 1 + random.below(3);
    for (int k = 0; k < count; ++k) {
      const Vector3d a = random.inBox(0.8);
      const Vector3d b = random.chance(0.2) ? a : Vector3d(a + random.arrow(0.001, 0.7));
      lss.back().push_back({a, b, random.chance(0.1) ? 0.0 : random.magnitude(0.001, 0.2)});
    }
  }
  return Avatar::build(Skeleton::build(raw).value(), lss).value();
}

double toAxis(const Lss& lss, const Vector3d& point) {
  const Vector3d along = lss.b - lss.a;
  const double square = along.squaredNorm();
  const double t = square > 0.0 ? std::clamp(along.dot(point - lss.a) / square, 0.0, 1.0) : 0.0;
  return (lss.a + t * along - point).norm();
}

/// How far `outer` is from holding `inner`: as it is convex, from holding the balls at both ends.
double lack(const Lss& inner, const Lss& outer) {
  return std::max(toAxis(outer, inner.a), toAxis(outer, inner.b)) + inner.radius - outer.radius;
}

/// Of each LSS the one that holds it, in the same order, and hardly more.
void expectHeld(const std::vector<Lss>& inner, const std::vector<Lss>& outer, double thicker,
                const std::string& link) {
  ASSERT_EQ(inner.size(), outer.size()) << link;
  for (std::size_t i = 0; i < inner.size(); ++i) {
    EXPECT_LE(lack(inner[i], outer[i]), kReaders) << link << ' ' << i;
    EXPECT_LE(outer[i].radius, std::max(inner[i].radius, 1e-6) + thicker) << link << ' ' << i;
  }
}

/// Link by link, by name; and where the two rest.
void expectHeld(const Avatar& avatar, const Avatar& read, double thicker) {
  const auto rest = [](const Avatar& of) {
    std::vector<LinkState> states;
    const Pose pose = restPose(of.skeleton());
    ChainMotion(of.skeleton(), pose, pose).statesAt(0.0, states);
    return states;
  };
  const auto ours = rest(avatar), theirs = rest(read);
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    const std::string& name = avatar.skeleton().name(link);
    if (avatar.lss(link).empty()) continue;
    const auto same = read.skeleton().find(name);
    ASSERT_TRUE(same) << name;
    expectHeld(avatar.lss(link), read.lss(*same), thicker, name);
    EXPECT_LT((ours[slotOf(link)].p_WL - theirs[slotOf(*same)].p_WL).norm(), 1e-12) << name;
    EXPECT_LT((ours[slotOf(link)].R_WL - theirs[slotOf(*same)].R_WL).norm(), 1e-12) << name;
  }
  EXPECT_EQ(avatar.numLss(), read.numLss());
}

/// The avatar as a file, and what the command makes of it.
struct Made {
  TempFolder folder;
  Ended ended;
  [[nodiscard]] std::string file(const std::string& name) const { return folder / name; }

  Made(const Avatar& avatar, const std::string& output, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"avatar", "colliders",
                                   folder.write("body.json", formatAvatar(avatar)), "-o",
                                   folder / output};
    words.insert(words.end(), more.begin(), more.end());
    ended = runForetouch(words);
    EXPECT_EQ(ended.exitCode, 0) << ended.err;
  }
};

Avatar readModel(const std::string& path, std::optional<UpAxis> up = std::nullopt) {
  ModelImportOptions options = withModelImporter();
  options.import.up = up;
  return avatarFromModel(importModel(path, options).value()).value().avatar;
}

TEST(Colliders, OfGltfAreReadBack) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Avatar avatar = drawnAvatar(seed);
    const Made made(avatar, "body.glb");
    expectHeld(avatar, readModel(made.file("body.glb")), kFloats);
  }
}

TEST(Colliders, OfMjcfAreReadBack) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Avatar avatar = drawnAvatar(seed);
    const Made made(avatar, "body.xml");
    EXPECT_TRUE(holds(made.ended.err, "every joint is a ball")) << made.ended.err;
    expectHeld(avatar, readModel(made.file("body.xml"), UpAxis::Z), kDoubles);
  }
}

TEST(Colliders, OfUrdfAreReadBack) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Avatar avatar = drawnAvatar(seed);
    const Made made(avatar, "body.urdf");
    EXPECT_TRUE(holds(made.ended.err, "every joint is floating")) << made.ended.err;
    expectHeld(avatar, readModel(made.file("body.urdf"), UpAxis::Z), kDoubles);
  }
}

#ifdef FORETOUCH_TEST_MUJOCO
/// libmujoco alone.
TEST(Colliders, AreTheGeomsOfMujocoItself) {
  const Avatar avatar = drawnAvatar(11);
  const Made made(avatar, "body.xml");
  char said[1000] = "";
  mjModel* const model = mj_loadXML(made.file("body.xml").c_str(), nullptr, said, sizeof said);
  ASSERT_NE(model, nullptr) << said;
  std::vector<std::vector<Lss>> geoms(countOf(avatar.numLinks()));
  for (int g = 0; g < model->ngeom; ++g) {
    const char* const body = model->names + model->name_bodyadr[model->geom_bodyid[g]];
    const auto link = avatar.skeleton().find(body);
    ASSERT_TRUE(link) << body;
    const Eigen::Map<const Vector3d> middle(model->geom_pos + 3 * g),
        size(model->geom_size + 3 * g);
    const mjtNum* const q = model->geom_quat + 4 * g;
    const bool isCapsule = model->geom_type[g] == mjGEOM_CAPSULE;
    const Vector3d half =
        isCapsule ? Vector3d(Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * Vector3d(0, 0, size[1]))
                  : Vector3d(Vector3d::Zero());
    geoms[slotOf(*link)].push_back({middle - half, middle + half, size[0]});
  }
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    expectHeld(avatar.lss(link), geoms[slotOf(link)], kDoubles, avatar.skeleton().name(link));
  }
  mj_deleteModel(model);
}
#endif

/// The three parts of a capsule: the two spheres hold its ends, and the cylinder is as long.
TEST(Colliders, OfUrdfWithoutCapsulesAreTheSameInParts) {
  const Avatar avatar = drawnAvatar(3);
  const Made made(avatar, "body.urdf", {"--urdf-parts"});
  EXPECT_FALSE(holds(contentOf(made.file("body.urdf")), "<capsule"));
  const Avatar read = readModel(made.file("body.urdf"), UpAxis::Z);
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    const auto& stated = read.lss(*read.skeleton().find(avatar.skeleton().name(link)));
    for (const Lss& lss : avatar.lss(link)) {
      for (const Vector3d& end : {lss.a, lss.b}) {
        EXPECT_TRUE(std::any_of(stated.begin(), stated.end(), [&](const Lss& part) {
          return part.a == part.b && lack({end, end, lss.radius}, part) <= kReaders;
        }));
      }
      // A cylinder's own reader puts a prism around it, whose LSS is larger.
      EXPECT_TRUE(std::any_of(stated.begin(), stated.end(), [&](const Lss& part) {
        return lss.a == lss.b || lack({lss.a, lss.b, 0.9 * lss.radius}, part) <= 0.1;
      }));
    }
  }
}

/// What a scene of Godot states, by this test's own reader of its text; godot3-server reads one
/// itself (integrations/godot/tests).
class GodotReader {
 public:
  explicit GodotReader(const std::string& text, bool isFour) : isFour_(isFour) {
    std::string head;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind('[', 0) == 0) head = line;
      if (line.rfind("radius = ", 0) == 0) radii_[idIn(head)] = std::stod(line.substr(9));
      if (line.rfind("height = ", 0) == 0) heights_[idIn(head)] = std::stod(line.substr(9));
      if (line.rfind("bone_name = ", 0) == 0) bone_ = json::parse(line.substr(12));
      if (line.rfind("transform = ", 0) == 0) transform_ = numbersIn(line);
      if (line.rfind("shape = ", 0) == 0) shapes[bone_].push_back(shapeAt(idIn(line)));
    }
  }
  std::map<std::string, std::vector<Lss>> shapes;

 private:
  static int idIn(const std::string& line) {
    std::smatch found;
    const std::regex word("(?:id=|SubResource\\( ?)\"?([0-9]+)");
    return std::regex_search(line, found, word) ? std::stoi(found[1]) : -1;
  }
  static std::vector<double> numbersIn(const std::string& line) {
    std::vector<double> numbers;
    std::istringstream words(line.substr(line.find('(') + 1));
    for (std::string word; std::getline(words, word, ',');) numbers.push_back(std::stod(word));
    return numbers;
  }
  Lss shapeAt(int id) {
    const auto& t = transform_;
    const int column = isFour_ ? 1 : 2;
    const Vector3d axis(t[column], t[3 + column], t[6 + column]), middle(t[9], t[10], t[11]);
    const double radius = radii_.at(id), height = heights_.count(id) != 0 ? heights_[id] : 0.0;
    const double half = heights_.count(id) == 0 ? 0.0 : 0.5 * height - (isFour_ ? radius : 0.0);
    return {middle - half * axis, middle + half * axis, radius};
  }
  bool isFour_;
  std::string bone_;
  std::vector<double> transform_;
  std::map<int, double> radii_, heights_;
};

TEST(Colliders, OfGodotHoldEveryLss) {
  for (const char* const version : {"3", "4"}) {
    const Avatar avatar = drawnAvatar(5);
    const Made made(avatar, "body.tscn", {"--godot", version});
    EXPECT_TRUE(holds(made.ended.err, "Godot takes no ':' and '/'")) << made.ended.err;
    const std::string text = contentOf(made.file("body.tscn"));
    const GodotReader read(text, version[0] == '4');
    std::size_t links = 0;
    for (LinkId link = 0; link < avatar.numLinks(); ++link) {
      std::string bone = avatar.skeleton().name(link);
      std::replace(bone.begin(), bone.end(), ':', '_');
      const auto found = read.shapes.find(bone);
      links += found == read.shapes.end() ? 0 : 1;
      expectHeld(avatar.lss(link), found == read.shapes.end() ? std::vector<Lss>() : found->second,
                 kFloats, bone);
    }
    EXPECT_EQ(links, 11u);
    // Nodes of a level have other names than those of paths.
    EXPECT_FALSE(holds(text, "[node name=\"joint.1\"")) << text.substr(0, 400);
  }
}

/// Unity's frame is the mirror image in z; a capsule stands along its y.
TEST(Colliders, OfUnityHoldEveryLss) {
  const Avatar avatar = drawnAvatar(6);
  const Made made(avatar, "colliders.json");
  const json said = json::parse(contentOf(made.file("colliders.json")));
  EXPECT_EQ(said["format"], "foretouch-unity-colliders");
  std::vector<std::vector<Lss>> read(countOf(avatar.numLinks()));
  for (const json& one : said["colliders"]) {
    const auto vector = [&](const json& v) { return Vector3d(v["x"], v["y"], v["z"]); };
    const json& q = one["rotation"];
    const Vector3d axis = Eigen::Quaterniond(q["w"], q["x"], q["y"], q["z"]) * Vector3d::UnitY();
    const double radius = one["radius"];
    const Vector3d half = (0.5 * one["height"].get<double>() - radius) * axis;
    const Vector3d ours(1, 1, -1), middle = vector(one["center"]);
    read[slotOf(*avatar.skeleton().find(one["joint"].get<std::string>()))].push_back(
        {(middle - half).cwiseProduct(ours), (middle + half).cwiseProduct(ours), radius});
  }
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    expectHeld(avatar.lss(link), read[slotOf(link)], kFloats, avatar.skeleton().name(link));
  }
}

/// A GLB's JSON, and all behind it.
std::pair<json, std::string> partsOf(const std::string& glb) {
  std::uint32_t bytes = 0;
  std::memcpy(&bytes, glb.data() + 12, sizeof bytes);
  return {json::parse(glb.substr(20, bytes)), glb.substr(20 + bytes)};
}

/// Where VRM 0.x has spheres alone, the avatar's points are in one of them.
bool isIn(const std::vector<Lss>& spheres, const Vector3d& point) {
  return std::any_of(spheres.begin(), spheres.end(), [&](const Lss& sphere) {
    return (sphere.a - point).norm() <= sphere.radius + kReaders;
  });
}

TEST(Colliders, AreAddedToAVrmAvatarAndNothingElse) {
  for (const VrmVersion version : {VrmVersion::Old, VrmVersion::One}) {
    const TempFolder folder;
    const bool isOld = version == VrmVersion::Old;
    const std::string glb = vrmSample(version).file.glb(), body = folder.write("body.vrm", glb);
    const std::string file = folder / "body.json", more = folder / "more.vrm";
    ASSERT_EQ(runForetouch({"avatar", "mesh", body, "-o", file}).exitCode, 0);
    const Ended ended = runForetouch({"avatar", "colliders", file, "--into", body, "-o", more});
    ASSERT_EQ(ended.exitCode, 0) << ended.err;
    EXPECT_TRUE(holds(ended.err, "colliders that the file has already are not added")) << ended.err;
    EXPECT_EQ(holds(ended.err, "VRM 0.x has spheres alone"), isOld) << ended.err;

    const Avatar avatar = readAvatarFile(file).value(), read = readModel(more);
    int outside = 0, asked = 0;
    for (LinkId link = 0; link < avatar.numLinks(); ++link) {
      const auto& found = read.lss(*read.skeleton().find(avatar.skeleton().name(link)));
      for (const Lss& lss : avatar.lss(link)) {
        if (!isOld) {
          EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const Lss& one) {
            return lack(lss, one) <= kReaders;
          })) << avatar.skeleton().name(link);
        }
        Random random(static_cast<std::uint64_t>(link));
        std::vector<Lss> spheres;
        std::copy_if(found.begin(), found.end(), std::back_inserter(spheres),
                     [](const Lss& one) { return one.a == one.b; });
        for (int i = 0; isOld && i < 200; ++i, ++asked) {
          const double t = random.uniform(0.0, 1.0);
          const Vector3d point = lss.a + t * (lss.b - lss.a) + lss.radius * random.direction();
          outside += isIn(spheres, point) ? 0 : 1;
        }
      }
    }
    EXPECT_EQ(outside, 0) << asked;
    EXPECT_EQ(asked > 1000, isOld);

    auto [before, bytes] = partsOf(glb);
    auto [after, moreBytes] = partsOf(contentOf(more));
    EXPECT_EQ(bytes, moreBytes);
    const json::json_pointer place(isOld ? "/extensions/VRM/secondaryAnimation"
                                         : "/extensions/VRMC_springBone");
    const json& springs = after[place][isOld ? "boneGroups" : "springs"][0];
    EXPECT_GT(springs["colliderGroups"].size(), isOld ? 10u : 0u);
    EXPECT_EQ(after[place][isOld ? "colliderGroups" : "colliders"][0],
              before[place][isOld ? "colliderGroups" : "colliders"][0]);
    after[place] = before[place] = nullptr;
    EXPECT_EQ(after, before);
  }
}

/// A bone that is scaled: whether a reader scales its colliders' radii or leaves them as they are.
TEST(Colliders, OfScaledBonesHoldTheLssEitherWay) {
  for (const double scale : {0.5, 2.0}) {
    const TempFolder folder;
    VrmSample sample = vrmSample(VrmVersion::One);
    sample.file.root["nodes"][sample.nodeOf.at("leftHand")]["scale"] = {scale, scale, scale};
    const std::string body = folder.write("body.vrm", sample.file.glb());
    const std::string file = folder / "body.json", more = folder / "more.vrm";
    ASSERT_EQ(runForetouch({"avatar", "mesh", body, "-o", file}).exitCode, 0);
    const Ended ended = runForetouch(
        {"avatar", "colliders", file, "--into", body, "-o", more, "--links", "leftHand"});
    ASSERT_EQ(ended.exitCode, 0) << ended.err;
    EXPECT_TRUE(holds(ended.err, "bones are scaled")) << ended.err;
    const Avatar avatar = readAvatarFile(file).value(), read = readModel(more);
    const LinkId hand = *avatar.skeleton().find("leftHand");
    const Lss lss = avatar.lss(hand).front();
    for (const Lss& one : avatar.lss(hand)) {
      const auto& found = read.lss(*read.skeleton().find("leftHand"));
      EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                              [&](const Lss& each) { return lack(one, each) <= 1e-9; }));
    }
    const auto after = partsOf(contentOf(more)).first;
    for (const json& collider : after["extensions"]["VRMC_springBone"]["colliders"]) {
      if (collider["node"] != sample.nodeOf.at("leftHand")) continue;
      for (const json& shape : collider["shape"])
        EXPECT_GE(shape["radius"].get<double>(), lss.radius);
    }
  }
}

TEST(Colliders, OfSomeLinksAlone) {
  const Avatar avatar = drawnAvatar(1);
  const Made made(avatar, "body.glb", {"--links", "joint.1", "--links", "joint.8"});
  const Avatar read = readModel(made.file("body.glb"));
  EXPECT_EQ(read.numLss(), static_cast<int>(avatar.lss(1).size() + avatar.lss(8).size()));
  EXPECT_TRUE(holds(made.ended.err, "10 links have no colliders")) << made.ended.err;
}

TEST(Colliders, SayWhatIsWrong) {
  const TempFolder folder;
  const std::string body = folder.write("body.json", formatAvatar(drawnAvatar(2)));
  const std::string vrm = folder.write("other.vrm", vrmSample(VrmVersion::One).file.glb());
  const struct {
    std::vector<std::string> words;
    const char* said;
  } cases[] = {
      {{"-o", folder / "body.fbx"}, "expected a file that ends in .glb, .vrm, .xml (MJCF)"},
      {{"-o", folder / "body.vrm"}, "expected the VRM avatar to which the colliders are added"},
      {{"-o", folder / "body.glb", "--into", vrm}, "expected an output that ends in .vrm"},
      {{"-o", folder / "body.glb", "--links", "Hnad"}, "'Hnad', which names none"},
      {{"-o", vrm, "--into", vrm}, "other.vrm"},
      {{"-o", folder / "more.vrm", "--into", vrm},
       "expected the avatar that foretouch avatar mesh makes of this file"},
      {{"-o", folder / "body.tscn", "--godot", "5"}, "--godot"},
  };
  for (const auto& one : cases) {
    std::vector<std::string> words{"avatar", "colliders", body};
    words.insert(words.end(), one.words.begin(), one.words.end());
    const Ended ended = runForetouch(words);
    EXPECT_EQ(ended.exitCode, 2) << one.said;
    EXPECT_TRUE(holds(ended.err, one.said)) << ended.err;
  }
}

/// An avatar of the same bones that rests elsewhere is told from the file's own.
TEST(Colliders, RefuseAnAvatarThatRestsElsewhere) {
  const TempFolder folder;
  const std::string body = folder.write("body.vrm", vrmSample(VrmVersion::Old).file.glb());
  const std::string file = folder / "body.json";
  ASSERT_EQ(runForetouch({"avatar", "mesh", body, "-o", file, "--model-scale", "0.9"}).exitCode, 0);
  const Ended ended =
      runForetouch({"avatar", "colliders", file, "--into", body, "-o", folder / "more.vrm"});
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_TRUE(holds(ended.err, "m from its node")) << ended.err;
}

/// The JSON is changed in the program itself: it refuses what would take its stack, and survives
/// all.
TEST(Colliders, SurviveDamagedVrmAvatars) {
  const TempFolder folder;
  VrmSample sample = vrmSample(VrmVersion::One);
  const std::string body = folder.write("body.vrm", sample.file.glb()), file = folder / "body.json";
  ASSERT_EQ(runForetouch({"avatar", "mesh", body, "-o", file}).exitCode, 0);
  const auto add = [&](const std::string& vrm) {
    return runForetouch({"avatar", "colliders", file, "--into", vrm, "-o", folder / "more.vrm"});
  };
  json nested = json::array();
  for (int i = 0; i < 300; ++i) nested = json::array({nested});
  sample.file.root["extras"] = nested;
  const Ended deep = add(folder.write("deep.vrm", sample.file.glb()));
  EXPECT_EQ(deep.exitCode, 2);
  EXPECT_TRUE(holds(deep.err, "nests at most 256 deep")) << deep.err;
  sample.file.root.erase("extras");
  for (const char* const part : {"springs", "colliders", "colliderGroups"}) {
    VrmSample odd = vrmSample(VrmVersion::One);
    odd.extension("VRMC_springBone").erase(part);
    EXPECT_EQ(add(folder.write("odd.vrm", odd.file.glb())).exitCode, 0) << part;
  }
  const std::string whole = contentOf(body);
  int refused = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random(seed);
    std::string damaged = whole;
    for (int i = 0; i < 3; ++i) {
      damaged[static_cast<std::size_t>(random.below(4000))] = static_cast<char>(random.below(256));
    }
    const Ended ended = add(folder.write("damaged.vrm", damaged));
    EXPECT_EQ(ended.signal, 0) << seed;
    refused += ended.exitCode == 2 ? 1 : 0;
  }
  EXPECT_GT(refused, 20);
}

/// glTF of other hands: two radii, a scale, a collider that is its own bone, and shapes that are
/// none.
TEST(Colliders, OfGltfByOthersAreRead) {
  const auto gltf = [](const std::string& collider) {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[
      {"name":"arm","children":[1,2],"translation":[1,2,3],
       "extensions":{"KHR_physics_rigid_bodies":{"motion":{},"collider":{"geometry":{"shape":1}}}}},
      {"name":"pad","scale":[2,1,1],"translation":[0,0.5,0],"rotation":[0,0,0.7071067811865476,0.7071067811865476],
       "extensions":{"KHR_physics_rigid_bodies":{"collider":)" +
           collider + R"(}}},
      {"name":"box","extensions":{"KHR_physics_rigid_bodies":{"collider":{"geometry":{"shape":2}}}}}],
      "extensionsUsed":["KHR_implicit_shapes","KHR_physics_rigid_bodies"],
      "extensions":{"KHR_implicit_shapes":{"shapes":[
        {"type":"capsule","capsule":{"height":0.6,"radiusBottom":0.1,"radiusTop":0.2}},
        {"type":"sphere","sphere":{"radius":0.3}},
        {"type":"box","box":{"size":[1,1,1]}}]}}})";
  };
  const TempFolder folder;
  const Model model =
      importModel(folder.write("a.gltf", gltf(R"({"geometry":{"shape":0}})")), withModelImporter())
          .value();
  const auto& arm = model.nodes[slotOf(nodeNamed(model, "arm"))];
  ASSERT_EQ(arm.lss.size(), 2u);
  EXPECT_EQ(arm.lss[0].radius, 0.3);
  // Along its y, which the turn takes to -x: a scale of its x alone makes it thicker.
  EXPECT_LT((arm.lss[1].a - Vector3d(0.3, 0.5, 0)).norm(), 1e-12);
  EXPECT_LT((arm.lss[1].b - Vector3d(-0.3, 0.5, 0)).norm(), 1e-12);
  EXPECT_NEAR(arm.lss[1].radius, 0.4, 1e-12);
  EXPECT_TRUE(std::any_of(model.notes.begin(), model.notes.end(), [](const std::string& note) {
    return holds(note, "1 colliders of KHR_physics_rigid_bodies are neither");
  }));
  for (const auto& [collider, said] :
       {std::pair(R"({"geometry":{"shape":9}})", "expected one of the 3 shapes"),
        std::pair(R"({"geometry":{"shape":"a"}})", "geometry.shape: expected")}) {
    const auto bad = importModel(folder.write("b.gltf", gltf(collider)), withModelImporter());
    ASSERT_FALSE(bad.ok());
    EXPECT_TRUE(holds(bad.error().message, said)) << bad.error().message;
  }
}

}  // namespace
}  // namespace foretouch::test
