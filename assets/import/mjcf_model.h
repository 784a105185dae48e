// assets/import/mjcf_model.h: MJCF compiled by libmujoco. In foretouch-import only, where it is
// built with libmujoco. Not installed.
#pragma once

#include <memory>
#include <mujoco/mujoco.h>
#include <string>

#include <Eigen/Core>

#include "assets/import/mjcf_text.h"
#include "assets/import/model.h"

namespace foretouch::internal {

struct DeleteMjModel {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
using MjModelPointer = std::unique_ptr<mjModel, DeleteMjModel>;

/// Throws Failure (assets/import/failure.h) with the place for what libmujoco refuses. Never null.
[[nodiscard]] MjModelPointer compileMjcf(const MjcfText& text);

/// The name at an address in mjModel::names; "" for a part without one.
[[nodiscard]] inline std::string mjName(const mjModel& model, int address) {
  return model.names + address;
}
[[nodiscard]] std::string bodyName(const mjModel& model, int body);  ///< For messages, in quotes.

/// Throws Failure if a number is not finite or beyond kMaxCoordinate: libmujoco takes them.
[[nodiscard]] Affine mjFrame(const mjtNum* position, const mjtNum* quaternion,
                             const std::string& owner);

/// The geoms of bodies as LSS and triangles of a model's nodes.
class MjcfSurface {
 public:
  MjcfSurface(const ModelQuestion& question, const mjModel& from, ModelBuilder& builder);

  /// Adds the body's geoms of the requested kind (those that collide, or those that are only seen)
  /// to node `node` of the builder's model, whose frame is the body's. If there are none, adds
  /// those of the other kind, with a note: a link without a surface means missed contacts.
  void add(int body, std::int32_t node);

 private:
  int addAll(int body, bool visual, std::int32_t node);
  void addGeom(int geom, std::int32_t node);
  void addRound(const Affine& toBody, double halfLength, double radius, std::int32_t node);
  void addMesh(int geom, const Affine& toBody, std::int32_t node);
  void addSolid(int geom, const Affine& toBody, std::int32_t node);
  [[nodiscard]] std::string geomName(int geom) const;  ///< For messages.

  const ModelQuestion& question_;
  const mjModel& from_;
  ModelBuilder& builder_;
  std::vector<bool> collides_;  // per geom
};

}  // namespace foretouch::internal
