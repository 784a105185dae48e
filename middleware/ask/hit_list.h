// middleware/ask/hit_list.h: what one question has found so far: the nearest, any, or all. Not
// installed.
#pragma once

#include "middleware/ask/ask.h"

namespace foretouch::internal {

/// Nearer first; then by body, link, LSS and triangle.
[[nodiscard]] bool comesBefore(const WorldHit& x, const WorldHit& y);

/// Keeps a reference to the answer, which it fills.
class HitList {
 public:
  HitList(double reach, AskWhich which, WorldAnswer& answer)
      : answer_(answer), which_(which), limit_(reach) {}

  /// Hits farther than this change nothing; below zero if nothing more is asked for.
  [[nodiscard]] double limit() const { return limit_; }
  /// A hit within the limit that no filter leaves out.
  void add(const WorldHit& hit);
  /// Nothing more comes.
  void finish();

 private:
  void dropTwins();

  WorldAnswer& answer_;
  AskWhich which_;
  double limit_;
};

}  // namespace foretouch::internal
