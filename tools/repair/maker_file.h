// tools/repair/maker_file.h: a clip's file as its maker wrote it: what can be changed in it, and
// the same file with changes, every other byte as it was.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "articulated/clip.h"
#include "articulated/result.h"
#include "tools/repair/knobs.h"
#include "tools/settings/clip_settings.h"

namespace foretouch::tools {

class MakerFile {
 public:
  virtual ~MakerFile() = default;
  /// Reads the request's motion again, which `clip` is. Errors name the file: a model (its
  /// animation is not a table of poses); a table whose rows were cut (Clip::framesPerRow).
  [[nodiscard]] static Result<std::unique_ptr<MakerFile>> open(const ClipRequest& request,
                                                               const Clip& clip);

  /// The knobs by joint, the root's first.
  [[nodiscard]] const std::vector<Knob>& knobs() const { return knobs_; }
  /// The file with the changes: a column per frame of the clip. Errors: those of its format.
  [[nodiscard]] virtual Result<std::string> with(const Changes& changes) const = 0;
  /// Such a file, read as the product reads it.
  [[nodiscard]] virtual Result<Clip> reread(const std::string& bytes) const = 0;

 protected:
  std::vector<Knob> knobs_;
};

/// Opens a table of joint positions: tools/repair/table_file.cpp.
[[nodiscard]] Result<std::unique_ptr<MakerFile>> openTable(const ClipRequest& request);

}  // namespace foretouch::tools
