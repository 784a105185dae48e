#include "middleware/pair/part_pairs.h"

#include "lss/assert.h"

namespace foretouch::internal {

void TimeBuckets::reset(double begin, double end) {
  FORETOUCH_ASSERT(begin < end);
  begin_ = begin;
  bucketsPerTime_ = kBuckets / (end - begin);
  occupied_ = 0;
  free_ = kNone;
  entries_.clear();
}

}  // namespace foretouch::internal
