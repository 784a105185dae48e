// middleware/ask/ask.h: questions about a world: at an instant, what a ray hits, what a moved
// sphere or capsule hits first, what a shape overlaps, what is nearest, where each body is as its
// motion has it then, between poses too; through a time, what a shape that flies straight hits
// first while the bodies move: their true motion and its own. The proof: ask.md. Metres, in W;
// world time in microseconds.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "articulated/result.h"
#include "lss/lss.h"
#include "middleware/scene/raw_scene.h"
#include "middleware/scratch.h"
#include "middleware/world/world.h"
#include "middleware/world/world_contacts.h"

namespace foretouch {

enum class AskWhat : std::uint8_t {
  Cast,     ///< The shape moves along `direction`, up to `reach`: where does it first touch?
  Overlap,  ///< What does the shape touch where it is?
  Nearest,  ///< What is near the shape, up to `reach`?
};

enum class AskWhich : std::uint8_t {
  Closest,  ///< The first one along the way, or the nearest one.
  Any,      ///< Whether there is one: some hit, which may be another one in another build.
  All,      ///< Each LSS and each triangle that is touched or near, nearest first.
};

/// In a filter: every object.
inline constexpr ObjectId kEveryObject = -1;

/// A body, one of its links, or an object of it: of a mesh, or of the static scene (kStillScene).
struct AskPart {
  BodyId body = kStillScene;
  LinkId link = kEveryLink;
  ObjectId object = kEveryObject;
};

/// A body that is asked about at an instant of its own, with all that carries it.
struct AskInstant {
  BodyId body = 0;
  WorldTime time;
};

/// What a question is about: everything, unless it says less.
struct AskWhom {
  std::uint32_t groups = ~std::uint32_t{0};  ///< Bit g: bodies of group g are asked about.
  bool asksStill = true;                     ///< So is the static scene, if there is one.
  std::vector<AskPart> only;                 ///< Not empty: nothing but these.
  std::vector<AskPart> without;              ///< Not these.
};

/// One question. Fill it by ray(), cast(), overlap() or nearest(), and set what else matters.
struct WorldQuestion : AskWhom {
  AskWhat what = AskWhat::Cast;
  AskWhich which = AskWhich::Closest;
  /// Where it begins; solid. Both ends alike: a sphere. No radius either: a point, whose cast is a
  /// ray. Coordinates and radius within kMaxCoordinate.
  Lss shape;
  /// Not empty: corners, from shape.a, of the convex solid that takes the place of the axis; the
  /// radius is around it. boxCorners() makes those of a box. Up to kMostCorners.
  std::vector<Eigen::Vector3d> hull;
  /// Closed objects of meshes and of the scene are solid: what begins inside one touches it. An
  /// object that is not closed is unknown where its box holds the shape's place. Else surfaces
  /// count.
  bool solids = false;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< For a cast: any length but zero.
  /// How far a cast moves. For Nearest: nothing farther is reported. Up to kMostAskReach.
  double reach = 0.0;
  WorldTime time;
  /// These bodies at these instants, all others at `time`: what a player saw who sees others late.
  std::vector<AskInstant> instants;

  [[nodiscard]] static WorldQuestion ray(const Eigen::Vector3d& from,
                                         const Eigen::Vector3d& direction, double reach,
                                         const WorldTime& time);
  [[nodiscard]] static WorldQuestion cast(const Lss& shape, const Eigen::Vector3d& direction,
                                          double reach, const WorldTime& time);
  /// All that it overlaps.
  [[nodiscard]] static WorldQuestion overlap(const Lss& shape, const WorldTime& time);
  [[nodiscard]] static WorldQuestion nearest(const Lss& shape, double reach, const WorldTime& time);
  /// All that it is in: LSS, and closed objects.
  [[nodiscard]] static WorldQuestion inside(const Eigen::Vector3d& point, const WorldTime& time);
};

/// The corners of a box around a shape's place, for `WorldQuestion::hull`; `axes`: its own, in W.
[[nodiscard]] std::vector<Eigen::Vector3d> boxCorners(
    const Eigen::Vector3d& halfExtents,
    const Eigen::Quaterniond& axes = Eigen::Quaterniond::Identity());

/// The most corners of a hull. A search looks at each a few times per piece that it comes near.
inline constexpr std::size_t kMostCorners = 1024;

/// A reach is at most this (m): from one end of all places that a world may have to the other.
inline constexpr double kMostAskReach = 1e8;

/// At the distance of a hit, the shape is at most so far (m) from what it hits, where doubles
/// resolve it: near places of 1e6 m they do not. A shape that passes by nearer may get a hit.
/// Doubled, answers are earlier by as much; halved, casts that graze take one more step.
inline constexpr double kAskTolerance = 1e-9;

/// An LSS or a triangle that was hit or is near; or, without either, an object that is solid and
/// holds the shape's place.
struct WorldHit {
  /// What is hit; `p_W` is the point of its surface, or the shape's own if an LSS holds it whole.
  ContactSide what;
  ObjectId object = kEveryObject;  ///< The object of a mesh or of the scene.
  /// For a cast: along the way; the shape is free of this LSS or triangle before. Else how far the
  /// two are apart. Rounded down; 0 if they touch where the shape begins.
  double distance = 0.0;
  Eigen::Vector3d nhat_W = Eigen::Vector3d::Zero();  ///< Unit, to the shape; zero if unknown.
  /// For a triangle: p_W as a sum of its corners, in the order of Scene::triangle(), or of
  /// AvatarSurface::triangles().
  std::array<double, 3> weights{};
  bool isAssumed = false;  ///< As WorldContact::isAssumed.
};

/// Why a body is not known at the instant.
enum class AskUnknown : std::uint8_t {
  Assumed,     ///< Silent, and taken to hold still: hits of it are assumed.
  Silent,      ///< Nothing is known after its last pose; it was left out.
  NotThere,    ///< Before its first pose; it was left out.
  Unresolved,  ///< In a flight: more triangles, or steps, than are followed in motion.
  Open,        ///< An object of it, or of the static scene, has no inside: it is not closed.
};

struct UnknownBody {
  BodyId body = 0;  ///< Or kStillScene.
  AskUnknown why = AskUnknown::Silent;
  ObjectId object = kEveryObject;  ///< The open object, unless it is a link's surface.
};

enum class AskVerdict : std::uint8_t {
  Clear,    ///< Nothing is hit or near, proven.
  Hit,      ///< Something is. What is left out may be nearer.
  Unknown,  ///< Nothing that is known is; nothing is claimed of `unknown`.
};

struct WorldAnswer {
  std::vector<WorldHit> hits;  ///< By distance, then by body, link, LSS and triangle.
  /// Bodies that were asked about and are not known then, by number; and objects without an inside.
  std::vector<UnknownBody> unknown;

  [[nodiscard]] AskVerdict verdict() const;
  /// All that was asked about is known: a hit is the first of all, and no hit is none.
  [[nodiscard]] bool isComplete() const;
};

/// Replaces `answer`. Never missed, never late: what the shape hits, where everything truly is at
/// the instant, has a hit, no farther than it is; tight to kAskTolerance (ask.md). The same for the
/// same world and question. Surfaces count: a shape inside a mesh that touches no triangle of it
/// does not overlap it. Questions at the instant of the last one, in a world that did not change,
/// are cheapest. Allocates nothing once scratch and answer have grown. Errors, which name what is
/// wrong: a shape, direction or reach that is not finite, out of range, or without length; unknown
/// bodies or links; an instant that was forgotten.
Result<Done> askWorld(const World& world, const WorldQuestion& question, Scratch& scratch,
                      WorldAnswer& answer);

/// Many in one call: answers[i] is that of questions[i], to the bit, but for AskWhich::Any, in what
/// order they come; those at the same instants follow each other. Errors: as of one, with its place
/// as Error::index; then no answer counts.
Result<Done> askWorld(const World& world, const std::vector<WorldQuestion>& questions,
                      Scratch& scratch, std::vector<WorldAnswer>& answers);

/// A sphere, capsule or convex solid on its way, at constant speed and without a turn; filters as
/// in a question.
struct FlightQuestion : AskWhom {
  Lss shape;                                      ///< Where it is at `fromUs`.
  std::vector<Eigen::Vector3d> hull;              ///< As in a question.
  Eigen::Vector3d way = Eigen::Vector3d::Zero();  ///< To where it is at `toUs`. Zero: it waits.
  std::int64_t fromUs = 0, toUs = 0;
};

/// The first hit of all.
struct FlightHit {
  WorldHit hit;    ///< `distance`: along the way; places at that time.
  WorldTime time;  ///< Rounded down: nothing is hit before.
};

struct FlightAnswer {
  std::optional<FlightHit> first;
  /// Bodies that were asked about and are not known all through; of a Silent body, what is known of
  /// it was asked.
  std::vector<UnknownBody> unknown;

  [[nodiscard]] AskVerdict verdict() const;
};

/// Replaces `answer`. Never missed and never late, in time as in place; at the hit's time the two
/// are at most kAskTolerance apart, where doubles resolve it. Errors: as askWorld(); a time without
/// length.
Result<Done> askFlight(const World& world, const FlightQuestion& question, Scratch& scratch,
                       FlightAnswer& answer);

}  // namespace foretouch
