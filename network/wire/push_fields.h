// network/wire/push_fields.h: where a solid body is pushed, as messages have it: what solid_t and
// pushes_t have in common of a contact. For the codec's sources only.
#pragma once

#include <cstddef>
#include <cstdint>

#include "network/wire/codec_lcm.h"
#include "network/wire/messages.h"

namespace foretouch {

/// A unit vector's norm may be off by this much.
inline constexpr double kMaxNormalError = 1e-6;

template <typename Wire>
void resizePushes(std::size_t n, Wire& wire) {
  wire.num_contacts = static_cast<std::int32_t>(n);
  wire.link_names.resize(n);
  for (auto* const part : {&wire.links, &wire.lss, &wire.triangles}) part->resize(n);
  for (auto* const part :
       {&wire.point_x, &wire.point_y, &wire.point_z, &wire.normal_x, &wire.normal_y, &wire.normal_z,
        &wire.gap, &wire.push, &wire.slip_speed}) {
    part->resize(n);
  }
}

template <typename Contact, typename Wire>
void writePush(const Contact& contact, std::size_t i, Wire& wire) {
  wire.links[i] = contact.link;
  wire.lss[i] = contact.lss;
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

/// The numbers as they are; checkPush() says what is wrong with them.
template <typename Contact, typename Wire>
void readPush(const Wire& wire, std::size_t i, Contact& contact) {
  contact.link = wire.links[i];
  contact.lss = wire.lss[i];
  contact.triangle = wire.triangles[i];
  contact.p_W = {wire.point_x[i], wire.point_y[i], wire.point_z[i]};
  contact.nhat_W = {wire.normal_x[i], wire.normal_y[i], wire.normal_z[i]};
  contact.gap = wire.gap[i];
  contact.push = wire.push[i];
  contact.slipSpeed = wire.slip_speed[i];
}

template <typename Contact>
[[nodiscard]] Reject checkPush(const Contact& contact) {
  if (!contact.p_W.allFinite() || !contact.nhat_W.allFinite() ||
      !allFinite({contact.gap, contact.push, contact.slipSpeed})) {
    return Reject::NonFinite;
  }
  const bool isInside = contact.nhat_W.norm() <= 1.0 + kMaxNormalError && contact.push >= 0.0 &&
                        contact.slipSpeed >= 0.0;
  return isInside ? Reject::None : Reject::OutOfRange;
}

}  // namespace foretouch
