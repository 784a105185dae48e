// assets/avatar/avatar_format.cpp: the writing half of assets/avatar/avatar_file.h.
#include <cmath>

#include <fmt/format.h>

#include "assets/avatar/avatar_file.h"
#include "assets/json_writer.h"

namespace foretouch {
namespace {

/// Shortest text that reads back as the same double. "-0" would read back as the integer 0.
std::string signedText(double value) {
  return value == 0.0 && std::signbit(value) ? "-0.0" : fmt::format("{}", value);
}

std::string vectorText(const Eigen::Vector3d& v) {
  return fmt::format("[{}, {}, {}]", signedText(v.x()), signedText(v.y()), signedText(v.z()));
}

bool isIdentity(const Quaternion& q) {  // bit for bit: a -0 must survive the file
  return q.w() == 1.0 && q.vec().isZero(0.0) && !std::signbit(q.x()) && !std::signbit(q.y()) &&
         !std::signbit(q.z());
}

std::string lssText(const std::vector<Lss>& list) {
  std::string out;
  for (const Lss& lss : list) {
    out += fmt::format("{}{{\"a\": {}, \"b\": {}, \"radius\": {}}}", out.empty() ? "" : ",\n    ",
                       vectorText(lss.a), vectorText(lss.b), signedText(lss.radius));
  }
  return out;
}

std::string linkText(const Avatar& avatar, LinkId link) {
  const Skeleton& skeleton = avatar.skeleton();
  const JointId parent = skeleton.parent(link);
  std::string out = fmt::format("  {{\"name\": {}, \"parent\": {}, \"offset\": {}",
                                jsonString(skeleton.name(link)),
                                parent == kNoParent ? "null" : jsonString(skeleton.name(parent)),
                                vectorText(skeleton.restOffset(link)));
  const Quaternion& q = skeleton.restRotation(link);
  if (!isIdentity(q)) {
    out += fmt::format(", \"rotation\": [{}, {}, {}, {}]", signedText(q.w()), signedText(q.x()),
                       signedText(q.y()), signedText(q.z()));
  }
  out += fmt::format(",\n   \"lss\": [{}]", lssText(avatar.lss(link)));
  const MeshReference& mesh = avatar.mesh(link);
  if (!mesh.file.empty()) {
    out += fmt::format(",\n   \"mesh\": {{\"file\": {}, \"node\": {}}}", jsonString(mesh.file),
                       jsonString(mesh.node));
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
