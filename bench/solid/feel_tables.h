// bench/solid/feel_tables.h: what FeelTally holds, as tables.
#pragma once

#include <string>

#include "bench/report.h"
#include "bench/solid/feel.h"

namespace foretouch::tools {

struct FeelRow {
  std::string scene;
  double rateHz = 0.0;
  int places = 0;
  std::string follower;
};

class FeelTables {
 public:
  FeelTables();
  void add(const FeelRow& row, const FeelTally& tally);
  void appendTo(BenchReport& report) const;

 private:
  BenchTable feel_, motion_, cost_, promise_;
};

}  // namespace foretouch::tools
