#include "bindings/c/last_step.h"

namespace foretouch::c {

ft_status checkedStep(const ft_query* query) {
  if (const auto s = checked(query); s != FT_OK) return s;
  if (query->hasStep) return FT_OK;
  return failure(FT_ERROR_NO_STEP, kNoIndex, "expected ft_query_step() to be answered before");
}

ft_status checkedObjects(const ft_query* query) {
  if (const auto s = checkedStep(query); s != FT_OK) return s;
  if (query->question->options().scope == Scope::EveryObject) return FT_OK;
  return failure(FT_ERROR_MISMATCH, kNoIndex,
                 "expected the scope FT_SCOPE_EVERY_OBJECT: objects were not asked one by one");
}

ft_status checkedPairs(const ft_query* query) {
  if (const auto s = checkedStep(query); s != FT_OK) return s;
  if (query->step.answer.arePairsAnswered) return FT_OK;
  return failure(FT_ERROR_MISMATCH, kNoIndex,
                 "expected ft_query_set_pair_rules() before the step: own links were not asked");
}

}  // namespace foretouch::c
