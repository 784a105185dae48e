// bindings/python/surface.cpp: foretouch.Surface, which exact fidelity needs.
#include "bindings/python/surface.h"

#include "assets/mesh/link_mesh.h"
#include "bindings/python/arguments.h"
#include "bindings/python/bindings.h"
#include "bindings/python/importer_place.h"
#include "bindings/skin_triangles.h"

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

/// Shares of no weight count for nothing.
SkinOfAvatar skinFromArrays(std::shared_ptr<Avatar> avatar, const py::object& triangles,
                            const py::object& triangleLinks, const py::object& links,
                            const py::object& weights, const py::object& points) {
  const Integers corners = integers(triangles, "triangles", {kAny, 3});
  const Integers owners = integers(triangleLinks, "triangle_links", {corners.shape(0)});
  const Integers movers = integers(links, "links", {kAny, kAny});
  const py::ssize_t vertices = movers.shape(0), most = movers.shape(1);
  const Numbers shares = numbers(weights, "weights", {vertices, most});
  const Numbers places = numbers(points, "points", {vertices, most, 3});
  Skin skin;
  skin.vertices.resize(static_cast<std::size_t>(vertices));
  for (py::ssize_t v = 0; v < vertices; ++v) {
    std::vector<SkinInfluence>& vertex = skin.vertices[static_cast<std::size_t>(v)];
    for (py::ssize_t i = 0; i < most; ++i) {
      if (*shares.data(v, i) == 0.0) continue;
      vertex.push_back({static_cast<LinkId>(*movers.data(v, i)), *shares.data(v, i),
                        Eigen::Vector3d(places.data(v, i, 0))});
    }
  }
  std::vector<LinkTriangle> all;
  for (py::ssize_t i = 0; i < corners.shape(0); ++i) {
    all.push_back({*owners.data(i), {}});
    for (std::size_t k = 0; k < 3; ++k) {
      all.back().vertices[k] =
          static_cast<std::int32_t>(*corners.data(i, static_cast<py::ssize_t>(k)));
    }
  }
  std::vector<std::size_t> ofLink(countOf(avatar->numLinks()));
  if (const auto bad = addTriangles(all, ofLink, skin)) {
    refuse(ErrorCode::OutOfRange, "triangle_links",
           "expected links of the avatar, found " + std::to_string(all[*bad].link));
  }
  const py::gil_scoped_release free;
  auto made = valueOf(SkinnedSurface::build(*avatar, std::move(skin), ofLink), "Skin.from_arrays");
  return {std::move(avatar), std::move(made)};
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
  py::class_<SkinOfAvatar>(module, "Skin",
                           "Triangles that bend with several links of an avatar. Immutable.")
      .def_static("from_arrays", &skinFromArrays, py::arg("avatar").none(false),
                  py::arg("triangles"), py::arg("triangle_links"), py::arg("links"),
                  py::arg("weights"), py::arg("points"),
                  "triangles: (m, 3) vertices; triangle_links: whose hit each is, (m,). Of n\n"
                  "vertices, up to k links each: links and weights (n, k), weights of 0 count for\n"
                  "nothing; points (n, k, 3): the vertex in the link's frame, where it was bound.")
      .def_property_readonly("avatar", [](const SkinOfAvatar& skin) { return skin.avatar; })
      .def_property_readonly("num_triangles",
                             [](const SkinOfAvatar& skin) { return skin.skin.numTriangles(); });
}

}  // namespace foretouch::python
