#include <cstddef>
#include <tuple>

#include "lss/index.h"
#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"
#include "network/wire/message_fields.h"

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

constexpr auto kSolid = std::tuple_cat(
    wire::kSolidKey, wire::kSolidOptions, wire::kSolidState, wire::kSolidLengths,
    wire::kSolidLeftOut, wire::solidCounters(&SolidMessage::counters), wire::kSolidStamps);
constexpr auto kSolidContact = std::tuple_cat(wire::kShownSides, wire::kShownPush);

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
  if (reject == Reject::None) reject = wire::read(wire, kSolid, message);
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
  wire::write(message, kSolid, wire);
  writeJoints(message, wire);
  writeWay(message, wire);
  wire::writeRows(message.contacts, kSolidContact, &solid_t::num_contacts, wire);
  toBytes(PayloadType::Solid, wire, payload);
}

}  // namespace foretouch
