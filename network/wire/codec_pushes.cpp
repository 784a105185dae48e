#include <foretouch/pushes_t.hpp>

#include "lss/index.h"
#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"
#include "network/wire/world_messages.h"

namespace foretouch {
namespace {

/// A unit vector's norm may be off by this much.
constexpr double kMostNormalError = 1e-6;

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

Reject checkNumbers(const SolidBodyContact& contact) {
  if (!contact.p_W.allFinite() || !contact.nhat_W.allFinite() ||
      !allFinite({contact.gap, contact.push, contact.slipSpeed})) {
    return Reject::NonFinite;
  }
  const bool isInside = contact.nhat_W.norm() <= 1.0 + kMostNormalError && contact.push >= 0.0 &&
                        contact.slipSpeed >= 0.0;
  return isInside ? Reject::None : Reject::OutOfRange;
}

Reject readContacts(const pushes_t& wire, PushesMessage& message) {
  message.contacts.resize(countOf(wire.num_contacts));
  for (std::size_t i = 0; i < message.contacts.size(); ++i) {
    SolidBodyContact& contact = message.contacts[i].contact;
    contact.body = wire.bodies[i];
    contact.link = wire.links[i];
    contact.lss = wire.lss[i];
    contact.triangle = wire.triangles[i];
    contact.p_W = {wire.point_x[i], wire.point_y[i], wire.point_z[i]};
    contact.nhat_W = {wire.normal_x[i], wire.normal_y[i], wire.normal_z[i]};
    contact.gap = wire.gap[i];
    contact.push = wire.push[i];
    contact.slipSpeed = wire.slip_speed[i];
    message.contacts[i].linkName = wire.link_names[i];
    if (contact.lss < -1 || contact.triangle < -1) return Reject::BadIndex;
    Reject reject = checkPair(message, contact.link, contact.body, wire.link_names[i]);
    if (reject == Reject::None) reject = checkNumbers(contact);
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

void resizeContacts(std::size_t n, pushes_t& wire) {
  wire.num_contacts = static_cast<std::int32_t>(n);
  wire.link_names.resize(n);
  for (auto* const part : {&wire.links, &wire.lss, &wire.bodies, &wire.triangles}) part->resize(n);
  for (auto* const part :
       {&wire.point_x, &wire.point_y, &wire.point_z, &wire.normal_x, &wire.normal_y, &wire.normal_z,
        &wire.gap, &wire.push, &wire.slip_speed}) {
    part->resize(n);
  }
}

void writeContacts(const PushesMessage& message, pushes_t& wire) {
  FORETOUCH_ASSERT(message.contacts.size() <= kMaxToldPushes);
  resizeContacts(message.contacts.size(), wire);
  for (std::size_t i = 0; i < message.contacts.size(); ++i) {
    const SolidBodyContact& contact = message.contacts[i].contact;
    wire.links[i] = contact.link;
    wire.link_names[i] = message.contacts[i].linkName;
    wire.lss[i] = contact.lss;
    wire.bodies[i] = contact.body;
    wire.triangles[i] = contact.triangle;
    wire.point_x[i] = contact.p_W.x();
    wire.point_y[i] = contact.p_W.y();
    wire.point_z[i] = contact.p_W.z();
    wire.normal_x[i] = contact.nhat_W.x();
    wire.normal_y[i] = contact.nhat_W.y();
    wire.normal_z[i] = contact.nhat_W.z();
    wire.gap[i] = contact.gap;
    wire.push[i] = contact.push;
    wire.slip_speed[i] = contact.slipSpeed;
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
