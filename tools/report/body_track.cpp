#include "tools/report/body_track.h"

#include <algorithm>

#include "lss/fit.h"
#include "lss/index.h"

namespace foretouch::tools {

Result<Avatar> standInOf(const BodyShape& shape) {
  std::vector<Eigen::Vector3d> points;
  for (const Triangle& triangle : *shape.triangles) {
    points.insert(points.end(), triangle.vertices.begin(), triangle.vertices.end());
  }
  return Avatar::build(shape.skeleton, {{fitLss(points)}});
}

bool BodyTrack::addAll(std::size_t mostPoses) {
  for (std::size_t i = 0; i < body_.stretches.size(); ++i) {
    const bool isLast = i + 1 == body_.stretches.size();
    const std::int64_t endUs =
        isLast ? world_.endUs : std::min(world_.endUs, body_.stretches[i + 1].beginUs - 1);
    if (!addStretch(body_.stretches[i], endUs, mostPoses)) return false;
  }
  return true;
}

bool BodyTrack::addStretch(const BodyStretch& stretch, std::int64_t endUs, std::size_t mostPoses) {
  const Track& track = stretch.track;
  const bool goesOn =
      stretch.isHeldFast() || world_.file.bodies[slotOf(id_)].whenSilent == WhenSilent::HoldStill;
  const std::int64_t knownUs = goesOn ? endUs : std::min(endUs, track.knownUntilUs());
  if (knownUs < track.knownFromUs()) return true;  // it appears later than the page ends
  std::set<std::int64_t> instants{track.knownFromUs(), knownUs};
  addKnots(id_, track.knownFromUs(), knownUs, 0, instants);
  bool isFirst = true;
  for (const std::int64_t us : instants) {
    if (builder_.poses() >= mostPoses) return false;
    builder_.addPose(LoadedWorld::secondsOf(us), places_.poseAt(id_, us));
    const auto pose = static_cast<std::uint32_t>(builder_.poses()) - 1;
    if (!isFirst) builder_.addStep(pose - 1, pose);
    isFirst = false;
  }
  return true;
}

void BodyTrack::addKnots(BodyId body, std::int64_t fromUs, std::int64_t untilUs, int depth,
                         std::set<std::int64_t>& instants) const {
  constexpr int kDeepest = 16;  // a body with more carriers above it has longer steps
  const BodyStretches& stretches = world_.bodies[slotOf(body)].stretches;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const std::int64_t endUs = i + 1 < stretches.size() ? stretches[i + 1].beginUs : untilUs;
    const std::int64_t firstUs = std::max(fromUs, stretches[i].beginUs);
    const std::int64_t lastUs = std::min(untilUs, endUs);
    if (lastUs <= firstUs) continue;
    if (stretches[i].isHeldFast()) {
      if (depth < kDeepest) {
        addKnots(stretches[i].carrier->body, firstUs, lastUs, depth + 1, instants);
      }
      continue;
    }
    const Track& track = stretches[i].track;
    for (std::int64_t us = track.nextKnotUs(firstUs); us < lastUs; us = track.nextKnotUs(us)) {
      instants.insert(us);
    }
  }
}

}  // namespace foretouch::tools
