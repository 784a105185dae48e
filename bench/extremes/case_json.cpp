#include "bench/extremes/case_json.h"

#include <cmath>
#include <cstddef>
#include <set>

#include <nlohmann/json.hpp>

namespace foretouch::tools::extremes {
namespace {

using Json = nlohmann::ordered_json;
constexpr std::size_t kManyTriangles = 1000;

Json numberJson(double x) {
  if (std::isnan(x)) return "nan";
  if (std::isinf(x)) return x > 0.0 ? "inf" : "-inf";
  return x;
}
Json pointJson(const Eigen::Vector3d& p) {
  return Json::array({numberJson(p.x()), numberJson(p.y()), numberJson(p.z())});
}
Json rotationJson(const Quaternion& q) {
  return Json::array({numberJson(q.w()), numberJson(q.x()), numberJson(q.y()), numberJson(q.z())});
}
Json triangleJson(const Triangle& t) {
  return Json::array(
      {pointJson(t.vertices[0]), pointJson(t.vertices[1]), pointJson(t.vertices[2])});
}

Json poseJson(const Pose& pose) {
  Json rotations = Json::array(), translations = Json::array();
  for (const Quaternion& q : pose.rotations) rotations.push_back(rotationJson(q));
  for (const Eigen::Vector3d& p : pose.translations) translations.push_back(pointJson(p));
  return {{"rotations_wxyz", rotations}, {"translations_m", translations}};
}

Json linksJson(const ExtremeCase& extreme) {
  Json links = Json::array();
  for (std::size_t j = 0; j < extreme.skeleton.joints.size(); ++j) {
    const RawJoint& joint = extreme.skeleton.joints[j];
    Json lss = Json::array(), surface = Json::array();
    if (j < extreme.lss.size()) {
      for (const Lss& one : extreme.lss[j]) {
        lss.push_back(
            {{"a", pointJson(one.a)}, {"b", pointJson(one.b)}, {"radius", numberJson(one.radius)}});
      }
    }
    if (j < extreme.surface.size()) {
      for (const Triangle& t : extreme.surface[j]) surface.push_back(triangleJson(t));
    }
    links.push_back({{"name", joint.name},
                     {"parent", joint.parent},
                     {"offset", pointJson(joint.offset)},
                     {"rotation_wxyz", rotationJson(joint.rotation)},
                     {"lss", lss},
                     {"surface", surface}});
  }
  return links;
}

Json sceneJson(const RawScene& scene) {
  const bool isMany = scene.triangles.size() > kManyTriangles;
  Json triangles = Json::array();
  std::set<std::string> seen;
  for (const Triangle& t : scene.triangles) {
    const Json one = triangleJson(t);
    if (!isMany || seen.insert(one.dump()).second) triangles.push_back(one);
  }
  return {{"count", scene.triangles.size()}, {"triangles", triangles}};
}

}  // namespace

std::string casesJson(const std::vector<ExtremeCase>& cases) {
  Json list = Json::array();
  for (const ExtremeCase& extreme : cases) {
    list.push_back({{"family", extreme.family},
                    {"member", extreme.member},
                    {"seed", extreme.seed},
                    {"tolerance_m", numberJson(extreme.tolerance)},
                    {"links", linksJson(extreme)},
                    {"from", poseJson(extreme.from)},
                    {"to", poseJson(extreme.to)},
                    {"scene", sceneJson(extreme.scene)}});
  }
  const Json document = {{"format", "foretouch-extremes"}, {"version", 1}, {"cases", list}};
  return document.dump(1) + "\n";
}

}  // namespace foretouch::tools::extremes
