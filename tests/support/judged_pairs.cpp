#include "tests/support/judged_pairs.h"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <tuple>
#include <utility>

#include "lss/index.h"
#include "tests/support/judged_answer.h"
#include "tests/support/own_surface.h"

namespace foretouch::test {
namespace {

oracle::Judgement inconsistent(const char* what) {
  oracle::Judgement judgement;
  judgement.finding = oracle::Finding::Inconsistent;
  judgement.what = what;
  return judgement;
}

PairContact clearPair(LinkId a, LinkId b) {
  PairContact contact;
  contact.link = a;
  contact.other = b;
  contact.verdict = Verdict::Clear;
  contact.toi = contact.freeUntil = 1.0;
  return contact;
}

}  // namespace

std::string JudgedPair::text(const Skeleton& skeleton) const {
  std::ostringstream line;
  line << "links " << contact.link << " '" << skeleton.name(contact.link) << "' lss " << contact.lss
       << " triangle " << contact.linkTriangle << " and " << contact.other << " '"
       << skeleton.name(contact.other) << "' lss " << contact.otherLss << " triangle "
       << contact.triangle << ": " << toString(verdict) << std::setprecision(17) << ", toi "
       << contact.toi << ", free until " << contact.freeUntil << ", separation "
       << contact.separation << ", penetration " << contact.penetration << " -> "
       << toString(judgement.finding);
  if (!judgement.what.empty()) line << " (" << judgement.what << ")";
  line << ": at t " << std::setprecision(21) << judgement.time << " the separation is "
       << judgement.separation;
  return line.str();
}

PairsJudge::PairsJudge(const Avatar& avatar, const PairRules& rules, const AvatarSurface* surface) {
  for (LinkId link = 0; link < avatar.numLinks(); ++link) addSurface(avatar, link, surface);
  for (LinkId a = 0; a < avatar.numLinks(); ++a) {
    for (LinkId b = a + 1; b < avatar.numLinks(); ++b) {
      const bool isAsked = !avatar.lss(a).empty() && !avatar.lss(b).empty() &&
                           rules.reasonOf(a, b) == PairReason::Asked;
      if (isAsked) ask(a, b, rules);
    }
  }
}

void PairsJudge::addSurface(const Avatar& avatar, LinkId link, const AvatarSurface* surface) {
  Surface added;
  if (surface != nullptr) {
    for (const Triangle& triangle : surface->triangles(link)) {
      added.hulls.push_back({link, 3, plain(triangle), 0.0});
    }
  }
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(avatar.lss(link).size()); ++i) {
    const Lss& lss = avatar.lss(link)[slotOf(i)];
    const bool isSurface = surface == nullptr || standsForItself(lss, surface->triangles(link));
    added.hullOfLss.push_back(isSurface ? static_cast<int>(added.hulls.size()) : -1);
    if (!isSurface) continue;
    added.hulls.push_back({link, 2, {plain(lss.a), plain(lss.b), plain(lss.b)}, lss.radius});
  }
  surfaces_.push_back(std::move(added));
}

void PairsJudge::ask(LinkId a, LinkId b, const PairRules& rules) {
  Asked asked{a, b, {}};
  for (const PairRadius& pair : rules.radii()) {
    if (pair.a != a || pair.b != b) continue;
    asked.sums.push_back({pieceOf(a, -1, pair.lssA), pieceOf(b, -1, pair.lssB), pair.radius});
  }
  asked_.push_back(std::move(asked));
}

int PairsJudge::pieceOf(LinkId link, std::int32_t triangle, std::int32_t lss) const {
  if (triangle >= 0) return triangle;
  const std::vector<int>& hulls = surfaces_[slotOf(link)].hullOfLss;
  const bool isKnown = lss >= 0 && lss < static_cast<std::int32_t>(hulls.size());
  return isKnown ? hulls[slotOf(lss)] : -1;
}

oracle::Answer PairsJudge::plainAnswer(const PairContact& contact) const {
  oracle::Answer answer = plain(static_cast<const LinkContact&>(contact));
  answer.capsule = pieceOf(contact.link, contact.linkTriangle, contact.lss);
  answer.triangle = pieceOf(contact.other, contact.triangle, contact.otherLss);
  return answer;
}

std::vector<JudgedPair> PairsJudge::judge(const oracle::Motion& truth, const StepContacts& step,
                                          double tolerance) const {
  std::vector<PairContact> listed = step.pairs;
  const auto linksOf = [](const PairContact& x) { return std::make_tuple(x.link, x.other); };
  std::stable_sort(listed.begin(), listed.end(), [&](const PairContact& x, const PairContact& y) {
    return linksOf(x) < linksOf(y);
  });
  std::vector<JudgedPair> judged;
  std::size_t next = 0;
  std::vector<JudgedPair> wrong;
  const auto refuse = [&](const PairContact& contact, const char* what) {
    wrong.push_back({contact, plain(contact.verdict), inconsistent(what)});
  };
  for (const Asked& asked : asked_) {
    const auto links = std::make_tuple(asked.a, asked.b);
    while (next < listed.size() && linksOf(listed[next]) < links) {
      refuse(listed[next++], "listed, but not asked or listed before");
    }
    PairContact contact = clearPair(asked.a, asked.b);
    if (next < listed.size() && linksOf(listed[next]) == links) {
      contact = listed[next++];
      if (contact.verdict == Verdict::Clear) refuse(contact, "listed, but clear");
    }
    oracle::Judge judge(truth, surfaces_[slotOf(asked.a)].hulls, surfaces_[slotOf(asked.b)].hulls,
                        asked.sums);
    const oracle::Answer answer = plainAnswer(contact);
    judged.push_back({contact, answer.verdict, judge.judge(answer, tolerance)});
  }
  while (next < listed.size()) refuse(listed[next++], "listed, but not asked or listed before");
  judged.insert(judged.end(), wrong.begin(), wrong.end());
  return judged;
}

}  // namespace foretouch::test
