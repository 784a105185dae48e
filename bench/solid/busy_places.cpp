#include "bench/solid/busy_places.h"

#include <algorithm>

#include "judge/heights.h"
#include "tools/portable_random.h"

namespace foretouch::tools {
namespace {

constexpr int kProbes = 24;
constexpr double kMostClearance = 0.03;  ///< The clip's lowest point above the surface (m).

class PlaceDraws {
 public:
  PlaceDraws(const SolidStage& stage, const SolidActor& actor, const BusyPlaceRequest& request)
      : stage_(stage),
        actor_(actor),
        request_(request),
        random_(request.seed),
        judge_(stage.judged, plainBody(actor.avatar)) {}

  /// A place, or none where the draw is outside of the scene, or not busy.
  bool draw(BusyPlace& place) {
    const oracle::Box& box = stage_.judged.box();
    const double x = random_.uniform(box.low.x, box.high.x),
                 z = random_.uniform(box.low.z, box.high.z);
    const double longest = std::max(0.0, actor_.clip.durationS() - request_.seconds);
    place.fromS = random_.uniform(0.0, longest);
    place.placement.yawDeg = random_.uniform(-180.0, 180.0);
    const bool isLowest = random_.uniform(0.0, 1.0) < 0.5;
    const double level = random_.uniform(0.0, 1.0),
                 clearance = random_.uniform(0.0, kMostClearance);
    const std::vector<double> heights = oracle::heightsAt(stage_.judged, x, z);
    if (heights.empty()) return false;
    const auto any = static_cast<std::size_t>(level * static_cast<double>(heights.size()));
    const double y = heights[isLowest ? 0 : std::min(any, heights.size() - 1)];
    stand(place, {x, y + clearance - actor_.lowestM, z});
    return isBusy(place);
  }

 private:
  /// The first root above (x, z), as the clip stands at its first pose there.
  void stand(BusyPlace& place, const Eigen::Vector3d& at) const {
    place.placement.origin.setZero();
    const auto poses = trackedPoses(actor_, place.placement, 1.0, place.fromS, 0.0);
    const Eigen::Vector3d root = poses.empty() ? at : poses.front().translations.front();
    place.placement.origin = {at.x() - root.x(), at.y(), at.z() - root.z()};
  }

  bool isBusy(BusyPlace& place) {
    const double rate = (kProbes - 1) / request_.seconds;
    int inside = 0, looked = 0;
    for (const Pose& pose :
         trackedPoses(actor_, place.placement, rate, place.fromS, request_.seconds)) {
      const bool isInside = judge_.at(plainPose(pose), 0.0).link >= 0;
      if (looked == 0 && isInside) return false;
      ++looked;
      inside += isInside ? 1 : 0;
    }
    if (looked < 2) return false;
    place.inside = static_cast<double>(inside) / looked;
    return place.inside >= request_.leastInside && place.inside <= request_.mostInside;
  }

  const SolidStage& stage_;
  const SolidActor& actor_;
  const BusyPlaceRequest& request_;
  PortableRandom random_;
  oracle::WayJudge judge_;
};

}  // namespace

std::vector<BusyPlace> busyPlaces(const SolidStage& stage, const SolidActor& actor,
                                  const BusyPlaceRequest& request) {
  PlaceDraws draws(stage, actor, request);
  std::vector<BusyPlace> places;
  for (int i = 0; i < request.mostDraws; ++i) {
    if (static_cast<int>(places.size()) >= request.count) break;
    BusyPlace place;
    if (draws.draw(place)) places.push_back(place);
  }
  return places;
}

}  // namespace foretouch::tools
