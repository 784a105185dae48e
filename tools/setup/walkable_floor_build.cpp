#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <recastnavigation/Recast.h>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "lss/index.h"
#include "tools/setup/walkable_floor.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// Shares of a body's height: what a person of 1.75 m needs is 0.2 m to each side of its middle,
/// and steps of 0.25 m; a cell of the grid is 0.1 m wide and 35 mm high.
constexpr double kRadius = 0.115, kClimb = 0.14, kCell = 0.06, kCellHeight = 0.02;
/// Floor with less room above it than this share of the height is not floor but a gap in a thing.
constexpr double kCrawl = 0.4;
/// Surfaces up to this slope (radians, 45 degrees) can be walked on.
constexpr double kSteepest = 0.785;
/// What Recast may hold: columns (8 bytes each), and spans (16 bytes each, at most one per visit of
/// a triangle to a column). Doubling them doubles memory and time.
constexpr std::size_t kMostColumns = 4'000'000, kMostVisits = 32'000'000;
/// Recast has 24 bits for the number of spans, and 13 for a height.
constexpr int kMostSpans = (1 << 24) - 1;
constexpr double kMostLevels = RC_SPAN_MAX_HEIGHT - 1;
/// A part of a level narrower than this (m) is not worth a look.
constexpr double kSmallestPart = 4.0;
constexpr std::chrono::seconds kLongestSearch(20);
/// How much lighter an area weighs that lies over other floor, and one that shows its back.
constexpr double kOverWeighs = 0.1, kBackWeighs = 0.3;
/// A level is too low if so many of its surfaces are.
constexpr double kManyAreLow = 0.3;

/// How Recast knows surfaces, which takes the larger number where two meet.
enum Surface : unsigned char { kObstacle = 0, kBackUp = 1, kFrontUp = 2, kAsked = 3 };
// Added: it lies over other floor; high in the air, with nothing below that stands on the ground.
constexpr unsigned char kOver = 4, kHangs = 8;

/// The part of a level that is looked at.
struct Part {
  Eigen::AlignedBox3d box;
  bool isWhole = true;
};

Eigen::AlignedBox3d boxOf(const Triangle& triangle) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& vertex : triangle.vertices) box.extend(vertex);
  return box;
}

bool isAbove(const Eigen::AlignedBox3d& box, const Eigen::AlignedBox3d& part) {
  return box.max().x() >= part.min().x() && box.min().x() <= part.max().x() &&
         box.max().z() >= part.min().z() && box.min().z() <= part.max().z();
}

double cellsAlong(const Eigen::AlignedBox3d& box, const Eigen::AlignedBox3d& part, int axis,
                  double cell) {
  const double from = std::max(box.min()[axis], part.min()[axis]);
  const double to = std::min(box.max()[axis], part.max()[axis]);
  return std::floor((to - from) / cell) + 2.0;
}

/// How often a triangle meets a column, at most.
double visitsIn(const Scene& scene, const Eigen::AlignedBox3d& part, double cell) {
  double visits = 0.0;
  for (std::size_t i = 0; i < scene.numTriangles(); ++i) {
    const Eigen::AlignedBox3d box = boxOf(scene.triangle(static_cast<TriangleId>(i)));
    if (!isAbove(box, part)) continue;
    visits += cellsAlong(box, part, 0, cell) * cellsAlong(box, part, 2, cell);
  }
  return visits;
}

double columnsIn(const Eigen::AlignedBox3d& part, double cell) {
  return (part.sizes().x() / cell + 1.0) * (part.sizes().z() / cell + 1.0);
}

Error tooMuch(const std::string& what) {
  return Error::of(ErrorCode::LimitExceeded,
                   what +
                       ", so no floor was looked for; --place X,Y,Z,YAW says where it stands, "
                       "and foretouch view shows it");
}

/// The whole level, or what is around a point and not too much.
Result<Part> partOf(const Scene& scene, const Vector3d& around, double cell) {
  const SceneAudit& audit = scene.audit();
  const Eigen::AlignedBox3d whole(audit.boxMin, audit.boxMax);
  const Vector3d middle = around.cwiseMax(audit.boxMin).cwiseMin(audit.boxMax);
  Part part{whole, true};
  for (double half = 0.5 * cell * std::sqrt(static_cast<double>(kMostColumns));
       columnsIn(part.box, cell) > static_cast<double>(kMostColumns) ||
       visitsIn(scene, part.box, cell) > static_cast<double>(kMostVisits);
       half *= 0.5) {
    if (half < kSmallestPart) return tooMuch("the scene has too many triangles in one place");
    const Vector3d reach(half, 0.0, half);
    part = {whole.intersection({middle - reach, middle + reach}), false};
    part.box.min().y() = audit.boxMin.y();
    part.box.max().y() = audit.boxMax.y();
  }
  return part;
}

/// Walks through the spans of each column, from the lowest up.
template <typename Function>
void forEachColumn(const rcHeightfield& field, Function&& function) {
  std::vector<rcSpan*> column;
  for (int i = 0; i < field.width * field.height; ++i) {
    column.clear();
    for (rcSpan* span = field.spans[i]; span != nullptr; span = span->next) column.push_back(span);
    if (!column.empty()) function(column);
  }
}

/// Marks what lies over other floor with room between them. From a surface's front down one goes
/// through a solid until a back is met; that is not floor.
void markOver(const std::vector<rcSpan*>& column, int crawl, int high) {
  const bool hangs = static_cast<int>(column.front()->smin) > high;
  bool isOver = false;           // for what is above the last surface
  const rcSpan* last = nullptr;  // surface, below
  const rcSpan* below = nullptr;
  std::vector<rcSpan*> over;
  int roomAboveLast = 0;
  for (rcSpan* const span : column) {
    if (below == last && last != nullptr) {
      roomAboveLast = static_cast<int>(span->smin) - static_cast<int>(last->smax);
    }
    if (span->area != kObstacle) {
      const bool isInSolid = last != nullptr && span->area != kBackUp && last->area == kBackUp;
      isOver = isOver || (last != nullptr && roomAboveLast >= crawl && !isInSolid);
      if (isOver) over.push_back(span);
      last = span;
    }
    below = span;
  }
  for (rcSpan* const span : over) span->area = (span->area + kOver) & RC_WALKABLE_AREA;
  for (rcSpan* const span : column) {
    if (hangs && span->area != kObstacle) span->area = (span->area + kHangs) & RC_WALKABLE_AREA;
  }
}

}  // namespace

BodyRoom roomOf(double height) {
  const double bounded = std::clamp(height, 0.3, 10.0);
  return {bounded, kRadius * bounded, kClimb * bounded};
}

/// Builds a floor in steps; Recast's own things live as long as this.
class FloorBuilder {
 public:
  FloorBuilder(const Level& level, const BodyRoom& room, const Vector3d& around,
               const std::function<bool(ObjectId)>& isAsked)
      : level_(level), scene_(level.scene()), around_(around), isAsked_(isAsked) {
    floor_.room_ = room;
    floor_.cell_ = kCell * room.height;
  }

  Result<WalkableFloor> build() {
    FORETOUCH_CHECK(chooseGrid());
    FORETOUCH_CHECK(drawTriangles());
    readHeadroom();
    forEachColumn(*field_, [&](const std::vector<rcSpan*>& column) {
      markOver(column, levels(kCrawl * floor_.room_.height),
               levels(WalkableFloor::kOnTop * floor_.room_.height));
    });
    FORETOUCH_CHECK(findRoom());
    takeSpans();
    labelAreas();
    measureAreas();
    return std::move(floor_);
  }

 private:
  template <typename Thing>
  using Owned = std::unique_ptr<Thing, void (*)(Thing*)>;

  [[nodiscard]] int levels(double height) const {
    return static_cast<int>(std::ceil(height / static_cast<double>(step_) - 1e-6));
  }

  Result<Done> chooseGrid() {
    FORETOUCH_TRY(const Part part, partOf(scene_, around_, floor_.cell_));
    if (!part.isWhole) {
      floor_.lookedWithin_ = 0.5 * std::max(part.box.sizes().x(), part.box.sizes().z());
    }
    Eigen::AlignedBox3d box = part.box;
    box.min().y() = std::numeric_limits<double>::max();
    box.max().y() = -box.min().y();
    for (std::size_t i = 0; i < scene_.numTriangles(); ++i) {
      const auto id = static_cast<TriangleId>(i);
      const Eigen::AlignedBox3d of = boxOf(scene_.triangle(id));
      if (!isAbove(of, part.box)) continue;
      drawn_.emplace_back(of.max().y(), id);
      box.min().y() = std::min(box.min().y(), of.min().y());
      box.max().y() = std::max(box.max().y(), of.max().y());
    }
    if (drawn_.empty()) return tooMuch("there is nothing of the scene here");
    // From low to high: where a wall meets the floor that it stands on, the wall comes last and
    // the two are a wall.
    std::sort(drawn_.begin(), drawn_.end());
    floor_.levelLowest_ = box.min().y();
    floor_.levelHighest_ = box.max().y();
    floor_.corner_ = box.min();
    floor_.width_ = static_cast<int>(box.sizes().x() / floor_.cell_) + 1;
    floor_.depth_ = static_cast<int>(box.sizes().z() / floor_.cell_) + 1;
    const double fine = kCellHeight * floor_.room_.height;
    step_ = static_cast<float>(std::max(fine, box.sizes().y() / kMostLevels));
    if (static_cast<double>(step_) > 3.0 * fine) {
      return tooMuch(fmt::format("the scene is {:.3g} m high for a body of {:.3g} m",
                                 box.sizes().y(), floor_.room_.height));
    }
    return Done{};
  }

  [[nodiscard]] unsigned char surfaceOf(TriangleId id) const {
    const double up = level_.normal(id).y();
    if (std::abs(up) < std::cos(kSteepest)) return kObstacle;
    if (isAsked_ && isAsked_(scene_.object(id))) return kAsked;
    return up > 0.0 ? kFrontUp : kBackUp;
  }

  Result<Done> drawTriangles() {
    const std::array<float, 3> from = {0.0F, 0.0F, 0.0F};
    const auto cell = static_cast<float>(floor_.cell_);
    const std::array<float, 3> to = {
        cell * static_cast<float>(floor_.width_),
        static_cast<float>(floor_.levelHighest_ - floor_.levelLowest_) + 2.0F * step_,
        cell * static_cast<float>(floor_.depth_)};
    if (!field_ || !rcCreateHeightfield(&context_, *field_, floor_.width_, floor_.depth_,
                                        from.data(), to.data(), cell, step_)) {
      return tooMuch("memory is short");
    }
    const auto begin = std::chrono::steady_clock::now();
    constexpr std::size_t kAtOnce = 256;
    for (std::size_t i = 0; i < drawn_.size(); i += kAtOnce) {
      if (!draw(i, std::min(i + kAtOnce, drawn_.size()))) return tooMuch("memory is short");
      if (std::chrono::steady_clock::now() - begin > kLongestSearch) {
        return tooMuch("the scene has too many layers in one place");
      }
    }
    return Done{};
  }

  bool draw(std::size_t begin, std::size_t end) {
    std::vector<float> vertices;
    std::vector<unsigned char> surfaces;
    for (std::size_t i = begin; i < end; ++i) {
      const TriangleId id = drawn_[i].second;
      for (const Vector3d& vertex : scene_.triangle(id).vertices) {
        const Eigen::Vector3f p = (vertex - floor_.corner_).cast<float>();
        vertices.insert(vertices.end(), p.data(), p.data() + 3);
      }
      surfaces.push_back(surfaceOf(id));
    }
    return rcRasterizeTriangles(&context_, vertices.data(), surfaces.data(),
                                static_cast<int>(surfaces.size()), *field_,
                                levels(floor_.room_.climb));
  }

  /// What headroom floors have on which one could crawl but not stand.
  void readHeadroom() {
    const int low = levels(kCrawl * floor_.room_.height), enough = levels(floor_.room_.height);
    std::vector<int> found;
    std::size_t all = 0;
    forEachColumn(*field_, [&](const std::vector<rcSpan*>& column) {
      for (std::size_t i = 0; i < column.size(); ++i) {
        if (column[i]->area < kFrontUp) continue;
        const int above = i + 1 < column.size() ? static_cast<int>(column[i + 1]->smin)
                                                : std::numeric_limits<int>::max();
        const int room = above - static_cast<int>(column[i]->smax);
        all += room >= low ? 1 : 0;
        if (room >= low && room < enough) found.push_back(room);
      }
    });
    if (found.empty() || static_cast<double>(found.size()) < kManyAreLow * static_cast<double>(all))
      return;
    const auto median = found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2);
    std::nth_element(found.begin(), median, found.end());
    // Both surfaces fill a level of the grid, half of it in the middle.
    floor_.lowHeadroom_ = (*median + 1) * static_cast<double>(step_);
  }

  Result<Done> findRoom() {
    const int height = levels(floor_.room_.height), climb = levels(floor_.room_.climb);
    rcFilterLowHangingWalkableObstacles(&context_, climb, *field_);
    rcFilterWalkableLowHeightSpans(&context_, height, *field_);
    if (rcGetHeightFieldSpanCount(&context_, *field_) > kMostSpans || !open_ ||
        !rcBuildCompactHeightfield(&context_, height, climb, *field_, *open_)) {
      return tooMuch("the scene has too many layers");
    }
    field_.reset();
    return Done{};
  }

  void takeSpans() {
    const double step = static_cast<double>(step_);
    floor_.spans_.resize(static_cast<std::size_t>(open_->spanCount));
    for (std::size_t i = 0; i < floor_.spans_.size(); ++i) {
      WalkableFloor::Span& span = floor_.spans_[i];
      const unsigned char area = open_->areas[i];
      // Rounded up to a level by Recast; the surface is half a level lower, give or take as much.
      span.y = floor_.corner_.y() + (open_->spans[i].y - 0.5) * step;
      span.isOver = (area & kOver) != 0;
      span.hangs = (area & kHangs) != 0;
      const int surface = area % kOver;
      span.facesUp = surface >= kFrontUp;
      span.isAsked = surface == kAsked;
    }
    const auto radius = static_cast<int>(std::ceil(floor_.room_.radius / floor_.cell_ - 1e-6));
    rcErodeWalkableArea(&context_, radius, *open_);
    const int columns = floor_.width_ * floor_.depth_;
    floor_.begins_.reserve(static_cast<std::size_t>(columns) + 1);
    std::uint32_t next = 0;
    for (int i = 0; i < columns; ++i) {
      floor_.begins_.push_back(next);
      next += open_->cells[i].count;
    }
    floor_.begins_.push_back(next);
  }

  /// The spans that are a step away from one: at most four.
  template <typename Function>
  void forEachNeighbour(int x, int z, std::size_t span, Function&& function) const {
    for (int side = 0; side < 4; ++side) {
      const int to = rcGetCon(open_->spans[span], side);
      if (to == RC_NOT_CONNECTED) continue;
      const int nx = x + rcGetDirOffsetX(side), nz = z + rcGetDirOffsetY(side);
      const auto column = static_cast<std::size_t>(nx + nz * floor_.width_);
      function(nx, nz, floor_.begins_[column] + static_cast<std::size_t>(to));
    }
  }

  struct Seed {
    int x, z;
    std::size_t span;
  };

  /// Where a body's middle may be, joined; then the edges beside it.
  void labelAreas() {
    std::vector<Seed> all;
    for (int z = 0; z < floor_.depth_; ++z) {
      for (int x = 0; x < floor_.width_; ++x) {
        const auto column = static_cast<std::size_t>(x + z * floor_.width_);
        for (std::size_t i = floor_.begins_[column]; i < floor_.begins_[column + 1]; ++i) {
          floor_.spans_[i].isCore = open_->areas[i] != RC_NULL_AREA;
          if (floor_.spans_[i].isCore) all.push_back({x, z, i});
        }
      }
    }
    for (const Seed& seed : all) {
      if (floor_.spans_[seed.span].area >= 0) continue;
      const auto area = static_cast<std::int32_t>(floor_.areas_.size());
      floor_.areas_.emplace_back();
      spread({seed}, area, true);
    }
    const auto radius = static_cast<int>(std::ceil(floor_.room_.radius / floor_.cell_)) + 1;
    for (int i = 0; i < radius; ++i) all = spread(std::move(all), -1, false);
  }

  /// From spans to their neighbours: on and on among cores; else one step, with the label of where
  /// it comes from. Returns those that it came to.
  std::vector<Seed> spread(std::vector<Seed> from, std::int32_t area, bool isOn) {
    std::vector<Seed> reached;
    if (isOn) floor_.spans_[from.front().span].area = area;
    while (!from.empty()) {
      const Seed seed = from.back();
      from.pop_back();
      const std::int32_t label = floor_.spans_[seed.span].area;
      forEachNeighbour(seed.x, seed.z, seed.span, [&](int x, int z, std::size_t i) {
        WalkableFloor::Span& span = floor_.spans_[i];
        if (span.area >= 0 || (isOn && !span.isCore)) return;
        span.area = label;
        (isOn ? from : reached).push_back({x, z, i});
      });
    }
    return reached;
  }

  void measureAreas() {
    for (WalkableFloor::Area& area : floor_.areas_) {
      area.lowest = std::numeric_limits<double>::max();
      area.highest = -area.lowest;
    }
    for (const WalkableFloor::Span& span : floor_.spans_) {
      if (!span.isCore) continue;
      WalkableFloor::Area& area = floor_.areas_[static_cast<std::size_t>(span.area)];
      ++area.cells;
      area.facingUp += span.facesUp ? 1 : 0;
      area.hanging += span.hangs ? 1 : 0;
      area.lowest = std::min(area.lowest, span.y);
      area.highest = std::max(area.highest, span.y);
    }
    for (const WalkableFloor::Span& span : floor_.spans_) {
      if (!span.isCore) continue;
      WalkableFloor::Area& area = floor_.areas_[static_cast<std::size_t>(span.area)];
      if (span.y > area.lowest + 0.5 * floor_.room_.height) continue;
      ++area.low;
      area.lowOver += span.isOver ? 1 : 0;
    }
    const auto best =
        std::max_element(floor_.areas_.begin(), floor_.areas_.end(),
                         [](const auto& a, const auto& b) { return a.score() < b.score(); });
    if (best == floor_.areas_.end() || best->isOver()) return;
    floor_.main_ = static_cast<std::int32_t>(best - floor_.areas_.begin());
    best->isRoof = floor_.isOnTop() && floor_.hangs();
    if (best->isRoof) floor_.main_ = -1;
  }

  const Level& level_;
  const Scene& scene_;
  const Vector3d around_;
  const std::function<bool(ObjectId)>& isAsked_;
  WalkableFloor floor_;
  float step_ = 0.0F;                                 ///< The height of a cell, metres.
  std::vector<std::pair<double, TriangleId>> drawn_;  ///< With their highest points.
  rcContext context_{false};
  Owned<rcHeightfield> field_{rcAllocHeightfield(), rcFreeHeightField};
  Owned<rcCompactHeightfield> open_{rcAllocCompactHeightfield(), rcFreeCompactHeightfield};
};

double WalkableFloor::Area::score() const {
  const double over = low == 0 ? 0.0 : static_cast<double>(lowOver) / static_cast<double>(low);
  return static_cast<double>(cells) * (1.0 - (1.0 - kOverWeighs) * over) *
         (2 * facingUp >= cells ? 1.0 : kBackWeighs);
}

Result<WalkableFloor> WalkableFloor::build(const Level& level, const BodyRoom& room,
                                           const Vector3d& around,
                                           const std::function<bool(ObjectId)>& isAsked) {
  return FloorBuilder(level, room, around, isAsked).build();
}

}  // namespace foretouch::tools
