#include "tools/repair/rows.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "lss/index.h"
#include "lss/separation.h"
#include "tools/floor/resting_body.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// Rows for what is within the gap and this much more (m): the change may bring it there.
constexpr double kReach = 0.02;
/// A feature whose normal is this near (cosine) to a side's is turned to that side.
constexpr double kAlong = 0.3;
/// What a step slides adds up over a stance: it counts so many times.
constexpr double kHeldTimes = 10.0;
/// An axis this near to a triangle's plane (m) crosses it.
constexpr double kCrosses = 1e-6;

/// An LSS where it is in W.
struct Placed {
  LinkId link;
  Vector3d a, b;
  double radius;
  [[nodiscard]] Vector3d at(double along) const { return a + along * (b - a); }
};

class Builder {
 public:
  Builder(const RepairStage& stage, const Levers& levers, const Demands& demands,
          const Changes& changes)
      : stage_(stage), levers_(levers), demands_(demands), changes_(changes) {}

  Rows build() {
    for (const Side& side : demands_.sides()) {
      if (side.isLost || side.isGivenUp) continue;
      for (std::int32_t step = side.first; step <= side.last; ++step) addSide(side, step);
    }
    const double gap = stage_.request().gap, off = 2.0 * stage_.request().tolerance + gap;
    for (const auto& [part, pose] : demands_.lifts()) addLift(part, pose, gap);
    for (const auto& [part, pose] : demands_.clears()) addLift(part, pose, off);
    for (const auto& [place, most] : demands_.keeps()) addKeep(place.first, place.second, most);
    for (const auto& [place, look] : demands_.holds()) addHold(look);
    for (const auto& [knob, pose] : demands_.limits()) addLimit(knob, pose);
    return std::move(rows_);
  }

 private:
  void addSide(const Side& side, std::int32_t step);
  void addScene(const Side& side);
  void addOwn(const Side& side);
  void addLift(std::size_t part, std::int32_t pose, double height);
  void addKeep(std::size_t part, std::int32_t pose, double most);
  void addHold(const RestLook& look);
  void addLimit(std::int32_t knob, std::int32_t pose);
  void pose(std::int32_t step, double t);
  [[nodiscard]] Placed placed(LinkId link, const Lss& lss) const;
  /// along.(point of link - point of other) >= gap + radii, of which it is `distance`.
  void addContact(const RowOwner& owner, const SeenPoint& point, const SeenPoint* other,
                  double distance, double radii);
  void push(Row row, const RowOwner& owner, double value);

  const RepairStage& stage_;
  const Levers& levers_;
  const Demands& demands_;
  const Changes& changes_;
  Rows rows_;
  // The instant that is looked at.
  std::int32_t step_ = 0;
  double t_ = 0.0;
  ChainMotion motion_;
  std::vector<LinkState> states_;
  Scratch scratch_;
  NearFeatures features_;
};

void Builder::pose(std::int32_t step, double t) {
  step_ = step;
  t_ = t;
  const auto& poses = stage_.poses();
  const std::size_t from = slotOf(step), to = std::min(from + 1, poses.size() - 1);
  motion_.assign(stage_.body().skeleton(), poses[from], poses[to]);
  motion_.statesAt(t, states_);
}

Placed Builder::placed(LinkId link, const Lss& lss) const {
  const LinkState& state = states_[slotOf(link)];
  return {link, state.pointAt(lss.a), state.pointAt(lss.b), lss.radius};
}

/// The row's bounds are about what is there now; those for the total change include the change that
/// is there already.
void Builder::push(Row row, const RowOwner& owner, double value) {
  double here = 0.0;
  for (const RowTerm& term : row.terms) here += term.by * changes_(term.knob, term.pose);
  row.lower += here - value;
  row.upper += here - value;
  if (row.terms.empty()) return;
  rows_.rows.push_back(std::move(row));
  rows_.owners.push_back(owner);
}

void Builder::addContact(const RowOwner& owner, const SeenPoint& point, const SeenPoint* other,
                         double distance, double radii) {
  const double gap = stage_.request().gap;
  if (distance > radii + gap + kReach) return;
  Row row;
  for (const bool isLater : {false, true}) {
    const Levers::Sight sight{states_, isLater ? std::min(step_ + 1, stage_.numPoses() - 1) : step_,
                              isLater ? t_ : 1.0 - t_};
    if (other == nullptr) {
      levers_.addOfLimb(point, sight, row.terms);
    } else {
      levers_.addBeside(other->link, point, sight, row.terms);
      levers_.addBeside(point.link, {other->link, other->p_W, -other->along_W}, sight, row.terms);
    }
  }
  row.lower = radii + gap;
  push(std::move(row), owner, distance);
}

void Builder::addSide(const Side& side, std::int32_t step) {
  std::vector<double> instants{0.0, 0.5};
  const auto found = demands_.instants().find(step);
  if (found != demands_.instants().end()) {
    instants.insert(instants.end(), found->second.begin(), found->second.end());
  }
  if (step == side.last) instants.push_back(1.0);
  for (const double t : instants) {
    pose(step, t);
    side.other < 0 ? addScene(side) : addOwn(side);
  }
}

void Builder::addScene(const Side& side) {
  const Scene& scene = stage_.feet().level.scene();
  const auto& all = stage_.body().lss(side.link);
  std::vector<double> reach(states_.size(), -1.0);
  reach[slotOf(side.link)] = stage_.request().gap + kReach;
  stage_.near().answer(states_, reach, scratch_, features_);
  const RowOwner owner{FaultKind::Scene, side.link, -1, side.object, step_};
  const bool hasSide = !side.normal_W.isZero(0.0);
  std::vector<std::uint8_t> isSeen(all.size(), 0);
  const NearRange& range = features_.links[slotOf(side.link)];
  for (std::size_t i = range.first; i < range.first + range.count; ++i) {
    const NearFeature& feature = features_.features[i];
    if (scene.object(feature.triangle) != side.object) continue;
    const Placed lss = placed(side.link, all[slotOf(feature.lss)]);
    Vector3d n = feature.nhat_SL_W;
    if (n.isZero(0.0)) n = side.normal_W;
    const double agrees = n.dot(side.normal_W);
    if (hasSide && agrees < -kAlong) n = -n;
    const bool isAlong = !hasSide || std::abs(agrees) > kAlong;
    // Beside an edge of what it is in: the side's own rows lead out.
    if (!isAlong && feature.gap < -0.5 * lss.radius) continue;
    const Vector3d axis = lss.at(feature.along);
    const double distance = n.dot(axis - feature.p_WScene);
    addContact(owner, {side.link, axis, n}, nullptr, distance, lss.radius);
    if (isAlong) isSeen[slotOf(feature.lss)] = 1;
    if (!isAlong || std::abs(distance) > kCrosses) continue;
    for (const Vector3d& end : {lss.a, lss.b}) {
      addContact(owner, {side.link, end, n}, nullptr, n.dot(end - feature.p_WScene), lss.radius);
    }
  }
  for (std::size_t i = 0; hasSide && i < all.size(); ++i) {
    if (isSeen[i] != 0) continue;
    const Placed lss = placed(side.link, all[i]);
    for (const Vector3d& end : {lss.a, lss.b}) {
      const double height = side.normal_W.dot(end - side.p_W);
      // Behind the surface, and out of its reach.
      if (height < -lss.radius)
        addContact(owner, {side.link, end, side.normal_W}, nullptr, height, lss.radius);
    }
  }
}

void Builder::addOwn(const Side& side) {
  const RowOwner owner{FaultKind::Own, side.link, side.other, -1, step_};
  const auto& mine = stage_.body().lss(side.link);
  const auto& others = stage_.body().lss(side.other);
  const auto& self = stage_.query().options().self;
  const auto radiiOf = [&](std::size_t i, std::size_t k) {
    const bool isTurned = side.link > side.other;
    for (const PairRadius& own : self->radii()) {
      const bool isIt =
          own.a == std::min(side.link, side.other) && own.b == std::max(side.link, side.other) &&
          slotOf(own.lssA) == (isTurned ? k : i) && slotOf(own.lssB) == (isTurned ? i : k);
      if (isIt) return own.radius;
    }
    return mine[i].radius + others[k].radius;
  };
  for (std::size_t i = 0; i < mine.size(); ++i) {
    const Placed one = placed(side.link, mine[i]);
    for (std::size_t k = 0; k < others.size(); ++k) {
      const Placed other = placed(side.other, others[k]);
      const Separation between =
          separation(Hull::segment(one.a, one.b), Hull::segment(other.a, other.b));
      Vector3d n = between.onOne - between.onOther;
      double distance = n.norm();
      n = distance > kCrosses ? Vector3d(n / distance) : side.normal_W;
      if (n.dot(side.normal_W) < -0.5) n = -n, distance = -distance;
      if (n.isZero(0.0)) continue;
      const SeenPoint beside{side.other, between.onOther, n};
      addContact(owner, {side.link, between.onOne, n}, &beside, distance, radiiOf(i, k));
    }
  }
}

/// Demands that every corner of the part is so high above what it stands on.
void Builder::addLift(std::size_t part, std::int32_t at, double height) {
  const FeetInputs& inputs = stage_.feet();
  const RestingPart& of = inputs.body.parts[part];
  at == stage_.numPoses() - 1 ? pose(at - 1, 1.0) : pose(at, 0.0);
  const RowOwner owner{FaultKind::Under, stage_.linkOf(of.links.front()), -1, -1, step_};
  for (const PartCorner& corner : of.corners) {
    const LinkId link = stage_.linkOf(corner.link);
    const Vector3d p_W = states_[slotOf(link)].pointAt(corner.center_L);
    const auto ground =
        inputs.groundOf(inputs.body.limbs[of.limb], states_, p_W - Vector3d(0, corner.radius, 0));
    if (!ground) continue;
    addContact(owner, {link, p_W, ground->normal_W}, nullptr, ground->heightOf(p_W),
               corner.radius + height - stage_.request().gap);
  }
}

/// Wishes that the lowest corner of the part is at most so high.
void Builder::addKeep(std::size_t part, std::int32_t at, double most) {
  const FeetInputs& inputs = stage_.feet();
  const RestingPart& of = inputs.body.parts[part];
  at == stage_.numPoses() - 1 ? pose(at - 1, 1.0) : pose(at, 0.0);
  const PartCorner* lowest = nullptr;
  double least = 0.0;
  for (const PartCorner& corner : of.corners) {
    const double y =
        states_[slotOf(stage_.linkOf(corner.link))].pointAt(corner.center_L).y() - corner.radius;
    if (lowest == nullptr || y < least) lowest = &corner, least = y;
  }
  const LinkId link = stage_.linkOf(lowest->link);
  const Vector3d p_W = states_[slotOf(link)].pointAt(lowest->center_L);
  const auto ground =
      inputs.groundOf(inputs.body.limbs[of.limb], states_, p_W - Vector3d(0, lowest->radius, 0));
  if (!ground) return;
  Row row;
  levers_.add({link, p_W, ground->normal_W}, {states_, at, 1.0}, row.terms);
  row.upper = lowest->radius + most;
  row.isWish = true;
  push(std::move(row), {FaultKind::Under, link, -1, -1, at}, ground->heightOf(p_W));
}

/// Demands that what counted for a slide does not move from one pose to the next.
void Builder::addHold(const RestLook& look) {
  const auto step = static_cast<std::int32_t>(look.step);
  const LinkId link = stage_.linkOf(look.link);
  const RowOwner owner{FaultKind::Slide, link, -1, -1, step};
  const Vector3d one = look.normal_W.unitOrthogonal(), other = look.normal_W.cross(one);
  for (const Vector3d& along : {one, other}) {
    Row row;
    double value = 0.0;
    for (const double t : {1.0, 0.0}) {
      pose(step, t);
      const Vector3d p_W = states_[slotOf(link)].pointAt(look.p_L);
      const double sign = t > 0.5 ? kHeldTimes : -kHeldTimes;
      levers_.add({link, p_W, along}, {states_, t > 0.5 ? step + 1 : step, sign}, row.terms);
      value += sign * along.dot(p_W);
    }
    row.lower = row.upper = 0.0;
    push(std::move(row), owner, value);
  }
}

void Builder::addLimit(std::int32_t knob, std::int32_t at) {
  const Knob& of = stage_.knobs()[slotOf(knob)];
  const double value = of.values[slotOf(stage_.frameOf(at))];
  Row row;
  row.terms.push_back({at, knob, 1.0});
  row.lower = of.lower - value;
  row.upper = of.upper - value;
  rows_.rows.push_back(std::move(row));
  rows_.owners.push_back({FaultKind::Limit, knob, -1, -1, at});
}

}  // namespace

Rows rowsOf(const RepairStage& stage, const Levers& levers, const Demands& demands,
            const Changes& changes) {
  return Builder(stage, levers, demands, changes).build();
}

}  // namespace foretouch::tools
