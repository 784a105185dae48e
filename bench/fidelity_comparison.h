// bench/fidelity_comparison.h: compares the answer of the links' meshes with that of their
// LSS alone: how many contacts exactness refutes.
#pragma once

#include <cstdint>

#include "articulated/motion.h"
#include "articulated/result.h"
#include "middleware/query/query.h"

namespace foretouch::tools {

/// Counts of links over one step or many: whose LSS touch (contact, or from the start).
struct FidelityCounts {
  std::int64_t lssContacts = 0;
  std::int64_t refuted = 0;    ///< Of these, the mesh is clear.
  std::int64_t later = 0;      ///< The mesh touches later.
  std::int64_t broken = 0;     ///< The mesh touches and the LSS do not, or earlier: always 0, or a
                               ///< bug.
  std::int64_t undecided = 0;  ///< By either: not compared.
  double lssUs = 0.0;          ///< Cost of the LSS' answer.

  void add(const FidelityCounts& other);
};

/// The same question at link fidelity.
[[nodiscard]] Result<Query> askLinks(const Query& exact);
/// Compares `exact`, the answer to `motion`, with that at link fidelity.
[[nodiscard]] FidelityCounts compareWithLink(const Query& link, const ChainMotion& motion,
                                             const StepContacts& exact, Scratch& scratch);

}  // namespace foretouch::tools
