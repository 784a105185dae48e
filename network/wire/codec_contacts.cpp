#include <bitset>
#include <cstddef>
#include <foretouch/contacts_t.hpp>
#include <optional>
#include <utility>

#include "lss/index.h"
#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"

namespace foretouch {
namespace {

static_assert(static_cast<int>(Verdict::Clear) == contacts_t::CLEAR);
static_assert(static_cast<int>(Verdict::Contact) == contacts_t::CONTACT);
static_assert(static_cast<int>(Verdict::StartsInContact) == contacts_t::STARTS_IN_CONTACT);
static_assert(static_cast<int>(Verdict::Undecided) == contacts_t::UNDECIDED);
static_assert(static_cast<int>(StepKind::Consecutive) == contacts_t::CONSECUTIVE);
static_assert(static_cast<int>(StepKind::First) == contacts_t::FIRST);
static_assert(static_cast<int>(StepKind::AcrossGap) == contacts_t::ACROSS_GAP);
constexpr auto kLastVerdict = static_cast<std::uint8_t>(Verdict::Undecided);
constexpr auto kLastFeature = static_cast<std::uint8_t>(FeatureKind::Face);
constexpr auto kLastKind = static_cast<std::int8_t>(StepKind::AcrossGap);

std::optional<Fidelity> fidelityOf(const std::string& word) {
  for (const Fidelity fidelity : {Fidelity::Link, Fidelity::Exact, Fidelity::Skinned}) {
    if (word == toString(fidelity)) return fidelity;
  }
  return std::nullopt;
}

Reject readHead(const contacts_t& wire, ContactsMessage& message) {
  if (!inRange({wire.session, wire.sequence_from, wire.sequence_to, wire.utime_from, wire.utime_to,
                wire.lost, wire.work_budget, wire.receive_utime, wire.send_utime}) ||
      wire.sequence_from > wire.sequence_to || wire.utime_from > wire.utime_to) {
    return Reject::OutOfRange;
  }
  if (!allFinite({wire.tolerance, wire.query_us})) return Reject::NonFinite;
  const auto fidelity = fidelityOf(wire.fidelity);
  if (wire.kind < 0 || wire.kind > kLastKind || wire.tolerance < 0.0 || wire.query_us < 0.0 ||
      !fidelity) {
    return Reject::OutOfRange;
  }
  message.avatar = wire.avatar;
  message.session = wire.session;
  message.sequenceFrom = wire.sequence_from;
  message.sequenceTo = wire.sequence_to;
  message.utimeFromUs = wire.utime_from;
  message.utimeToUs = wire.utime_to;
  message.skeletonHash = wire.skeleton_hash;
  message.kind = static_cast<StepKind>(wire.kind);
  message.lost = wire.lost;
  message.tolerance = wire.tolerance;
  message.fidelity = *fidelity;
  message.workBudget = wire.work_budget;
  message.receiveUtimeUs = wire.receive_utime;
  message.sendUtimeUs = wire.send_utime;
  message.queryUs = wire.query_us;
  return Reject::None;
}

/// Every verdict, and which of the links must be among the contacts.
Reject readVerdicts(const contacts_t& wire, std::vector<Verdict>& verdicts, std::size_t& notClear) {
  notClear = 0;
  verdicts.resize(static_cast<std::size_t>(wire.num_links));
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    if (wire.verdicts[i] > kLastVerdict) return Reject::OutOfRange;
    verdicts[i] = static_cast<Verdict>(wire.verdicts[i]);
    if (verdicts[i] != Verdict::Clear) ++notClear;
  }
  return Reject::None;
}

/// +0.0, which stands in for a number without meaning.
bool isNothing(double number) {
  return number == 0.0 && !std::signbit(number);
}

bool isNothing(const Eigen::Vector3d& vector) {
  return isNothing(vector.x()) && isNothing(vector.y()) && isNothing(vector.z());
}

Reject checkCodes(const contacts_t& wire, std::size_t i, Verdict verdict) {
  const bool undecided = verdict == Verdict::Undecided;
  if (wire.reasons[i] >= kNumUndecidedReasons || (wire.reasons[i] != 0) != undecided ||
      wire.link_features[i] > kLastFeature || wire.scene_features[i] > kLastFeature ||
      wire.triangles[i] < -1 || wire.link_triangles[i] < -1) {
    return Reject::OutOfRange;
  }
  return nameProblem(wire.link_names[i]) ? Reject::BadName : Reject::None;
}

Reject checkNumbers(const LinkContact& contact) {
  if (!allFinite({contact.freeUntil, contact.separation, contact.penetration}) ||
      !contact.p_WScene.allFinite() || !contact.p_WLink.allFinite() ||
      !contact.nhat_SL_W.allFinite()) {
    return Reject::NonFinite;
  }
  const bool inside = contact.freeUntil >= 0.0 && contact.freeUntil <= 1.0 &&
                      contact.separation >= 0.0 && contact.penetration >= 0.0;
  return inside ? Reject::None : Reject::OutOfRange;
}

/// An undecided link has no contact to describe.
bool describesNothing(const contacts_t& wire, std::size_t i, const LinkContact& contact) {
  return isNothing(contact.separation) && isNothing(contact.penetration) &&
         isNothing(contact.p_WScene) && isNothing(contact.p_WLink) &&
         isNothing(contact.nhat_SL_W) && contact.triangle == -1 && wire.objects[i].empty() &&
         contact.linkTriangle == -1 && wire.link_features[i] == 0 && wire.scene_features[i] == 0;
}

Reject readContact(contacts_t& wire, std::size_t i, Verdict verdict, AnsweredContact& answered) {
  Reject reject = checkCodes(wire, i, verdict);
  if (reject != Reject::None) return reject;
  LinkContact contact;
  contact.link = wire.links[i];
  contact.verdict = verdict;
  contact.toi = contact.freeUntil = wire.free_until[i];
  contact.separation = wire.separation[i];
  contact.penetration = wire.penetration[i];
  contact.triangle = wire.triangles[i];
  contact.p_WScene = {wire.point_x[i], wire.point_y[i], wire.point_z[i]};
  contact.p_WLink = {wire.on_link_x[i], wire.on_link_y[i], wire.on_link_z[i]};
  contact.nhat_SL_W = {wire.normal_x[i], wire.normal_y[i], wire.normal_z[i]};
  contact.linkTriangle = wire.link_triangles[i];
  reject = checkNumbers(contact);
  if (reject != Reject::None) return reject;
  contact.reason = static_cast<UndecidedReason>(wire.reasons[i]);
  if (verdict == Verdict::Undecided) {
    if (!describesNothing(wire, i, contact)) return Reject::OutOfRange;
  } else {
    contact.linkFeature = static_cast<FeatureKind>(wire.link_features[i]);
    contact.sceneFeature = static_cast<FeatureKind>(wire.scene_features[i]);
  }
  answered.contact = contact;
  answered.linkName = wire.link_names[i];
  answered.objectName = wire.objects[i];
  return Reject::None;
}

/// Requires every link that is not clear once, and no other. Linear in links and contacts.
Reject readContacts(contacts_t& wire, ContactsMessage& message) {
  std::size_t notClear = 0;
  Reject reject = readVerdicts(wire, message.verdicts, notClear);
  if (reject != Reject::None) return reject;
  const auto numContacts = static_cast<std::size_t>(wire.num_contacts);
  std::bitset<static_cast<std::size_t>(kMaxListed)> listed;
  message.contacts.resize(numContacts);
  for (std::size_t i = 0; i < numContacts; ++i) {
    const std::int32_t link = wire.links[i];
    if (link < 0 || link >= wire.num_links) return Reject::BadIndex;
    const auto place = slotOf(link);
    if (listed[place] || message.verdicts[place] == Verdict::Clear) return Reject::BadIndex;
    listed.set(place);
    reject = readContact(wire, i, message.verdicts[place], message.contacts[i]);
    if (reject != Reject::None) return reject;
  }
  return numContacts == notClear ? Reject::None : Reject::BadIndex;
}

void writeHead(const ContactsMessage& message, contacts_t& wire) {
  wire.version = kMessageVersion;
  wire.avatar = message.avatar;
  wire.session = message.session;
  wire.sequence_from = message.sequenceFrom;
  wire.sequence_to = message.sequenceTo;
  wire.utime_from = message.utimeFromUs;
  wire.utime_to = message.utimeToUs;
  wire.skeleton_hash = message.skeletonHash;
  wire.kind = static_cast<std::int8_t>(message.kind);
  wire.lost = message.lost;
  wire.tolerance = message.tolerance;
  wire.fidelity = toString(message.fidelity);
  wire.work_budget = message.workBudget;
  wire.receive_utime = message.receiveUtimeUs;
  wire.send_utime = message.sendUtimeUs;
  wire.query_us = message.queryUs;
}

void resizeContacts(std::size_t n, contacts_t& wire) {
  wire.num_contacts = static_cast<std::int32_t>(n);
  for (auto* const part : {&wire.links, &wire.triangles, &wire.link_triangles}) part->resize(n);
  for (auto* const part : {&wire.link_names, &wire.objects}) part->resize(n);
  for (auto* const part : {&wire.reasons, &wire.link_features, &wire.scene_features}) {
    part->resize(n);
  }
  for (auto* const part : {&wire.free_until, &wire.separation, &wire.penetration, &wire.point_x,
                           &wire.point_y, &wire.point_z, &wire.on_link_x, &wire.on_link_y,
                           &wire.on_link_z, &wire.normal_x, &wire.normal_y, &wire.normal_z}) {
    part->resize(n);
  }
}

void writeContact(const AnsweredContact& answered, std::size_t i, contacts_t& wire) {
  const LinkContact& contact = answered.contact;
  // Without a contact, its fields are 0, -1 or "".
  const bool described = contact.verdict != Verdict::Undecided;
  const Eigen::Vector3d nothing = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& point = described ? contact.p_WScene : nothing;
  const Eigen::Vector3d& onLink = described ? contact.p_WLink : nothing;
  const Eigen::Vector3d& normal = described ? contact.nhat_SL_W : nothing;
  wire.links[i] = contact.link;
  wire.link_names[i] = answered.linkName;
  wire.reasons[i] = static_cast<std::uint8_t>(contact.reason);
  wire.free_until[i] = contact.freeUntil;
  wire.separation[i] = described ? contact.separation : 0.0;
  wire.penetration[i] = described ? contact.penetration : 0.0;
  wire.point_x[i] = point.x();
  wire.point_y[i] = point.y();
  wire.point_z[i] = point.z();
  wire.on_link_x[i] = onLink.x();
  wire.on_link_y[i] = onLink.y();
  wire.on_link_z[i] = onLink.z();
  wire.normal_x[i] = normal.x();
  wire.normal_y[i] = normal.y();
  wire.normal_z[i] = normal.z();
  wire.triangles[i] = described ? contact.triangle : -1;
  wire.objects[i].clear();
  if (described) wire.objects[i] = answered.objectName;
  wire.link_triangles[i] = described ? contact.linkTriangle : -1;
  wire.link_features[i] = described ? static_cast<std::uint8_t>(contact.linkFeature) : 0;
  wire.scene_features[i] = described ? static_cast<std::uint8_t>(contact.sceneFeature) : 0;
}

/// Keeps its memory: every pose has an answer.
contacts_t& scratch() {
  static thread_local contacts_t wire;
  return wire;
}

/// Of receive_utime, send_utime and query_us; in a solid_t solid_us.
constexpr std::size_t kStampBytes = 2 * sizeof(std::int64_t) + sizeof(double);

}  // namespace

Reject decode(ByteView payload, ContactsMessage& message) {
  contacts_t& wire = scratch();
  Reject reject = fromBytes(PayloadType::Contacts, payload, wire);
  if (reject == Reject::None) reject = readHead(wire, message);
  if (reject == Reject::None) reject = readContacts(wire, message);
  return reject;
}

void encode(const ContactsMessage& message, Bytes& payload) {
  contacts_t& wire = scratch();
  writeHead(message, wire);
  wire.num_links = static_cast<std::int32_t>(message.verdicts.size());
  wire.verdicts.resize(message.verdicts.size());
  for (std::size_t i = 0; i < message.verdicts.size(); ++i) {
    wire.verdicts[i] = static_cast<std::uint8_t>(message.verdicts[i]);
  }
  resizeContacts(message.contacts.size(), wire);
  for (std::size_t i = 0; i < message.contacts.size(); ++i) {
    writeContact(message.contacts[i], i, wire);
  }
  toBytes(PayloadType::Contacts, wire, payload);
}

ByteView verdictBytes(ByteView payload) {
  if (payload.size < kStampBytes) return {};
  return {payload.data, payload.size - kStampBytes};
}

}  // namespace foretouch
