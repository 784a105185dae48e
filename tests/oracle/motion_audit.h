// tests/oracle/motion_audit.h: how a solid avatar moves beside the tracked one, judged by
// kinematics that share no code with it: no point outruns the fastest tracked one by more than the
// catch-up, nor the head the tracked head, nor a joint the fastest tracked one, the lift changes
// slowly; and what a person sees of the rest, in figures by link.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "judge/vector.h"
#include "judge/way_judge.h"
#include "middleware/solid/solid_options.h"
#include "middleware/solid/solid_tick.h"

namespace foretouch::test {

/// Of one link, the worst of all ticks.
struct LinkMotion {
  double beyond = 0.0;     ///< Faster than the fastest tracked point (m/s).
  double turn = 0.0;       ///< Of its joint from where that is tracked (rad).
  double unseen = 0.0;     ///< The same from the nearest turn in which it was ever tracked (rad).
  double turnSpeed = 0.0;  ///< Of its joint (rad/s).
  double ownDepth = 0.0;   ///< In other own links, deeper than tracked (m).
  double acceleration = 0.0;  ///< Of its points (m/s^2), from tick to tick; of no appearance.
  double tracked = 0.0;       ///< The tracked one's.
};

struct MotionTally {
  std::uint64_t ticks = 0;
  std::uint64_t outrun = 0;      ///< Ticks with a point that outran the tracked ones.
  std::uint64_t headOutrun = 0;  ///< Ticks with a head that outran the tracked head.
  std::uint64_t overturned = 0;  ///< Ticks with a joint that turned faster than it may.
  std::uint64_t liftJumped = 0;  ///< Ticks in which the lift changed faster than it may.
  std::uint64_t deeper = 0;      ///< Ticks with a link 5 cm deeper in another than tracked.
  std::map<std::string, LinkMotion> links;
  double lifted = 0.0;                    ///< The most (m).
  double headBeyond = 0.0;                ///< Of all ticks, faster than the tracked head (m/s).
  double turnBeyond = 0.0;                ///< Of a joint, faster than one is tracked (rad/s).
  std::vector<double> head, trackedHead;  ///< Accelerations of the head, shown and tracked.
  std::vector<std::string> findings;      ///< The first twenty.

  [[nodiscard]] std::uint64_t violations() const {
    return outrun + headOutrun + overturned + liftJumped;
  }
  void add(const MotionTally& other);
  /// A table by link, and the head's accelerations.
  [[nodiscard]] std::string table() const;
};

/// How ugly a tick is: three measures, each of the link that is worst.
struct UglyTick {
  struct Worst {
    double value = 0.0;
    std::size_t link = 0;
    void take(double other, std::size_t of) {
      if (other > value) *this = {other, of};
    }
  };
  Worst unseen;    ///< As LinkMotion::unseen (rad).
  Worst jerk;      ///< Of an end of an LSS beyond the tracked one's (m/s^3).
  Worst ownDepth;  ///< As LinkMotion::ownDepth (m).
};

class MotionAudit {
 public:
  /// The judge's scene must outlive it; it places the bodies, and is not asked about the scene.
  MotionAudit(const oracle::Scene& scene, const Avatar& avatar, const SolidOptions& options);

  /// `name`: of the run, for findings. The next tick is the first.
  void begin(std::string name);
  void look(const Pose& tracked, const SolidTick& tick, double dtS);
  [[nodiscard]] const MotionTally& tally() const { return tally_; }
  /// Of the last tick.
  [[nodiscard]] const UglyTick& ugly() const { return ugly_; }

  using Vec = oracle::Vec3<double>;
  /// Where a pose has the ends of all LSS, and its joints' turns.
  struct Body {
    std::vector<std::array<Vec, 2>> axes;
    std::vector<std::array<double, 4>> turns;
  };
  [[nodiscard]] Body placed(const Pose& pose);
  /// Of each LSS, in the order of Body::axes: its radius, and its link's name.
  [[nodiscard]] const std::vector<double>& radii() const { return radii_; }
  [[nodiscard]] const std::string& nameOf(std::size_t lss) const { return names_[linkOf_[lss]]; }

 private:
  /// How fast the fastest end of an LSS is, of all links or of the head, or how fast the fastest
  /// joint turns, and its link.
  struct Fastest {
    double speed = 0.0;
    std::size_t link = 0;
  };
  [[nodiscard]] Fastest fastest(const Body& before, const Body& now, double dtS, bool ofHead) const;
  [[nodiscard]] static Fastest fastestTurn(const Body& before, const Body& now, double dtS);
  void lookAtSpeed(const Body& shown, const Body& tracked, double dtS);
  /// `lifted`: how far the lift moved the target.
  void lookAtTurns(const Body& shown, const Body& tracked, double lifted, double dtS);
  void lookAtDepth(const Body& shown, const Body& tracked);
  void lookAtHead(const Body& shown, const Body& tracked, double dtS);
  void lookAtJerk(const Body& shown, const Body& tracked, double dtS);
  void find(const std::string& what);
  [[nodiscard]] double ownDepth(const Body& body, std::size_t i, std::size_t k) const;
  [[nodiscard]] LinkMotion& of(std::size_t link) { return tally_.links[names_[link]]; }

  oracle::WayJudge judge_;
  oracle::WayBody body_;
  double catchUp_;
  std::vector<std::string> names_;
  std::vector<std::size_t> linkOf_;                // of each LSS
  std::vector<double> radii_;                      // of each LSS
  std::vector<bool> isHead_;                       // of each link
  std::vector<std::array<std::size_t, 2>> pairs_;  // of LSS that an avatar can keep apart
  MotionTally tally_;
  std::string name_;
  std::uint64_t tickOfRun_ = 0;
  double lift_ = 0.0;
  std::vector<std::vector<std::array<double, 4>>> seen_;  // per tick of the run, the tracked turns
  std::vector<Body> shown_, tracked_;  // of the last three ticks since it appeared
  UglyTick ugly_;
};

}  // namespace foretouch::test
