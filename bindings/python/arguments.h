// bindings/python/arguments.h: Python's arguments as C++ values, checked. Everything here needs the
// GIL and throws a Failure that names the argument.
#pragma once

#include <array>
#include <cstdint>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "assets/import/scene_import.h"
#include "assets/near_names.h"
#include "bindings/python/errors.h"
#include "bindings/python/shown.h"

namespace foretouch::python {

/// Any extent, in an expected shape.
inline constexpr py::ssize_t kAny = -1;
using Shape = std::vector<py::ssize_t>;

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Integers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

/// Anything that numpy makes an array of: real numbers (no booleans, no objects), all finite, of
/// this shape. Does not copy a C-contiguous array of doubles.
[[nodiscard]] Numbers numbers(py::handle given, const std::string& what, const Shape& shape);
/// The same for integers; refuses floats, even whole ones.
[[nodiscard]] Integers integers(py::handle given, const std::string& what, const Shape& shape);

/// (a, b, radius).
[[nodiscard]] Lss lssFrom(py::handle given, const std::string& what);
[[nodiscard]] Eigen::Vector3d point(py::handle given, const std::string& what);
/// One number, finite or not: the library judges it.
[[nodiscard]] double number(py::handle given, const std::string& what);
/// An integer in [least, most]; no booleans.
[[nodiscard]] std::int64_t integer(py::handle given, const std::string& what, std::int64_t least,
                                   std::int64_t most);

/// str, bytes or os.PathLike, as the system names files; no NUL in it.
[[nodiscard]] std::string path(py::handle given, const std::string& what);
[[nodiscard]] std::string text(py::handle given, const std::string& what);
/// A list or tuple (of texts); refuses a single text, which Python would iterate letter by letter.
[[nodiscard]] std::vector<py::object> items(py::handle given, const std::string& what);
[[nodiscard]] std::vector<std::string> texts(py::handle given, const std::string& what);

/// 'y' or 'z', of a file.
[[nodiscard]] UpAxis upAxis(py::handle given);

/// A dict, or another mapping as one.
[[nodiscard]] py::dict mapping(py::handle given, const std::string& what);

/// A link's name or its index.
[[nodiscard]] LinkId linkOf(const Avatar& avatar, py::handle given, const std::string& what);
[[nodiscard]] py::str nameOf(const Avatar& avatar, LinkId link);
/// "no link is called 'LeftHnad'; did you mean 'LeftHand'?"
[[noreturn]] void refuseName(const std::string& what, const char* kind, const std::string& name,
                             const std::vector<std::string>& known);

/// The value of the given word.
template <typename Value, std::size_t kCount>
Value oneOf(py::handle given, const std::string& what,
            const std::array<std::pair<const char*, Value>, kCount>& words) {
  const std::string word = text(given, what);
  std::string expected;
  std::vector<std::string> names;
  for (const auto& [name, value] : words) {
    if (word == name) return value;
    expected += (expected.empty() ? "'" : ", '") + std::string(name) + "'";
    names.emplace_back(name);
  }
  refuse(ErrorCode::UnknownName, what,
         "expected one of " + expected + ", found '" + word + "'" + didYouMean(word, names));
}

}  // namespace foretouch::python
