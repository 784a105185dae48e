#include "tools/replay/fidelity_comparison.h"

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

Result<FidelityCounts> compareWithLink(const Avatar& avatar, const ChainMotion& motion,
                                       const StepContacts& exact, const Scene& scene,
                                       const QueryOptions& options, QueryScratch& scratch) {
  QueryOptions coarser = options;
  coarser.fidelity = Fidelity::Link;
  for (LinkPolicy& policy : coarser.linkPolicies) policy.fidelity = Fidelity::Link;
  const auto start = std::chrono::steady_clock::now();
  const auto link = firstContacts(avatar, motion, scene, coarser, scratch);
  const std::chrono::duration<double, std::micro> elapsed =
      std::chrono::steady_clock::now() - start;
  if (!link.ok()) return link.error();
  FidelityCounts counts;
  counts.lssUs = elapsed.count();
  for (std::size_t i = 0; i < exact.links.size(); ++i) {
    const LinkContact& mesh = exact.links[i];
    const LinkContact& lss = link.value().links[i];
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
