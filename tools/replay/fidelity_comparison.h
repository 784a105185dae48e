// tools/replay/fidelity_comparison.h: what the links' LSS alone would have answered where the
// answer is that of their meshes: how many contacts exactness refutes.
#pragma once

#include <cstdint>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/result.h"
#include "middleware/query/query.h"
#include "middleware/scene/scene.h"

namespace foretouch::tools {

/// Counts of links over one step or many: those whose LSS touch (contact, or from the start).
struct FidelityCounts {
  std::int64_t lssContacts = 0;
  std::int64_t refuted = 0;  ///< Of these, the mesh is clear.
  std::int64_t later = 0;    ///< The mesh touches later.
  std::int64_t broken = 0;  ///< The mesh touches where the LSS do not, or earlier: never, or a bug.
  std::int64_t undecided = 0;  ///< Of either: not compared.
  double lssUs = 0.0;          ///< What the LSS' answer cost.

  void add(const FidelityCounts& other);
};

/// Compares `exact`, the answer to `motion` by `options`, with that of link fidelity.
[[nodiscard]] Result<FidelityCounts> compareWithLink(const Avatar& avatar,
                                                     const ChainMotion& motion,
                                                     const StepContacts& exact, const Scene& scene,
                                                     const QueryOptions& options,
                                                     QueryScratch& scratch);

}  // namespace foretouch::tools
