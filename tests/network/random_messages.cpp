#include "tests/network/random_messages.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t kLargest = (std::int64_t{1} << 62) - 1;

/// From 0 to the largest that is legal, ends included.
std::int64_t integer(Random& random) {
  switch (random.below(4)) {
    case 0: return 0;
    case 1: return kLargest;
    case 2: return 1'700'000'000'000'000 + random.below(1'000'000);
    default: return static_cast<std::int64_t>(random.uniform(0.0, 1.0) * 4e18);
  }
}

std::int64_t anyHash(Random& random) {
  return static_cast<std::int64_t>(random.uniform(-9e18, 9e18));
}

double coordinate(Random& random) {
  switch (random.below(6)) {
    case 0: return -0.0;
    case 1: return random.chance(0.5) ? kMaxCoordinate : -kMaxCoordinate;
    case 2: return std::numeric_limits<double>::denorm_min();
    case 3: return random.uniform(-1e7, 1e7);
    default: return random.uniform(-2.0, 2.0);
  }
}

Vector3d place(Random& random) {
  return {coordinate(random), coordinate(random), coordinate(random)};
}

/// Unit up to rounding, or off by nearly as much as is allowed.
Quaternion rotation(Random& random) {
  Quaternion q = random.rotation();
  if (random.chance(0.3)) q.coeffs() *= 1.0 + random.uniform(-9.9e-4, 9.9e-4);
  if (random.chance(0.1)) q = Quaternion(1.0, -0.0, 0.0, -0.0);
  return q;
}

std::string text(Random& random, int longest) {
  static const char* const parts[] = {
      "a", "Left", ":", " ", "\xc3\xa9", "\xe6\x89\x8b", "\xf0\x9f\x96\x90", "_", "7"};
  std::string result;
  const int n = random.below(longest);
  for (int i = 0; i < n; ++i) result += parts[random.below(9)];
  return result;
}

std::string name(Random& random, int index) {
  return text(random, random.chance(0.05) ? 200 : 8) + "." + std::to_string(index);
}

Verdict verdict(Random& random) {
  return random.chance(0.5) ? Verdict::Clear : static_cast<Verdict>(random.below(4));
}

FeatureKind feature(Random& random) {
  return static_cast<FeatureKind>(random.below(3));
}

AnsweredContact contact(Random& random, LinkId link, Verdict verdict) {
  AnsweredContact answered;
  answered.linkName = name(random, link);
  LinkContact& contact = answered.contact;
  contact.link = link;
  contact.verdict = verdict;
  contact.freeUntil = random.chance(0.2) ? 1.0 : random.uniform(0.0, 1.0);
  if (verdict == Verdict::Undecided) {
    contact.reason = static_cast<UndecidedReason>(1 + random.below(kNumUndecidedReasons - 1));
    return answered;
  }
  contact.toi = contact.freeUntil;
  contact.separation = random.magnitude(1e-12, 1e-3);
  contact.penetration = random.chance(0.5) ? 0.0 : random.uniform(0.0, 0.1);
  contact.triangle = random.chance(0.1) ? std::numeric_limits<TriangleId>::max() : random.below(99);
  contact.p_WScene = place(random);
  contact.p_WLink = place(random);
  contact.nhat_SL_W = random.direction();
  contact.linkTriangle = random.below(9) - 1;
  contact.linkFeature = feature(random);
  contact.sceneFeature = feature(random);
  answered.objectName = text(random, 30);
  return answered;
}

ShownContact shown(Random& random, int numJoints) {
  ShownContact shown;
  SolidContact& contact = shown.contact;
  contact.link = random.below(numJoints);
  contact.lss = random.below(3) - 1;
  const bool isOwn = numJoints > 1 && random.chance(0.2);
  if (isOwn) contact.other = (contact.link + 1) % numJoints;
  if (!isOwn) contact.triangle = random.below(99);
  contact.p_W = place(random);
  contact.nhat_W = random.direction();
  contact.gap = random.uniform(-1e-3, 5e-3);
  contact.push = random.magnitude(1e-9, 1.0);
  contact.slipSpeed = random.magnitude(1e-9, 10.0);
  shown.linkName = name(random, contact.link);
  shown.otherName = text(random, 30);
  return shown;
}

template <typename T>
void shuffle(Random& random, std::vector<T>& list) {
  for (std::size_t i = list.size(); i > 1; --i) {
    std::swap(list[i - 1], list[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  }
}

}  // namespace

SkeletonMessage randomSkeletonMessage(Random& random, int numJoints) {
  SkeletonMessage message;
  message.avatar = random.below(1'000'000) - 500'000;
  message.session = integer(random);
  message.sendUtimeUs = integer(random);
  message.generation = random.below(1000);
  message.source = text(random, 40);
  message.rateHz = random.chance(0.2) ? 0.0 : random.uniform(1.0, 240.0);
  for (int i = 0; i < numJoints; ++i) {
    RawJoint joint;
    joint.name = name(random, i);
    // Never deeper than a few dozen.
    joint.parent = i == 0 || random.chance(0.1) ? kNoParent : random.below(i);
    joint.offset = place(random);
    joint.rotation = rotation(random);
    message.skeleton.joints.push_back(std::move(joint));
  }
  message.hash = skeletonHash(message.skeleton);
  return message;
}

PoseMessage randomPoseMessage(Random& random, int numJoints) {
  PoseMessage message;
  message.avatar = random.below(1'000'000) - 500'000;
  message.session = integer(random);
  message.sequence = integer(random);
  message.utimeUs = integer(random);
  message.sendUtimeUs = integer(random);
  message.skeletonHash = anyHash(random);
  std::vector<std::int32_t> order(static_cast<std::size_t>(numJoints));
  std::iota(order.begin(), order.end(), 0);
  shuffle(random, order);
  for (const std::int32_t index : order) {
    if (random.chance(0.1)) continue;
    PoseJoint joint;
    joint.joint = index;
    joint.flags = static_cast<std::uint8_t>(random.below(8));
    const bool valid = (joint.flags & kJointValid) != 0;
    if (valid) joint.rotation = rotation(random);
    message.joints.push_back(joint);
    if (!random.chance(0.3)) continue;
    message.translations.push_back({index, valid ? place(random) : Vector3d::Zero()});
  }
  shuffle(random, message.translations);
  return message;
}

ContactsMessage randomContactsMessage(Random& random, int numLinks) {
  ContactsMessage message;
  message.avatar = random.below(1'000'000) - 500'000;
  message.session = integer(random);
  std::tie(message.sequenceFrom, message.sequenceTo) =
      std::minmax({integer(random), integer(random)});
  std::tie(message.utimeFromUs, message.utimeToUs) =
      std::minmax({integer(random), integer(random)});
  message.skeletonHash = anyHash(random);
  message.kind = static_cast<StepKind>(random.below(3));
  message.lost = integer(random);
  message.tolerance = random.magnitude(1e-9, 1.0);
  message.fidelity = static_cast<Fidelity>(random.below(3));
  message.workBudget = integer(random);
  for (LinkId link = 0; link < numLinks; ++link) {
    message.verdicts.push_back(verdict(random));
    if (message.verdicts.back() == Verdict::Clear) continue;
    message.contacts.push_back(contact(random, link, message.verdicts.back()));
  }
  shuffle(random, message.contacts);
  message.receiveUtimeUs = integer(random);
  message.sendUtimeUs = integer(random);
  message.queryUs = random.magnitude(1e-3, 1e9);
  return message;
}

PersonMessage randomPersonMessage(Random& random, int numLinks, int numBrackets) {
  PersonMessage message;
  message.avatar = random.below(1'000'000) - 500'000;
  for (std::int64_t* const count :
       {&message.session, &message.sequence, &message.utimeUs, &message.sequenceFrom,
        &message.utimeFromUs, &message.receiveUtimeUs, &message.sendUtimeUs}) {
    *count = integer(random);
  }
  message.sequenceTo = std::max(message.sequenceFrom, integer(random));
  message.utimeToUs = std::max(message.utimeFromUs, integer(random));
  message.model = static_cast<MotionModel>(random.below(3));
  message.kind = static_cast<StepKind>(random.below(3));
  message.boundsHash = anyHash(random);
  message.resolution = random.magnitude(1e-9, 1.0);
  message.personUs = random.magnitude(1e-3, 1e9);
  message.aheadUs = random.chance(0.5) ? 0 : integer(random);
  for (int i = 0; i < numLinks; ++i) {
    message.verdicts.push_back(static_cast<BracketVerdict>(random.below(4)));
    message.notBeforeUs.push_back(random.chance(0.3) ? -1 : integer(random));
  }
  for (int i = 0; numLinks > 0 && i < numBrackets; ++i) {
    ToldBracket& told = message.brackets.emplace_back();
    LinkBracket& bracket = told.bracket;
    bracket.link = random.below(numLinks);
    bracket.verdict = random.chance(0.5) ? BracketVerdict::Possible : BracketVerdict::Certain;
    if (numLinks > 1 && random.chance(0.3)) bracket.other = (bracket.link + 1) % numLinks;
    if (bracket.other == kNoParent) bracket.triangle = random.below(99) - 1;
    for (double* const t : {&bracket.possibleFrom, &bracket.possibleUntil, &bracket.certainFrom,
                            &bracket.certainUntil}) {
      *t = random.chance(0.2) ? 1.0 : random.uniform(0.0, 1.0);
    }
    bracket.growth = random.magnitude(1e-9, 1.0);
    told.linkName = name(random, bracket.link);
    told.otherName = text(random, 30);
  }
  message.bracketsLeftOut = random.chance(0.9) ? 0 : random.below(1000);
  for (int i = 0; i < numLinks && random.chance(0.3); ++i) {
    message.broken.push_back({random.below(numLinks),
                              static_cast<BrokenBound::Claim>(random.below(2)),
                              random.magnitude(1e-6, 10.0)});
  }
  return message;
}

SolidMessage randomSolidMessage(Random& random, int numJoints, int numPoses, int numContacts) {
  SolidMessage message;
  message.avatar = random.below(1'000'000) - 500'000;
  for (std::int64_t* const count :
       {&message.session, &message.sequence, &message.utimeUs, &message.lost, &message.stepUs,
        &message.workBudget, &message.receiveUtimeUs, &message.sendUtimeUs}) {
    *count = integer(random);
  }
  message.kind = static_cast<StepKind>(random.below(3));
  message.avatarHash = anyHash(random);
  for (double* const length :
       {&message.skin, &message.tolerance, &message.catchUp, &message.deviation, &message.lift,
        &message.clearance, &message.solidUs}) {
    *length = random.chance(0.2) ? 0.0 : random.magnitude(1e-9, 1e3);
  }
  message.state = static_cast<SolidState>(random.below(kNumSolidStates));
  message.limit = static_cast<SolidLimit>(random.below(kNumSolidLimits));
  message.isCertified = random.chance(0.8);
  message.hasAppeared = random.chance(0.1);
  message.snapInUs = random.chance(0.7) ? -1 : integer(random);
  for (int i = 0; i < numJoints; ++i) {
    message.joints.push_back(static_cast<SolidJointState>(random.below(kNumSolidJointStates)));
    message.linkDeviation.push_back(random.chance(0.5) ? 0.0 : random.magnitude(1e-9, 2.0));
  }
  for (int i = 0; i < numPoses; ++i) {
    Pose& pose = message.way.emplace_back();
    message.times.push_back(i == 0 && random.chance(0.5) ? 0.0 : (i + 1.0) / numPoses);
    for (int k = 0; k < numJoints; ++k) {
      pose.rotations.push_back(random.chance(0.1) ? Quaternion(1.0, -0.0, 0.0, -0.0)
                                                  : Quaternion(random.rotation()));
      pose.translations.push_back(place(random));
    }
  }
  for (int i = 0; i < numContacts; ++i) message.contacts.push_back(shown(random, numJoints));
  message.contactsLeftOut = random.chance(0.9) ? 0 : random.below(1000);
  message.counters.queries = static_cast<std::uint32_t>(random.below(100));
  message.counters.rows = std::numeric_limits<std::uint32_t>::max();
  message.counters.work = static_cast<std::uint64_t>(integer(random));
  return message;
}

StatusMessage randomStatusMessage(Random& random, int numReasons) {
  StatusMessage message;
  for (std::int64_t* const count :
       {&message.utimeUs, &message.startUtimeUs, &message.received, &message.answered,
        &message.rejected, &message.lost, &message.gaps, &message.waiting, &message.publishFailures,
        &message.journalFailures, &message.kernelDrops}) {
    *count = integer(random);
  }
  message.build = text(random, 30);
  message.scene = text(random, 300);
  message.numAvatars = random.below(100);
  message.numWorkers = random.below(100);
  for (int i = 0; i < numReasons; ++i) {
    message.counts.push_back({text(random, 20), integer(random)});
  }
  for (double* const duration :
       {&message.latencyP50Us, &message.latencyP99Us, &message.latencyMaxUs, &message.queryP50Us,
        &message.queryP99Us, &message.queryMaxUs}) {
    *duration = random.chance(0.2) ? 0.0 : random.magnitude(1e-3, 1e7);
  }
  return message;
}

SpeakerMessage randomSpeakerMessage(Random& random) {
  SpeakerMessage message;
  message.avatar = random.below(1000);
  message.utimeUs = integer(random);
  message.address = random.chance(0.2) ? 0xffffffffU : static_cast<std::uint32_t>(integer(random));
  message.port = static_cast<std::uint16_t>(random.below(65536));
  return message;
}

BodyMessage randomBodyMessage(Random& random, int longest) {
  BodyMessage message;
  message.body = random.below(1'000'000);
  for (std::int64_t* const count : {&message.session, &message.sequence, &message.utimeUs,
                                    &message.sendUtimeUs, &message.sinceUs}) {
    *count = integer(random);
  }
  message.kind = random.chance(0.2) ? BodyMessageKind::Avatar : BodyMessageKind::Rigid;
  message.isPresent = random.chance(0.8);
  message.shape = name(random, longest);
  message.shapeHash = random.chance(0.3) ? 0 : anyHash(random);
  if (message.kind == BodyMessageKind::Rigid && random.chance(0.5)) {
    message.carrier = message.body + 1;
    message.carrierLink = random.below(kMaxJoints);
    message.movesInFrame = random.chance(0.5);
  }
  message.pose = {rotation(random), place(random)};
  return message;
}

RigidPoseMessage randomRigidPoseMessage(Random& random, int numBodies) {
  RigidPoseMessage message;
  for (std::int64_t* const count :
       {&message.session, &message.sequence, &message.utimeUs, &message.sendUtimeUs}) {
    *count = integer(random);
  }
  for (int i = 0; i < numBodies; ++i) {
    BodyPose told;
    told.body = 3 * i + random.below(3);
    told.flags = static_cast<std::uint8_t>(random.below(8));
    if ((told.flags & kJointValid) != 0) told.pose = {rotation(random), place(random)};
    message.bodies.push_back(told);
  }
  shuffle(random, message.bodies);
  return message;
}

namespace {

ContactSide side(Random& random) {
  return {random.below(100) - 2, random.below(100) - 1, random.below(9) - 1, random.below(99) - 1,
          place(random)};
}

WorldTime instant(Random& random) {
  return {integer(random), random.chance(0.3) ? 0.0 : random.uniform(0.0, 1.0)};
}

ToldEvent happening(Random& random) {
  ToldEvent told;
  WorldEvent& event = told.event;
  event.kind = static_cast<EventKind>(random.below(kNumEventKinds));
  told.cause = static_cast<ToldCause>(random.below(kNumToldCauses));
  event.cause = told.cause == ToldCause::NotAsked ? LeaveCause::NotAsked : LeaveCause::Apart;
  event.reason = static_cast<UndecidedReason>(random.below(kNumUndecidedReasons));
  if (event.kind == EventKind::Leave) {
    event.reason = UndecidedReason::None;
    const bool isApart = told.cause == ToldCause::Apart;
    if (isApart && random.chance(0.4)) event.cause = LeaveCause::Moved;
  }
  event.isAssumed = random.chance(0.3);
  event.time = instant(random);
  event.since = instant(random);
  event.a = side(random);
  event.b = side(random);
  event.object = random.below(9) - 1;
  event.nhat_BA_W = random.chance(0.2) ? Vector3d::Zero() : random.direction();
  event.velocity_W = place(random);
  for (double* const number : {&event.separation, &event.penetration, &event.approachSpeed,
                               &event.approachLower, &event.approachUpper}) {
    *number = random.uniform(-1.0, 1.0);
  }
  event.effectiveMass =
      random.chance(0.5) ? std::numeric_limits<double>::infinity() : random.magnitude(1e-3, 1e3);
  event.numPoints = static_cast<std::size_t>(random.below(WorldEvent::kMostPoints + 1));
  for (std::size_t i = 0; i < event.numPoints; ++i) {
    event.points[i] = {place(random), place(random), random.uniform(-1.0, 1.0)};
  }
  return told;
}

}  // namespace

EventsMessage randomEventsMessage(Random& random, int numEvents) {
  EventsMessage message;
  for (std::int64_t* const count :
       {&message.timeline, &message.sequence, &message.receiveUtimeUs, &message.sendUtimeUs}) {
    *count = integer(random);
  }
  std::tie(message.fromUs, message.toUs) = std::minmax({integer(random), integer(random)});
  message.hasMore = random.chance(0.2);
  message.tolerance = random.magnitude(1e-9, 1.0);
  message.worldUs = random.magnitude(1e-3, 1e7);
  for (int i = 0; i < numEvents; ++i) {
    message.bodies.push_back(
        {2 * i + random.below(2), random.chance(0.2) ? -1 : integer(random), random.chance(0.5)});
    message.unknown.push_back(
        {random.below(9) - 2, random.below(9) - 1,
         static_cast<UndecidedReason>(1 + random.below(kNumUndecidedReasons - 1)), message.fromUs,
         message.toUs});
    message.events.push_back(happening(random));
  }
  return message;
}

PushesMessage randomPushesMessage(Random& random, int numContacts) {
  PushesMessage message;
  message.avatar = random.below(1000);
  for (std::int64_t* const count :
       {&message.session, &message.sequence, &message.utimeUs, &message.stepUs, &message.timeline,
        &message.receiveUtimeUs, &message.sendUtimeUs}) {
    *count = integer(random);
  }
  message.isAssumed = random.chance(0.2);
  message.tickUs = random.magnitude(1e-3, 1e7);
  for (int i = 0; i < numContacts; ++i) {
    ToldPush& told = message.contacts.emplace_back();
    told.contact = {message.avatar + 1 + i,
                    random.below(99),
                    random.below(3) - 1,
                    random.below(99) - 1,
                    place(random),
                    random.direction(),
                    random.uniform(-1e-3, 5e-3),
                    random.magnitude(1e-9, 1.0),
                    random.magnitude(1e-9, 10.0)};
    told.linkName = name(random, told.contact.link);
    ToldCrush& crush = message.crushes.emplace_back();
    crush.crush = {message.avatar + 1 + i, random.below(99), integer(random), random.chance(0.2),
                   random.chance(0.5) ? 0.0 : random.magnitude(1e-9, 1.0)};
    crush.linkName = name(random, crush.crush.link);
  }
  message.contactsLeftOut = random.chance(0.9) ? 0 : random.below(1000);
  message.crushesLeftOut = random.chance(0.9) ? 0 : random.below(1000);
  return message;
}

}  // namespace foretouch::test
