// bench/trade/strategy.h: the interface of `bench trade` to every strategy, Foretouch's and
// others', that finds the contacts of a moving avatar. t is normalised: 0 at the earlier pose, 1 at
// the later.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/skeleton.h"
#include "bench/trade/nearest_tree.h"

namespace foretouch::tools {

/// Two validated poses of the strategy's avatar.
struct TradeStep {
  const Pose& from;
  const Pose& to;
  bool continues = false;  ///< `from` is the `to` of the previous step.
};

struct LinkTouch {
  bool touches = false;
  double toi = 1.0;  ///< If it touches: the time, by the strategy.
};

/// A strategy's promise for every link.
enum class TradePromise : std::uint8_t {
  Nothing,   ///< May miss contacts or report them late.
  Sound,     ///< Misses none, and reports none late.
  Accurate,  ///< Sound, and no farther than the tolerance from touching when reported.
};

/// One strategy with one setting, in one scene, for one avatar. The constructor prepares everything
/// that a user would prepare once; only solve() is timed. For one thread.
class Strategy {
 public:
  Strategy(std::string name, TradePromise promise) : name_(std::move(name)), promise_(promise) {}
  Strategy(const Strategy&) = delete;
  Strategy& operator=(const Strategy&) = delete;
  virtual ~Strategy() = default;

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] TradePromise promise() const { return promise_; }

  /// `touches` gets one entry per link of the avatar, in order.
  virtual void solve(const TradeStep& step, std::vector<LinkTouch>& touches, TradeWork& work) = 0;

 private:
  std::string name_;
  TradePromise promise_;
};

using Strategies = std::vector<std::unique_ptr<Strategy>>;

}  // namespace foretouch::tools
