// bindings/c/scene.cpp: ft_scene.
#include <string>
#include <utility>

#include "articulated/try.h"
#include "bindings/c/handles.h"
#include "bindings/c/import_options.h"
#include "bindings/c/sized_struct.h"
#include "lss/index.h"

namespace foretouch::c {
namespace {

ft_status checkedArrays(const ft_scene_arrays& arrays) {
  if (const auto s = zero(arrays.reserved, "reserved"); s != FT_OK) return s;
  if (const auto s = withinLimit(arrays.triangle_count, kMaxTriangles, "triangles"); s != FT_OK) {
    return s;
  }
  if (const auto s = withinLimit(arrays.object_count, kMaxTriangles, "objects"); s != FT_OK) {
    return s;
  }
  if (arrays.triangle_count > 0) {
    if (const auto s = needed(arrays.positions, "positions"); s != FT_OK) return s;
  }
  if (arrays.indices == nullptr && arrays.vertex_count != 3 * arrays.triangle_count) {
    return failure(FT_ERROR_MISMATCH, kNoIndex,
                   "vertex_count: expected three per triangle (%zu) when there are no indices, "
                   "found %zu",
                   3 * arrays.triangle_count, arrays.vertex_count);
  }
  return FT_OK;
}

ft_status readTriangles(const ft_scene_arrays& arrays, std::vector<Triangle>& triangles) {
  triangles.resize(arrays.triangle_count);
  for (std::size_t i = 0; i < arrays.triangle_count; ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t at = 3 * i + corner;
      const std::size_t vertex = arrays.indices == nullptr ? at : arrays.indices[at];
      if (vertex >= arrays.vertex_count) {
        return failure(FT_ERROR_OUT_OF_RANGE, static_cast<std::int64_t>(i),
                       "indices: triangle %zu has vertex %zu; expected one below %zu", i, vertex,
                       arrays.vertex_count);
      }
      const double* const position = arrays.positions + 3 * vertex;
      triangles[i].vertices[corner] = {position[0], position[1], position[2]};
    }
  }
  return FT_OK;
}

ft_status readObjects(const ft_scene_arrays& arrays, RawScene& raw) {
  const std::size_t count =
      arrays.objects == nullptr && arrays.object_count == 0 ? 1 : arrays.object_count;
  raw.objectNames.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (arrays.object_names == nullptr || arrays.object_count == 0) {
      raw.objectNames.push_back("object " + std::to_string(i));
      continue;
    }
    const char* const name = arrays.object_names[i];
    if (name == nullptr) {
      return failure(FT_ERROR_NULL_ARGUMENT, static_cast<std::int64_t>(i),
                     "object_names: expected the name of object %zu, found NULL", i);
    }
    raw.objectNames.emplace_back(name);
  }
  if (arrays.objects == nullptr) {
    raw.objectOf.assign(arrays.triangle_count, 0);
  } else {
    raw.objectOf.assign(arrays.objects, arrays.objects + arrays.triangle_count);
  }
  return FT_OK;
}

}  // namespace
}  // namespace foretouch::c

using namespace foretouch;
using namespace foretouch::c;

ft_status ft_scene_arrays_init(ft_scene_arrays* arrays, size_t size) {
  return initStruct(__func__, arrays, size, "ft_scene_arrays", ft_scene_arrays{});
}

ft_status ft_scene_create(const ft_scene_arrays* arrays, ft_scene** scene) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = cleared(scene); s != FT_OK) return s;
    ft_scene_arrays known{};
    if (const auto s = readStruct(arrays, "ft_scene_arrays", known); s != FT_OK) return s;
    if (const auto s = checkedArrays(known); s != FT_OK) return s;
    RawScene raw;
    if (const auto s = readTriangles(known, raw.triangles); s != FT_OK) return s;
    if (const auto s = readObjects(known, raw); s != FT_OK) return s;
    FORETOUCH_TRY_OR(failure, auto built, Scene::build(std::move(raw)));
    *scene = new ft_scene{ft_scene::kMark, std::move(built)};
    return FT_OK;
  });
}

ft_status ft_scene_create_from_file(const char* path, const ft_import_options* options,
                                    ft_scene** scene) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = cleared(scene); s != FT_OK) return s;
    if (const auto s = needed(path, "path"); s != FT_OK) return s;
    SceneImportOptions known;
    if (const auto s = readImportOptions(options, known); s != FT_OK) return s;
    FORETOUCH_TRY_OR(failure, auto loaded, readScene(path, known));
    *scene = new ft_scene{ft_scene::kMark, std::move(loaded.scene)};
    return FT_OK;
  });
}

ft_status ft_scene_get_info(const ft_scene* scene, ft_scene_info* info) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(scene); s != FT_OK) return s;
    const SceneAudit& audit = scene->scene.audit();
    ft_scene_info known{};
    known.object_count = static_cast<std::int32_t>(scene->scene.objectNames().size());
    known.triangles = audit.triangles;
    known.dropped_non_finite = audit.droppedNonFinite;
    known.zero_area = audit.zeroArea;
    known.duplicates = audit.duplicates;
    Eigen::Map<Eigen::Vector3d>(known.box_min) = audit.boxMin;
    Eigen::Map<Eigen::Vector3d>(known.box_max) = audit.boxMax;
    return writeStruct(info, "ft_scene_info", known);
  });
}

ft_status ft_scene_object_name(const ft_scene* scene, int32_t object, const char** name) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = needed(name, "name"); s != FT_OK) return s;
    *name = nullptr;
    if (const auto s = checked(scene); s != FT_OK) return s;
    const auto& names = scene->scene.objectNames();
    if (object < 0 || slotOf(object) >= names.size()) {
      return failure(FT_ERROR_OUT_OF_RANGE, object, "object: expected 0 to %zu, found %d",
                     names.size() - 1, object);
    }
    *name = names[slotOf(object)].c_str();
    return FT_OK;
  });
}

void ft_scene_destroy(ft_scene* scene) {
  destroy(__func__, scene);
}
