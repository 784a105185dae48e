#include <bitset>
#include <cstddef>
#include <optional>
#include <tuple>

#include "lss/index.h"
#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"
#include "network/wire/message_fields.h"

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

constexpr auto kContacts =
    std::tuple_cat(wire::kContactsKey, wire::kContactsStep, wire::kContactsTolerance,
                   wire::kContactsOptions, wire::kContactsStamps);
constexpr auto kContact = std::tuple_cat(wire::kContactLink, wire::kContact);

std::optional<Fidelity> fidelityOf(const std::string& word) {
  for (const Fidelity fidelity : {Fidelity::Link, Fidelity::Exact, Fidelity::Skinned}) {
    if (word == toString(fidelity)) return fidelity;
  }
  return std::nullopt;
}

Reject readHead(const contacts_t& wire, ContactsMessage& message) {
  const Reject reject = wire::read(wire, kContacts, message);
  const auto fidelity = fidelityOf(wire.fidelity);
  if (reject != Reject::None) return reject;
  if (wire.sequence_from > wire.sequence_to || wire.utime_from > wire.utime_to || !fidelity) {
    return Reject::OutOfRange;
  }
  message.fidelity = *fidelity;
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

/// An undecided link has no contact to describe: what a contact has is 0, -1 or "".
AnsweredContact bare(const LinkContact& contact) {
  AnsweredContact row;
  row.contact = undecidedContact(contact.link, contact.freeUntil, contact.reason);
  row.contact.linkFeature = row.contact.sceneFeature = FeatureKind{};
  return row;
}

/// What the row itself does not say; and what may not be said of an undecided link.
Reject settle(AnsweredContact& answered) {
  LinkContact& contact = answered.contact;
  const bool isUndecided = contact.verdict == Verdict::Undecided;
  if ((contact.reason != UndecidedReason::None) != isUndecided) return Reject::OutOfRange;
  contact.toi = contact.freeUntil;
  contact.lss = -1;  // does not travel
  if (!isUndecided) return Reject::None;
  const bool isBare = wire::areSame(answered, bare(contact), wire::kContact);
  contact.linkFeature = LinkContact{}.linkFeature;
  contact.sceneFeature = LinkContact{}.sceneFeature;
  return isBare ? Reject::None : Reject::OutOfRange;
}

/// Requires every link that is not clear once, and no other. Linear in links and contacts.
Reject readContacts(const contacts_t& wire, ContactsMessage& message) {
  std::size_t notClear = 0;
  Reject reject = readVerdicts(wire, message.verdicts, notClear);
  if (reject != Reject::None) return reject;
  std::bitset<static_cast<std::size_t>(kMaxListed)> listed;
  const auto settleRow = [&](AnsweredContact& answered, std::size_t) {
    LinkContact& contact = answered.contact;
    if (contact.link >= wire.num_links) return Reject::BadIndex;
    const auto place = slotOf(contact.link);
    contact.verdict = message.verdicts[place];
    if (listed[place] || contact.verdict == Verdict::Clear) return Reject::BadIndex;
    listed.set(place);
    return settle(answered);
  };
  reject = wire::readRows(wire, kContact, &contacts_t::num_contacts, message.contacts, settleRow);
  if (reject != Reject::None) return reject;
  return message.contacts.size() == notClear ? Reject::None : Reject::BadIndex;
}

/// The size of receive_utime, send_utime and query_us; in a solid_t solid_us.
constexpr std::size_t kStampBytes = 2 * sizeof(std::int64_t) + sizeof(double);

}  // namespace

Reject decode(ByteView payload, ContactsMessage& message) {
  auto& wire = wire::scratch<contacts_t>();
  Reject reject = fromBytes(PayloadType::Contacts, payload, wire);
  if (reject == Reject::None) reject = readHead(wire, message);
  if (reject == Reject::None) reject = readContacts(wire, message);
  return reject;
}

void encode(const ContactsMessage& message, Bytes& payload) {
  auto& wire = wire::scratch<contacts_t>();
  wire::write(message, kContacts, wire);
  wire.fidelity = toString(message.fidelity);
  wire.num_links = static_cast<std::int32_t>(message.verdicts.size());
  wire.verdicts.resize(message.verdicts.size());
  for (std::size_t i = 0; i < message.verdicts.size(); ++i) {
    wire.verdicts[i] = static_cast<std::uint8_t>(message.verdicts[i]);
  }
  wire::resize(message.contacts.size(), kContact, &contacts_t::num_contacts, wire);
  for (std::size_t i = 0; i < message.contacts.size(); ++i) {
    const AnsweredContact& answered = message.contacts[i];
    wire::write(answered, kContact, wire, i);
    if (answered.contact.verdict != Verdict::Undecided) continue;
    wire::write(bare(answered.contact), wire::kContact, wire, i);
  }
  toBytes(PayloadType::Contacts, wire, payload);
}

ByteView verdictBytes(ByteView payload) {
  if (payload.size < kStampBytes) return {};
  return {payload.data, payload.size - kStampBytes};
}

}  // namespace foretouch
