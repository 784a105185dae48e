// network/wire/push_fields.h: where a solid body is pushed, as messages have it: what solid_t and
// pushes_t have in common of a contact. For the codec's sources only.
#pragma once

#include <string>
#include <tuple>

#include "network/wire/messages.h"
#include "network/wire/wire_fields.h"

namespace foretouch::wire {

/// Of a row that holds a contact and its link's name.
template <typename Wire, typename Row, typename Contact>
constexpr auto pushFields(Contact Row::*contact, std::string Row::*linkName) {
  return std::make_tuple(
      field(in(contact, &Contact::link), &Wire::links, kAny),
      field(linkName, &Wire::link_names, kJointName),
      field(in(contact, &Contact::lss), &Wire::lss, indexFrom(-1)),
      field(in(contact, &Contact::triangle), &Wire::triangles, indexFrom(-1)),
      field(in(contact, &Contact::p_W), &Wire::point_x, &Wire::point_y, &Wire::point_z, kFinite),
      field(in(contact, &Contact::nhat_W), &Wire::normal_x, &Wire::normal_y, &Wire::normal_z,
            kUnit),
      field(in(contact, &Contact::gap), &Wire::gap, kFinite),
      field(in(contact, &Contact::push), &Wire::push, kNotNegative),
      field(in(contact, &Contact::slipSpeed), &Wire::slip_speed, kNotNegative));
}

}  // namespace foretouch::wire
