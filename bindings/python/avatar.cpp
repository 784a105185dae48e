// bindings/python/avatar.cpp: foretouch.Avatar.
#include "articulated/avatar.h"

#include <memory>

#include "assets/avatar/avatar_file.h"
#include "assets/bvh/bvh_reader.h"
#include "bindings/python/arguments.h"
#include "bindings/python/bindings.h"
#include "bindings/python/poses.h"

namespace foretouch::python {
namespace {

using Eigen::Vector3d;
using SharedAvatar = std::shared_ptr<Avatar>;

SharedAvatar loadAvatar(const Shown<shown::Path>& file) {
  const std::string from = path(file, "path");
  const py::gil_scoped_release free;
  return std::make_shared<Avatar>(valueOf(readAvatarFile(from), from));
}

void save(const Avatar& avatar, const Shown<shown::Path>& file) {
  const std::string to = path(file, "path");
  const py::gil_scoped_release free;
  valueOf(writeAvatarFile(avatar, to), to);
}

SharedAvatar fromClip(const Clip& clip, const Shown<shown::Number>& radiusScale) {
  const BvhAvatarOptions options{number(radiusScale, "radius_scale")};
  return std::make_shared<Avatar>(valueOf(avatarFromClip(clip, options), "Avatar.from_clip"));
}

SharedAvatar fromBvh(const Shown<shown::Path>& file, const Shown<shown::Number>& scale,
                     const Shown<shown::Number>& radiusScale) {
  const std::string from = path(file, "path");
  const BvhOptions options{number(scale, "scale")};
  const BvhAvatarOptions body{number(radiusScale, "radius_scale")};
  const py::gil_scoped_release free;
  const Clip clip = valueOf(readBvhFile(from, options), from);
  return std::make_shared<Avatar>(valueOf(avatarFromClip(clip, body), from));
}

RawSkeleton skeletonFrom(const Shown<shown::Texts>& names, const Shown<shown::Array>& parents,
                         const Shown<shown::Array>& offsets, const Shown<shown::Array>& rotations) {
  const std::vector<std::string> name = texts(names, "names");
  const auto count = static_cast<py::ssize_t>(name.size());
  const Integers parent = integers(parents, "parents", {count});
  const Numbers offset = numbers(offsets, "offsets", {count, 3});
  RawSkeleton raw;
  for (py::ssize_t j = 0; j < count; ++j) {
    // Beyond any index either way: the library's check of hierarchies reports it.
    const std::int64_t above = std::min<std::int64_t>(std::max<std::int64_t>(parent.at(j), -2),
                                                      kMaxJoints + std::int64_t{1});
    raw.joints.push_back({name[std::size_t(j)], static_cast<JointId>(above),
                          Vector3d(offset.data(j)), Quaternion::Identity()});
  }
  if (rotations.is_none()) return raw;
  const Numbers rotation = numbers(rotations, "rotations", {count, 4});
  for (py::ssize_t j = 0; j < count; ++j) {
    const double* const q = rotation.data(j);
    raw.joints[std::size_t(j)].rotation = Quaternion(q[0], q[1], q[2], q[3]);
  }
  return raw;
}

std::vector<std::vector<Lss>> lssPerLinkFrom(const py::object& given) {
  std::vector<std::vector<Lss>> perLink;
  for (const py::object& link : items(given, "lss")) {
    const std::string what = "lss[" + std::to_string(perLink.size()) + "]";
    std::vector<Lss> found;
    for (const py::object& one : items(link, what)) {
      found.push_back(lssFrom(one, what + "[" + std::to_string(found.size()) + "]"));
    }
    perLink.push_back(std::move(found));
  }
  return perLink;
}

SharedAvatar fromArrays(const Shown<shown::Texts>& names, const Shown<shown::Array>& parents,
                        const Shown<shown::Array>& offsets, const Shown<shown::Array>& rotations,
                        const Shown<shown::Items>& lss) {
  const char* const what = "Avatar.from_arrays";
  auto skeleton = valueOf(Skeleton::build(skeletonFrom(names, parents, offsets, rotations)), what);
  return std::make_shared<Avatar>(
      valueOf(Avatar::build(std::move(skeleton), lssPerLinkFrom(lss)), what));
}

py::list nameList(const Avatar& avatar) {
  py::list names;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) names.append(nameOf(avatar, link));
  return names;
}

py::array_t<JointId> parentArray(const Avatar& avatar) {
  const std::vector<JointId>& parents = avatar.skeleton().parents();
  return py::array_t<JointId>(static_cast<py::ssize_t>(parents.size()), parents.data());
}

py::list lssList(const Avatar& avatar) {
  const py::object type = pythonType("Lss");
  py::list perLink;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    py::list found;
    for (const Lss& lss : avatar.lss(link)) {
      found.append(type(Numbers(3, lss.a.data()), Numbers(3, lss.b.data()), lss.radius));
    }
    perLink.append(found);
  }
  return perLink;
}

std::string representAvatar(const Avatar& avatar) {
  return "<foretouch.Avatar of " + std::to_string(avatar.numLinks()) + " links, " +
         std::to_string(avatar.numLss()) + " LSS>";
}

}  // namespace

void bindAvatar(py::module_& module) {
  py::class_<Avatar, SharedAvatar>(
      module, "Avatar",
      "A tree of links, each bounded by line-swept spheres (LSS) in its frame. Immutable; any\n"
      "number of threads may use one. Metres, quaternions in the order w, x, y, z.")
      .def_static("load", &loadAvatar, py::arg("path"), "An avatar file (docs/formats.md).")
      .def_static("from_arrays", &fromArrays, py::arg("names"), py::arg("parents"),
                  py::arg("offsets"), py::arg("rotations"), py::arg("lss"),
                  "names: one per link, unique; parents (n,): an earlier link, -1 for a root;\n"
                  "offsets (n, 3) and rotations (n, 4), or None: the rest pose, in the parent's\n"
                  "frame; lss: per link, a list of (a, b, radius), in the link's frame.")
      .def_static("from_bvh", &fromBvh, py::arg("path"), py::arg("scale") = 1.0, py::kw_only(),
                  py::arg("radius_scale") = 1.0,
                  "The skeleton of a BVH file, with one LSS a bone. scale: metres per unit.")
      .def_static("from_clip", &fromClip, py::arg("clip"), py::kw_only(),
                  py::arg("radius_scale") = 1.0, "As from_bvh(), of a clip that is read already.")
      .def("save", &save, py::arg("path"),
           "Writes an avatar file; load() gives it back bit for bit.")
      .def(
          "link",
          [](const Avatar& avatar, const Shown<shown::Link>& name) {
            return linkOf(avatar, name, "name");
          },
          py::arg("name"), "The index of a link.")
      .def(
          "rest_pose",
          [](const Avatar& avatar) -> Shown<shown::Pose> {
            return toPython(restPose(avatar.skeleton()));
          },
          "The pose of the file, as a Pose.")
      .def_property_readonly("num_links", &Avatar::numLinks)
      .def_property_readonly("num_lss", &Avatar::numLss)
      .def_property_readonly("names", &nameList)
      .def_property_readonly("link_names", &nameList, "As names: Step calls them so.")
      .def_property_readonly("parents", &parentArray, "A copy, (n,); -1 for roots.")
      .def_property_readonly("lss", &lssList, "Per link, a list of Lss.")
      .def("__len__", &Avatar::numLinks)
      .def("__repr__", &representAvatar);
}

}  // namespace foretouch::python
