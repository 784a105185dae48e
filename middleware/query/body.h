// middleware/query/body.h: what a query moves through the scene: an avatar's own LSS, or LSS that
// each cover several links and move with one of them (middleware/ladder/). Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/avatar.h"
#include "lss/index.h"
#include "middleware/query_options.h"

namespace foretouch::internal {

/// All references outlive it.
class Body {
 public:
  Body(const Avatar& avatar, const std::vector<IgnoredPair>& ignored)
      : avatar_(&avatar), ignored_(&ignored) {}
  /// Volumes by the link that carries them: one list per link.
  Body(const std::vector<std::vector<Lss>>& volumes, const std::vector<IgnoredPair>& ignored)
      : volumes_(&volumes), ignored_(&ignored) {}

  [[nodiscard]] std::int32_t numLinks() const {
    return volumes_ != nullptr ? static_cast<std::int32_t>(volumes_->size()) : avatar_->numLinks();
  }
  [[nodiscard]] const std::vector<Lss>& lss(LinkId link) const {
    return volumes_ != nullptr ? (*volumes_)[slotOf(link)] : avatar_->lss(link);
  }
  [[nodiscard]] const std::vector<IgnoredPair>& ignored() const { return *ignored_; }

 private:
  const Avatar* avatar_ = nullptr;
  const std::vector<std::vector<Lss>>* volumes_ = nullptr;
  const std::vector<IgnoredPair>* ignored_;
};

}  // namespace foretouch::internal
