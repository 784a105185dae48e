// tools/setup/body_source.h: the body of a setup: the avatar that stands in the scene, and the
// poses that its clip gives it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "articulated/clip.h"
#include "articulated/result.h"
#include "assets/file_frame.h"
#include "assets/model/model_avatar.h"
#include "tools/settings/clip_settings.h"
#include "tools/setup/walker.h"

namespace foretouch::tools {

/// Which files make the body: a clip, a robot's table, or a model that holds a clip; and an avatar
/// file, or a model. Either may be empty, but not both: without an avatar, the body is the motion's
/// own, or the robot. Its scale and axis are those of both.
using BodyRequest = ClipRequest;

/// A body, read with a unit and an axis.
struct BodySource {
  std::optional<Avatar> avatar;
  std::optional<ModelAvatar> ofModel;  ///< If a model's triangles make the avatar.
  std::optional<Clip> clip;            ///< Nothing: it stands at rest.
  bool isUpright = false;              ///< The clip needs no turn.
  FileFrame frame;
  std::vector<std::string> notes;

  /// The clip, or the avatar's rest pose as a clip of one frame.
  [[nodiscard]] Clip clipOrRest() const;
};

/// Errors name the file. `meshFile`: for an avatar that is made of a model.
[[nodiscard]] Result<BodySource> readBody(const BodyRequest& request, const std::string& meshFile);

/// The file that the body comes from.
[[nodiscard]] std::string bodyFileOf(const BodyRequest& request);

/// Whether the avatar must be written, because none of the files is one.
[[nodiscard]] bool makesAvatar(const BodyRequest& request);

/// Its poses as walkingBody() has them, for the part of the clip that the request cuts out. A note
/// says what became of a T-pose.
[[nodiscard]] Result<WalkingBody> walkingBody(BodySource& source, const BodyRequest& request);

}  // namespace foretouch::tools
