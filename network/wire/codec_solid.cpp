#include <cstddef>
#include <foretouch/solid_t.hpp>
#include <limits>
#include <tuple>

#include "lss/index.h"
#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"
#include "network/wire/push_fields.h"
#include "network/wire/wire_fields.h"

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
// The largest message fits: poses, joints, contacts with their texts, and the rest.
static_assert(kMaxSolidPoses * (kMaxSolidJoints * 7 + 1) * sizeof(double) +
                  kMaxSolidJoints * (sizeof(double) + 1) +
                  kMaxSolidContacts * (kMaxNameBytes + kMaxTextBytes + 2 * 5 + 4 * 4 + 9 * 8) +
                  1024 <=
              kMaxMessageBytes);

using wire::field;
using wire::in;

constexpr wire::Whole kCount{0, std::numeric_limits<std::uint32_t>::max()};
constexpr auto kSolidHead = std::make_tuple(
    field(&SolidMessage::avatar, &solid_t::avatar, wire::kAny),
    field(&SolidMessage::session, &solid_t::session, wire::kWhole),
    field(&SolidMessage::sequence, &solid_t::sequence, wire::kWhole),
    field(&SolidMessage::utimeUs, &solid_t::utime, wire::kWhole),
    field(&SolidMessage::kind, &solid_t::kind, wire::codeBelow(kNumStepKinds)),
    field(&SolidMessage::lost, &solid_t::lost, wire::kWhole),
    field(&SolidMessage::stepUs, &solid_t::step_us, wire::kWhole),
    field(&SolidMessage::avatarHash, &solid_t::avatar_hash, wire::kAny),
    field(&SolidMessage::skin, &solid_t::skin, wire::kNotNegative),
    field(&SolidMessage::tolerance, &solid_t::tolerance, wire::kNotNegative),
    field(&SolidMessage::catchUp, &solid_t::catch_up, wire::kNotNegative),
    field(&SolidMessage::workBudget, &solid_t::work_budget, wire::kWhole),
    field(&SolidMessage::state, &solid_t::state, wire::codeBelow(kNumSolidStates)),
    field(&SolidMessage::limit, &solid_t::limit, wire::codeBelow(kNumSolidLimits)),
    field(&SolidMessage::isCertified, &solid_t::certified, wire::kFlag),
    field(&SolidMessage::hasAppeared, &solid_t::appeared, wire::kFlag),
    field(&SolidMessage::deviation, &solid_t::deviation, wire::kNotNegative),
    field(&SolidMessage::lift, &solid_t::lift, wire::kNotNegative),
    field(&SolidMessage::clearance, &solid_t::clearance, wire::kNotNegative),
    field(&SolidMessage::snapInUs, &solid_t::snap_in_us, wire::Whole{-1}),
    field(&SolidMessage::contactsLeftOut, &solid_t::contacts_left_out, wire::kWhole),
    field(in(&SolidMessage::counters, &SolidCounters::queries), &solid_t::queries, kCount),
    field(in(&SolidMessage::counters, &SolidCounters::iterations), &solid_t::iterations, kCount),
    field(in(&SolidMessage::counters, &SolidCounters::features), &solid_t::features, kCount),
    field(in(&SolidMessage::counters, &SolidCounters::rows), &solid_t::rows, kCount),
    field(in(&SolidMessage::counters, &SolidCounters::aroundQueries), &solid_t::around_queries,
          kCount),
    field(in(&SolidMessage::counters, &SolidCounters::placingQueries), &solid_t::placing_queries,
          kCount),
    field(in(&SolidMessage::counters, &SolidCounters::work), &solid_t::work, wire::kWhole),
    field(&SolidMessage::receiveUtimeUs, &solid_t::receive_utime, wire::kWhole),
    field(&SolidMessage::sendUtimeUs, &solid_t::send_utime, wire::kWhole),
    field(&SolidMessage::solidUs, &solid_t::solid_us, wire::kNotNegative));

constexpr auto kSolidContact = std::tuple_cat(
    wire::pushFields<solid_t>(&ShownContact::contact, &ShownContact::linkName),
    std::make_tuple(
        field(&ShownContact::otherName, &solid_t::objects, wire::kAny),
        field(in(&ShownContact::contact, &SolidContact::other), &solid_t::others, wire::kAny)));

Reject checkLimits(const solid_t& wire) {
  const bool isWithinLimits = wire.num_joints >= 1 && countOf(wire.num_joints) <= kMaxSolidJoints &&
                              wire.num_poses >= 1 && countOf(wire.num_poses) <= kMaxSolidPoses &&
                              countOf(wire.num_contacts) <= kMaxSolidContacts;
  return isWithinLimits ? Reject::None : Reject::Limit;
}

Reject readJoints(const solid_t& wire, SolidMessage& message) {
  const std::size_t n = countOf(wire.num_joints);
  message.joints.resize(n);
  message.linkDeviation = wire.link_deviation;
  for (std::size_t i = 0; i < n; ++i) {
    const Reject reject = wire::kNotNegative(wire.link_deviation[i]);
    if (reject != Reject::None) return reject;
    if (wire.joint_states[i] >= kNumSolidJointStates) return Reject::OutOfRange;
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

}  // namespace

Reject decode(ByteView payload, SolidMessage& message) {
  auto& wire = wire::scratch<solid_t>();
  Reject reject = fromBytes(PayloadType::Solid, payload, wire);
  if (reject == Reject::None) reject = wire::read(wire, kSolidHead, message);
  if (reject == Reject::None) reject = checkLimits(wire);
  if (reject == Reject::None) reject = readJoints(wire, message);
  if (reject == Reject::None) reject = readWay(wire, message);
  if (reject != Reject::None) return reject;
  return wire::readRows(wire, kSolidContact, &solid_t::num_contacts, message.contacts,
                        [&](const ShownContact& shown, std::size_t) {
                          return checkPlace(shown.contact, wire.num_joints);
                        });
}

void encode(const SolidMessage& message, Bytes& payload) {
  FORETOUCH_ASSERT(message.contacts.size() <= kMaxSolidContacts);
  auto& wire = wire::scratch<solid_t>();
  wire::write(message, kSolidHead, wire);
  writeJoints(message, wire);
  writeWay(message, wire);
  wire::writeRows(message.contacts, kSolidContact, &solid_t::num_contacts, wire);
  toBytes(PayloadType::Solid, wire, payload);
}

}  // namespace foretouch
