// What our reader makes of a model, as JSON on standard output, for oracle.mjs to compare.
//   read_model FILE [DURATION...]
// {"nodes": [[name, x, y, z]...], "vertices": [[x, y, z]...], "lss": [[x, y, z, x, y, z, r]...],
//  "stated": [[...]...] (of those the file's own, as its nodes hold them),
//  "notes": [...], "animations": [{"name", "duration", "instants": [{"joints": [[name, x, y,
//  z]...], "vertices": [[x, y, z]...]}...]}...]}, or {"error": "..."}.
// All in the world, metres; vertices with their skins. The instants divide an animation's duration,
// or the one that is given for it.
#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <nlohmann/json.hpp>

#include "articulated/motion.h"
#include "assets/import/model_import.h"
#include "assets/model/model_avatar.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

constexpr int kInstants = 8;

json numbers(const Vector3d& p) {
  return json::array({p.x(), p.y(), p.z()});
}

json named(const std::string& name, const Vector3d& p) {
  return json::array({name, p.x(), p.y(), p.z()});
}

std::vector<Affine> placesOf(const Model& model) {
  std::vector<Affine> places;
  for (const ModelNode& node : model.nodes) {
    places.push_back(node.parent < 0
                         ? node.toParent
                         : places[static_cast<std::size_t>(node.parent)] * node.toParent);
  }
  return places;
}

/// Of all triangles, by linear blending where there is a skin.
void addVertices(const ModelMesh& mesh, const std::vector<Affine>& places, json& vertices) {
  std::vector<Vector3d> sums(mesh.vertices.size(), Vector3d::Zero());
  std::vector<double> weights(mesh.vertices.size(), 0.0);
  for (const ModelBone& bone : mesh.bones) {
    if (bone.node < 0) continue;
    const Affine toWorld = places[static_cast<std::size_t>(bone.node)] * bone.meshToBone;
    for (const auto& [vertex, weight] : bone.weights) {
      const auto v = static_cast<std::size_t>(vertex);
      sums[v] += weight * (toWorld * mesh.vertices[v]);
      weights[v] += weight;
    }
  }
  std::set<std::int32_t> used;
  for (const auto& triangle : mesh.triangles) used.insert(triangle.begin(), triangle.end());
  for (const std::int32_t vertex : used) {
    const auto v = static_cast<std::size_t>(vertex);
    vertices.push_back(
        numbers(weights[v] > 0.0 ? Vector3d(sums[v] / weights[v])
                                 : places[static_cast<std::size_t>(mesh.node)] * mesh.vertices[v]));
  }
}

json verticesOf(const Model& model, const std::vector<Affine>& places) {
  json vertices = json::array();
  for (const ModelMesh& mesh : model.meshes) addVertices(mesh, places, vertices);
  return vertices;
}

std::vector<LinkState> statesIn(const Skeleton& skeleton, const Pose& pose) {
  std::vector<LinkState> states;
  ChainMotion(skeleton, pose, pose).statesAt(0.0, states);
  return states;
}

/// Every node as the nearest link above it carries it.
std::vector<Affine> placesIn(const Model& model, const ModelAvatar& made,
                             const std::vector<LinkState>& states) {
  const Skeleton& skeleton = made.avatar.skeleton();
  const std::vector<LinkState> rest = statesIn(skeleton, restPose(skeleton));
  std::vector<Affine> places = placesOf(model);
  std::vector<std::int32_t> links(places.size(), -1);
  for (std::size_t link = 0; link < made.nodeOfLink.size(); ++link) {
    links[static_cast<std::size_t>(made.nodeOfLink[link])] = static_cast<std::int32_t>(link);
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::int32_t parent = model.nodes[i].parent;
    if (links[i] < 0 && parent >= 0) links[i] = links[static_cast<std::size_t>(parent)];
    if (links[i] < 0) continue;
    const auto link = static_cast<std::size_t>(links[i]);
    const Eigen::Matrix3d turn =
        Eigen::Matrix3d(states[link].R_WL) * Eigen::Matrix3d(rest[link].R_WL).transpose();
    places[i] = Affine{turn, states[link].p_WL - turn * rest[link].p_WL} * places[i];
  }
  return places;
}

/// A link has those that its node states first.
json lssIn(const Model& model, const ModelAvatar& made, const std::vector<LinkState>& states,
           bool statedAlone) {
  json all = json::array();
  for (std::int32_t link = 0; link < made.avatar.numLinks(); ++link) {
    const auto l = static_cast<std::size_t>(link);
    const LinkState& state = states[l];
    std::vector<Lss> shown = made.avatar.lss(link);
    if (statedAlone)
      shown.resize(model.nodes[static_cast<std::size_t>(made.nodeOfLink[l])].lss.size());
    for (const Lss& lss : shown) {
      const Vector3d a = state.p_WL + state.R_WL * lss.a, b = state.p_WL + state.R_WL * lss.b;
      all.push_back(json::array({a.x(), a.y(), a.z(), b.x(), b.y(), b.z(), lss.radius}));
    }
  }
  return all;
}

/// Links are rigid: a scale that changes is not followed.
bool changesScale(const ModelAnimation& animation) {
  return std::any_of(animation.tracks.begin(), animation.tracks.end(), [](const ModelTrack& track) {
    return std::any_of(track.scales.begin(), track.scales.end(), [&track](const auto& key) {
      return (key.value - track.scales[0].value).norm() > 1e-6;
    });
  });
}

json animationOf(const Model& model, std::size_t number, double durationS,
                 const ModelAvatar* made) {
  ModelClipOptions options;
  options.animation = std::to_string(number);
  options.rateHz = durationS > 0.0 ? (kInstants - 1) / durationS : 1.0;
  const auto clip = clipFromModel(model, options);
  if (!clip.ok()) return {{"error", describe(clip.error())}};
  json instants = json::array();
  const auto& [skeleton, frames] = std::tie(clip.value().skeleton, clip.value().frames);
  for (std::size_t f = 0; f < std::min<std::size_t>(frames.size(), kInstants); ++f) {
    const std::vector<LinkState> states = statesIn(skeleton, frames[f]);
    json joints = json::array();
    for (std::size_t j = 0; j < states.size(); ++j) {
      joints.push_back(named(skeleton.name(static_cast<JointId>(j)), states[j].p_WL));
    }
    instants.push_back({{"joints", joints}});
    if (made != nullptr) {
      instants.back()["vertices"] = verticesOf(model, placesIn(model, *made, states));
    }
  }
  return {{"name", model.animations[number].name},
          {"duration", durationS},
          {"changes_scale", changesScale(model.animations[number])},
          {"instants", instants}};
}

json reading(const std::string& path, const std::vector<double>& durations) {
  const auto imported = importModel(path);
  if (!imported.ok()) return {{"error", describe(imported.error())}};
  const Model& model = imported.value();
  const std::vector<Affine> places = placesOf(model);
  json said = {{"nodes", json::array()},      {"vertices", verticesOf(model, places)},
               {"lss", json::array()},        {"stated", json::array()},
               {"animations", json::array()}, {"notes", model.notes}};
  for (std::size_t i = 0; i < places.size(); ++i) {
    said["nodes"].push_back(named(model.nodes[i].name, places[i].translation));
  }
  const auto made = avatarFromModel(model);  // what has no surface makes none
  if (made.ok()) {
    const Skeleton& skeleton = made.value().avatar.skeleton();
    const std::vector<LinkState> states = statesIn(skeleton, restPose(skeleton));
    said["lss"] = lssIn(model, made.value(), states, false);
    said["stated"] = lssIn(model, made.value(), states, true);
  }
  for (std::size_t i = 0; i < model.animations.size(); ++i) {
    const double durationS = i < durations.size() ? durations[i] : model.animations[i].durationS;
    said["animations"].push_back(
        animationOf(model, i, durationS, made.ok() ? &made.value() : nullptr));
  }
  return said;
}

}  // namespace
}  // namespace foretouch

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "read_model FILE [DURATION...]\n";
    return 2;
  }
  std::vector<double> durations;
  for (int i = 2; i < argc; ++i) durations.push_back(std::strtod(argv[i], nullptr));
  std::cout << foretouch::reading(argv[1], durations) << "\n";
}
