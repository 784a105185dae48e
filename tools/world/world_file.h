// tools/world/world_file.h: a world as a file says it, format "foretouch-world" version 1
// (docs/formats.md, "World files"): TOML, with nothing loaded yet. Paths are ready to open.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "articulated/motion_model.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "articulated/track.h"
#include "middleware/query_options.h"
#include "tools/settings/clip_settings.h"
#include "tools/settings/world_settings.h"
#include "tools/world/file_shape.h"

namespace foretouch::tools {

/// The most bodies and triggers of a file, and poses, changes of carriers and LSS of a body.
inline constexpr std::size_t kMaxFileBodies = 4096;
inline constexpr std::size_t kMaxFileTriggers = 256;
inline constexpr std::size_t kMaxFilePoses = 65536;
inline constexpr std::size_t kMaxFileChanges = 65536;

struct FilePose {
  std::int64_t utimeUs = 0;
  RigidPose pose;
  std::int64_t line = -1;
};

/// A body is carried from an instant on, or no longer.
struct FileChange {
  std::int64_t utimeUs = 0;
  bool isAttached = false;
  std::string carrier, link;      ///< Names; an empty link: the carrier's only one.
  bool movesInFrame = false;      ///< Carrier::movesInFrame.
  std::optional<RigidPose> pose;  ///< Nothing: where it is at that instant.
  std::int64_t line = -1;
};

/// When the frames of a body's clip are: the frame at `fromUs` of the clip is at `startUs` of the
/// world.
struct ClipTiming {
  std::int64_t startUs = 0, fromUs = 0;
  std::optional<std::int64_t> untilUs;  ///< An instant of the clip.
  double speed = 1.0;                   ///< 2: twice as fast as recorded.
};

/// What a trigger looks at.
struct FileWatch {
  std::string body, link;  ///< Names; an empty link: all of them.
  std::int64_t line = -1;
};
struct FileTrigger {
  bool byLink = false;             ///< TriggerOptions::byLink.
  std::vector<FileWatch> watched;  ///< Empty: all bodies.
};

struct FileBody {
  std::string name;
  std::int64_t line = -1;
  FileShape shape;
  std::string group;             ///< Empty: the group of all bodies that name none.
  std::optional<double> massKg;  ///< Kept for later use.
  WhenSilent whenSilent = WhenSilent::Wait;
  Fidelity fidelity = Fidelity::Link;  ///< For an avatar: Exact: by its meshes.
  bool asksSelf = false;
  std::string pairsPath;  ///< Empty: derived.

  // How far it may be from what its poses say (docs/person.md). Neither: nothing is claimed.
  std::string boundsPath;
  bool isExact = false;                             ///< It does what its poses say.
  MotionModel between = MotionModel::ConstantRate;  ///< The one that the bounds are about.

  // How it moves: a clip, or poses, or none of them: it stands.
  ClipRequest clip;   ///< An empty motion: no clip.
  ClipTiming timing;  ///< The clip's.
  std::string joint;  ///< A prop's motion is this joint's in the clip; empty: the only root's.
  std::int64_t clipLine = -1;
  std::string posesPath;
  std::vector<FilePose> poses;
  std::optional<RigidPose> place;  ///< Where it stands.

  std::vector<FileChange> changes;  ///< By time; those of one instant as the file has them.

  std::optional<FileTrigger> trigger;  ///< It is a volume that reports what is in it.

  /// "[[body]]" or "[[trigger]]", and for a table in it "[[trigger.pose]]": for errors.
  [[nodiscard]] std::string title(const std::string& inner = "") const;
};

/// Bodies of two groups are not asked, or are asked again; an empty `with`: the scene.
struct FileAsk {
  std::string group, with;
  bool isAsked = false;
  std::int64_t line = -1;
};

struct WorldFile {
  std::string path;
  WorldRequest scene;  ///< The scene's file and how to read it; no path: there is none.
  double tolerance = kDefaultTolerance;
  bool askMeshes = false;        ///< WorldOptions::askMeshes.
  std::vector<FileBody> bodies;  ///< Triggers behind all others.
  std::vector<FileAsk> asks;

  [[nodiscard]] bool hasTriggers() const {
    return !bodies.empty() && bodies.back().trigger.has_value();
  }
};

/// The error of a world with its bodies' names in place of their numbers.
[[nodiscard]] Error named(Error error, const WorldFile& file);

/// --tolerance, and [query] tolerance of a file.
Setting& addWorldTolerance(Settings& settings, double& tolerance);

/// Refuses what breaks the format's rules; errors name the line. `file`: the path of `text`, to
/// which its paths are relative. Never throws.
[[nodiscard]] Result<WorldFile> parseWorldFile(std::string_view text, const std::string& file);
[[nodiscard]] Result<WorldFile> readWorldFile(const std::string& path);

}  // namespace foretouch::tools
