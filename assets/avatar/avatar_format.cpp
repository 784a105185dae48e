// assets/avatar/avatar_format.cpp: the writing half of assets/avatar/avatar_file.h.
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "assets/avatar/avatar_file.h"

namespace foretouch {
namespace {

/// Shortest text that reads back as the same double. "-0" would read back as the integer 0.
std::string numberText(double value) {
  return value == 0.0 && std::signbit(value) ? "-0.0" : fmt::format("{}", value);
}

std::string vectorText(const Eigen::Vector3d& v) {
  return fmt::format("[{}, {}, {}]", numberText(v.x()), numberText(v.y()), numberText(v.z()));
}

/// In quotes, escaped. Names and paths of an Avatar are UTF-8, so this cannot fail.
std::string stringText(const std::string& text) {
  return nlohmann::json(text).dump();
}

bool isIdentity(const Quaternion& q) {  // bit for bit: a -0 must survive the file
  return q.w() == 1.0 && q.vec().isZero(0.0) && !std::signbit(q.x()) && !std::signbit(q.y()) &&
         !std::signbit(q.z());
}

std::string lssText(const std::vector<Lss>& list) {
  std::string out;
  for (const Lss& lss : list) {
    out += fmt::format("{}{{\"a\": {}, \"b\": {}, \"radius\": {}}}", out.empty() ? "" : ",\n    ",
                       vectorText(lss.a), vectorText(lss.b), numberText(lss.radius));
  }
  return out;
}

std::string linkText(const Avatar& avatar, LinkId link) {
  const Skeleton& skeleton = avatar.skeleton();
  const JointId parent = skeleton.parent(link);
  std::string out = fmt::format("  {{\"name\": {}, \"parent\": {}, \"offset\": {}",
                                stringText(skeleton.name(link)),
                                parent == kNoParent ? "null" : stringText(skeleton.name(parent)),
                                vectorText(skeleton.restOffset(link)));
  const Quaternion& q = skeleton.restRotation(link);
  if (!isIdentity(q)) {
    out += fmt::format(", \"rotation\": [{}, {}, {}, {}]", numberText(q.w()), numberText(q.x()),
                       numberText(q.y()), numberText(q.z()));
  }
  out += fmt::format(",\n   \"lss\": [{}]", lssText(avatar.lss(link)));
  const MeshReference& mesh = avatar.mesh(link);
  if (!mesh.file.empty()) {
    out += fmt::format(",\n   \"mesh\": {{\"file\": {}, \"node\": {}}}", stringText(mesh.file),
                       stringText(mesh.node));
  }
  return out + "}";
}

}  // namespace

std::string formatAvatar(const Avatar& avatar) {
  std::string out = "{\"format\": \"foretouch-avatar\", \"version\": 1,\n \"links\": [\n";
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    out += linkText(avatar, link) + (link + 1 < avatar.numLinks() ? ",\n" : "\n");
  }
  return out + " ]}\n";
}

}  // namespace foretouch
