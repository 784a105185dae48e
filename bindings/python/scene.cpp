// bindings/python/scene.cpp: foretouch.Scene.
#include "middleware/scene/scene.h"

#include <limits>
#include <memory>
#include <pybind11/stl.h>

#include "assets/import/scene_import.h"
#include "bindings/python/arguments.h"
#include "bindings/python/bindings.h"
#include "bindings/python/importer_place.h"
#include "bindings/python/poses.h"

namespace foretouch::python {
namespace {

using Eigen::Vector3d;
using SharedScene = std::shared_ptr<Scene>;

SharedScene built(RawScene raw, const std::string& what) {
  const py::gil_scoped_release free;
  return std::make_shared<Scene>(valueOf(Scene::build(std::move(raw)), what));
}

std::vector<Triangle> gathered(const Numbers& vertices, const Integers& corners) {
  const auto* const points = vertices.data();
  const py::ssize_t count = vertices.shape(0);
  std::vector<Triangle> triangles(static_cast<std::size_t>(corners.shape(0)));
  for (py::ssize_t i = 0; i < corners.shape(0); ++i) {
    for (py::ssize_t k = 0; k < 3; ++k) {
      const std::int64_t vertex = corners.at(i, k);
      if (vertex < 0 || vertex >= count) {
        refuse(ErrorCode::OutOfRange,
               "triangles[" + std::to_string(i) + ", " + std::to_string(k) + "]",
               "expected a vertex from 0 to " + std::to_string(count - 1) + ", found " +
                   std::to_string(vertex),
               i);
      }
      triangles[std::size_t(i)].vertices[std::size_t(k)] = Vector3d(points + 3 * vertex);
    }
  }
  return triangles;
}

/// One object for all triangles, or one index each. Numbers objects without names, at most as many
/// as there are triangles.
void nameObjects(RawScene& raw, const Shown<shown::Array>& objectOf,
                 const Shown<shown::Texts>& objectNames) {
  if (!objectNames.is_none()) raw.objectNames = texts(objectNames, "object_names");
  raw.objectOf.assign(raw.triangles.size(), 0);
  const auto count = static_cast<py::ssize_t>(raw.triangles.size());
  const py::ssize_t objects =
      objectNames.is_none() ? count : static_cast<py::ssize_t>(raw.objectNames.size());
  ObjectId most = 0;
  if (!objectOf.is_none()) {
    const Integers given = integers(objectOf, "object_of", {count});
    for (py::ssize_t i = 0; i < count; ++i) {
      const std::int64_t object = given.at(i);
      if (object < 0 || object >= objects) {
        refuse(ErrorCode::OutOfRange, "object_of[" + std::to_string(i) + "]",
               "expected an object from 0 to " + std::to_string(objects - 1) + ", found " +
                   std::to_string(object),
               i);
      }
      raw.objectOf[std::size_t(i)] = static_cast<ObjectId>(object);
      most = std::max(most, static_cast<ObjectId>(object));
    }
  }
  if (!objectNames.is_none()) return;
  for (ObjectId object = 0; object <= most; ++object) {
    raw.objectNames.push_back("object_" + std::to_string(object));
  }
}

SharedScene fromArrays(const Shown<shown::Array>& vertices, const Shown<shown::Array>& triangles,
                       const Shown<shown::Array>& objectOf,
                       const Shown<shown::Texts>& objectNames) {
  const Numbers points = numbers(vertices, "vertices", {kAny, 3});
  RawScene raw;
  raw.triangles = gathered(points, integers(triangles, "triangles", {kAny, 3}));
  nameObjects(raw, objectOf, objectNames);
  return built(std::move(raw), "Scene.from_arrays");
}

SharedScene loadScene(const Shown<shown::Path>& file, const Shown<shown::Number>& scale,
                      const Shown<shown::Text>& up, const Shown<shown::Path>& importer,
                      const Shown<shown::Number>& timeLimitS,
                      const Shown<shown::Integer>& memoryLimitBytes) {
  const std::string from = path(file, "path");
  SceneImportOptions options;
  if (!scale.is_none()) options.scale = number(scale, "scale");
  if (!up.is_none()) options.up = upAxis(up);
  options.importer = importerPlace(importer);
  options.timeLimitS = number(timeLimitS, "time_limit_s");
  options.memoryLimitBytes = static_cast<std::size_t>(
      integer(memoryLimitBytes, "memory_limit_bytes", 0, std::numeric_limits<std::int64_t>::max()));
  const py::gil_scoped_release free;
  return std::make_shared<Scene>(valueOf(readScene(from, options), from).scene);
}

Numbers triangleArray(const Scene& scene) {
  const std::size_t count = scene.numTriangles();
  Numbers array(Shape{static_cast<py::ssize_t>(count), 3, 3});
  double* value = array.mutable_data();
  for (std::size_t i = 0; i < count; ++i) {
    for (const Vector3d& vertex : scene.triangle(static_cast<TriangleId>(i)).vertices) {
      for (int axis = 0; axis < 3; ++axis) *value++ = vertex[axis];
    }
  }
  return array;
}

py::array_t<ObjectId> objectArray(const Scene& scene) {
  py::array_t<ObjectId> array(static_cast<py::ssize_t>(scene.numTriangles()));
  for (std::size_t i = 0; i < scene.numTriangles(); ++i) {
    array.mutable_at(i) = scene.object(static_cast<TriangleId>(i));
  }
  return array;
}

py::list nameList(const Scene& scene) {
  py::list names;
  for (const std::string& name : scene.objectNames()) names.append(readable(name));
  return names;
}

Numbers arrayOf(const Vector3d& point) {
  return Numbers(3, point.data());
}

py::object auditOf(const Scene& scene) {
  const SceneAudit& audit = scene.audit();
  return pythonType("SceneAudit")(audit.triangles, audit.droppedNonFinite, audit.zeroArea,
                                  audit.duplicates, arrayOf(audit.boxMin), arrayOf(audit.boxMax),
                                  audit.shortestEdge, audit.longestEdge);
}

std::string representScene(const Scene& scene) {
  return "<foretouch.Scene of " + std::to_string(scene.numTriangles()) + " triangles, " +
         std::to_string(scene.objectNames().size()) + " objects>";
}

}  // namespace

void bindScene(py::module_& module) {
  const SceneImportOptions usual;
  py::class_<Scene, SharedScene>(
      module, "Scene",
      "Static triangles, ready for queries. Immutable; any number of threads may use one.\n"
      "Metres, +Y up. A triangle's id is its place in the arrays or in the file.")
      .def_static(
          "from_arrays", &fromArrays, py::arg("vertices"), py::arg("triangles"),
          py::arg("object_of") = py::none(), py::arg("object_names") = py::none(),
          "vertices (n, 3) in metres; triangles (m, 3) indices of vertices; object_of (m,)\n"
          "indices of object_names. Without object_of all triangles are one object.")
      .def_static(
          "load", &loadScene, py::arg("path"), py::arg("scale") = py::none(),
          py::arg("up") = py::none(), py::kw_only(), py::arg("importer") = py::none(),
          py::arg("time_limit_s") = usual.timeLimitS,
          py::arg("memory_limit_bytes") = usual.memoryLimitBytes,
          "OBJ, PLY, STL, glTF, FBX, Collada, 3DS, OFF, X or IQM, in a caged child process (the\n"
          "program foretouch-import; docs/python.md says where it is looked for). scale: metres "
          "per\n"
          "unit of the file; up: 'y' or 'z'; both in place of what the file says itself. Or a\n"
          "scene that `foretouch scene bake` wrote: in milliseconds, without that process.")
      .def_property_readonly("num_triangles", &Scene::numTriangles)
      .def_property_readonly("triangles", &triangleArray,
                             "A copy, (m, 3, 3): each triangle's vertices, in ascending order.")
      .def_property_readonly("object_of", &objectArray, "A copy, (m,): indices of object_names.")
      .def_property_readonly("object_names", &nameList)
      .def_property_readonly("audit", &auditOf)
      .def("__repr__", &representScene);
}

}  // namespace foretouch::python
