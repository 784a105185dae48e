// assets/certificate/certificate_texts.h: the files that say what a certificate is about
// (docs/certificates.md). Not installed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "middleware/scene/scene.h"

namespace foretouch {

/// The scene as an OBJ of triangles, with all digits; those that are not finite are left out.
[[nodiscard]] std::string sceneAsObj(const Scene& scene);
/// A step's two poses as foretouch-steps has them.
[[nodiscard]] std::string stepText(std::int64_t number, const Pose& from, const Pose& to);

struct NamedText {
  const char* name;
  const std::string& text;
};
/// Writes each text as a file of this folder, which it makes. Never half a file.
[[nodiscard]] Result<Done> writeTexts(const std::string& folder,
                                      const std::vector<NamedText>& texts);

}  // namespace foretouch
