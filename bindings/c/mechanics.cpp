// bindings/c/mechanics.cpp: impulses.
#include "bindings/c/include/foretouch/mechanics.h"

#include <utility>

#include "articulated/skeleton.h"
#include "articulated/try.h"
#include "bindings/c/sized_struct.h"
#include "middleware/mechanics/mass.h"

namespace foretouch::c {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
/// Row after row. Symmetric ones are the same either way.
using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

ft_status checkedNumbers(const ft_collision_point& point) {
  const bool isFinite = Eigen::Map<const Vector3d>(point.normal).allFinite() &&
                        Eigen::Map<const Vector3d>(point.velocity).allFinite() &&
                        Eigen::Map<const Rows>(point.inverse_mass).allFinite();
  if (!isFinite) {
    return failure(FT_ERROR_NON_FINITE, kNoIndex,
                   "expected a finite normal, velocity and inverse mass");
  }
  if (!(point.restitution >= 0.0 && point.restitution <= 1.0)) {
    return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex, "restitution: expected 0 to 1, found %g",
                   point.restitution);
  }
  if (!(point.friction >= 0.0)) {
    return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex, "friction: expected at least 0, found %g",
                   point.friction);
  }
  return FT_OK;
}

}  // namespace
}  // namespace foretouch::c

using namespace foretouch;
using namespace foretouch::c;

ft_status ft_inverse_mass_at(double kg, const double* center, const double* inertia,
                             const double* rotation, const double* translation, const double* point,
                             double* inverse_mass) {
  return guarded(__func__, [&]() -> ft_status {
    const std::pair<const void*, const char*> places[] = {
        {center, "center"},           {inertia, "inertia"}, {rotation, "rotation"},
        {translation, "translation"}, {point, "point"},     {inverse_mass, "inverse_mass"}};
    for (const auto& [place, name] : places) {
      if (const auto s = needed(place, name); s != FT_OK) return s;
    }
    Mass mass;
    mass.kg = kg;
    mass.center_B = Eigen::Map<const Vector3d>(center);
    mass.inertia_B = Eigen::Map<const Rows>(inertia);
    FORETOUCH_TRY_OR(failure, const Mass known, checkedMass(mass));
    const auto turn = unitQuaternion({rotation[0], rotation[1], rotation[2], rotation[3]});
    if (!turn) return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex, "rotation: expected a unit one");
    const RigidPose pose{*turn, Eigen::Map<const Vector3d>(translation)};
    const Vector3d p_W = Eigen::Map<const Vector3d>(point);
    if (!pose.translation.allFinite() || !p_W.allFinite()) {
      return failure(FT_ERROR_NON_FINITE, kNoIndex, "expected a finite translation and point");
    }
    Eigen::Map<Rows> found(inverse_mass);
    found = inverseMassAt(known, pose, p_W);
    return FT_OK;
  });
}

ft_status ft_collide(const ft_collision_point* point, ft_collision_impulse* impulse) {
  return guarded(__func__, [&]() -> ft_status {
    ft_collision_point given{};
    if (const auto s = readStruct(point, "ft_collision_point", given); s != FT_OK) return s;
    if (const auto s = checkedNumbers(given); s != FT_OK) return s;
    CollisionPoint at;
    at.nhat_BA_W = Eigen::Map<const Vector3d>(given.normal);
    at.velocity_W = Eigen::Map<const Vector3d>(given.velocity);
    at.inverseMass_W = Eigen::Map<const Rows>(given.inverse_mass);
    const CollisionImpulse found = collisionImpulse(at, {given.restitution, given.friction});
    ft_collision_impulse known{};
    known.sticks = found.sticks ? 1 : 0;
    Eigen::Map<Vector3d>(known.on_a) = found.onA_W;
    known.restitution = found.applied.restitution;
    known.friction = found.applied.friction;
    known.effective_mass = effectiveMass(at);
    return writeStruct(impulse, "ft_collision_impulse", known);
  });
}
