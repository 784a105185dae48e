#include "middleware/contact.h"

#include <algorithm>
#include <utility>

namespace foretouch {

const char* toString(Verdict verdict) {
  switch (verdict) {
    case Verdict::Clear: return "clear";
    case Verdict::Contact: return "contact";
    case Verdict::StartsInContact: return "starts_in_contact";
    case Verdict::Undecided: return "undecided";
  }
  return "undecided";
}

const char* toString(UndecidedReason reason) {
  switch (reason) {
    case UndecidedReason::None: return "none";
    case UndecidedReason::WorkBudget: return "work-budget";
    case UndecidedReason::Resolution: return "resolution";
    case UndecidedReason::AfterFirst: return "after-first";
    case UndecidedReason::Gap: return "gap";
    case UndecidedReason::MissingJoint: return "missing-joint";
    case UndecidedReason::InvalidJoint: return "invalid-joint";
    case UndecidedReason::StaleJoint: return "stale-joint";
    case UndecidedReason::UnmatchedJoint: return "unmatched-joint";
  }
  return "none";
}

LinkContact undecidedContact(LinkId link, double freeUntil, UndecidedReason reason) {
  LinkContact contact;
  contact.link = link;
  contact.verdict = Verdict::Undecided;
  contact.reason = reason;
  contact.freeUntil = contact.toi = freeUntil;
  return contact;
}

bool isReportedBefore(const LinkContact& x, const LinkContact& y) {
  const auto timeOf = [](const LinkContact& contact) {
    return contact.verdict == Verdict::Undecided ? contact.freeUntil : contact.toi;
  };
  return std::make_pair(timeOf(x), x.link) < std::make_pair(timeOf(y), y.link);
}

std::vector<LinkId> reported(const StepContacts& step) {
  std::vector<LinkId> links;
  listReported(step.links.data(), step.links.size(), links);
  return links;
}

void listReported(const LinkContact* contacts, std::size_t count, std::vector<LinkId>& links) {
  links.clear();
  for (std::size_t i = 0; i < count; ++i) {
    if (contacts[i].verdict != Verdict::Clear) links.push_back(static_cast<LinkId>(i));
  }
  std::sort(links.begin(), links.end(),
            [contacts](LinkId x, LinkId y) { return isReportedBefore(contacts[x], contacts[y]); });
}

}  // namespace foretouch
