#include "assets/certificate/certificate_texts.h"

#include <cstddef>
#include <filesystem>
#include <system_error>

#include "articulated/try.h"
#include "assets/json_writer.h"
#include "assets/text_file.h"

namespace foretouch {

std::string sceneAsObj(const Scene& scene) {
  std::string vertices, faces;
  const auto count = static_cast<TriangleId>(scene.numTriangles());
  std::int64_t last = 0;
  for (TriangleId id = 0; id < count; ++id) {
    if (!isFinite(scene.triangle(id))) continue;
    faces += "f";
    for (const Eigen::Vector3d& vertex : scene.triangle(id).vertices) {
      vertices += "v";
      for (const double part : vertex) vertices += " " + numberText(part);
      vertices += "\n";
      faces += " " + std::to_string(++last);
    }
    faces += "\n";
  }
  return vertices + faces;
}

std::string stepText(std::int64_t number, const Pose& from, const Pose& to) {
  std::string text = "step " + std::to_string(number) + "\n";
  for (const Pose* const pose : {&from, &to}) {
    for (std::size_t joint = 0; joint < pose->rotations.size(); ++joint) {
      const auto& q = pose->rotations[joint];
      const Eigen::Vector3d& p = pose->translations[joint];
      text += numberText(p.x()) + " " + numberText(p.y()) + " " + numberText(p.z());
      for (const double part : {q.w(), q.x(), q.y(), q.z()}) text += " " + numberText(part);
      text += "\n";
    }
  }
  return text;
}

Result<Done> writeTexts(const std::string& folder, const std::vector<NamedText>& texts) {
  std::error_code unmade;
  std::filesystem::create_directories(folder, unmade);
  for (const auto& [name, text] : texts) {
    FORETOUCH_TRY(auto file, PendingFile::create(folder + "/" + name));
    file.write(text);
    FORETOUCH_CHECK(file.commit());
  }
  return Done{};
}

}  // namespace foretouch
