#include "tests/network/world_stream/crowd_told.h"

#include <algorithm>
#include <map>
#include <utility>

#include "lss/index.h"
#include "tests/network/world_stream/small_world.h"

namespace foretouch::test {
namespace {

constexpr std::int64_t kLateUs = 200;

class Telling {
 public:
  Telling(const WorldSetup& setup, std::size_t bodies, const WorldPolicy& policy,
          CrowdMutation mutation)
      : setup_(setup),
        policy_(policy),
        mutation_(mutation),
        solver_(WorldSolver::make(setup, policy).value()) {
    told_.heard.resize(bodies);
    told_.presentUs.resize(bodies);
    for (const WorldSetup::ServedAvatar& avatar : setup.avatars) {
      streams_.emplace(avatar.number,
                       AvatarStream::make(*setup.shapes[avatar.shape].avatar, {}).value());
    }
  }

  void hear(const CrowdArrival& arrival) {
    std::visit([&](const auto& message) { hear(message, arrival); }, arrival.message);
  }

  CrowdTold take() {
    told_.answers = std::move(world_.answers);
    told_.counts = solver_.counts();
    breakAnswers();
    return std::move(told_);
  }

 private:
  void hear(const SkeletonMessage& message, const CrowdArrival& arrival);
  void hear(const PoseMessage& message, const CrowdArrival& arrival);
  void hear(const BodyMessage& message, const CrowdArrival& arrival);
  void hear(const RigidPoseMessage& message, const CrowdArrival& arrival);
  void present(BodyNumber body, std::int64_t us) {
    auto& since = told_.presentUs[slotOf(body)];
    if (!since) since = us;
  }
  void breakAnswers();
  void breakEvent(ToldEvent& event) const;

  const WorldSetup& setup_;
  WorldPolicy policy_;
  CrowdMutation mutation_;
  WorldSolver solver_;
  std::map<BodyNumber, AvatarStream> streams_;
  ToldWorld world_;
  CrowdTold told_;
};

void Telling::hear(const SkeletonMessage& message, const CrowdArrival& arrival) {
  AvatarStream& stream = streams_.at(message.avatar);
  if (stream.take(message) == Reject::None || stream.leftTrace()) told_.accepted.push_back(arrival);
}

void Telling::hear(const PoseMessage& message, const CrowdArrival& arrival) {
  AvatarStream& stream = streams_.at(message.avatar);
  PoseMessage given = message;
  if (mutation_ == CrowdMutation::BadJointsAreGood) {
    for (PoseJoint& joint : given.joints) joint.flags = kTrackedNow;
  }
  StreamStep step;
  const Reject reason = stream.take(given, step);
  // What its stream accepts is recorded, whatever the world says of it.
  if (reason == Reject::None || stream.leftTrace()) told_.accepted.push_back(arrival);
  if (reason != Reject::None) return;
  if (solver_.take(message.avatar, step, arrival.timeUs) != Reject::None) return;
  present(message.avatar, message.utimeUs);
  world_.hear(solver_);
}

void Telling::hear(const BodyMessage& message, const CrowdArrival& arrival) {
  BodyMessage given = message;
  if (mutation_ == CrowdMutation::OtherLinkCarries && message.carrier != kNoBody) {
    given.carrierLink = message.carrierLink == 0 ? 1 : message.carrierLink - 1;
  }
  const bool isLetGo = message.carrier == kNoBody && !told_.heard[slotOf(message.body)].empty() &&
                       told_.heard[slotOf(message.body)].back().state.carrier != kNoBody;
  const bool isKept = mutation_ == CrowdMutation::CarriersStay && message.isPresent && isLetGo;
  const std::int64_t answeredUs = solver_.counts().answeredUntilUs;
  if (!isKept && solver_.take(given, arrival.timeUs) != Reject::None) return;
  told_.accepted.push_back(arrival);
  const CrowdState state{message.sinceUs, message.isPresent, message.carrier, message.carrierLink,
                         message.movesInFrame};
  told_.heard[slotOf(message.body)].push_back({state, answeredUs});
  if (message.carrier != kNoBody && told_.presentUs[slotOf(message.carrier)]) {
    // As early as it can have taken effect.
    present(message.body, std::max({message.sinceUs, arrival.timeUs, answeredUs + 1,
                                    *told_.presentUs[slotOf(message.carrier)]}));
  }
  world_.hear(solver_);
}

void Telling::hear(const RigidPoseMessage& message, const CrowdArrival& arrival) {
  const Reject reason = solver_.take(message, arrival.timeUs);
  if (reason == Reject::None || solver_.isNoted()) told_.accepted.push_back(arrival);
  if (reason != Reject::None) return;
  present(message.bodies[0].body, message.utimeUs);
  world_.hear(solver_);
}

void Telling::breakAnswers() {
  for (EventsMessage& answer : told_.answers) {
    if (mutation_ == CrowdMutation::UnknownIsSilent) answer.unknown.clear();
    if (mutation_ == CrowdMutation::EntersAreLost) {
      answer.events.erase(
          std::remove_if(answer.events.begin(), answer.events.end(),
                         [](const ToldEvent& told) { return told.event.kind == EventKind::Enter; }),
          answer.events.end());
    }
    for (ToldEvent& event : answer.events) breakEvent(event);
  }
}

void Telling::breakEvent(ToldEvent& event) const {
  const bool isEnter = event.event.kind == EventKind::Enter;
  const bool isLeave = event.event.kind == EventKind::Leave && event.cause == ToldCause::Apart;
  if (mutation_ == CrowdMutation::EntersAreLate && isEnter) event.event.time.us += kLateUs;
  if (mutation_ == CrowdMutation::LeavesAreEarly && isLeave) event.event.time.us -= kLateUs;
  if (mutation_ == CrowdMutation::UnknownIsSilent) event.event.isAssumed = false;
}

}  // namespace

const char* toString(CrowdMutation mutation) {
  switch (mutation) {
    case CrowdMutation::None: return "none";
    case CrowdMutation::OtherLinkCarries: return "other-link-carries";
    case CrowdMutation::CarriersStay: return "carriers-stay";
    case CrowdMutation::BadJointsAreGood: return "bad-joints-are-good";
    case CrowdMutation::EntersAreLate: return "enters-are-late";
    case CrowdMutation::LeavesAreEarly: return "leaves-are-early";
    case CrowdMutation::EntersAreLost: return "enters-are-lost";
    case CrowdMutation::UnknownIsSilent: return "unknown-is-silent";
  }
  return "";
}

CrowdTold tellCrowd(const WorldSetup& setup, std::size_t bodies,
                    const std::vector<CrowdArrival>& arrivals, const WorldPolicy& policy,
                    CrowdMutation mutation) {
  Telling telling(setup, bodies, policy, mutation);
  for (const CrowdArrival& arrival : arrivals) telling.hear(arrival);
  return telling.take();
}

}  // namespace foretouch::test
