#include <algorithm>
#include <cstddef>
#include <foretouch/solid_t.hpp>
#include <limits>

#include "lss/index.h"
#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"
#include "network/wire/push_fields.h"

namespace foretouch {
namespace {

static_assert(static_cast<int>(SolidState::Placing) == solid_t::PLACING);
static_assert(static_cast<int>(SolidState::Equal) == solid_t::EQUAL);
static_assert(static_cast<int>(SolidState::Following) == solid_t::FOLLOWING);
static_assert(static_cast<int>(SolidState::Sliding) == solid_t::SLIDING);
static_assert(static_cast<int>(SolidState::Held) == solid_t::HELD);
static_assert(static_cast<int>(SolidState::Around) == solid_t::AROUND);
static_assert(static_cast<int>(SolidState::Snapped) == solid_t::SNAPPED);
static_assert(static_cast<int>(SolidLimit::None) == solid_t::LIMIT_NONE);
static_assert(static_cast<int>(SolidLimit::Budget) == solid_t::LIMIT_BUDGET);
static_assert(static_cast<int>(SolidLimit::CatchUp) == solid_t::LIMIT_CATCH_UP);
static_assert(static_cast<int>(SolidLimit::Inside) == solid_t::LIMIT_INSIDE);
static_assert(static_cast<int>(SolidJointState::Free) == solid_t::JOINT_FREE);
static_assert(static_cast<int>(SolidJointState::Sliding) == solid_t::JOINT_SLIDING);
static_assert(static_cast<int>(SolidJointState::Held) == solid_t::JOINT_HELD);
static_assert(static_cast<int>(SolidJointState::Lost) == solid_t::JOINT_LOST);
constexpr auto kLastSolidKind = static_cast<std::int8_t>(StepKind::AcrossGap);
// The largest message fits: poses, joints, contacts with their texts, and the rest.
static_assert(kMaxSolidPoses * (kMaxSolidJoints * 7 + 1) * sizeof(double) +
                  kMaxSolidJoints * (sizeof(double) + 1) +
                  kMaxSolidContacts * (kMaxNameBytes + kMaxTextBytes + 2 * 5 + 4 * 4 + 9 * 8) +
                  1024 <=
              kMaxMessageBytes);

Reject checkHead(const solid_t& wire) {
  if (!inRange({wire.session, wire.sequence, wire.utime, wire.lost, wire.step_us, wire.work_budget,
                wire.contacts_left_out, wire.receive_utime, wire.send_utime}) ||
      !inRange({wire.queries, wire.iterations, wire.features, wire.rows, wire.around_queries,
                wire.placing_queries, wire.work}) ||
      std::max({wire.queries, wire.iterations, wire.features, wire.rows, wire.around_queries,
                wire.placing_queries}) > std::numeric_limits<std::uint32_t>::max() ||
      wire.snap_in_us < -1 || wire.snap_in_us > kMaxWireInteger) {
    return Reject::OutOfRange;
  }
  const std::initializer_list<double> lengths{wire.skin,      wire.tolerance, wire.catch_up,
                                              wire.deviation, wire.lift,      wire.clearance,
                                              wire.solid_us};
  if (!allFinite(lengths)) return Reject::NonFinite;
  const bool isInside =
      std::all_of(lengths.begin(), lengths.end(), [](double x) { return x >= 0; });
  const bool isKnown =
      wire.kind >= 0 && wire.kind <= kLastSolidKind && wire.state >= 0 &&
      wire.state < kNumSolidStates && wire.limit >= 0 && wire.limit < kNumSolidLimits &&
      (wire.certified == 0 || wire.certified == 1) && (wire.appeared == 0 || wire.appeared == 1);
  if (!isInside || !isKnown) return Reject::OutOfRange;
  const bool isWithinLimits = wire.num_joints >= 1 && countOf(wire.num_joints) <= kMaxSolidJoints &&
                              wire.num_poses >= 1 && countOf(wire.num_poses) <= kMaxSolidPoses &&
                              countOf(wire.num_contacts) <= kMaxSolidContacts;
  return isWithinLimits ? Reject::None : Reject::Limit;
}

void readHead(const solid_t& wire, SolidMessage& message) {
  message.avatar = wire.avatar;
  message.session = wire.session;
  message.sequence = wire.sequence;
  message.utimeUs = wire.utime;
  message.kind = static_cast<StepKind>(wire.kind);
  message.lost = wire.lost;
  message.stepUs = wire.step_us;
  message.avatarHash = wire.avatar_hash;
  message.skin = wire.skin;
  message.tolerance = wire.tolerance;
  message.catchUp = wire.catch_up;
  message.workBudget = wire.work_budget;
  message.state = static_cast<SolidState>(wire.state);
  message.limit = static_cast<SolidLimit>(wire.limit);
  message.isCertified = wire.certified != 0;
  message.hasAppeared = wire.appeared != 0;
  message.deviation = wire.deviation;
  message.lift = wire.lift;
  message.clearance = wire.clearance;
  message.snapInUs = wire.snap_in_us;
  message.contactsLeftOut = wire.contacts_left_out;
  message.counters.queries = static_cast<std::uint32_t>(wire.queries);
  message.counters.iterations = static_cast<std::uint32_t>(wire.iterations);
  message.counters.features = static_cast<std::uint32_t>(wire.features);
  message.counters.rows = static_cast<std::uint32_t>(wire.rows);
  message.counters.aroundQueries = static_cast<std::uint32_t>(wire.around_queries);
  message.counters.placingQueries = static_cast<std::uint32_t>(wire.placing_queries);
  message.counters.work = static_cast<std::uint64_t>(wire.work);
  message.receiveUtimeUs = wire.receive_utime;
  message.sendUtimeUs = wire.send_utime;
  message.solidUs = wire.solid_us;
}

Reject readJoints(const solid_t& wire, SolidMessage& message) {
  const std::size_t n = countOf(wire.num_joints);
  message.joints.resize(n);
  message.linkDeviation = wire.link_deviation;
  for (std::size_t i = 0; i < n; ++i) {
    if (!std::isfinite(wire.link_deviation[i])) return Reject::NonFinite;
    if (wire.joint_states[i] >= kNumSolidJointStates || wire.link_deviation[i] < 0.0) {
      return Reject::OutOfRange;
    }
    message.joints[i] = static_cast<SolidJointState>(wire.joint_states[i]);
  }
  return Reject::None;
}

/// In [0, 1], one after the other.
bool areTimes(const std::vector<double>& times) {
  double last = -1.0;
  for (const double time : times) {
    if (!(time > last && time >= 0.0 && time <= 1.0)) return false;
    last = time;
  }
  return true;
}

Reject readPose(const solid_t& wire, std::size_t i, Pose& pose) {
  const std::size_t n = countOf(wire.num_joints);
  pose.rotations.resize(n);
  pose.translations.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    const Quaternion rotation(wire.rotation_w[i][k], wire.rotation_x[i][k], wire.rotation_y[i][k],
                              wire.rotation_z[i][k]);
    const Eigen::Vector3d translation(wire.translation_x[i][k], wire.translation_y[i][k],
                                      wire.translation_z[i][k]);
    if (!rotation.coeffs().allFinite() || !translation.allFinite()) return Reject::NonFinite;
    const auto unit = unitQuaternion(rotation);  // what is unit already, bit for bit
    if (!unit) return Reject::NonUnit;
    if (translation.cwiseAbs().maxCoeff() > kMaxCoordinate) return Reject::OutOfRange;
    pose.rotations[k] = *unit;
    pose.translations[k] = translation;
  }
  return Reject::None;
}

Reject readWay(const solid_t& wire, SolidMessage& message) {
  if (!areTimes(wire.times)) return Reject::OutOfRange;
  message.times = wire.times;
  message.way.resize(countOf(wire.num_poses));
  for (std::size_t i = 0; i < message.way.size(); ++i) {
    const Reject reject = readPose(wire, i, message.way[i]);
    if (reject != Reject::None) return reject;
  }
  return Reject::None;
}

Reject checkPlace(const SolidContact& contact, std::int32_t numJoints) {
  if (contact.link < 0 || contact.link >= numJoints || contact.lss < -1) return Reject::BadIndex;
  const bool isOfScene = contact.triangle >= 0 && contact.other == kNoParent;
  const bool isOwn = contact.triangle == -1 && contact.other >= 0 && contact.other < numJoints &&
                     contact.other != contact.link;
  return isOfScene || isOwn ? Reject::None : Reject::BadIndex;
}

Reject readContacts(const solid_t& wire, SolidMessage& message) {
  message.contacts.resize(countOf(wire.num_contacts));
  for (std::size_t i = 0; i < message.contacts.size(); ++i) {
    SolidContact contact;
    readPush(wire, i, contact);
    contact.other = wire.others[i];
    Reject reject = checkPlace(contact, wire.num_joints);
    if (reject == Reject::None) reject = checkPush(contact);
    if (reject == Reject::None && nameProblem(wire.link_names[i])) reject = Reject::BadName;
    if (reject != Reject::None) return reject;
    message.contacts[i].contact = contact;
    message.contacts[i].linkName = wire.link_names[i];
    message.contacts[i].otherName = wire.objects[i];
  }
  return Reject::None;
}

void writeHead(const SolidMessage& message, solid_t& wire) {
  wire.version = kMessageVersion;
  wire.avatar = message.avatar;
  wire.session = message.session;
  wire.sequence = message.sequence;
  wire.utime = message.utimeUs;
  wire.kind = static_cast<std::int8_t>(message.kind);
  wire.lost = message.lost;
  wire.step_us = message.stepUs;
  wire.avatar_hash = message.avatarHash;
  wire.skin = message.skin;
  wire.tolerance = message.tolerance;
  wire.catch_up = message.catchUp;
  wire.work_budget = message.workBudget;
  wire.state = static_cast<std::int8_t>(message.state);
  wire.limit = static_cast<std::int8_t>(message.limit);
  wire.certified = message.isCertified ? 1 : 0;
  wire.appeared = message.hasAppeared ? 1 : 0;
  wire.deviation = message.deviation;
  wire.lift = message.lift;
  wire.clearance = message.clearance;
  wire.snap_in_us = message.snapInUs;
  wire.contacts_left_out = message.contactsLeftOut;
  wire.queries = message.counters.queries;
  wire.iterations = message.counters.iterations;
  wire.features = message.counters.features;
  wire.rows = message.counters.rows;
  wire.around_queries = message.counters.aroundQueries;
  wire.placing_queries = message.counters.placingQueries;
  wire.work = static_cast<std::int64_t>(message.counters.work);
  wire.receive_utime = message.receiveUtimeUs;
  wire.send_utime = message.sendUtimeUs;
  wire.solid_us = message.solidUs;
}

void writeJoints(const SolidMessage& message, solid_t& wire) {
  const std::size_t n = message.joints.size();
  FORETOUCH_ASSERT(n == message.linkDeviation.size() && n <= kMaxSolidJoints);
  wire.num_joints = static_cast<std::int32_t>(n);
  wire.joint_states.resize(n);
  wire.link_deviation = message.linkDeviation;
  for (std::size_t i = 0; i < n; ++i) {
    wire.joint_states[i] = static_cast<std::uint8_t>(message.joints[i]);
  }
}

void writePose(const Pose& pose, std::size_t i, solid_t& wire) {
  for (std::size_t k = 0; k < pose.rotations.size(); ++k) {
    wire.rotation_w[i][k] = pose.rotations[k].w();
    wire.rotation_x[i][k] = pose.rotations[k].x();
    wire.rotation_y[i][k] = pose.rotations[k].y();
    wire.rotation_z[i][k] = pose.rotations[k].z();
    wire.translation_x[i][k] = pose.translations[k].x();
    wire.translation_y[i][k] = pose.translations[k].y();
    wire.translation_z[i][k] = pose.translations[k].z();
  }
}

void writeWay(const SolidMessage& message, solid_t& wire) {
  const std::size_t n = message.way.size(), numJoints = message.joints.size();
  FORETOUCH_ASSERT(n >= 1 && n <= kMaxSolidPoses && n == message.times.size());
  wire.num_poses = static_cast<std::int32_t>(n);
  wire.times = message.times;
  for (auto* const part : {&wire.rotation_w, &wire.rotation_x, &wire.rotation_y, &wire.rotation_z,
                           &wire.translation_x, &wire.translation_y, &wire.translation_z}) {
    part->resize(n);
    for (auto& row : *part) row.resize(numJoints);
  }
  for (std::size_t i = 0; i < n; ++i) writePose(message.way[i], i, wire);
}

void writeContacts(const SolidMessage& message, solid_t& wire) {
  FORETOUCH_ASSERT(message.contacts.size() <= kMaxSolidContacts);
  const std::size_t n = message.contacts.size();
  resizePushes(n, wire);
  wire.objects.resize(n);
  wire.others.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const SolidContact& contact = message.contacts[i].contact;
    writePush(contact, i, wire);
    wire.link_names[i] = message.contacts[i].linkName;
    wire.objects[i] = message.contacts[i].otherName;
    wire.others[i] = contact.other;
  }
}

/// Keeps its memory: every pose has an answer.
solid_t& scratch() {
  static thread_local solid_t wire;
  return wire;
}

}  // namespace

Reject decode(ByteView payload, SolidMessage& message) {
  solid_t& wire = scratch();
  Reject reject = fromBytes(PayloadType::Solid, payload, wire);
  if (reject == Reject::None) reject = checkHead(wire);
  if (reject != Reject::None) return reject;
  readHead(wire, message);
  reject = readJoints(wire, message);
  if (reject == Reject::None) reject = readWay(wire, message);
  if (reject == Reject::None) reject = readContacts(wire, message);
  return reject;
}

void encode(const SolidMessage& message, Bytes& payload) {
  solid_t& wire = scratch();
  writeHead(message, wire);
  writeJoints(message, wire);
  writeWay(message, wire);
  writeContacts(message, wire);
  toBytes(PayloadType::Solid, wire, payload);
}

}  // namespace foretouch
