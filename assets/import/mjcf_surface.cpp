#include <cmath>
#include <utility>

#include "assets/import/failure.h"
#include "assets/import/mjcf_model.h"
#include "assets/import/solids.h"
#include "assets/import/text.h"
#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// How much larger a solid's sizes must be (m) so that its corners, rounded to float in the link's
/// frame, still contain it: a convex solid whose sides stand off by d contains itself after its
/// corners have moved by at most d.
double roomForFloats(const Affine& toLink, double reach) {
  const double farthest = toLink.translation.norm() + reach;
  return std::sqrt(3.0) * static_cast<double>(kUnitRoundoffOfFloat) * farthest * 2.0;
}

/// The semi-axes of an ellipsoid that contains this one and what is within `room` of it: along each
/// direction n, its support is that of the old one times 1 + room / least >= the old one's + room.
Vector3d grown(const Vector3d& semiAxes, double room) {
  const Vector3d notFlat = semiAxes.cwiseMax(100.0 * room);
  return notFlat * (1.0 + room / notFlat.minCoeff());
}

void place(FlatMesh& mesh, const Affine& to) {
  for (Vector3d& vertex : mesh.vertices) vertex = to * vertex;
}

}  // namespace

MjcfSurface::MjcfSurface(const ModelQuestion& question, const mjModel& from, ModelBuilder& builder)
    : question_(question), from_(from), builder_(builder) {
  for (int i = 0; i < from.ngeom; ++i) {
    collides_.push_back(from.geom_contype[i] != 0 || from.geom_conaffinity[i] != 0);
  }
  for (int i = 0; i < from.npair; ++i) {
    for (const int geom : {from.pair_geom1[i], from.pair_geom2[i]}) collides_[slotOf(geom)] = true;
  }
}

void MjcfSurface::add(int body, std::int32_t node) {
  if (addAll(body, question_.visual, node) > 0) return;
  if (addAll(body, !question_.visual, node) == 0) return;
  builder_.note("body " + bodyName(from_, body) +
                (question_.visual
                     ? " has no geoms that are only seen: those that collide stand in"
                     : " has no geoms that collide: those that are only seen stand in"));
}

int MjcfSurface::addAll(int body, bool visual, std::int32_t node) {
  int added = 0;
  const int first = from_.body_geomadr[body];
  for (int geom = first; geom < first + from_.body_geomnum[body]; ++geom) {
    if (collides_[slotOf(geom)] == visual) continue;
    addGeom(geom, node);
    ++added;
  }
  return added;
}

std::string MjcfSurface::geomName(int geom) const {
  const std::string name = mjName(from_, from_.name_geomadr[geom]);
  return (name.empty() ? "a geom" : "geom " + quotedName(name)) + " of body " +
         bodyName(from_, from_.geom_bodyid[geom]);
}

void MjcfSurface::addGeom(int geom, std::int32_t node) {
  const Affine toBody =
      mjFrame(from_.geom_pos + 3 * geom, from_.geom_quat + 4 * geom, geomName(geom));
  const mjtNum* size = from_.geom_size + 3 * geom;
  const int type = from_.geom_type[geom];
  for (int i = 0; i < 3 && type != mjGEOM_MESH; ++i) {
    if (size[i] >= 0.0 && size[i] <= kMaxCoordinate) continue;
    refuse(geomName(geom) + " has a size that is not finite, negative or beyond " +
           std::to_string(static_cast<long>(kMaxCoordinate)) + " m");
  }
  switch (type) {
    case mjGEOM_SPHERE: return addRound(toBody, 0.0, size[0], node);
    case mjGEOM_CAPSULE: return addRound(toBody, size[1], size[0], node);
    case mjGEOM_CYLINDER:
    case mjGEOM_ELLIPSOID:
    case mjGEOM_BOX: return addSolid(geom, toBody, node);
    case mjGEOM_MESH: return addMesh(geom, toBody, node);
    default:
      refuse(geomName(geom) +
             " is endless or a height field; expected a sphere, capsule, cylinder, ellipsoid, box "
             "or mesh");
  }
}

void MjcfSurface::addRound(const Affine& toBody, double halfLength, double radius,
                           std::int32_t node) {
  builder_.addLss(
      node, {toBody * Vector3d(0, 0, -halfLength), toBody * Vector3d(0, 0, halfLength), radius});
}

void MjcfSurface::addSolid(int geom, const Affine& toBody, std::int32_t node) {
  const mjtNum* size = from_.geom_size + 3 * geom;
  const double reach = size[0] + size[1] + size[2];
  const double room = roomForFloats(toBody, reach);
  const Vector3d own(size[0], size[1], size[2]), sizes = own.array() + room;
  FlatMesh solid;
  switch (from_.geom_type[geom]) {
    case mjGEOM_BOX: solid = boxOf(2.0 * sizes); break;
    case mjGEOM_CYLINDER: solid = cylinderAround(sizes[0], 2.0 * sizes[1]); break;
    default: solid = ellipsoidAround(grown(own, room)); break;
  }
  place(solid, toBody);
  builder_.addMesh(node, mjName(from_, from_.name_geomadr[geom]), std::move(solid.vertices),
                   solid.triangles);
}

void MjcfSurface::addMesh(int geom, const Affine& toBody, std::int32_t node) {
  const int mesh = from_.geom_dataid[geom];
  if (mesh < 0 || mesh >= from_.nmesh) refuse(geomName(geom) + " has no mesh");
  FlatMesh flat;
  const int vertices = from_.mesh_vertnum[mesh], faces = from_.mesh_facenum[mesh];
  const float* vertex = from_.mesh_vert + 3 * static_cast<std::ptrdiff_t>(from_.mesh_vertadr[mesh]);
  for (int i = 0; i < vertices; ++i, vertex += 3) {
    flat.vertices.emplace_back(vertex[0], vertex[1], vertex[2]);
  }
  const int* face = from_.mesh_face + 3 * static_cast<std::ptrdiff_t>(from_.mesh_faceadr[mesh]);
  for (int i = 0; i < faces; ++i, face += 3) {
    for (int k = 0; k < 3; ++k) {
      if (face[k] < 0 || face[k] >= vertices) refuse(geomName(geom) + " has a broken mesh");
    }
    flat.triangles.push_back({face[0], face[1], face[2]});
  }
  if (flat.triangles.empty()) refuse(geomName(geom) + " has a mesh without triangles");
  place(flat, toBody);
  builder_.addMesh(node, mjName(from_, from_.name_meshadr[mesh]), std::move(flat.vertices),
                   flat.triangles);
}

}  // namespace foretouch::internal
