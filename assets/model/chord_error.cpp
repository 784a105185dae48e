#include "assets/model/chord_error.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "assets/model/model_frames.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// How far from a node what it carries reaches at rest, m: its own vertices, and all nodes below it
/// with theirs. From above, by the triangle inequality.
std::vector<double> reachesOf(const Model& model, const std::vector<Affine>& world) {
  std::vector<double> reach(model.nodes.size(), 0.0);
  const auto extend = [&](std::int32_t node, const Affine& toWorld, const Vector3d& vertex) {
    const double distance = (toWorld * vertex - world[slotOf(node)].translation).norm();
    if (std::isfinite(distance)) reach[slotOf(node)] = std::max(reach[slotOf(node)], distance);
  };
  for (const ModelMesh& mesh : model.meshes) {
    if (mesh.bones.empty()) {
      for (const Vector3d& vertex : mesh.vertices) {
        extend(mesh.node, world[slotOf(mesh.node)], vertex);
      }
    }
    for (const ModelBone& bone : mesh.bones) {
      if (bone.node < 0) continue;
      const Affine toWorld = world[slotOf(bone.node)] * bone.meshToBone;
      for (const auto& weight : bone.weights) {
        extend(bone.node, toWorld, mesh.vertices[slotOf(weight.vertex)]);
      }
    }
  }
  for (std::size_t i = model.nodes.size(); i > 0; --i) {
    const std::int32_t parent = model.nodes[i - 1].parent;
    if (parent < 0) continue;
    const double bone = (world[i - 1].translation - world[slotOf(parent)].translation).norm();
    reach[slotOf(parent)] = std::max(reach[slotOf(parent)], bone + reach[i - 1]);
  }
  return reach;
}

/// The part of a track's frame that turns.
Quaternion turnOf(const Affine& frame) {
  return Quaternion(nearestRotation(frame.linear));
}

/// What a track contributes between two instants: metres, and radians.
struct Off {
  double shift = 0.0, turn = 0.0;
};

Off offBetween(const SampledTrack& track, double fromS, double toS) {
  const Affine from = track.at(fromS), to = track.at(toS);
  const Quaternion fromTurn = turnOf(from), toTurn = turnOf(to);
  Off off;
  for (const double share : {0.25, 0.5, 0.75}) {
    const Affine on = track.at(fromS + share * (toS - fromS));
    const Vector3d chord = from.translation + share * (to.translation - from.translation);
    off.shift = std::max(off.shift, (on.translation - chord).norm());
    off.turn = std::max(off.turn, turnOf(on).angularDistance(fromTurn.slerp(share, toTurn)));
  }
  return off;
}

}  // namespace

double chordErrorOf(const Model& model, const std::vector<SampledTrack>& tracks, std::size_t frames,
                    double rateHz) {
  std::vector<const SampledTrack*> splines;
  for (const SampledTrack& track : tracks) {
    if (track.isCubic()) splines.push_back(&track);
  }
  if (splines.empty()) return 0.0;
  const std::vector<Affine> world = worldFrames(model, restFrames(model));
  const std::vector<double> reach = reachesOf(model, world);
  double worst = 0.0;
  std::vector<double> off(model.nodes.size());
  for (std::size_t i = 0; i + 1 < frames; ++i) {
    std::fill(off.begin(), off.end(), 0.0);
    for (const SampledTrack* const track : splines) {
      const auto [shift, turn] =
          offBetween(*track, static_cast<double>(i) / rateHz, static_cast<double>(i + 1) / rateHz);
      const std::int32_t parent = model.nodes[slotOf(track->node())].parent;
      const double scale =
          parent < 0 ? 1.0 : world[slotOf(parent)].linear.colwise().norm().maxCoeff();
      off[slotOf(track->node())] += scale * shift + turn * reach[slotOf(track->node())];
    }
    for (std::size_t n = 0; n < off.size(); ++n) {
      const std::int32_t parent = model.nodes[n].parent;
      if (parent >= 0) off[n] += off[slotOf(parent)];
      worst = std::max(worst, off[n]);
    }
  }
  return worst;
}

}  // namespace foretouch::internal
