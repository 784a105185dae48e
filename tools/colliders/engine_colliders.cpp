// Scenes of Godot and JSON for Unity: tools/colliders/collider_writers.h.
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "assets/json_writer.h"
#include "lss/index.h"
#include "tools/colliders/capsule_forms.h"
#include "tools/colliders/collider_writers.h"

namespace foretouch::tools {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// What Godot takes for a path, in names of bones and of nodes (Skeleton::add_bone(),
/// String::invalid_node_name_characters).
constexpr std::string_view kNotInBones = ":/", kNotInNodes = ".:@/\"%";

/// Makes names differ from each other, with '_' for what may not be in them.
class GodotNames {
 public:
  explicit GodotNames(std::string_view illegal) : illegal_(illegal) {}
  std::string operator()(std::string name) {
    for (char& c : name) {
      if (illegal_.find(c) != std::string_view::npos) c = '_';
    }
    const std::string base = name;
    for (int n = 2; !taken_.insert(name).second; ++n) name = base + '_' + std::to_string(n);
    return name;
  }

 private:
  std::string_view illegal_;
  std::set<std::string> taken_;
};

/// What Godot 3 and 4 call the same things.
struct GodotWords {
  int format;
  const char *node, *skeleton, *attachment, *body, *shape, *capsule, *sphere, *transform;
};
constexpr GodotWords kGodot3{2,
                             "Spatial",
                             "Skeleton",
                             "BoneAttachment",
                             "KinematicBody",
                             "CollisionShape",
                             "CapsuleShape",
                             "SphereShape",
                             "Transform"};
constexpr GodotWords kGodot4{3,
                             "Node3D",
                             "Skeleton3D",
                             "BoneAttachment3D",
                             "AnimatableBody3D",
                             "CollisionShape3D",
                             "CapsuleShape3D",
                             "SphereShape3D",
                             "Transform3D"};

class GodotScene {
 public:
  GodotScene(const Avatar& avatar, GodotVersion version)
      : avatar_(avatar),
        isFour_(version == GodotVersion::Four),
        words_(isFour_ ? kGodot4 : kGodot3) {}

  std::string text(const std::string& name, std::vector<std::string>& notes) {
    std::string nodes = node(GodotNames(kNotInNodes)(name), words_.node, "");
    nodes += node("Skeleton", words_.skeleton, ".") + skeleton();
    GodotNames attachments(kNotInNodes);
    for (LinkId link = 0; link < avatar_.numLinks(); ++link) {
      if (!avatar_.lss(link).empty()) nodes += attachment(link, attachments);
    }
    if (!renamed_.empty()) {
      notes.push_back(
          fmt::format("Godot takes no ':' and '/' in a bone's name: {} has '_' there", renamed_));
    }
    return fmt::format("[gd_scene load_steps={} format={}]\n", shapes_ + 1, words_.format) +
           resources_ + nodes;
  }

 private:
  static std::string quoted(const std::string& text) { return jsonString(text); }

  static std::string node(const std::string& name, const char* type, const std::string& parent) {
    const std::string place = parent.empty() ? "" : " parent=" + quoted(parent);
    return fmt::format("\n[node name={} type=\"{}\"{}]\n", quoted(name), type, place);
  }

  /// Rows of the basis, then the origin.
  [[nodiscard]] std::string transform(const Matrix3d& turn, const Vector3d& origin) const {
    std::string numbers;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) numbers += numberText(turn(row, column)) + ", ";
    }
    return fmt::format("{}({}{}, {}, {})", words_.transform, numbers, numberText(origin.x()),
                       numberText(origin.y()), numberText(origin.z()));
  }

  std::string skeleton() {
    const Skeleton& skeleton = avatar_.skeleton();
    GodotNames legal(kNotInBones);
    std::string text;
    for (LinkId link = 0; link < skeleton.numJoints(); ++link) {
      bones_.push_back(legal(skeleton.name(link)));
      if (renamed_.empty() && bones_.back() != skeleton.name(link))
        renamed_ = quoted(bones_.back());
      const Vector3d& offset = skeleton.restOffset(link);
      const Quaternion& q = skeleton.restRotation(link);
      const std::string rest = transform(turnMatrix(q, HeldAs::Floats), offset);
      const std::string bone = fmt::format("bones/{}/", link);
      text += fmt::format("{0}name = {1}\n{0}parent = {2}\n{0}rest = {3}\n{0}enabled = true\n",
                          bone, quoted(bones_.back()), skeleton.parent(link), rest);
      if (!isFour_) continue;
      text += fmt::format(
          "{0}position = Vector3({1}, {2}, {3})\n{0}rotation = Quaternion({4}, {5}, {6}, {7})\n"
          "{0}scale = Vector3(1, 1, 1)\n",
          bone, offset.x(), offset.y(), offset.z(), q.x(), q.y(), q.z(), q.w());
    }
    return text;
  }

  std::string attachment(LinkId link, GodotNames& names) {
    const std::string name = names(avatar_.skeleton().name(link));
    std::string text = node(name, words_.attachment, "Skeleton");
    text += "bone_name = " + quoted(bones_[slotOf(link)]) + "\n";
    if (isFour_) text += fmt::format("bone_idx = {}\n", link);
    text += node("Body", words_.body, "Skeleton/" + name);
    if (isFour_) text += "sync_to_physics = false\n";  // the bone leads it
    const auto& list = avatar_.lss(link);
    for (std::size_t i = 0; i < list.size(); ++i) {
      text += shape(list[i], fmt::format("Shape{}", i), "Skeleton/" + name + "/Body");
    }
    return text;
  }

  /// Godot 3's capsules lie along z and state the height between the caps' centres, Godot 4's stand
  /// along y and state the whole one; radius first, as either setter bounds the other number.
  std::string shape(const Lss& lss, const std::string& name, const std::string& parent) {
    const Vector3d axis = isFour_ ? Vector3d::UnitY() : Vector3d::UnitZ();
    const StandingCapsule c = standing(lss, axis, HeldAs::Floats);
    const bool isSphere = c.halfLength == 0.0;
    const std::string id = isFour_ ? fmt::format("\"{}\"", ++shapes_) : std::to_string(++shapes_);
    resources_ += fmt::format("\n[sub_resource type=\"{}\" id={}]\nradius = {}\n",
                              isSphere ? words_.sphere : words_.capsule, id, numberText(c.radius));
    if (!isSphere) {
      const double height = isFour_ ? wholeHeight(c, HeldAs::Floats) : 2.0 * c.halfLength;
      resources_ += "height = " + numberText(height) + "\n";
    }
    // Godot 3 writes these numbers without quotes.
    const std::string reference = isFour_ ? "SubResource(" + id + ")" : "SubResource( " + id + " )";
    return node(name, words_.shape, parent) +
           "transform = " + transform(turnMatrix(c.turn, HeldAs::Floats), c.middle) +
           "\nshape = " + reference + "\n";
  }

  const Avatar& avatar_;
  bool isFour_;
  const GodotWords& words_;
  std::vector<std::string> bones_;
  std::string resources_, renamed_;
  int shapes_ = 0;
};

/// Unity's x and y are ours, and its z points the other way: a mirror turns axes of rotation over.
void writeUnity(const char* name, const Vector3d& v, JsonWriter& out) {
  out.key(name);
  out.beginObject();
  out.field("x", v.x());
  out.field("y", v.y());
  out.field("z", -v.z());
  out.endObject();
}

void writeUnity(const char* name, const Quaternion& q, JsonWriter& out) {
  out.key(name);
  out.beginObject();
  out.field("x", -q.x());
  out.field("y", -q.y());
  out.field("z", q.z());
  out.field("w", q.w());
  out.endObject();
}

void writeUnityJoints(const Skeleton& skeleton, JsonWriter& out) {
  out.key("joints");
  out.beginArray();
  for (LinkId link = 0; link < skeleton.numJoints(); ++link) {
    const LinkId parent = skeleton.parent(link);
    out.beginObject();
    out.field("name", skeleton.name(link));
    out.field("parent", parent == kNoParent ? "" : skeleton.name(parent));
    writeUnity("position", skeleton.restOffset(link), out);
    writeUnity("rotation", skeleton.restRotation(link), out);
    out.endObject();
  }
  out.endArray();
}

}  // namespace

std::string godotColliders(const Avatar& avatar, const std::string& name, GodotVersion version,
                           std::vector<std::string>& notes) {
  return GodotScene(avatar, version).text(name, notes);
}

std::string unityColliders(const Avatar& avatar) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("format", "foretouch-unity-colliders");
  out.field("version", 1);
  writeUnityJoints(avatar.skeleton(), out);
  out.key("colliders");
  out.beginArray();
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    for (const Lss& lss : avatar.lss(link)) {
      const StandingCapsule c = standing(lss, Vector3d::UnitY(), HeldAs::Floats);
      out.beginObject();
      out.field("joint", avatar.skeleton().name(link));
      writeUnity("center", c.middle, out);
      writeUnity("rotation", c.turn, out);
      out.field("radius", c.radius);
      out.field("height", c.halfLength == 0.0 ? 2.0 * c.radius : wholeHeight(c, HeldAs::Floats));
      out.endObject();
    }
  }
  out.endArray();
  out.endObject();
  return text + "\n";
}

}  // namespace foretouch::tools
