// middleware/query/body.h: what a query moves through the scene. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/skeleton.h"
#include "lss/index.h"
#include "lss/lss.h"
#include "middleware/query_options.h"

namespace foretouch::internal {

/// All references outlive it.
class Body {
 public:
  /// `lss`: per link, those that move with it.
  Body(const std::vector<std::vector<Lss>>& lss, const std::vector<IgnoredPair>& ignored)
      : lss_(lss), ignored_(ignored) {}

  [[nodiscard]] std::int32_t numLinks() const { return static_cast<std::int32_t>(lss_.size()); }
  [[nodiscard]] const std::vector<Lss>& lss(LinkId link) const { return lss_[slotOf(link)]; }
  [[nodiscard]] const std::vector<IgnoredPair>& ignored() const { return ignored_; }

 private:
  const std::vector<std::vector<Lss>>& lss_;
  const std::vector<IgnoredPair>& ignored_;
};

}  // namespace foretouch::internal
