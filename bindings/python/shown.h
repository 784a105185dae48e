// bindings/python/shown.h: arguments and results that the library checks or makes itself, each with
// the type that help() shows for it. Without that, pybind11 shows "object".
#pragma once

#include <pybind11/pybind11.h>
#include <utility>

namespace foretouch::python {

/// Any object: what it is has to be asked (arguments.h), the name is for people.
template <typename Name>
class Shown : public pybind11::object {
 public:
  using pybind11::object::object;
  Shown() = default;
  Shown(pybind11::object given)  // NOLINT: implicit by intent
      : pybind11::object(std::move(given)) {}
  static bool check_(pybind11::handle) { return true; }
};

namespace shown {
struct Path {
  static constexpr auto kText = pybind11::detail::const_name("str | os.PathLike");
};
struct Text {
  static constexpr auto kText = pybind11::detail::const_name("str");
};
struct Number {
  static constexpr auto kText = pybind11::detail::const_name("float");
};
struct Integer {
  static constexpr auto kText = pybind11::detail::const_name("int");
};
struct Truth {
  static constexpr auto kText = pybind11::detail::const_name("bool");
};
struct Array {
  static constexpr auto kText = pybind11::detail::const_name("numpy.typing.ArrayLike");
};
struct Instants {
  static constexpr auto kText = pybind11::detail::const_name("float | numpy.typing.ArrayLike");
};
struct Texts {
  static constexpr auto kText = pybind11::detail::const_name("Sequence[str]");
};
struct Items {
  static constexpr auto kText = pybind11::detail::const_name("Sequence");
};
struct Mapping {
  static constexpr auto kText = pybind11::detail::const_name("dict");
};
struct Link {
  static constexpr auto kText = pybind11::detail::const_name("str | int");
};
struct Pose {
  static constexpr auto kText = pybind11::detail::const_name("foretouch.Pose");
};
struct Poses {
  static constexpr auto kText = pybind11::detail::const_name("foretouch.Poses");
};
struct PoseOrPoses {
  static constexpr auto kText = pybind11::detail::const_name("foretouch.Pose | foretouch.Poses");
};
struct JointMatch {
  static constexpr auto kText = pybind11::detail::const_name("foretouch.JointMatch");
};
struct Motions {
  static constexpr auto kText =
      pybind11::detail::const_name("foretouch.Motion | Sequence[foretouch.Motion]");
};
struct Surface {
  static constexpr auto kText = pybind11::detail::const_name("foretouch.Surface");
};
struct PairRules {
  static constexpr auto kText = pybind11::detail::const_name("foretouch.PairRules");
};
struct SweptSurface {
  static constexpr auto kText = pybind11::detail::const_name("foretouch.SweptSurface");
};
struct Axes {
  static constexpr auto kText = pybind11::detail::const_name("matplotlib.axes.Axes");
};
}  // namespace shown

}  // namespace foretouch::python

template <typename Name>
struct pybind11::detail::handle_type_name<foretouch::python::Shown<Name>> {
  static constexpr auto name = Name::kText;
};
