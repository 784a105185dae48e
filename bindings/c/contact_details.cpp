// bindings/c/contact_details.cpp: more about one contact of a query's last step.
#include <cstddef>

#include "bindings/c/last_step.h"
#include "bindings/c/sized_struct.h"
#include "lss/index.h"
#include "middleware/query/query.h"

namespace foretouch::c {
namespace {

static_assert(ContactDetails::kMostPoints == FT_MOST_CONTACT_POINTS);

ft_contact_point pointOf(const ContactPoint& point) {
  ft_contact_point p{};
  Eigen::Map<Eigen::Vector3d>(p.point_scene) = point.p_WOther;
  Eigen::Map<Eigen::Vector3d>(p.point_link) = point.p_WLink;
  p.separation = point.separation;
  p.triangle = point.triangle;
  p.lss = point.lss;
  p.link_triangle = point.linkTriangle;
  return p;
}

ft_contact_details detailsOf(const ContactDetails& details) {
  ft_contact_details d{};
  d.point_count = static_cast<std::int32_t>(details.numPoints);
  Eigen::Map<Eigen::Vector3d>(d.velocity_scene) = details.v_WOther;
  Eigen::Map<Eigen::Vector3d>(d.velocity_link) = details.v_WLink;
  d.approach_speed = details.approachSpeed;
  d.approach_lower = details.approachLower;
  d.approach_upper = details.approachUpper;
  for (std::size_t i = 0; i < details.numPoints; ++i) d.points[i] = pointOf(details.points[i]);
  return d;
}

/// Where a list has its contact; one of the two is set.
struct Found {
  const LinkContact* contact = nullptr;
  const PairContact* pair = nullptr;
};

ft_status checkedIndex(std::size_t index, std::size_t count) {
  if (index < count) return FT_OK;
  return failure(FT_ERROR_OUT_OF_RANGE, static_cast<std::int64_t>(index),
                 "index: expected one of the list's %zu contacts, found %zu", count, index);
}

ft_status findIn(const std::vector<LinkContact>& contacts, std::size_t index, Found& found) {
  if (const auto s = checkedIndex(index, contacts.size()); s != FT_OK) return s;
  found.contact = &contacts[index];
  return FT_OK;
}

ft_status find(const ft_query& query, std::int32_t list, std::size_t index, Found& found) {
  const StepContacts& answer = query.step.answer;
  switch (list) {
    case FT_LIST_LINKS: return findIn(answer.links, index, found);
    case FT_LIST_CONTACTS: {
      const auto& reported = query.step.reported;
      if (const auto s = checkedIndex(index, reported.size()); s != FT_OK) return s;
      found.contact = &answer.links[slotOf(reported[index])];
      return FT_OK;
    }
    case FT_LIST_OBJECTS: {
      if (const auto s = checkedObjects(&query); s != FT_OK) return s;
      return findIn(answer.perObject, index, found);
    }
    case FT_LIST_PAIRS: {
      if (const auto s = checkedPairs(&query); s != FT_OK) return s;
      if (const auto s = checkedIndex(index, answer.pairs.size()); s != FT_OK) return s;
      found.contact = found.pair = &answer.pairs[index];
      return FT_OK;
    }
    default: break;
  }
  return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex, "list: expected one of FT_LIST_*, found %d",
                 list);
}

ft_status checkedTouch(const LinkContact& contact) {
  if (contact.verdict == Verdict::Contact || contact.verdict == Verdict::StartsInContact) {
    return FT_OK;
  }
  return failure(FT_ERROR_MISMATCH, contact.link,
                 "index: expected a contact, found a link that is %s: nothing is touched there",
                 toString(contact.verdict));
}

}  // namespace
}  // namespace foretouch::c

using namespace foretouch;
using namespace foretouch::c;

ft_status ft_query_details(ft_query* query, int32_t list, size_t index,
                           ft_contact_details* details) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = needed(details, "details"); s != FT_OK) return s;
    if (const auto s = checkedStep(query); s != FT_OK) return s;
    Found found;
    if (const auto s = find(*query, list, index, found); s != FT_OK) return s;
    if (const auto s = checkedTouch(*found.contact); s != FT_OK) return s;
    if (query->isScratchSuspect) query->scratch = Scratch();
    query->isScratchSuspect = true;
    const ChainMotion& motion = query->step.motion;
    const ContactDetails known =
        found.pair != nullptr ? query->question->details(motion, *found.pair, query->scratch)
                              : query->question->details(motion, *found.contact, query->scratch);
    query->isScratchSuspect = false;
    return writeStruct(details, "ft_contact_details", detailsOf(known));
  });
}
