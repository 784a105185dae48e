// tools/setup/walkable_floor.h: where in a level a person could walk: surfaces with headroom for a
// body, joined by steps that it can climb. Recast finds them, on a grid; exact answers are the
// engine's. World W: metres, +Y up.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "articulated/result.h"
#include "tools/setup/level.h"

namespace foretouch::tools {

/// What a body needs to walk (m).
struct BodyRoom {
  double height = 1.75, radius = 0.2, climb = 0.25;
};

/// The room for a body of this height; in proportion to a person's.
[[nodiscard]] BodyRoom roomOf(double height);

enum class FloorKind : std::uint8_t {
  None,   ///< Nothing to walk on: void, too steep, too low, or too narrow.
  Main,   ///< The level's own floor, and whatever is reached from it.
  Over,   ///< Above other floor, and out of its reach: a roof, a beam, furniture.
  Apart,  ///< Out of reach of the level's own floor.
};

class WalkableFloor {
 public:
  /// `around`: where to look in a level that is too large to be looked at as a whole. `isAsked`: on
  /// an object, whether the body is wanted there; may be empty. Errors: too many triangles, too
  /// high, or too slow. Takes at most some 0.7 GB and half a minute, and mostly a hundredth of it.
  [[nodiscard]] static Result<WalkableFloor> build(const Level& level, const BodyRoom& room,
                                                   const Eigen::Vector3d& around,
                                                   const std::function<bool(ObjectId)>& isAsked);

  /// The kind of what lies at most `up` above and `down` below a point; the nearest to it counts.
  [[nodiscard]] FloorKind kindAt(const Eigen::Vector3d& p_W, double up, double down) const;
  /// Whether an asked object's surface lies there.
  [[nodiscard]] bool isAskedAt(const Eigen::Vector3d& p_W, double up, double down) const;
  /// About `count` spots, spread evenly: on the main floor where a body's middle may be, or on the
  /// asked objects. The same ones every time.
  [[nodiscard]] std::vector<Eigen::Vector3d> spots(std::size_t count, bool onAsked) const;
  /// The main floor straight above and below a point.
  [[nodiscard]] std::vector<Eigen::Vector3d> spotsAlong(const Eigen::Vector3d& p_W) const;

  [[nodiscard]] bool hasMain() const { return main_ >= 0; }
  /// The main floor's area where a body's middle may be (square metres).
  [[nodiscard]] double area() const;
  /// True if the main floor shows its back, so it may be the outside of the level.
  [[nodiscard]] bool showsBack() const;
  /// True if the main floor lies high above the level's lowest point, and nothing is above it.
  [[nodiscard]] bool isOnTop() const;
  /// True if the main floor is high above the level's lowest point, with only air under it.
  [[nodiscard]] bool hangs() const;
  /// True if a body could walk somewhere, be it on a roof.
  [[nodiscard]] bool hasAny() const { return !areas_.empty(); }
  /// True if the main floor is that of a thing: a crate, a step.
  [[nodiscard]] bool isSmall() const;
  /// The usual headroom of floors that are too low for this body; nothing if they are few.
  [[nodiscard]] std::optional<double> lowHeadroom() const { return lowHeadroom_; }
  [[nodiscard]] const BodyRoom& room() const { return room_; }
  /// How far from `around` the level was looked at, if only in part (m).
  [[nodiscard]] std::optional<double> lookedWithin() const { return lookedWithin_; }

 private:
  friend class FloorBuilder;

  /// Something to stand on with headroom above it.
  struct Span {
    double y = 0.0;
    std::int32_t area = -1;  ///< Index into areas_; none: too narrow for a body.
    bool isCore = false;     ///< A body's middle may be here.
    bool facesUp = false, isOver = false, hangs = false, isAsked = false;
  };
  /// Spans that are reached from one another.
  struct Area {
    std::size_t cells = 0, facingUp = 0, hanging = 0;
    double lowest = 0.0, highest = 0.0;
    std::size_t low = 0, lowOver = 0;  ///< Its lowest part: cells, and those over other floor.

    bool isRoof = false;

    [[nodiscard]] bool isOver() const { return isRoof || 2 * lowOver > low; }
    [[nodiscard]] double score() const;
  };

  /// A floor that is higher than this above the level's lowest point is high (share of the body's
  /// height).
  static constexpr double kOnTop = 0.85;

  /// The first span straight above and below a point, and the one behind the last.
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> spansAlong(
      const Eigen::Vector3d& p_W) const;
  [[nodiscard]] const Area& mainArea() const { return areas_[static_cast<std::size_t>(main_)]; }
  [[nodiscard]] bool isHigh() const;
  [[nodiscard]] const Span* spanAt(const Eigen::Vector3d& p_W, double up, double down) const;
  [[nodiscard]] Eigen::Vector3d pointOf(std::size_t column, const Span& span) const;

  BodyRoom room_;
  Eigen::Vector3d corner_ = Eigen::Vector3d::Zero();
  double cell_ = 0.0;
  int width_ = 0, depth_ = 0;
  std::vector<std::uint32_t> begins_;  ///< Per column, and one more: its first span.
  std::vector<Span> spans_;
  std::vector<Area> areas_;
  std::int32_t main_ = -1;
  double levelLowest_ = 0.0, levelHighest_ = 0.0;
  std::optional<double> lowHeadroom_, lookedWithin_;
};

}  // namespace foretouch::tools
