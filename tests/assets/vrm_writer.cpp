#include "tests/assets/vrm_writer.h"

#include <cmath>
#include <utility>
#include <vector>

namespace foretouch::test {
namespace {

using Eigen::Affine3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using nlohmann::json;

struct Bone {
  std::string name, parent;
  Vector3d place;
};

std::vector<Bone> bones() {
  std::vector<Bone> all{{"hips", "root", {0, 1, 0}},         {"spine", "hips", {0, 1.1, 0}},
                        {"chest", "spine", {0, 1.25, 0.01}}, {"neck", "chest", {0, 1.5, 0}},
                        {"head", "neck", {0, 1.6, 0.01}},    {"SkirtBack", "hips", {0, 0.9, -0.15}},
                        {"hair", "head", {0, 1.75, -0.05}}};
  for (const double s : {1.0, -1.0}) {
    const std::string side = s > 0 ? "left" : "right";
    all.push_back({side + "UpperArm", "chest", {s * 0.2, 1.4, 0}});
    all.push_back({side + "LowerArm", side + "UpperArm", {s * 0.48, 1.4, -0.01}});
    all.push_back({side + "Hand", side + "LowerArm", {s * 0.72, 1.4, 0}});
    all.push_back({side + "ThumbMetacarpal", side + "Hand", {s * 0.74, 1.39, 0.03}});
    all.push_back({side + "UpperLeg", "hips", {s * 0.1, 0.95, 0}});
    all.push_back({side + "LowerLeg", side + "UpperLeg", {s * 0.1, 0.52, 0.01}});
    all.push_back({side + "Foot", side + "LowerLeg", {s * 0.1, 0.08, -0.01}});
  }
  return all;
}

std::vector<double> numbersOf(const Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

/// Any turn, another one for every number.
Quaterniond turnOf(std::size_t number) {
  const auto k = static_cast<double>(number);
  return Quaterniond(std::cos(k), std::sin(2 * k), std::cos(3 * k + 1), std::sin(k + 2))
      .normalized();
}

void addNode(VrmSample& sample, const std::string& key, const std::string& parent,
             const std::string& name, const Affine3d& world) {
  const Affine3d local =
      parent.empty() ? world : Affine3d(sample.frameOf.at(parent).inverse() * world);
  const Quaterniond q(local.linear());
  const std::size_t index = sample.file.root["nodes"].size();
  sample.file.node({{"name", name},
                    {"translation", numbersOf(local.translation())},
                    {"rotation", {q.x(), q.y(), q.z(), q.w()}}},
                   parent.empty());
  if (!parent.empty()) {
    sample.file.root["nodes"][sample.nodeOf.at(parent)]["children"].push_back(index);
  }
  sample.nodeOf[key] = index;
  sample.frameOf[key] = world;
}

/// A triangle at every bone, which moves with it.
void addSkin(VrmSample& sample, const std::vector<Bone>& all) {
  std::vector<double> places, joints, weights, inverses;
  json nodes = json::array();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Affine3d& world = sample.frameOf.at(all[i].name);
    for (int corner = 0; corner < 3; ++corner) {
      const Vector3d p = world.translation() + 0.03 * Vector3d::Unit(corner);
      places.insert(places.end(), {p.x(), p.y(), p.z()});
      joints.insert(joints.end(), {static_cast<double>(i), 0, 0, 0});
      weights.insert(weights.end(), {1, 0, 0, 0});
    }
    const Eigen::Matrix4d inverse = world.inverse().matrix();
    inverses.insert(inverses.end(), inverse.data(), inverse.data() + 16);
    nodes.push_back(sample.nodeOf.at(all[i].name));
  }
  AccessorWay asJoints;
  asJoints.type = Stored::UByte;
  const json attributes{{"POSITION", sample.file.accessor(places, 3)},
                        {"JOINTS_0", sample.file.accessor(joints, 4, asJoints)},
                        {"WEIGHTS_0", sample.file.accessor(weights, 4)}};
  sample.file.meshNode({{"attributes", attributes}}, "skin")["skin"] = 0;
  sample.file.root["skins"] = {
      {{"joints", nodes}, {"inverseBindMatrices", sample.file.accessor(inverses, 16)}}};
}

void addVrm(VrmSample& sample, const std::vector<Bone>& all) {
  json humanBones;
  for (const Bone& bone : all) {
    if (bone.name == "SkirtBack" || bone.name == "hair") continue;
    humanBones[bone.name] = {{"node", sample.nodeOf.at(bone.name)}};
  }
  sample.file.root["extensionsUsed"] = {"VRMC_vrm", "VRMC_springBone", "VRMC_node_constraint",
                                        "VRMC_springBone_extended_collider"};
  sample.extension("VRMC_vrm") = {{"specVersion", "1.0"},
                                  {"humanoid", {{"humanBones", humanBones}}}};
  const auto extended = [&](const char* node, const json& shape) {
    return json{
        {"node", sample.nodeOf.at(node)},
        {"shape", {{"sphere", {{"offset", {0, -10000, 0}}, {"radius", 0}}}}},
        {"extensions",
         {{"VRMC_springBone_extended_collider", {{"specVersion", "1.0"}, {"shape", shape}}}}}};
  };
  const json sphere{{"node", sample.nodeOf.at("head")},
                    {"shape", {{"sphere", {{"offset", {0.01, 0.08, 0.02}}, {"radius", 0.1}}}}}};
  const json capsule{
      {"node", sample.nodeOf.at("leftUpperArm")},
      {"shape",
       {{"capsule", {{"offset", {0.02, 0, 0.01}}, {"tail", {0.25, 0.01, 0}}, {"radius", 0.05}}}}}};
  sample.extension("VRMC_springBone") = {
      {"specVersion", "1.0"},
      {"colliders",
       {sphere, capsule, extended("hips", {{"plane", {{"normal", {0, 1, 0}}}}}),
        extended("chest", {{"sphere", {{"radius", 0.5}, {"inside", true}}}}),
        extended("neck", {{"sphere", {{"radius", 0.06}, {"offset", {0, 0.02, 0}}}}})}},
      {"springs",
       {{{"joints",
          {{{"node", sample.nodeOf.at("hair")}}, {{"node", sample.nodeOf.at("SkirtBack")}}}}}}}};
  sample.file.root["nodes"][sample.nodeOf.at("SkirtBack")]["extensions"]["VRMC_node_constraint"] = {
      {"specVersion", "1.0"},
      {"constraint", {{"rotation", {{"source", sample.nodeOf.at("hips")}}}}}};
}

void addOldVrm(VrmSample& sample, const std::vector<Bone>& all) {
  json humanBones = json::array();
  for (const Bone& bone : all) {
    if (bone.name == "SkirtBack" || bone.name == "hair") continue;
    // What VRM 1.0 calls the metacarpal.
    const std::size_t thumb = bone.name.find("ThumbMetacarpal");
    const std::string name =
        thumb == std::string::npos ? bone.name : bone.name.substr(0, thumb) + "ThumbProximal";
    humanBones.push_back({{"bone", name}, {"node", sample.nodeOf.at(bone.name)}});
  }
  sample.file.root["extensionsUsed"] = {"VRM"};
  const json offset{{"x", 0.01}, {"y", 0.08}, {"z", 0.03}};
  const json group{{"node", sample.nodeOf.at("head")},
                   {"colliders", {{{"offset", offset}, {"radius", 0.1}}}}};
  const json moved{{"stiffiness", 1},
                   {"gravityDir", {{"x", 0}, {"y", -1}, {"z", 0}}},
                   {"bones", {sample.nodeOf.at("hair"), sample.nodeOf.at("SkirtBack")}},
                   {"colliderGroups", {0}}};
  sample.extension("VRM") = {
      {"specVersion", "0.0"},
      {"humanoid", {{"humanBones", humanBones}}},
      {"secondaryAnimation", {{"boneGroups", {moved}}, {"colliderGroups", {group}}}}};
}

}  // namespace

Vector3d placeInTPose(const std::string& wanted) {
  for (const Bone& bone : bones()) {
    if (bone.name == wanted) return bone.place;
  }
  return Vector3d::Constant(std::nan(""));
}

VrmSample vrmSample(VrmVersion version) {
  const bool isOld = version == VrmVersion::Old;
  const std::vector<Bone> all = bones();
  VrmSample sample;
  Affine3d root = Affine3d::Identity();
  if (!isOld) root = Eigen::Translation3d(0.1, 0.2, 0.3) * turnOf(1);
  addNode(sample, "root", "", "root", root);
  for (std::size_t i = 0; i < all.size(); ++i) {
    Affine3d world = Affine3d::Identity();
    world.translation() = all[i].place;
    if (isOld) {
      world.translation().x() *= -1;
      world.translation().z() *= -1;
    } else {
      world.linear() = turnOf(i + 2).toRotationMatrix();
    }
    const bool isBone = all[i].name != "SkirtBack" && all[i].name != "hair";
    const std::string number = (i < 10 ? "0" : "") + std::to_string(i);
    addNode(sample, all[i].name, all[i].parent, isBone ? "Bone" + number : all[i].name, world);
  }
  addSkin(sample, all);
  isOld ? addOldVrm(sample, all) : addVrm(sample, all);
  return sample;
}

}  // namespace foretouch::test
