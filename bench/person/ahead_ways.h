// bench/person/ahead_ways.h: ways to say when a link may touch the scene after a pose, and bounds
// of each that hold on what was seen: Foretouch's, and grown capsules as SaRA has them
// ([Schepp22]), written anew with the judge's kinematics. Metres, seconds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/skeleton.h"
#include "bench/person/held_back.h"
#include "middleware/bracket/bracket.h"

namespace foretouch::tools {

/// What stands for the person after the last pose.
enum class AheadWay : std::uint8_t {
  Chain,         ///< Foretouch: joints go on turning, and their links with them.
  Capsule,       ///< Each capsule goes on in a line and grows, as the ACCEL model of SaRA has it.
  WiderCapsule,  ///< Each capsule stays and grows by its greatest speed, as the VEL model has it.
  LimbBall,      ///< A limb may be anywhere around its shoulder or hip, which moves at its greatest
                 ///< speed, as the POS model has it; other links as by WiderCapsule.
};
inline constexpr std::size_t kAheadWays = 4;
[[nodiscard]] const char* toString(AheadWay way);

/// Bounds that hold on all that was seen.
struct AheadBounds {
  /// The error after tau s is at most speed tau + acceleration tau^2/2.
  struct Growth {
    double speed = 0.0, acceleration = 0.0;
    [[nodiscard]] double at(double tau) const { return tau * (speed + 0.5 * acceleration * tau); }
  };
  /// An end of an axis at the limb's shoulder or hip, how far from there the limb reaches, its
  /// radii counted, and how fast that end is at most (m/s).
  struct Limb {
    std::size_t base = 0;  ///< Index of the axis.
    double reach = 0.0, speed = 0.0;
  };
  std::array<std::vector<Growth>, 3> growths;  ///< Per way but LimbBall, and link.
  std::vector<std::optional<Limb>> limbs;      ///< Per link.
};

/// One person at full rate; every n-th pose is given. For one thread; what it refers to outlives
/// it.
class AheadPerson {
 public:
  struct Horizon {
    double frameS = 0.0;  ///< Between poses at full rate.
    std::size_t every = 1;
    int frames = 0;  ///< At full rate.
    [[nodiscard]] double seconds() const { return frames * frameS; }
  };
  AheadPerson(HeldBack& held, const Avatar& avatar, const std::vector<Pose>& frames,
              const BracketQuery& query, const Horizon& horizon);

  /// The steps after which the whole horizon is known.
  [[nodiscard]] const std::vector<HeldBackStep>& steps() const { return steps_; }
  /// Raises the bounds until they hold here: for several persons first `Speed` of all, then `Rest`.
  enum class Learn : std::uint8_t { Speed, Rest };
  void learn(Learn what, AheadBounds& bounds);

  using Instants = std::vector<std::optional<double>>;  ///< Per link (s); none within the horizon.
  /// When a touch is possible first. Fills `us`: the time that the library took.
  [[nodiscard]] Instants told(AheadWay way, const HeldBackStep& step, const AheadBounds& bounds,
                              double& us);
  /// When links first touch.
  [[nodiscard]] Instants truth(const HeldBackStep& step);

 private:
  using Axes = std::vector<HeldBack::Axis>;
  [[nodiscard]] const Axes& truthAt(const HeldBackStep& step, double frame);
  [[nodiscard]] Axes placedBy(AheadWay way, const HeldBackStep& step, double tau);
  void learnStep(Learn what, const HeldBackStep& step, AheadBounds& bounds);
  void findLimbs(AheadBounds& bounds) const;
  void learnLimbs(AheadBounds& bounds);
  [[nodiscard]] bool hasSurface(std::size_t link) const;
  [[nodiscard]] Instants byChain(const HeldBackStep& step, const AheadBounds& bounds, double& us);
  [[nodiscard]] Instants byCapsules(AheadWay way, const HeldBackStep& step,
                                    const AheadBounds& bounds);
  [[nodiscard]] Instants byLimbs(const HeldBackStep& step, const AheadBounds& bounds);

  HeldBack& held_;
  const Avatar& avatar_;
  const std::vector<Pose>& frames_;
  const BracketQuery& query_;
  Horizon horizon_;
  double stepS_;
  std::vector<HeldBackStep> steps_;
  Scratch scratch_;
  StepBrackets brackets_;
};

}  // namespace foretouch::tools
