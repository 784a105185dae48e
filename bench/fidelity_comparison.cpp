#include "bench/fidelity_comparison.h"

#include <chrono>

namespace foretouch::tools {
namespace {

bool touches(const LinkContact& contact) {
  return contact.verdict == Verdict::Contact || contact.verdict == Verdict::StartsInContact;
}

}  // namespace

void FidelityCounts::add(const FidelityCounts& other) {
  lssContacts += other.lssContacts;
  refuted += other.refuted;
  later += other.later;
  broken += other.broken;
  undecided += other.undecided;
  lssUs += other.lssUs;
}

Result<Query> askLinks(const Query& exact) {
  QueryOptions coarser = exact.options();
  coarser.fidelity = Fidelity::Link;
  // Compared is each link's first contact with the scene, which is the same in both scopes.
  if (coarser.scope == Scope::EveryObject) coarser.scope = Scope::EveryLink;
  coarser.self.reset();
  for (LinkPolicy& policy : coarser.linkPolicies) policy.fidelity = Fidelity::Link;
  return Query::build(exact.avatar(), exact.scene(), coarser);
}

FidelityCounts compareWithLink(const Query& link, const ChainMotion& motion,
                               const StepContacts& exact, Scratch& scratch) {
  const auto start = std::chrono::steady_clock::now();
  const StepContacts coarse = link.answer(motion, scratch);
  const std::chrono::duration<double, std::micro> elapsed =
      std::chrono::steady_clock::now() - start;
  FidelityCounts counts;
  counts.lssUs = elapsed.count();
  for (std::size_t i = 0; i < exact.links.size(); ++i) {
    const LinkContact& mesh = exact.links[i];
    const LinkContact& lss = coarse.links[i];
    if (mesh.verdict == Verdict::Undecided || lss.verdict == Verdict::Undecided) {
      ++counts.undecided;
      continue;
    }
    if (touches(lss)) ++counts.lssContacts;
    if (touches(lss) && !touches(mesh)) ++counts.refuted;
    if (touches(mesh) && (!touches(lss) || mesh.toi < lss.toi)) ++counts.broken;
    if (touches(mesh) && touches(lss) && mesh.toi > lss.toi) ++counts.later;
  }
  return counts;
}

}  // namespace foretouch::tools
