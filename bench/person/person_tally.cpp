#include "bench/person/person_tally.h"

namespace foretouch::tools {

void PersonTally::add(const PersonTally& o) {
  intervals += o.intervals;
  missed += o.missed;
  lied += o.lied;
  excluded += o.excluded;
  possible += o.possible;
  certain += o.certain;
  unclaimed += o.unclaimed;
  passed += o.passed;
  fresh += o.fresh;
  freshCertain += o.freshCertain;
  missedByPoses += o.missedByPoses;
  missedBetween += o.missedBetween;
  inventedBetween += o.inventedBetween;
  widthsMs.insert(widthsMs.end(), o.widthsMs.begin(), o.widthsMs.end());
  widths.insert(widths.end(), o.widths.begin(), o.widths.end());
  growthsMm.insert(growthsMm.end(), o.growthsMm.begin(), o.growthsMm.end());
  bracketUs += o.bracketUs;
  plainUs += o.plainUs;
  pieces += o.pieces;
  steps += o.steps;
  findings.insert(findings.end(), o.findings.begin(), o.findings.end());
}

}  // namespace foretouch::tools
