#include "tests/cross/cases.h"

#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace foretouch::test {
namespace {

std::ifstream opened(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be read");
  return file;
}

/// Of a corner such as 7 or 7/1/3.
std::uint32_t vertexOf(const std::string& corner, std::size_t numVertices,
                       const std::string& path) {
  const unsigned long vertex = std::strtoul(corner.c_str(), nullptr, 10);
  if (vertex < 1 || vertex > numVertices) {
    throw std::runtime_error(path + ": expected a vertex of the " + std::to_string(numVertices) +
                             " before it, found '" + corner + "'");
  }
  return static_cast<std::uint32_t>(vertex - 1);
}

}  // namespace

std::string formatCase(const CrossCase& asked) {
  std::ostringstream line;
  line << asked.scene << '\t' << asked.avatar << '\t' << asked.clip << '\t' << asked.stride
       << std::setprecision(17) << '\t' << asked.scale << '\t' << asked.yawDeg;
  for (const double x : asked.origin) line << '\t' << x;
  return line.str();
}

std::vector<CrossCase> readCases(const std::string& path) {
  std::ifstream file = opened(path);
  std::vector<CrossCase> cases;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    CrossCase asked;
    std::getline(words, asked.scene, '\t');
    std::getline(words, asked.avatar, '\t');
    std::getline(words, asked.clip, '\t');
    words >> asked.stride >> asked.scale >> asked.yawDeg;
    for (double& x : asked.origin) words >> x;
    if (!words || asked.stride < 1) {
      throw std::runtime_error(path + ":" + std::to_string(cases.size() + 1) +
                               ": expected nine words parted by tabs, found '" + line + "'");
    }
    cases.push_back(asked);
  }
  if (cases.empty()) throw std::runtime_error(path + ": expected a case, found none");
  return cases;
}

ObjScene readObj(const std::string& path) {
  std::ifstream file = opened(path);
  ObjScene scene;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      for (int axis = 0; axis < 3; ++axis) {
        words >> word;
        scene.positions.push_back(std::strtod(word.c_str(), nullptr));
      }
    } else if (word == "f") {
      std::vector<std::uint32_t> corners;
      while (words >> word) {
        corners.push_back(vertexOf(word, scene.positions.size() / 3, path));
      }
      for (std::size_t i = 2; i < corners.size(); ++i) {
        scene.indices.insert(scene.indices.end(), {corners[0], corners[i - 1], corners[i]});
      }
    }
  }
  return scene;
}

}  // namespace foretouch::test
