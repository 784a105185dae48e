// tools/report/view_document.h: what the page of a report shows, as plain values: the document of
// docs/formats.md, "View documents". Metres and seconds in the world W; texts are untrusted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "tools/reported_contact.h"

namespace foretouch::tools {

enum class ViewKind : std::uint8_t { Replay, Log, Inspection, Live };

/// A line of a table that people read.
struct ViewRow {
  std::string name, value, note;  ///< `note` may be empty.
};

/// Indexed triangles: x, y, z a vertex, three indices a triangle.
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
  Clipped,     ///< Triangles far from all action were left out.
  Simplified,  ///< Triangles were made that the scene does not have.
};

/// World = origin + position: floats suffice near the origin, however far out that is.
struct ViewScene {
  std::string name;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  ViewMesh mesh;                           ///< Grouped by object, in the scene's order within one.
  std::vector<std::uint32_t> triangleIds;  ///< Per triangle; empty where Simplified.
  std::vector<ViewObject> objects;
  std::size_t trianglesInFile = 0;
  SceneReduction reduction = SceneReduction::None;
  Eigen::Vector3d boundsMin = Eigen::Vector3d::Zero(),
                  boundsMax = Eigen::Vector3d::Zero();  ///< Of the whole scene.
};

struct ViewLinkMesh {
  LinkId link = 0;
  ViewMesh mesh;  ///< In the link's frame.
};

/// Poses of an avatar, and which of them are joined by a motion that was answered.
struct ViewTrack {
  std::vector<double> poseTimesS;  ///< Increasing.
  std::vector<double> rotations;   ///< w, x, y, z a link and pose, bit for bit those of the poses.
  std::vector<double> offsets;     ///< x, y, z a link: its translation where it never moves.
  std::vector<LinkId> moving;      ///< Links whose translation is not the same in every pose.
  std::vector<double> values;      ///< x, y, z of each of these and pose.
  std::vector<std::uint32_t> stepFrom, stepTo;  ///< Indices of poses.
  std::vector<double> latencyUs;                ///< One a step; empty where nothing was asked.
  /// What a check of pose i alone sees touching: touching[touchingFirst[i]] up to
  /// touching[touchingFirst[i + 1]]. Empty where nobody asked.
  std::vector<std::uint32_t> touchingFirst;
  std::vector<std::uint16_t> touching;

  [[nodiscard]] std::size_t poses() const { return poseTimesS.size(); }
};

/// A certified outer surface of what one link sweeps in one step.
struct ViewSwept {
  std::uint32_t step = 0;
  LinkId link = 0;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< World = origin + position, exactly.
  ViewMesh mesh;
  double error = 0.0;  ///< Largest distance from the swept volume.
};

struct ViewAvatar {
  std::int32_t id = 0;
  std::string name;
  const Avatar* avatar = nullptr;  ///< Links and LSS; outlives the document.
  std::vector<ViewLinkMesh> meshes;
  std::optional<ViewTrack> track;
  std::vector<ReportedContact> contacts;  ///< `step`: an index of the track's steps.
  std::vector<ViewSwept> swept;
};

struct ViewDocument {
  ViewKind kind = ViewKind::Replay;
  std::string title;
  std::vector<ViewRow> settings, summary;
  std::vector<std::string> notes;  ///< Sentences.
  std::optional<ViewScene> scene;  ///< Nothing where an avatar is looked at by itself.
  std::vector<ViewAvatar> avatars;
};

}  // namespace foretouch::tools
