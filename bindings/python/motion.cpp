// bindings/python/motion.cpp: foretouch.Motion.
#include "bindings/python/motion.h"

#include "bindings/python/arguments.h"
#include "bindings/python/bindings.h"
#include "bindings/python/instants.h"
#include "bindings/python/poses.h"
#include "lss/index.h"

namespace foretouch::python {
namespace {

std::shared_ptr<Motion> createMotion(std::shared_ptr<Avatar> avatar,
                                     const Shown<shown::Pose>& start,
                                     const Shown<shown::Pose>& end) {
  const Skeleton& skeleton = avatar->skeleton();
  Pose from = poseFrom(skeleton, start, "start"), to = poseFrom(skeleton, end, "end");
  ChainMotion chain(skeleton, from, to);
  return std::make_shared<Motion>(
      Motion{std::move(avatar), std::move(from), std::move(to), std::move(chain)});
}

/// The homogeneous matrix that takes points of L to W, row by row.
void writeTransform(const LinkState& state, double* value) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) *value++ = state.R_WL(row, column);
    *value++ = state.p_WL[row];
  }
  for (const double last : {0.0, 0.0, 0.0, 1.0}) *value++ = last;
}

Numbers transforms(const Motion& motion, const Shown<shown::Instants>& t) {
  const Instants instants(t);
  const auto links = static_cast<py::ssize_t>(motion.chain.numLinks());
  Numbers array(instants.shapeWith({links, 4, 4}));
  double* const values = array.mutable_data();
  const py::gil_scoped_release free;
  std::vector<LinkState> states;
  double* value = values;
  for (const double instant : instants.values()) {
    motion.chain.statesAt(instant, states);
    for (const LinkState& state : states) {
      writeTransform(state, value);
      value += 16;
    }
  }
  return array;
}

Shown<shown::PoseOrPoses> poseAt(const Motion& motion, const Shown<shown::Instants>& t) {
  const Instants instants(t);
  std::vector<Pose> poses(instants.values().size());
  for (std::size_t i = 0; i < poses.size(); ++i)
    motion.chain.poseAt(instants.values()[i], poses[i]);
  if (instants.isOne()) return toPython(poses.front());
  return toPython(poses, countOf(motion.chain.numLinks()));
}

}  // namespace

void bindMotion(py::module_& module) {
  py::class_<Motion, std::shared_ptr<Motion>>(
      module, "Motion",
      "The in-between motion of an avatar: every joint turns at constant rate on the shorter arc\n"
      "(slerp) and moves on a straight line in its parent's frame, t from 0 to 1. Immutable.")
      .def(py::init(&createMotion), py::arg("avatar").none(false), py::arg("start"), py::arg("end"))
      .def("transforms", &transforms, py::arg("t"),
           "Where every link is: (n, 4, 4) homogeneous matrices from the link's frame to the\n"
           "world for a number t, (k, n, 4, 4) for k of them.")
      .def("pose_at", &poseAt, py::arg("t"),
           "The Pose at a number t, the given ones at 0 and 1; Poses for many. A motion from it, "
           "or\n"
           "to it, runs along the same path: at a contact's toi, where a stopped avatar stands.")
      .def_property_readonly("avatar", [](const Motion& motion) { return motion.avatar; })
      .def_property_readonly("start", [](const Motion& motion) { return toPython(motion.start); })
      .def_property_readonly("end", [](const Motion& motion) { return toPython(motion.end); })
      .def("__repr__", [](const Motion& motion) {
        return "<foretouch.Motion of " + std::to_string(motion.avatar->numLinks()) + " links>";
      });
}

}  // namespace foretouch::python
