#include <foretouch/pushes_t.hpp>

#include "lss/index.h"
#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"
#include "network/wire/push_fields.h"
#include "network/wire/world_messages.h"

namespace foretouch {
namespace {

// The largest message fits.
static_assert((kMaxToldPushes + kMaxToldCrushes) * (kMaxNameBytes + 5 + 4 * 4 + 9 * 8) + 1024 <=
              kMaxMessageBytes);

Reject readHead(const pushes_t& wire, PushesMessage& message) {
  if (!inRange({wire.session, wire.sequence, wire.utime, wire.step_us, wire.timeline,
                wire.contacts_left_out, wire.crushes_left_out, wire.receive_utime,
                wire.send_utime})) {
    return Reject::OutOfRange;
  }
  if (!std::isfinite(wire.tick_us)) return Reject::NonFinite;
  if (wire.tick_us < 0.0 || (wire.assumed != 0 && wire.assumed != 1)) return Reject::OutOfRange;
  if (countOf(wire.num_contacts) > kMaxToldPushes || countOf(wire.num_crushes) > kMaxToldCrushes) {
    return Reject::Limit;
  }
  message.avatar = wire.avatar;
  message.session = wire.session;
  message.sequence = wire.sequence;
  message.utimeUs = wire.utime;
  message.stepUs = wire.step_us;
  message.timeline = wire.timeline;
  message.isAssumed = wire.assumed != 0;
  message.contactsLeftOut = wire.contacts_left_out;
  message.crushesLeftOut = wire.crushes_left_out;
  message.receiveUtimeUs = wire.receive_utime;
  message.sendUtimeUs = wire.send_utime;
  message.tickUs = wire.tick_us;
  return wire.avatar >= 0 ? Reject::None : Reject::BadIndex;
}

/// A link of a body, and another body.
Reject checkPair(const PushesMessage& message, LinkId link, BodyNumber other,
                 const std::string& name) {
  if (link < 0 || link >= kMaxJoints || other < 0 || other == message.avatar) {
    return Reject::BadIndex;
  }
  return nameProblem(name) ? Reject::BadName : Reject::None;
}

Reject readContacts(const pushes_t& wire, PushesMessage& message) {
  message.contacts.resize(countOf(wire.num_contacts));
  for (std::size_t i = 0; i < message.contacts.size(); ++i) {
    SolidBodyContact& contact = message.contacts[i].contact;
    readPush(wire, i, contact);
    contact.body = wire.bodies[i];
    message.contacts[i].linkName = wire.link_names[i];
    if (contact.lss < -1 || contact.triangle < -1) return Reject::BadIndex;
    Reject reject = checkPair(message, contact.link, contact.body, wire.link_names[i]);
    if (reject == Reject::None) reject = checkPush(contact);
    if (reject != Reject::None) return reject;
  }
  return Reject::None;
}

Reject readCrushes(const pushes_t& wire, PushesMessage& message) {
  message.crushes.resize(countOf(wire.num_crushes));
  for (std::size_t i = 0; i < message.crushes.size(); ++i) {
    SolidCrush& crush = message.crushes[i].crush;
    crush = {wire.crushers[i], wire.crushed_links[i], wire.crushed_since[i], wire.over[i] != 0,
             wire.depth[i]};
    message.crushes[i].linkName = wire.crushed_names[i];
    if (!std::isfinite(crush.depth)) return Reject::NonFinite;
    if (!inRange({crush.sinceUs}) || crush.depth < 0.0 || wire.over[i] > 1) {
      return Reject::OutOfRange;
    }
    const Reject reject = checkPair(message, crush.link, crush.body, wire.crushed_names[i]);
    if (reject != Reject::None) return reject;
  }
  return Reject::None;
}

void writeHead(const PushesMessage& message, pushes_t& wire) {
  wire.version = kMessageVersion;
  wire.avatar = message.avatar;
  wire.session = message.session;
  wire.sequence = message.sequence;
  wire.utime = message.utimeUs;
  wire.step_us = message.stepUs;
  wire.timeline = message.timeline;
  wire.assumed = message.isAssumed ? 1 : 0;
  wire.contacts_left_out = message.contactsLeftOut;
  wire.crushes_left_out = message.crushesLeftOut;
  wire.receive_utime = message.receiveUtimeUs;
  wire.send_utime = message.sendUtimeUs;
  wire.tick_us = message.tickUs;
}

void writeContacts(const PushesMessage& message, pushes_t& wire) {
  FORETOUCH_ASSERT(message.contacts.size() <= kMaxToldPushes);
  const std::size_t n = message.contacts.size();
  resizePushes(n, wire);
  wire.bodies.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const SolidBodyContact& contact = message.contacts[i].contact;
    writePush(contact, i, wire);
    wire.link_names[i] = message.contacts[i].linkName;
    wire.bodies[i] = contact.body;
  }
}

void writeCrushes(const PushesMessage& message, pushes_t& wire) {
  FORETOUCH_ASSERT(message.crushes.size() <= kMaxToldCrushes);
  const std::size_t n = message.crushes.size();
  wire.num_crushes = static_cast<std::int32_t>(n);
  wire.crushers.resize(n);
  wire.crushed_links.resize(n);
  wire.crushed_names.resize(n);
  wire.crushed_since.resize(n);
  wire.over.resize(n);
  wire.depth.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const SolidCrush& crush = message.crushes[i].crush;
    wire.crushers[i] = crush.body;
    wire.crushed_links[i] = crush.link;
    wire.crushed_names[i] = message.crushes[i].linkName;
    wire.crushed_since[i] = crush.sinceUs;
    wire.over[i] = crush.isOver ? 1 : 0;
    wire.depth[i] = crush.depth;
  }
}

/// Keeps its memory: every tick has one.
pushes_t& scratch() {
  static thread_local pushes_t wire;
  return wire;
}

}  // namespace

Reject decode(ByteView payload, PushesMessage& message) {
  pushes_t& wire = scratch();
  Reject reject = fromBytes(PayloadType::Pushes, payload, wire);
  if (reject == Reject::None) reject = readHead(wire, message);
  if (reject == Reject::None) reject = readContacts(wire, message);
  if (reject == Reject::None) reject = readCrushes(wire, message);
  return reject;
}

void encode(const PushesMessage& message, Bytes& payload) {
  pushes_t& wire = scratch();
  writeHead(message, wire);
  writeContacts(message, wire);
  writeCrushes(message, wire);
  toBytes(PayloadType::Pushes, wire, payload);
}

}  // namespace foretouch
