// tools/report/view_document.h: the content of a report's page, as plain values: the document of
// docs/formats.md, "View documents". Metres and seconds in the world W; texts are untrusted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "tools/person/bracket_joiner.h"
#include "tools/reported_contact.h"
#include "tools/setup/check_list.h"
#include "tools/touches/touch.h"
#include "tools/touches/touch_strength.h"

namespace foretouch::tools {

enum class ViewKind : std::uint8_t { Replay, World, Log, Inspection, Live };

/// A row of a table for people.
struct ViewRow {
  std::string name, value, note;  ///< `note` may be empty.
};

/// Indexed triangles: x, y, z per vertex, three indices per triangle.
struct ViewMesh {
  std::vector<float> positions;
  std::vector<std::uint32_t> indices;

  [[nodiscard]] std::size_t triangles() const { return indices.size() / 3; }
  [[nodiscard]] std::size_t vertices() const { return positions.size() / 3; }
};

struct ViewObject {
  std::string name;
  std::uint32_t first = 0, count = 0;  ///< Its triangles in the scene's mesh.
};

enum class SceneReduction : std::uint8_t {
  None,
  Clipped,     ///< Omits triangles far from all action.
  Simplified,  ///< Has triangles that the scene does not have.
};

/// World = origin + position: floats suffice near the origin, however far out it is.
struct ViewScene {
  std::string name;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  ViewMesh mesh;                           ///< Grouped by object, in the scene's order within one.
  std::vector<std::uint32_t> triangleIds;  ///< Per triangle; empty if Simplified.
  std::vector<ViewObject> objects;
  std::size_t trianglesInFile = 0;
  SceneReduction reduction = SceneReduction::None;
  Eigen::Vector3d boundsMin = Eigen::Vector3d::Zero(),
                  boundsMax = Eigen::Vector3d::Zero();  ///< The bounds of the whole scene.
};

struct ViewLinkMesh {
  LinkId link = 0;
  ViewMesh mesh;  ///< In the link's frame.
};

/// Poses of an avatar, and which pairs of them have an answered motion.
struct ViewTrack {
  std::vector<double> poseTimesS;  ///< Increasing.
  std::vector<double> rotations;   ///< w, x, y, z per link and pose, bit for bit those of the
                                   ///< poses.
  std::vector<double> offsets;     ///< x, y, z per link: its translation if it never moves.
  std::vector<LinkId> moving;      ///< Links whose translation changes.
  std::vector<double> values;      ///< x, y, z per moving link and pose.
  std::vector<std::uint32_t> stepFrom, stepTo;  ///< Indices of poses.
  std::vector<double> latencyUs;                ///< One per step; empty if nothing was asked.
  /// Links that touch in a check of pose i alone: touching[touchingFirst[i]] up to
  /// touching[touchingFirst[i + 1]]. Empty if not checked.
  std::vector<std::uint32_t> touchingFirst;
  std::vector<std::uint16_t> touching;

  [[nodiscard]] std::size_t poses() const { return poseTimesS.size(); }
};

/// A certified outer surface of one link's sweep in one step.
struct ViewSwept {
  std::uint32_t step = 0;
  LinkId link = 0;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< World = origin + position, exactly.
  ViewMesh mesh;
  double error = 0.0;  ///< Largest distance from the swept volume.
};

/// What a solid avatar does, one entry per tick.
struct ViewSolid {
  std::vector<double> timesS;         ///< Increasing.
  std::vector<std::uint16_t> states;  ///< SolidState.
  std::vector<double> deviations;     ///< The largest of all links (m).
};

/// The push of a solid avatar's contact.
struct ViewPush {
  double push = 0.0;       ///< Metres.
  double slipSpeed = 0.0;  ///< Metres per second.
};

/// A body that another one carries: its poses are then in the frame of a link of that one.
struct ViewCarried {
  double fromS = 0.0;
  std::optional<double> untilS;  ///< Nothing: to the end.
  std::size_t avatar = 0;        ///< The carrier among the document's.
  LinkId link = 0;
};

struct ViewAvatar {
  std::int32_t id = 0;
  std::string name;
  const Avatar* avatar = nullptr;  ///< Links and LSS; outlives the document.
  bool hasLss = true;              ///< False: only its meshes are shown.
  std::vector<ViewLinkMesh> meshes;
  std::optional<ViewTrack> track;
  std::vector<ReportedContact> contacts;  ///< `step`: an index of the track's steps.
  bool knowsMissed = true;  ///< Whether what a check of the poses misses was looked for.
  /// What was tracked, for a solid avatar, whose `track` is what is shown.
  std::optional<ViewTrack> tracked;
  std::optional<ViewSolid> solid;
  std::vector<ViewPush> pushes;  ///< A solid avatar's: one per contact.
  bool isLiveSolid = false;      ///< For kind Live: events will say what is shown.
  std::vector<ViewSwept> swept;
  std::vector<ViewCarried> carried;  ///< By time.
  /// For a trigger, which nothing touches: two points per line, in the body's frame; else empty.
  std::vector<float> outline;
};

struct ViewTouch {
  std::size_t avatar = 0;
  Touch touch;                      ///< On the document's clock, in the track's steps.
  std::vector<std::uint32_t> rows;  ///< Its contacts among the avatar's, in their order.
  std::optional<std::size_t> otherAvatar = std::nullopt;  ///< Owner of `touch.other`, if another.
  std::optional<TouchStrength> strength = std::nullopt;   ///< At its begin, if it is known.
  /// Nothing is claimed about the two in this time: it is not a touch, and has no contacts.
  UndecidedReason unresolved = UndecidedReason::None;
};

/// An avatar in a trigger, or one about which nothing is known there.
struct ViewStay {
  std::size_t trigger = 0, avatar = 0;  ///< Indices of the document's avatars.
  LinkId link = 0;                      ///< The link whose entering it begins with.
  double beginS = 0.0, endS = 0.0;
  bool beginsInside = false, isOpen = false;  ///< As a touch's.
  bool isUnresolved = false;
};

/// What a foot does from when to when: a touch of the whole foot, or that it hovers.
struct ViewStance {
  std::string kind;  ///< One of StanceKind's words.
  double beginS = 0.0, endS = 0.0;
  bool beganBefore = false, goesOn = false;  ///< The clip begins, or ends, in it.
  double slide = 0.0, depth = 0.0, depthAtS = 0.0, hover = 0.0;
  std::string slides, deepest;           ///< The part that does so most: "heel".
  std::vector<Eigen::Vector3d> trace_W;  ///< The trace of its slide, if it has one.
};

struct ViewFoot {
  LinkId link = 0;  ///< The ankle, of the only avatar.
  std::vector<ViewStance> stances;
};

/// What a link of a person surely touched, or may have touched.
struct ViewPersonTouch {
  PersonTouch touch;
  std::string object;      ///< In the scene, or another body; empty: not known.
  std::size_t avatar = 0;  ///< The owner of the link; `touch.other` is an own one.
};

/// The only avatar's person, or all persons of a world.
struct ViewPerson {
  std::string bounds, between;
  double rateHz = 0.0;                   ///< 0: each has its own.
  std::vector<ViewPersonTouch> touches;  ///< In the order of their begins.
};

struct ViewDocument {
  ViewKind kind = ViewKind::Replay;
  std::string title;
  std::vector<ViewRow> settings, summary;
  std::vector<std::string> notes;      ///< Sentences.
  std::vector<PlacementCheck> checks;  ///< An inspection's.
  std::optional<ViewScene> scene;      ///< Nothing if the document shows only an avatar.
  std::vector<ViewAvatar> avatars;
  std::optional<std::vector<ViewTouch>> touches;  ///< For what was asked, in listed order.
  std::vector<ViewStay> stays;                    ///< By begin.
  double frameTimeS = 0.0;     ///< Of the clip's frames, the first at 0 s; 0: no frames are known.
  std::vector<ViewFoot> feet;  ///< A replay's.
  std::optional<ViewPerson> person;  ///< A replay's, with bounds.
};

}  // namespace foretouch::tools
