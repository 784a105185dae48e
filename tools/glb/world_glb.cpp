#include "tools/glb/world_glb.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "lss/index.h"
#include "lss/turn_between.h"
#include "tools/glb/replay_scene.h"
#include "tools/world/outline.h"
#include "tools/world/world_results.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

/// Markers are costly to viewers, each an animated node.
constexpr std::size_t kMostWorldTouches = 5000;
constexpr GlbMaterial kBodyLss{"LSS", {0.16, 0.36, 0.70, 1.0}};
constexpr GlbMaterial kBodyMesh{"mesh", {0.62, 0.42, 0.22, 1.0}};
constexpr GlbMaterial kMetRed{"contact", {0.80, 0.05, 0.03, 1.0}};
constexpr GlbMaterial kInsideAmber{"starts in contact", {0.90, 0.50, 0.02, 1.0}};
/// How long (s) a touch stays visible at least.
constexpr double kShownS = 1.0;
/// The arrow of a touch, by how fast the two approach where it begins, each a level: m/s, m.
struct ArrowOfSpeed {
  double fromSpeed, length;
};
constexpr ArrowOfSpeed kArrows[] = {{0.0, 0.12}, {0.25, 0.18}, {1.0, 0.27}, {4.0, 0.40}};
constexpr double kArrowOfUnknown = 0.18;
constexpr GlbMaterial kTriggerGreen{"trigger", {0.0, 0.34, 0.17, 1.0}};

/// The nodes of a body between two instants, in which nothing above it changes.
struct BodyPiece {
  std::int64_t fromUs = 0, untilUs = 0;
  std::size_t firstNode = 0;  ///< The node of its first link; the others follow in order.
};

/// Adds the bodies of a world, each below its carrier. In glTF a node's parent cannot change over
/// time: a body has nodes for each of its carriers, visible while that one carries it.
class BodyNodes {
 public:
  BodyNodes(const LoadedWorld& world, const Vector3d& origin, std::size_t parent,
            GlbContent& content, GlbAnimation& animation)
      : world_(world),
        origin_(origin),
        group_(addGroup(content.document(), parent, "bodies")),
        triggers_(world.file.hasTriggers() ? addGroup(content.document(), parent, "triggers")
                                           : group_),
        content_(content),
        animation_(animation),
        pieces_(world.bodies.size()),
        isMade_(world.bodies.size()) {
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
      pieces_[i].resize(world.bodies[i].stretches.size());
      isMade_[i].resize(world.bodies[i].stretches.size(), false);
    }
  }

  Result<Done> addAll(TriangleBudget& budget, std::vector<std::string>& notes) {
    addMeshes(budget, notes);
    for (std::size_t body = 0; body < world_.bodies.size(); ++body) {
      for (std::size_t i = 0; i < world_.bodies[body].stretches.size(); ++i) {
        FORETOUCH_CHECK(add(static_cast<BodyId>(body), i));
      }
    }
    addAppearances(appearances_, seconds(world_.endUs), content_, animation_);
    return Done{};
  }

  /// Seconds on the animation's clock, which begins where the world does.
  [[nodiscard]] double seconds(std::int64_t utimeUs) const {
    return static_cast<double>(utimeUs - world_.beginUs) / kUsPerS;
  }

 private:
  [[nodiscard]] const BodyStretches& stretchesOf(BodyId body) const {
    return world_.bodies[slotOf(body)].stretches;
  }
  [[nodiscard]] std::int64_t endOf(BodyId body, std::size_t stretch) const {
    const BodyStretches& all = stretchesOf(body);
    return stretch + 1 < all.size() ? std::min(world_.endUs, all[stretch + 1].beginUs)
                                    : world_.endUs;
  }

  void addMeshes(TriangleBudget& budget, std::vector<std::string>& notes) {
    const std::size_t lss = content_.addMaterial(kBodyLss), mesh = content_.addMaterial(kBodyMesh);
    std::size_t leftOut = 0;
    for (std::size_t i = 0; i < world_.numBodies(); ++i) {
      const BodyShape& shape = world_.bodies[i].shape;
      const std::string& name = world_.file.bodies[i].name;
      if (shape.avatar) {
        meshes_.push_back(addLssMeshes(*shape.avatar, name + ": ", lss, content_, budget, leftOut));
        continue;
      }
      const std::vector<Triangle>& triangles = *shape.triangles;
      const bool fits = budget.take(triangles.size());
      if (!fits) notes.push_back(fmt::format("the mesh of {} is left out", name));
      meshes_.push_back(
          {fits ? content_.addMesh(name, {{tools::meshOf(triangles), mesh}}) : kNoMesh});
    }
    if (leftOut > 0) notes.push_back(fmt::format("{} LSS of bodies are left out", leftOut));
    addOutlines();
  }

  /// Triggers come behind all other bodies.
  void addOutlines() {
    if (!world_.file.hasTriggers()) return;
    const std::size_t material = content_.addMaterial(kTriggerGreen);
    for (std::size_t i = world_.numBodies(); i < world_.bodies.size(); ++i) {
      GlbMesh lines;
      for (const Vector3d& point : outlineOf(world_.bodies[i].shape)) {
        lines.indices.push_back(static_cast<std::uint32_t>(lines.positions.size()));
        lines.positions.push_back(point.cast<float>());
      }
      meshes_.push_back(
          {content_.addMesh(world_.file.bodies[i].name, {{std::move(lines), material, true}})});
    }
  }

  /// Adds a stretch's nodes, below those of its carrier, which come first.
  Result<Done> add(BodyId body, std::size_t index) {
    if (isMade_[slotOf(body)][index]) return Done{};
    isMade_[slotOf(body)][index] = true;
    const BodyStretch& stretch = stretchesOf(body)[index];
    const std::int64_t fromUs = stretch.beginUs, untilUs = endOf(body, index);
    if (untilUs <= fromUs) return Done{};
    if (!stretch.carrier) {
      return addPiece(body, index, {fromUs, untilUs, 0},
                      world_.isTrigger(body) ? triggers_ : group_, origin_);
    }
    const BodyId carrier = stretch.carrier->body;
    for (std::size_t i = 0; i < stretchesOf(carrier).size(); ++i) {
      if (endOf(carrier, i) <= fromUs || stretchesOf(carrier)[i].beginUs >= untilUs) continue;
      FORETOUCH_CHECK(add(carrier, i));
      // A copy: the carrier's pieces are all there, but those of others grow.
      const std::vector<BodyPiece> above = pieces_[slotOf(carrier)][i];
      for (const BodyPiece& piece : above) {
        const BodyPiece part{std::max(fromUs, piece.fromUs), std::min(untilUs, piece.untilUs), 0};
        if (part.untilUs <= part.fromUs) continue;
        FORETOUCH_CHECK(addPiece(body, index, part, piece.firstNode + slotOf(stretch.carrier->link),
                                 Vector3d::Zero()));
      }
    }
    return Done{};
  }

  Result<Done> addPiece(BodyId body, std::size_t index, BodyPiece piece, std::size_t parent,
                        const Vector3d& origin) {
    const Track& track = stretchesOf(body)[index].track;
    std::vector<Pose> poses;
    std::vector<double> timesS;
    const auto addPose = [&](std::int64_t us, Pose pose) {
      poses.push_back(std::move(pose));
      timesS.push_back(seconds(us));
    };
    addPose(piece.fromUs, poseOn(track, piece.fromUs));
    for (std::int64_t us = track.nextKnotUs(piece.fromUs); us < piece.untilUs;
         us = track.nextKnotUs(us)) {
      addPose(us, poseOn(track, us));
    }
    // At the end of its own stretch it has not changed its frame yet.
    addPose(piece.untilUs, poseOn(track, piece.untilUs));
    FORETOUCH_CHECK(checkTimes(timesS));
    const std::size_t holder = addGroup(content_.document(), parent, world_.nameOf(body));
    const bool isShownFirst = piece.fromUs <= world_.beginUs,
               isShownLast = piece.untilUs >= world_.endUs;
    if (!isShownFirst || !isShownLast) {
      appearances_.push_back({holder, seconds(piece.fromUs), seconds(piece.untilUs)});
    }
    const BodyShape& shape = world_.bodies[slotOf(body)].shape;
    piece.firstNode = addAvatar({shape.skeleton, poses, timesS}, meshes_[slotOf(body)], holder,
                                origin, content_, animation_);
    pieces_[slotOf(body)][index].push_back(piece);
    return Done{};
  }

  const LoadedWorld& world_;
  Vector3d origin_;
  std::size_t group_, triggers_;
  GlbContent& content_;
  GlbAnimation& animation_;
  std::vector<std::vector<std::vector<BodyPiece>>> pieces_;  // per body and stretch
  std::vector<std::vector<bool>> isMade_;
  std::vector<std::vector<std::size_t>> meshes_;  // per body and link
  std::vector<Appearance> appearances_;
};

/// Where bodies are over time, for the scene's choice of triangles and the world's origin.
std::vector<Vector3d> placesOf(const LoadedWorld& world) {
  constexpr std::int64_t kPlaces = 32;
  const std::vector<const BodyStretches*> stretches = world.stretches();
  const BodyPlaces places(stretches);
  std::vector<Vector3d> found;
  for (std::int64_t i = 0; i <= kPlaces; ++i) {
    const std::int64_t us = world.beginUs + (world.endUs - world.beginUs) / kPlaces * i;
    for (std::size_t body = 0; body < world.numBodies(); ++body) {
      const auto id = static_cast<BodyId>(body);
      if (places.isThere(id, us)) found.push_back(places.linkAt(id, 0, us).translation);
    }
  }
  return found;
}

json parsedContact(const LoadedWorld& world, const WorldContact& contact) {
  std::string text;
  JsonWriter out(text);
  writeWorldContact(world, contact, out);
  return json::parse(text);
}

json parsedTouch(const LoadedWorld& world, const TouchSides& sides, const WorldTouch& touch) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  writeWorldTouch(world, sides, touch, out);
  out.endObject();
  return json::parse(text);
}

std::string sideName(const LoadedWorld& world, const ContactSide& side) {
  if (side.body == kStillScene) {
    return world.scene->objectNames()[slotOf(world.scene->object(side.triangle))];
  }
  const std::string link = world.linkNameOf(side.body, side.link);
  return world.nameOf(side.body) + (link.empty() ? "" : ": " + link);
}

/// "anna: LeftHand at ben: Head, 1.003 s".
std::string titleOf(const LoadedWorld& world, const WorldContact& contact, double timeS) {
  return fmt::format("{} at {}, {:.3f} s", sideName(world, contact.a), sideName(world, contact.b),
                     timeS);
}

double arrowLength(const WorldTouch& touch) {
  if (!touch.strength) return kArrowOfUnknown;
  double length = kArrows[0].length;
  for (const ArrowOfSpeed& arrow : kArrows) {
    if (touch.strength->approachSpeed >= arrow.fromSpeed) length = arrow.length;
  }
  return length;
}

/// Balls and arrows where touches begin.
class Markers {
 public:
  Markers(const LoadedWorld& world, const Vector3d& origin, std::size_t group, GlbContent& content)
      : world_(world), origin_(origin), group_(group), content_(content) {}

  void add(const WorldTouch& touch, const TouchSides& sides) {
    const WorldContact& contact = touch.first;
    json extras = parsedContact(world_, contact);
    extras["window"] = touch.firstStep;
    extras["touch"] = parsedTouch(world_, sides, touch);
    const auto turn = turnBetween(Vector3d::UnitY(), contact.nhat_BA_W).normalized();
    GltfDocument& document = content_.document();
    const std::size_t node =
        document.add("nodes", {{"name", titleOf(world_, contact, touch.beginS)},
                               {"mesh", meshFor(contact.verdict, arrowLength(touch))},
                               {"translation", gltfVector(contact.b.p_W - origin_)},
                               {"rotation", json::array({turn.x(), turn.y(), turn.z(), turn.w()})},
                               {"extras", std::move(extras)}});
    document.at("nodes", group_)["children"].push_back(node);
    const double zeroS = LoadedWorld::secondsOf(world_.beginUs);
    const double beginS = touch.beginS - zeroS, endS = touch.endS - zeroS;
    appearances_.push_back({node, beginS, std::max(endS, beginS + kShownS)});
  }

  void finish(GlbAnimation& animation) {
    const double lastS = LoadedWorld::secondsOf(world_.endUs - world_.beginUs);
    addAppearances(appearances_, lastS, content_, animation);
  }

 private:
  std::size_t meshFor(Verdict verdict, double length) {
    const bool isMet = verdict == Verdict::Contact;
    const auto known = meshes_.find({isMet, length});
    if (known != meshes_.end()) return known->second;
    const GlbMaterial& look = isMet ? kMetRed : kInsideAmber;
    std::optional<std::size_t>& material = isMet ? met_ : inside_;
    if (!material) material = content_.addMaterial(look);
    const std::size_t mesh = content_.addMesh(look.name, {{markerMesh(length), *material}});
    meshes_.emplace(std::make_pair(isMet, length), mesh);
    return mesh;
  }

  const LoadedWorld& world_;
  Vector3d origin_;
  std::size_t group_;
  GlbContent& content_;
  std::map<std::pair<bool, double>, std::size_t> meshes_;
  std::optional<std::size_t> met_, inside_;
  std::vector<Appearance> appearances_;
};

}  // namespace

Result<std::vector<std::string>> writeWorldGlb(const LoadedWorld& loaded,
                                               const WorldTouches& touches,
                                               const std::string& header,
                                               const GlbRequest& request) {
  std::vector<std::string> notes;
  const std::vector<WorldTouch>& listed = touches.listed();
  const std::size_t numShown = std::min(listed.size(), kMostWorldTouches);
  if (numShown < listed.size()) {
    notes.push_back(fmt::format("{} touches are not shown: the first {} are",
                                listed.size() - numShown, numShown));
  }
  const std::vector<Vector3d> places = placesOf(loaded);
  Vector3d low = places.front(), high = low;
  for (const Vector3d& place : places) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  const Vector3d origin = originFor(low, high);
  GlbContent content(fmt::format("foretouch {}", FORETOUCH_VERSION));
  GltfDocument& document = content.document();
  GlbAnimation animation("world");
  TriangleBudget budget(request.mostTriangles);
  const std::size_t world = addWorld(origin, json::parse(header), document);
  BodyNodes bodies(loaded, origin, world, content, animation);
  FORETOUCH_CHECK(inFile(bodies.addAll(budget, notes), request.path));
  Markers markers(loaded, origin, addGroup(document, world, "contacts"), content);
  std::vector<TriangleId> touched;
  for (std::size_t i = 0; i < numShown; ++i) {
    markers.add(listed[i], touches.sidesOf(listed[i]));
    const ContactSide& b = listed[i].first.b;
    if (b.body == kStillScene) touched.push_back(b.triangle);
  }
  markers.finish(animation);
  if (loaded.scene) {
    addScene(*loaded.scene, places, std::move(touched), origin, addGroup(document, world, "scene"),
             content, budget, notes);
  }
  animation.finish(document);

  FORETOUCH_CHECK(content.writeFile(request.path));
  return notes;
}

}  // namespace foretouch::tools
