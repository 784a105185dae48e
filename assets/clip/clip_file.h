// assets/clip/clip_file.h: clips from whatever file has one: BVH, AMC, MVNX, an animated model, a
// session of WebXR, or a table of a robot's joint positions. The file's extension decides
// (docs/formats.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "articulated/clip.h"
#include "articulated/result.h"
#include "assets/import/scene_import.h"
#include "assets/model/model.h"

namespace foretouch {

inline constexpr std::size_t kMaxJointTableBytes = std::size_t{256} << 20;

/// Model: also MVNX, whose segments are its nodes. WebXr: a session as iwer records it (.json).
enum class ClipFormat : std::uint8_t { Bvh, Model, JointTable, Acclaim, WebXr };

/// A table in numpy's format (.npz) counts as JointTable, but readClipFile() reads only CSV.
/// Every other file that is neither a table nor a model format with animations counts as BVH, whose
/// reader gives the best error.
[[nodiscard]] ClipFormat clipFormatOf(const std::string& path);

struct ClipFileOptions {
  /// scale and up in place of what the file says; placed() turns BVH clips, and robots stand on z.
  /// Limits and importer are those of models.
  SceneImportOptions import;
  std::string animation;                  ///< The one of a model to take; empty: its first.
  double rateHz = 30.0;                   ///< Sampling rate of a model's animation.
  std::string robot;                      ///< The URDF whose joints a table is about.
  std::string skeleton;                   ///< The ASF of an AMC; empty: the one beside it.
  std::vector<std::string> packagePaths;  ///< Folders of that URDF's packages.
  JointTableOptions table;  ///< What a table does not say itself; for AMC and WebXR only the rate.
};

struct ClipFile {
  Clip clip;
  /// True: already turned from Z-up. The reader of models turns their roots, so that a joint that
  /// the clip leaves at rest matches the avatar of the same model.
  bool isUpright = false;
  FileFrame frame;  ///< For BVH, which does not declare it: as asked.
};

/// Errors name the file. What the format does not need is ignored, but for a table's robot.
[[nodiscard]] Result<ClipFile> readClipFile(const std::string& path,
                                            const ClipFileOptions& options = {});

/// The robot that options.robot names, read as that of a table. Errors name the file.
[[nodiscard]] Result<Model> readRobotModel(const ClipFileOptions& options);

/// clipFromSampledJoints() for options.robot. Errors name the file.
[[nodiscard]] Result<Clip> sampleRobotFile(const ClipFileOptions& options, std::int32_t samples,
                                           std::uint64_t seed);

}  // namespace foretouch
