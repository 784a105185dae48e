// tests/support/judged_answer.h: a link's answer in the judge's form.
#pragma once

#include "judge/judge.h"
#include "middleware/contact.h"
#include "tests/support/judged.h"

namespace foretouch::test {

inline oracle::Verdict plain(Verdict verdict) {
  switch (verdict) {
    case Verdict::Clear: return oracle::Verdict::Clear;
    case Verdict::Contact: return oracle::Verdict::Contact;
    case Verdict::StartsInContact: return oracle::Verdict::StartsInContact;
    case Verdict::Undecided: return oracle::Verdict::Undecided;
  }
  return oracle::Verdict::Undecided;
}

/// Its piece is the LSS; for a link's own surface, the triangle.
inline oracle::Answer plain(const LinkContact& contact) {
  oracle::Answer answer;
  answer.verdict = plain(contact.verdict);
  answer.toi = contact.toi;
  answer.freeUntil = contact.freeUntil;
  answer.separation = contact.separation;
  answer.penetration = contact.penetration;
  answer.triangle = contact.triangle;
  answer.capsule = contact.linkTriangle >= 0 ? contact.linkTriangle : contact.lss;
  answer.onScene = plain(contact.p_WScene);
  answer.onLink = plain(contact.p_WLink);
  answer.normal = plain(contact.nhat_SL_W);
  return answer;
}

}  // namespace foretouch::test
