#include "articulated/try.h"
#include "lss/assert.h"
#include "lss/index.h"
#include "middleware/near/clearance.h"
#include "middleware/near/clearance_search.h"
#include "middleware/pair/query_plan.h"

namespace foretouch {

using internal::ClearancePlan;

Result<ClearanceQuery> ClearanceQuery::build(const Avatar& avatar, const Scene& scene,
                                             const ClearanceOptions& options) {
  if (!(options.tolerance >= kMinTolerance && options.tolerance <= kMaxTolerance)) {
    return Error::in("tolerance", ErrorCode::OutOfRange, "expected metres, 1e-9 to 1e7");
  }
  if (!(options.within > 0.0)) {
    return Error::in("within", ErrorCode::OutOfRange, "expected metres, above 0");
  }
  if (!(options.reach >= 0.0 && options.reach <= kMaxCoordinate)) {
    return Error::in("reach", ErrorCode::OutOfRange, "expected metres, at least 0");
  }
  FORETOUCH_CHECK(internal::checkedIgnored(avatar, scene, options.ignored));
  return ClearanceQuery(std::make_shared<const ClearancePlan>(avatar, scene, options));
}

const ClearanceOptions& ClearanceQuery::options() const {
  return plan_->options;
}

Clearance ClearanceQuery::answer(const ChainMotion& motion, Scratch& scratch) const {
  FORETOUCH_ASSERT(motion.numLinks() == plan_->avatar.numLinks());
  internal::ClearanceSearch search(plan_->options, scratch.of<internal::ClearanceMemory>());
  search.look({plan_.get(), &motion});
  return search.finish();
}

}  // namespace foretouch
