// tests/assets/bvh_samples.h: small BVH texts for tests to modify.
#pragma once

#include <string>

namespace foretouch::test {

/// Replaces the only occurrence of `from`. A test whose edit no longer applies must fail.
inline std::string edited(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == text.npos || text.find(from, at + 1) != text.npos)
    return "edit does not apply: " + from;
  return text.replace(at, from.size(), to);
}

/// The same everywhere.
inline std::string editedAll(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// Two joints and an End Site, two frames; nothing odd about it.
inline std::string plainBvh() {
  return "HIERARCHY\n"
         "ROOT Hips\n"
         "{\n"
         "  OFFSET 0 1 0\n"
         "  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
         "  JOINT Spine\n"
         "  {\n"
         "    OFFSET 0 2 0.5\n"
         "    CHANNELS 3 Zrotation Xrotation Yrotation\n"
         "    End Site\n"
         "    {\n"
         "      OFFSET 0 3 0\n"
         "    }\n"
         "  }\n"
         "}\n"
         "MOTION\n"
         "Frames: 2\n"
         "Frame Time: 0.025\n"
         "1 2 3 10 20 30 40 50 60\n"
         "4 5 6 -10 -20 -30 -40 -50 -60\n";
}

}  // namespace foretouch::test
