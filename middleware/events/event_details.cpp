#include "middleware/events/event_details.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "lss/rounding.h"
#include "middleware/mechanics/mass.h"
#include "middleware/pair/approach.h"
#include "middleware/pair/link_query.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// By separation, then by place: as contacts of one link are chosen.
bool isNearer(const MovingPair& x, const SidesPair& ofX, const MovingPair& y,
              const SidesPair& ofY) {
  const auto key = [](const MovingPair& pair, const SidesPair& of) {
    const Vector3d &p = pair.axes.onOther, &n = pair.axes.nhat;
    return std::make_tuple(pair.estimate(), p.x(), p.y(), p.z(), n.x(), n.y(), n.z(),
                           of.other.triangle, of.other.lss, of.one.lss, of.one.triangle);
  };
  return key(x, ofX) < key(y, ofY);
}

/// The event is about a and b, the sides are the other way round.
void turnAround(WorldEvent& event) {
  std::swap(event.a.lss, event.b.lss);
  std::swap(event.a.triangle, event.b.triangle);
  std::swap(event.a.p_W, event.b.p_W);
  event.nhat_BA_W = -event.nhat_BA_W;
  for (std::size_t i = 0; i < event.numPoints; ++i) {
    std::swap(event.points[i].p_WA, event.points[i].p_WB);
  }
}

}  // namespace

void EventDetails::fill(SpanSides& span, MovingSides& sides, double t, double within,
                        const BodyMasses& masses, WorldEvent& event) {
  if (!findNearest(sides, t, within, event.object)) return;
  tellPlaces(event);
  tellPoints(sides, t, within, event);
  toWorld(span, t, event);
  if (span.isTurned()) turnAround(event);
  tellSpeeds(span, t, event);
  tellMass(span, t, masses, event);
}

bool EventDetails::findNearest(MovingSides& sides, double t, double within, ObjectId object) {
  sides.collect(t, t, within, near_);
  bool isFound = false;
  std::size_t kept = 0;
  for (const SidesPair& pair : near_) {
    if (sides.objectOf(pair) != object) continue;
    const MovingPair now = sides.at(pair, t);
    if (now.estimate() > within) continue;
    near_[kept++] = pair;
    if (isFound && !isNearer(now, pair, nearest_.at, nearest_.pair)) continue;
    nearest_ = {pair, now};
    isFound = true;
  }
  near_.resize(kept);
  return isFound;
}

void EventDetails::tellPlaces(WorldEvent& event) const {
  const auto& [pair, at] = nearest_;
  event.separation = std::max(0.0, at.estimate());
  event.penetration = std::max(0.0, -at.estimate());
  event.nhat_BA_W = contactNormal(at.axes);
  event.a.lss = pair.one.lss;
  event.a.triangle = pair.one.triangle;
  event.a.p_W = at.axes.onOne - at.one.radius * event.nhat_BA_W;
  event.b.lss = pair.other.lss;
  event.b.triangle = pair.other.triangle;
  event.b.p_W = at.axes.onOther + at.other.radius * event.nhat_BA_W;
}

void EventDetails::tellPoints(MovingSides& sides, double t, double within, WorldEvent& event) {
  manifold_.begin(within, event.nhat_BA_W);
  for (const SidesPair& pair : near_) {
    const MovingPair now = sides.at(pair, t);
    const auto& [one, other] = pair;
    manifold_.offer({now.one.hull, now.one.radius, one.lss, one.triangle},
                    {now.other.hull, now.other.radius, other.lss,
                     other.triangle < 0 ? other.lss : other.triangle});
  }
  details_.numPoints = 0;
  manifold_.choose(details_);
  event.numPoints = details_.numPoints;
  for (std::size_t i = 0; i < event.numPoints; ++i) {
    const ContactPoint& point = details_.points[i];
    event.points[i] = {point.p_WLink, point.p_WOther, point.separation};
  }
}

/// Takes the event from the frame of the sides to W.
void EventDetails::toWorld(SpanSides& span, double t, WorldEvent& event) const {
  const LinkState frame = span.frameAt(t);
  const auto move = [&](Vector3d& p) { p = frame.pointAt(p) + span.origin(); };
  move(event.a.p_W);
  move(event.b.p_W);
  event.nhat_BA_W = frame.R_WL * event.nhat_BA_W;
  for (std::size_t i = 0; i < event.numPoints; ++i) {
    move(event.points[i].p_WA);
    move(event.points[i].p_WB);
  }
}

void EventDetails::tellSpeeds(SpanSides& span, double t, WorldEvent& event) const {
  const auto pointOf = [&](const ContactSide& side) {
    if (side.body == kStillScene) return MaterialPoint();
    return materialPointAt(span.stateOf(side.body, side.link, t),
                           span.boundsOf(side.body, side.link), side.p_W - span.origin());
  };
  const MaterialPoint a = pointOf(event.a), b = pointOf(event.b);
  const Approach approach = approachAlong(event.nhat_BA_W, event.separation, a, b, 1.0 - t);
  const double perSecond = 1.0 / span.seconds();
  event.velocity_W = perSecond * (a.velocity - b.velocity);
  event.approachSpeed = perSecond * approach.speed;
  // One rounding of the time, one of the product.
  const double slack = 4.0 * kUnitRoundoff *
                       std::max(std::abs(approach.lower), std::abs(approach.upper)) * perSecond;
  event.approachLower = perSecond * approach.lower - slack;
  event.approachUpper = perSecond * approach.upper + slack;
}

void EventDetails::tellMass(SpanSides& span, double t, const BodyMasses& masses,
                            WorldEvent& event) {
  CollisionPoint point{event.nhat_BA_W, event.velocity_W, Eigen::Matrix3d::Zero()};
  const ContactSide &a = event.a, &b = event.b;
  const Vector3d p = a.p_W - span.origin(), q = b.p_W - span.origin();
  const auto add = [&](const ContactSide& side, const Vector3d& at) {
    if (side.body == kStillScene || !masses.has(side.body)) return;
    span.statesOf(side.body, t, states_);
    point.inverseMass_W += masses.inverseAt(side.body, side.link, states_, at);
  };
  if (a.body == b.body) {
    if (masses.has(a.body)) {
      span.statesOf(a.body, t, states_);
      point.inverseMass_W = masses.inverseBetween(a.body, a.link, p, b.link, q, states_);
    }
  } else {
    add(a, p);
    add(b, q);
  }
  event.effectiveMass = effectiveMass(point);
}

}  // namespace foretouch::internal
