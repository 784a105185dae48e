#include "bench/workload.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "articulated/motion.h"
#include "articulated/try.h"
#include "lss/index.h"
#include "middleware/query/query.h"
#include "tools/console.h"
#include "tools/inputs/step_selection.h"
#include "tools/portable_random.h"
#include "tools/progress.h"

namespace foretouch::tools {
namespace {

Avatar grownBy(const Avatar& avatar, double margin) {
  std::vector<std::vector<Lss>> lss;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    lss.push_back(avatar.lss(link));
    for (Lss& one : lss.back()) one.radius += margin;
  }
  return Avatar::build(avatar.skeleton(), std::move(lss)).value();  // as legal as before
}

/// A query with legal options, which cannot be refused.
Query queryOf(const Avatar& avatar, const Scene& scene) {
  QueryOptions options;
  options.tolerance = kWorkloadTolerance;
  return Query::build(avatar, scene, options).value();
}

/// Classifies steps.
class Classifier {
 public:
  Classifier(const BenchInputs& inputs, const BenchBody& body)
      : inputs_(inputs),
        body_(body),
        query_(queryOf(body.avatar, inputs.scene)),
        grown_(queryOf(grownBy(body.avatar, kNearM), inputs.scene)) {}

  [[nodiscard]] Result<Pose> poseAt(const Placement& placement, std::int64_t frame) const {
    const double timeS = static_cast<double>(frame) * inputs_.clip.frameTimeS;
    return validatedPose(body_.avatar.skeleton(),
                         poseOfBody(body_, placedPose(inputs_, placement, frame), timeS));
  }

  StepClass classOf(const Pose& from, const Pose& to) {
    const ChainMotion motion(body_.avatar.skeleton(), from, to);
    const StepContacts contacts = query_.answer(motion, scratch_);
    StepClass kind = StepClass::Far;
    for (const LinkContact& contact : contacts.links) {
      if (contact.verdict == Verdict::StartsInContact) return StepClass::Start;
      if (contact.verdict == Verdict::Contact) kind = StepClass::Contact;
    }
    return kind == StepClass::Far && isNear(motion) ? StepClass::Near : kind;
  }

 private:
  bool isNear(const ChainMotion& motion) {
    for (int i = 0; i < kNearInstants; ++i) {
      const double t = static_cast<double>(i) / (kNearInstants - 1);
      for (LinkId link = 0; link < grown_.avatar().numLinks(); ++link) {
        if (grown_.touchesAt(motion, link, t, scratch_)) return true;
      }
    }
    return false;
  }

  const BenchInputs& inputs_;
  const BenchBody& body_;
  Query query_, grown_;
  Scratch scratch_;
};

/// Lowest point of any LSS of the whole avatar over all frames, and the middle of the first link's
/// path: the point by which a placement holds the clip.
Eigen::Vector3d holdOf(const BenchInputs& inputs) {
  double lowest = std::numeric_limits<double>::infinity();
  Eigen::Vector3d low = Eigen::Vector3d::Constant(lowest), high = -low;
  std::vector<LinkState> states;
  for (std::size_t frame = 0; frame < inputs.clip.frames.size(); ++frame) {
    const Pose pose = placedPose(inputs, Placement{}, static_cast<std::int64_t>(frame));
    ChainMotion(inputs.avatar.skeleton(), pose, pose).statesAt(0.0, states);
    low = low.cwiseMin(states[0].p_WL);
    high = high.cwiseMax(states[0].p_WL);
    for (LinkId link = 0; link < inputs.avatar.numLinks(); ++link) {
      const LinkState& state = states[slotOf(link)];
      for (const Lss& lss : inputs.avatar.lss(link)) {
        const double y = std::min(state.pointAt(lss.a).y(), state.pointAt(lss.b).y());
        lowest = std::min(lowest, y - lss.radius);
      }
    }
  }
  return {0.5 * (low.x() + high.x()), lowest, 0.5 * (low.z() + high.z())};
}

/// A place drawn in the scene's box, for the clip's middle.
Placement drawnPlace(const BenchInputs& inputs, const WorkloadRequest& request,
                     const Eigen::Vector3d& hold, PortableRandom& random) {
  const SceneAudit& box = inputs.scene.audit();
  Placement placement;
  const double x = random.uniform(box.boxMin.x(), box.boxMax.x());
  const double z = random.uniform(box.boxMin.z(), box.boxMax.z());
  placement.yawDeg = random.uniform(0.0, 360.0);
  const double yaw = placement.yawDeg * (3.14159265358979323846 / 180.0);
  const double c = std::cos(yaw), s = std::sin(yaw);  // about +Y: x' = c x + s z, z' = c z - s x
  placement.origin = {x - (c * hold.x() + s * hold.z()), request.floorY + request.liftM - hold.y(),
                      z - (c * hold.z() - s * hold.x())};
  return placement;
}

struct FoundStep {
  StepPick pick;
  std::uint64_t lot = 0;  ///< Drawn on finding it: takes those of each class with the least lots.
  std::size_t order = 0;
};

/// How many of each class make up the mix; fewer in total if a class runs short.
void fillMix(Workload& workload) {
  const auto found = [&](StepClass kind) { return workload.found[slotOf(kind)]; };
  const std::int64_t contacts = found(StepClass::Contact), near = found(StepClass::Near),
                     far = found(StepClass::Far);
  const auto share = [](double part, std::int64_t of) {
    return static_cast<std::int64_t>(std::llround(part * static_cast<double>(of)));
  };
  std::int64_t total = static_cast<std::int64_t>(workload.request.steps);
  total = std::min(total, share(1.0 / kBusyContact, contacts));
  total = std::min(total, share(1.0 / (1.0 - kBusyContact), near + far));
  const std::int64_t free = total - std::min(contacts, share(kBusyContact, total));
  std::int64_t takeNear = std::min(near, share(kBusyNear, total));
  takeNear = std::min(near, std::max(takeNear, free - far));  // if there are too few far ones
  workload.chosen[slotOf(StepClass::Contact)] = total - free;
  workload.chosen[slotOf(StepClass::Near)] = takeNear;
  workload.chosen[slotOf(StepClass::Far)] = std::min(far, free - takeNear);
}

bool isComplete(const Workload& workload) {
  const auto steps = static_cast<double>(workload.request.steps);
  const auto found = [&](StepClass kind) {
    return static_cast<double>(workload.found[slotOf(kind)]);
  };
  return found(StepClass::Contact) >= kBusyContact * steps &&
         found(StepClass::Near) >= kBusyNear * steps &&
         found(StepClass::Far) >= (1.0 - kBusyContact - kBusyNear) * steps;
}

void takeMix(Workload& workload, std::vector<FoundStep> found) {
  fillMix(workload);
  std::sort(found.begin(), found.end(),
            [](const FoundStep& a, const FoundStep& b) { return a.lot < b.lot; });
  std::int64_t left[kStepClasses];
  std::copy(std::begin(workload.chosen), std::end(workload.chosen), left);
  std::vector<FoundStep> taken;
  for (const FoundStep& step : found) {
    if (left[slotOf(step.pick.kind)]-- > 0) taken.push_back(step);
  }
  // Like a stream: place by place, in the clip's order.
  std::sort(taken.begin(), taken.end(),
            [](const FoundStep& a, const FoundStep& b) { return a.order < b.order; });
  for (const FoundStep& step : taken) workload.picks.push_back(step.pick);
}

/// Adds `steps` steps at one placement, spread over all of the clip. False if a pose lies beyond
/// the limit of coordinates.
Result<bool> addSteps(const Placement& placement, std::int64_t ofAll, std::int64_t steps,
                      Classifier& classifier, Workload& workload, std::vector<StepPick>& found) {
  for (std::int64_t i = 0; i < steps; ++i) {
    const std::int64_t frame = i * ofAll / steps * workload.stride;
    const auto from = classifier.poseAt(placement, frame);
    const auto to = classifier.poseAt(placement, frame + workload.stride);
    if (!from.ok() || !to.ok()) return false;
    const StepClass kind = classifier.classOf(from.value(), to.value());
    ++workload.found[slotOf(kind)];
    found.push_back({placement, frame, kind});
  }
  return true;
}

Result<Done> takeAll(std::int64_t steps, Classifier& classifier, Workload& workload) {
  const std::int64_t taken = std::min(steps, static_cast<std::int64_t>(workload.request.steps));
  const auto added =
      addSteps(*workload.request.place, taken, taken, classifier, workload, workload.picks);
  if (!added.ok()) return added.error();
  if (!added.value()) {
    return Error::in("--place", ErrorCode::OutOfRange, "expected poses within 1e7 m");
  }
  workload.placements = 1;
  std::copy(std::begin(workload.found), std::end(workload.found), workload.chosen);
  return Done{};
}

struct Place {
  std::vector<StepPick> steps;
  double contacts = 0.0;  ///< Share of those that do not start in contact.
  double starts = 0.0;    ///< Share of all.

  [[nodiscard]] bool isBusy() const {
    return starts <= kMostStarts && contacts >= kLeastBusy && contacts <= kMostBusy;
  }
  [[nodiscard]] double offBusy() const { return std::abs(contacts - kBusyContact); }
};

Place judged(std::vector<StepPick> steps) {
  const auto count = [&](StepClass kind) {
    return static_cast<double>(std::count_if(steps.begin(), steps.end(),
                                             [&](const StepPick& p) { return p.kind == kind; }));
  };
  Place place;
  const double starts = count(StepClass::Start), all = static_cast<double>(steps.size());
  place.starts = starts / all;
  place.contacts = all > starts ? count(StepClass::Contact) / (all - starts) : 0.0;
  place.steps = std::move(steps);
  return place;
}

void take(const Place& place, Workload& workload) {
  ++workload.taken;
  for (const StepPick& pick : place.steps) {
    if (pick.kind == StepClass::Start || workload.picks.size() >= workload.request.steps) continue;
    ++workload.chosen[slotOf(pick.kind)];
    workload.picks.push_back(pick);
  }
}

/// If a scene and a rate have too few busy places, takes the nearest to busy of the others.
void takeNearlyBusy(std::vector<Place> others, Workload& workload) {
  std::sort(others.begin(), others.end(),
            [](const Place& a, const Place& b) { return a.offBusy() < b.offBusy(); });
  for (const Place& place : others) {
    if (workload.picks.size() >= std::min(workload.request.steps, kLeastSteps)) return;
    take(place, workload);
  }
}

bool hasEnough(const Workload& workload) {
  return workload.request.choice == StepChoice::BusyPlaces
             ? workload.picks.size() >= workload.request.steps
             : workload.placements >= kLeastPlaces && isComplete(workload);
}

Result<Done> search(const BenchInputs& inputs, std::int64_t steps, Classifier& classifier,
                    Workload& workload) {
  const WorkloadRequest& request = workload.request;
  PortableRandom places(request.seed), lots(request.seed);
  const Eigen::Vector3d hold = holdOf(inputs);
  std::vector<FoundStep> found;
  std::vector<Place> others;
  ProgressBar progress("places", request.mostPlacements);
  while (workload.placements < request.mostPlacements && !hasEnough(workload)) {
    const Placement placement = drawnPlace(inputs, request, hold, places);
    std::vector<StepPick> here;
    const auto added =
        addSteps(placement, steps, std::min(steps, kMostStepsAPlace), classifier, workload, here);
    if (!added.ok()) return added.error();
    if (request.choice == StepChoice::BusyPlaces) {
      Place place = judged(std::move(here));
      if (place.isBusy()) {
        take(place, workload);
      } else if (place.starts <= kMostStarts && place.contacts > 0.0) {
        others.push_back(std::move(place));
      }
    } else {
      for (const StepPick& pick : here) found.push_back({pick, lots.next(), found.size()});
    }
    progress.advanceTo(++workload.placements);
  }
  if (request.choice == StepChoice::Mix) {
    takeMix(workload, std::move(found));
  } else {
    takeNearlyBusy(std::move(others), workload);
  }
  if (!workload.picks.empty()) return Done{};
  return Error::in(inputs.files.scenePath, ErrorCode::Empty,
                   fmt::format("no steps with and without a contact were found at {} places; are "
                               "--clip-scale, --floor and --lift right?",
                               workload.placements));
}

}  // namespace

const char* toString(StepChoice choice) {
  return choice == StepChoice::BusyPlaces ? "busy" : "mix";
}

Result<Workload> chooseSteps(const BenchInputs& inputs, const BenchBody& body,
                             const WorkloadRequest& request) {
  const auto selection = selectSteps(inputs.clip, request.rateHz);
  if (!selection.ok()) return inFile(selection.error(), inputs.files.motionPath);
  Workload workload;
  workload.request = request;
  workload.stride = selection.value().stride;
  const std::int64_t steps = selection.value().count;
  Classifier classifier(inputs, body);
  FORETOUCH_CHECK(request.place ? takeAll(steps, classifier, workload)
                                : search(inputs, steps, classifier, workload));
  return workload;
}

std::string describe(const Workload& workload) {
  const auto count = static_cast<double>(workload.picks.size());
  std::int64_t all = 0;
  for (const std::int64_t found : workload.found) all += found;
  const auto share = [&](StepClass kind) {
    return 100.0 * static_cast<double>(workload.chosen[slotOf(kind)]) / count;
  };
  std::string text = fmt::format(
      "{} steps: {:.1f} % with a contact, {:.1f} % within {:g} mm of something, {:.1f} % farther",
      workload.picks.size(), share(StepClass::Contact), share(StepClass::Near), 1e3 * kNearM,
      share(StepClass::Far));
  const WorkloadRequest& request = workload.request;
  if (request.place) {
    const Eigen::Vector3d& p = request.place->origin;
    return text + fmt::format(
                      ", {:.1f} % starting in contact; every step at the place "
                      "{:g},{:g},{:g},{:g}",
                      share(StepClass::Start), p.x(), p.y(), p.z(), request.place->yawDeg);
  }
  const std::string from = fmt::format(
      " (seed {}) with the clip's lowest point {:g} mm above the floor, less those that start in "
      "contact ({:.1f} % of all that were looked at)",
      request.seed, 1e3 * request.liftM,
      100.0 * static_cast<double>(workload.found[0]) / static_cast<double>(all));
  if (request.choice == StepChoice::BusyPlaces) {
    return text +
           fmt::format("; all steps, up to {} a place, of the {} busy ones of {} places",
                       kMostStepsAPlace, workload.taken, workload.placements) +
           from;
  }
  return text + fmt::format("; a mix of {} steps at {} places", all, workload.placements) + from;
}

Result<std::vector<StepPoses>> posesOf(const BenchInputs& inputs, const BenchBody& body,
                                       const Workload& workload) {
  const Skeleton& skeleton = body.avatar.skeleton();
  const auto poseAt = [&](const StepPick& pick, std::int64_t frame) {
    const double timeS = static_cast<double>(frame) * inputs.clip.frameTimeS;
    return validatedPose(skeleton,
                         poseOfBody(body, placedPose(inputs, pick.placement, frame), timeS));
  };
  std::vector<StepPoses> poses;
  for (const StepPick& pick : workload.picks) {
    FORETOUCH_TRY(auto from, poseAt(pick, pick.frame));
    FORETOUCH_TRY(auto to, poseAt(pick, pick.frame + workload.stride));
    poses.push_back({std::move(from), std::move(to)});
  }
  return poses;
}

std::vector<std::size_t> inClipOrder(const Workload& workload) {
  std::vector<std::size_t> order(workload.picks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) {
    const StepPick& pick = workload.picks[i];
    const Eigen::Vector3d& p = pick.placement.origin;
    return std::make_tuple(p.x(), p.y(), p.z(), pick.placement.yawDeg, pick.frame);
  };
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

}  // namespace foretouch::tools
