#include "tools/feet/rest_runs.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "tools/feet/foot_touches.h"

namespace foretouch::tools {
namespace {

/// Poses in a row at which something holds.
class Runs {
 public:
  Runs(const FeetInputs& inputs, const FeetAnswer& answer)
      : inputs_(inputs), answer_(answer), parts_(inputs.body.parts.size()) {}

  std::vector<FootStance> all() {
    for (std::size_t limb = 0; limb < inputs_.body.limbs.size(); ++limb) {
      if (!inputs_.body.limbs[limb].isHand) findHovers(limb);
    }
    return std::move(found_);
  }

 private:
  [[nodiscard]] const PartSample& sample(std::int64_t step, std::size_t part) const {
    return answer_.sample(step, part, parts_);
  }
  [[nodiscard]] FootStance stanceAt(StanceKind kind, std::size_t part, std::int64_t first,
                                    std::int64_t last) const;
  void findHovers(std::size_t limb);
  [[nodiscard]] std::optional<std::size_t> hoveringPart(std::size_t limb, std::int64_t step) const;

  const FeetInputs& inputs_;
  const FeetAnswer& answer_;
  std::size_t parts_;
  std::vector<FootStance> found_;
};

FootStance Runs::stanceAt(StanceKind kind, std::size_t part, std::int64_t first,
                          std::int64_t last) const {
  FootStance stance;
  stance.kind = kind;
  stance.part = part;
  stance.fromS = inputs_.timeOf(first);
  stance.toS = inputs_.timeOf(last);
  stance.fromFrame = inputs_.played.steps.frameOf(first);
  stance.toFrame = inputs_.played.steps.frameOf(last);
  stance.beganBefore = first == 0;
  stance.goesOn = last == inputs_.steps();
  return stance;
}

/// The lowest part of the foot, if the foot hovers there.
std::optional<std::size_t> Runs::hoveringPart(std::size_t limb, std::int64_t step) const {
  std::optional<std::size_t> lowest;
  for (std::size_t part = 0; part < parts_; ++part) {
    if (inputs_.body.parts[part].limb != limb) continue;
    const PartSample& at = sample(step, part);
    if (at.touches || at.isUnder) return std::nullopt;
    if (!lowest || at.height < sample(step, *lowest).height) lowest = part;
  }
  if (!lowest) return std::nullopt;
  const PartSample& at = sample(step, *lowest);
  const bool hovers =
      at.height > inputs_.request.tolerance && at.height <= kHighestHover && at.speed <= kRestSpeed;
  return hovers ? lowest : std::nullopt;
}

void Runs::findHovers(std::size_t limb) {
  for (std::int64_t step = 0; step <= inputs_.steps(); ++step) {
    const auto part = hoveringPart(limb, step);
    if (!part) continue;
    const std::int64_t first = step;
    double heights = 0.0;
    for (; step <= inputs_.steps(); ++step) {
      const auto still = hoveringPart(limb, step);
      if (!still) break;
      heights += sample(step, *still).height;
    }
    FootStance stance = stanceAt(StanceKind::Hovers, *part, first, step - 1);
    if (stance.durationS() < kRestTimeS) continue;
    stance.hover = heights / static_cast<double>(step - first);
    found_.push_back(std::move(stance));
  }
}

}  // namespace

std::vector<FootStance> restRunsOf(const FeetInputs& inputs, const FeetAnswer& answer) {
  return Runs(inputs, answer).all();
}

namespace {

/// Counts touches like contacts: one begins within the tolerance, and ends beyond twice that.
class RaisedFoot {
 public:
  RaisedFoot(const FeetInputs& inputs, const FeetAnswer& answer, std::size_t limb)
      : inputs_(inputs), answer_(answer), limb_(limb) {}

  void addTo(Sensitivity& at) const {
    const double tolerance = inputs_.request.tolerance;
    bool touches = false;
    for (std::int64_t step = 0; step <= inputs_.steps(); ++step) {
      const double height = lowestAt(step) + at.raise;
      const bool touched = touches;
      touches = height <= (touched ? 2.0 * tolerance : tolerance);
      at.touches += touches && !touched ? 1 : 0;
      at.touchS += touches && step < inputs_.steps() ? inputs_.stepS() : 0.0;
    }
  }

 private:
  [[nodiscard]] double lowestAt(std::int64_t step) const {
    const std::size_t parts = inputs_.body.parts.size();
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t part = 0; part < parts; ++part) {
      if (inputs_.body.parts[part].limb != limb_) continue;
      const double height = answer_.sample(step, part, parts).height;
      if (height < lowest) lowest = height;
    }
    return lowest;
  }

  const FeetInputs& inputs_;
  const FeetAnswer& answer_;
  std::size_t limb_;
};

}  // namespace

std::vector<Sensitivity> sensitivityOf(const FeetInputs& inputs, const FeetAnswer& answer) {
  const auto asItIs = [&] {
    Sensitivity at;
    for (const FootTouch& touch : footTouchesOf(inputs, answer)) {
      if (inputs.body.limbs[touch.limb].isHand) continue;
      ++at.touches;
      at.touchS += touch.durationS();
    }
    return at;
  };
  constexpr double kRaises[] = {-0.03, -0.02, -0.01, -0.005, 0.0, 0.005, 0.01, 0.02, 0.03};
  std::vector<Sensitivity> curve;
  for (const double raise : kRaises) {
    if (raise == 0.0) {
      curve.push_back(asItIs());
      continue;
    }
    Sensitivity at{raise, 0, 0.0};
    for (std::size_t limb = 0; limb < inputs.body.limbs.size(); ++limb) {
      if (!inputs.body.limbs[limb].isHand) RaisedFoot(inputs, answer, limb).addTo(at);
    }
    curve.push_back(at);
  }
  return curve;
}

}  // namespace foretouch::tools
