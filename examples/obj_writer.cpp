// examples/obj_writer.cpp: see the header.
#include "examples/obj_writer.h"

#include <cmath>
#include <iterator>

#include <fmt/format.h>

namespace foretouch::examples {
namespace {

/// The value, rounded before it is printed, so that no "-0.00000" depends on how a zero arose.
double printable(double metres) {
  return std::round(metres * 1e5) / 1e5 + 0.0;
}

}  // namespace

std::string objText(const std::vector<MeshObject>& objects) {
  std::string text = "# Foretouch example: a furnished room. Metres, +Y up.\n";
  const auto out = std::back_inserter(text);
  std::size_t before = 1;  // OBJ counts vertices from 1, through all objects
  for (const MeshObject& object : objects) {
    fmt::format_to(out, "o {}\n", object.name);
    for (const Eigen::Vector3d& p : object.vertices) {
      fmt::format_to(out, "v {:.5f} {:.5f} {:.5f}\n", printable(p.x()), printable(p.y()),
                     printable(p.z()));
    }
    for (const auto& [a, b, c] : object.triangles) {
      fmt::format_to(out, "f {} {} {}\n", before + a, before + b, before + c);
    }
    before += object.vertices.size();
  }
  return text;
}

}  // namespace foretouch::examples
