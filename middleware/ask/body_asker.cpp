#include "middleware/ask/body_asker.h"

#include <algorithm>

#include "lss/index.h"
#include "middleware/ask/way_boxes.h"

namespace foretouch::internal {
namespace {

Aabb boxOf(const Lss& lss, double rounding) {
  Aabb box;
  box.add(lss.a);
  box.add(lss.b);
  box.grow(lss.radius + rounding);
  return box;
}

/// Whether an object's box may hold the shape's place.
bool holds(const ObjectRoom& room, const AskedShape& shape) {
  Aabb place;
  place.add(shape.lss.a);
  place.grow(shape.rounding);
  return room.box.overlaps(place);
}

}  // namespace

void BodyAsker::askStill(const Scene& scene) {
  const LinkPlace inPlace;
  askSolids(scene.parts(), kStillScene, shape_);
  PieceAsker asker(filter_, shape_, inPlace, false, hits_);
  askScene(scene.parts(), ContactSide(), asker);
}

void BodyAsker::askBodies() {
  const InstantBodies& bodies = memory_.bodies;
  const double *const lower[3] = {bodies.lower(0), bodies.lower(1), bodies.lower(2)},
                      *const upper[3] = {bodies.upper(0), bodies.upper(1), bodies.upper(2)};
  memory_.bounds.resize(countOf(bodies.count()));
  const WayBoxes boxes(shape_, Eigen::Vector3d::Zero(), bodies.extent());
  boxes.nearest(bodies.count(), lower, upper, memory_.bounds.data());
  memory_.near.clear();
  const double limit = hits_.limit();
  for (BodyId body = 0; body < bodies.count(); ++body) {
    const double bound = memory_.bounds[slotOf(body)];
    if (bound <= limit && filter_.mayTake(world_, body)) memory_.near.push_back({bound, body});
  }
  std::sort(memory_.near.begin(), memory_.near.end(),
            [](const AskMemory::NearBody& x, const AskMemory::NearBody& y) {
              return x.bound != y.bound ? x.bound < y.bound : x.body < y.body;
            });
  for (const AskMemory::NearBody& near : memory_.near) {
    if (near.bound > hits_.limit()) break;
    askBody(near);
  }
}

void BodyAsker::askBody(const AskMemory::NearBody& near) {
  const PieceBoxes* const pieces = memory_.bodies.pieces(near.body);
  // Its box may have been a rough one so far. From here on nothing depends on earlier questions.
  const Aabb box = memory_.bodies.box(near.body);
  const double extent = box.min.lpNorm<1>() + box.max.lpNorm<1>();
  const double bound = WayBoxes(shape_, Eigen::Vector3d::Zero(), extent).nearest(box);
  if (bound > hits_.limit()) return;
  // From where it comes to the body on: near it, doubles resolve more.
  const AskedShape shape = shape_.moves() ? shape_.movedBy(bound, hits_.limit()) : shape_;
  if (world_.kindOf(near.body).mesh) {
    askMesh(near.body, shape);
  } else if (world_.kindOf(near.body).skin) {
    askSkin(near.body, pieces, shape);
  } else {
    askLinks(near.body, pieces, shape);
  }
}

void BodyAsker::askSkin(BodyId body, const PieceBoxes* pieces, const AskedShape& shape) {
  const BodyKind& kind = world_.kindOf(body);
  SkinAsker asker(kind, shape, filter_, isAssumed(body), hits_, memory_.skin);
  ContactSide side;
  side.body = body;
  if (!asker.findLinks(body, pieces)) return;
  // A skin has no inside to report.
  Aabb place;
  place.add(shape.lss.a);
  place.grow(shape.rounding);
  if (open_ != nullptr && shape.moved == 0.0 && memory_.bodies.box(body).overlaps(place) &&
      asker.takesTriangles(body)) {
    open_->push_back({body, AskUnknown::Open, kEveryObject});
  }
  const std::vector<LinkPlace>& places = memory_.bodies.places(body);
  asker.askTriangles(side, places);
  for (const LinkId link : asker.bareLinks()) {
    side.link = link;
    askSolidsOf(side, shape);
    for (std::size_t i = 0; i < kind.volumes[slotOf(link)].size(); ++i) {
      side.lss = static_cast<std::int32_t>(i);
      askLink(side, places[slotOf(link)], shape);
    }
  }
}

void BodyAsker::askMesh(BodyId body, const AskedShape& shape) {
  const LinkPlace& place = memory_.bodies.places(body).front();
  const AskedShape seen = shape.seenFrom(place, memory_.seen);
  askSolids(world_.kindOf(body).mesh->parts(), body, seen);
  PieceAsker asker(filter_, seen, place, isAssumed(body), hits_);
  ContactSide side;
  side.body = body;
  askScene(world_.kindOf(body).mesh->parts(), side, asker);
}

void BodyAsker::askLinks(BodyId body, const PieceBoxes* pieces, const AskedShape& shape) {
  const BodyKind& kind = world_.kindOf(body);
  ContactSide side;
  side.body = body;
  for (LinkId link = 0; open_ != nullptr && link < kind.skeleton.numJoints(); ++link) {
    side.link = link;
    askSolidsOf(side, shape);
  }
  const std::size_t count = kind.linkOf.size();
  memory_.bounds.assign(count, 0.0);
  if (pieces != nullptr && count > 0) {
    const float* lower[3];
    const float* upper[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lower[axis] = pieces->lower[axis].data();
      upper[axis] = pieces->upper[axis].data();
    }
    const double extent = (pieces->box.max - pieces->origin).lpNorm<1>() +
                          (pieces->box.min - pieces->origin).lpNorm<1>();
    WayBoxes(shape, pieces->origin, extent)
        .nearest(static_cast<int>(count), lower, upper, memory_.bounds.data());
  }
  std::size_t first = 0;  // LSS of the current link
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0 && kind.linkOf[i] != kind.linkOf[i - 1]) first = i;
    if (memory_.bounds[i] > std::min(shape.reach, hits_.limit() - shape.moved)) continue;
    side.link = kind.linkOf[i];
    side.lss = static_cast<std::int32_t>(i - first);
    askLink(side, memory_.bodies.places(body)[slotOf(side.link)], shape);
  }
}

void BodyAsker::askLink(const ContactSide& side, const LinkPlace& place, const AskedShape& shape) {
  const BodyKind& kind = world_.kindOf(side.body);
  AskedShape nearer = shape;
  const Lss& lss_L = kind.volumes[slotOf(side.link)][slotOf(side.lss)];
  double rounding = 0.0;
  const Lss lss = placed(lss_L, place, rounding);
  nearer.rounding += rounding;
  const Aabb box = boxOf(lss, nearer.rounding);
  const double extent = box.min.lpNorm<1>() + box.max.lpNorm<1>();
  const WayBoxes boxes(nearer, Eigen::Vector3d::Zero(), extent);
  if (boxes.nearest(box) > std::min(shape.reach, hits_.limit() - shape.moved)) return;
  const LinkSurface* const surface = surfaceOf(kind, side.link);
  if (surface != nullptr && surface->hasTriangles(side.lss)) {
    PieceAsker asker(filter_, shape.seenFrom(place, memory_.seen), place, isAssumed(side.body),
                     hits_);
    askSurface(*surface, side, asker);
    return;
  }
  const LinkPlace inPlace;
  PieceAsker asker(filter_, nearer, inPlace, isAssumed(side.body), hits_);
  asker.askLss(lss, side);
}

void BodyAsker::askSolids(const SceneParts& scene, BodyId body, const AskedShape& shape) {
  if (open_ == nullptr || shape.moved > 0.0) return;
  const std::vector<ObjectRoom>& rooms = scene.rooms();
  ContactSide side;
  side.body = body;
  bool isAny = false;
  for (std::size_t object = 0; object < rooms.size(); ++object) {
    const auto id = static_cast<ObjectId>(object);
    if (!holds(rooms[object], shape) || !filter_.takes(body, side.link, id)) continue;
    isAny = isAny || rooms[object].isClosed;
    if (!rooms[object].isClosed) open_->push_back({body, AskUnknown::Open, id});
  }
  if (!isAny) return;
  findObjectsAround(scene, shape.lss.a, shape.rounding, memory_.around);
  for (const auto* objects : {&memory_.around.inside, &memory_.around.atSurface}) {
    for (const ObjectId object : *objects) {
      if (rooms[slotOf(object)].isClosed) addSolid(side, object);
    }
  }
}

void BodyAsker::askSolidsOf(const ContactSide& side, const AskedShape& shape) {
  const LinkSurface* const surface = surfaceOf(world_.kindOf(side.body), side.link);
  if (open_ == nullptr || surface == nullptr || surface->triangles().empty()) return;
  const LinkPlace& place = memory_.bodies.places(side.body)[slotOf(side.link)];
  askSolids(*surface, side, shape.seenFrom(place, memory_.seen));
}

void BodyAsker::askSolids(const LinkSurface& surface, const ContactSide& side,
                          const AskedShape& shape) {
  if (shape.moved > 0.0 || !holds(surface.room(), shape)) return;
  if (!filter_.takes(side.body, side.link, kEveryObject)) return;
  if (!surface.room().isClosed) {
    open_->push_back({side.body, AskUnknown::Open, kEveryObject});
    return;
  }
  ObjectsAround& around = memory_.around;
  findObjectsAround(surface.triangles(), shape.lss.a, shape.rounding, around);
  if (!around.inside.empty() || !around.atSurface.empty()) addSolid(side, kEveryObject);
}

void BodyAsker::addSolid(const ContactSide& side, ObjectId object) {
  if (hits_.limit() < 0.0 || !filter_.takes(side.body, side.link, object)) return;
  WorldHit hit;
  takeOwner(side, hit);
  hit.what.p_W = shape_.lss.a;
  hit.object = object;
  hit.isAssumed = side.body != kStillScene && isAssumed(side.body);
  hits_.add(hit);
}

}  // namespace foretouch::internal
