#include "middleware/contact.h"

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
  }
  return "none";
}

bool isReportedBefore(const LinkContact& x, const LinkContact& y) {
  const auto timeOf = [](const LinkContact& contact) {
    return contact.verdict == Verdict::Undecided ? contact.freeUntil : contact.toi;
  };
  return std::make_pair(timeOf(x), x.link) < std::make_pair(timeOf(y), y.link);
}

}  // namespace foretouch
