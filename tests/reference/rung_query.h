// tests/reference/rung_query.h: a query's answers by volumes that cover several links each: the
// step's volumes, their first contacts, and the verdicts of the links that they cover.
#pragma once

#include "middleware/pair/provers.h"
#include "tests/reference/rungs.h"

namespace foretouch::internal {

/// Of plans at link fidelity, all of whose links are asked alike.
class RungAnswerer final : public StepAnswerer {
 public:
  explicit RungAnswerer(Rung rung) : rung_(rung) {}
  /// Always true.
  [[nodiscard]] bool answers(const QueryPlan& plan, const ChainMotion& motion,
                             const WorkMeter& meter, QueryMemory& scratch,
                             StepContacts& step) const override;

 private:
  Rung rung_;
};

}  // namespace foretouch::internal
