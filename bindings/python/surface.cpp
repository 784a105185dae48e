// bindings/python/surface.cpp: foretouch.Surface, which exact fidelity needs.
#include "bindings/python/surface.h"

#include "assets/mesh/link_mesh.h"
#include "bindings/python/arguments.h"
#include "bindings/python/bindings.h"
#include "bindings/python/importer_place.h"

namespace foretouch::python {
namespace {

using TrianglesPerLink = std::vector<std::vector<Triangle>>;

Surface built(std::shared_ptr<Avatar> avatar, TrianglesPerLink perLink, const std::string& what) {
  const py::gil_scoped_release free;
  auto surface = valueOf(AvatarSurface::build(*avatar, std::move(perLink)), what);
  return {std::move(avatar), std::move(surface)};
}

Surface loadSurface(std::shared_ptr<Avatar> avatar, const Shown<shown::Path>& avatarPath,
                    const Shown<shown::Path>& importer) {
  const std::string beside = path(avatarPath, "avatar_path");
  ModelImportOptions options;
  options.import.importer = importerPlace(importer);
  TrianglesPerLink perLink;
  {
    const py::gil_scoped_release free;
    perLink = valueOf(loadLinkMeshes(*avatar, beside, options), beside);
  }
  return built(std::move(avatar), std::move(perLink), beside);
}

Surface fromTriangles(std::shared_ptr<Avatar> avatar, const py::object& given) {
  TrianglesPerLink perLink;
  for (const py::object& link : items(given, "triangles")) {
    std::vector<Triangle>& triangles = perLink.emplace_back();
    if (link.is_none()) continue;
    const std::string what = "triangles[" + std::to_string(perLink.size() - 1) + "]";
    const Numbers corners = numbers(link, what, {kAny, 3, 3});
    for (py::ssize_t i = 0; i < corners.shape(0); ++i) {
      Triangle& triangle = triangles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        triangle.vertices[k] = Eigen::Vector3d(corners.data(i) + 3 * k);
      }
    }
  }
  return built(std::move(avatar), std::move(perLink), "Surface.from_triangles");
}

Numbers trianglesOf(const Surface& surface, const Shown<shown::Link>& link) {
  const std::vector<Triangle>& triangles =
      surface.triangles.triangles(linkOf(*surface.avatar, link, "link"));
  Numbers array(Shape{static_cast<py::ssize_t>(triangles.size()), 3, 3});
  double* value = array.mutable_data();
  for (const Triangle& triangle : triangles) {
    for (const Eigen::Vector3d& vertex : triangle.vertices) {
      for (int axis = 0; axis < 3; ++axis) *value++ = vertex[axis];
    }
  }
  return array;
}

}  // namespace

void bindSurface(py::module_& module) {
  py::class_<Surface>(module, "Surface",
                      "An avatar's own triangles, for fidelity 'exact'. Immutable.")
      .def_static("load", &loadSurface, py::arg("avatar").none(false), py::arg("avatar_path"),
                  py::kw_only(), py::arg("importer") = py::none(),
                  "The meshes that the avatar file at avatar_path refers to.")
      .def_static("from_triangles", &fromTriangles, py::arg("avatar").none(false),
                  py::arg("triangles"),
                  "triangles: one per link, (m, 3, 3) in the link's frame, or None. Each triangle\n"
                  "must lie in one of its link's LSS.")
      .def_property_readonly("avatar", [](const Surface& surface) { return surface.avatar; })
      .def_property_readonly(
          "num_triangles", [](const Surface& surface) { return surface.triangles.numTriangles(); })
      .def("triangles", &trianglesOf, py::arg("link"), "A copy, (m, 3, 3), in the link's frame.");
}

}  // namespace foretouch::python
