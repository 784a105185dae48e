#include "bindings/python/arguments.h"

#include <cmath>
#include <limits>
#include <pybind11/stl.h>

#include "assets/text_file.h"

namespace foretouch::python {
namespace {

std::string typeName(py::handle given) {
  return Py_TYPE(given.ptr())->tp_name;
}

std::string shapeText(const Shape& shape) {
  std::string text;
  for (const py::ssize_t extent : shape) {
    text += (text.empty() ? "" : ", ") + (extent == kAny ? "any" : std::to_string(extent));
  }
  return "(" + text + (shape.size() == 1 ? ",)" : ")");
}

py::array asArray(py::handle given, const std::string& what) {
  if (py::isinstance<py::array>(given)) return py::reinterpret_borrow<py::array>(given);
  try {
    return py::module_::import("numpy").attr("asarray")(given);
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_TypeError)) throw;
  }
  refuse(ErrorCode::Mismatch, what, "expected an array, found " + typeName(given));
}

void checkKind(const py::array& array, const std::string& what, const std::string& kinds,
               const char* expected) {
  if (kinds.find(array.dtype().kind()) != std::string::npos) return;
  refuse(ErrorCode::Mismatch, what,
         std::string("expected ") + expected + ", found dtype " +
             py::str(array.dtype()).cast<std::string>());
}

void checkShape(const py::array& array, const std::string& what, const Shape& expected) {
  const Shape found(array.shape(), array.shape() + array.ndim());
  bool fits = found.size() == expected.size();
  for (std::size_t i = 0; fits && i < found.size(); ++i) {
    fits = expected[i] == kAny || expected[i] == found[i];
  }
  if (fits) return;
  refuse(ErrorCode::Mismatch, what,
         "expected the shape " + shapeText(expected) + ", found " + shapeText(found));
}

/// "[3, 1]", for the element at this position in C order.
std::string placeText(const py::array& array, py::ssize_t position) {
  std::string text;
  for (py::ssize_t axis = array.ndim(); axis-- > 0;) {
    text = std::to_string(position % array.shape(axis)) + (text.empty() ? "" : ", ") + text;
    position /= array.shape(axis);
  }
  return "[" + text + "]";
}

}  // namespace

Numbers numbers(py::handle given, const std::string& what, const Shape& shape) {
  const py::array array = asArray(given, what);
  checkShape(array, what, shape);
  checkKind(array, what, "fiu", "real numbers");
  Numbers converted = Numbers::ensure(array);
  if (!converted) throw py::error_already_set();
  const double* const values = converted.data();
  for (py::ssize_t i = 0; i < converted.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    refuse(ErrorCode::NonFinite, what + (array.ndim() > 0 ? placeText(array, i) : ""),
           "expected a finite number, found " + std::to_string(values[i]));
  }
  return converted;
}

Integers integers(py::handle given, const std::string& what, const Shape& shape) {
  const py::array array = asArray(given, what);
  checkShape(array, what, shape);
  checkKind(array, what, "iu", "integers");
  Integers converted = Integers::ensure(array);
  if (!converted) throw py::error_already_set();
  return converted;
}

Eigen::Vector3d point(py::handle given, const std::string& what) {
  return Eigen::Map<const Eigen::Vector3d>(numbers(given, what, {3}).data());
}

double number(py::handle given, const std::string& what) {
  const double value = PyBool_Check(given.ptr()) ? -1.0 : PyFloat_AsDouble(given.ptr());
  if (PyErr_Occurred() == nullptr && !PyBool_Check(given.ptr())) return value;
  PyErr_Clear();
  refuse(ErrorCode::Mismatch, what, "expected a number, found " + typeName(given));
}

std::int64_t integer(py::handle given, const std::string& what, std::int64_t least,
                     std::int64_t most) {
  const std::string range = std::to_string(least) + " to " + std::to_string(most);
  const bool isWhole = !PyBool_Check(given.ptr()) && PyIndex_Check(given.ptr());
  const auto whole =
      py::reinterpret_steal<py::object>(isWhole ? PyNumber_Index(given.ptr()) : nullptr);
  if (!whole) {
    PyErr_Clear();
    refuse(ErrorCode::Mismatch, what, "expected an integer, found " + typeName(given));
  }
  int overflow = 0;
  const long long value = PyLong_AsLongLongAndOverflow(whole.ptr(), &overflow);
  if (overflow == 0 && value >= least && value <= most) return value;
  refuse(ErrorCode::OutOfRange, what,
         "expected " + range + ", found " + py::str(whole).cast<std::string>());
}

std::string path(py::handle given, const std::string& what) {
  auto bytes = py::reinterpret_steal<py::object>(PyOS_FSPath(given.ptr()));
  if (!bytes) {
    PyErr_Clear();
    refuse(ErrorCode::Mismatch, what, "expected a path, found " + typeName(given));
  }
  if (PyUnicode_Check(bytes.ptr())) {
    bytes = py::reinterpret_steal<py::object>(PyUnicode_EncodeFSDefault(bytes.ptr()));
    if (!bytes) {
      PyErr_Clear();
      refuse(ErrorCode::Syntax, what, "expected a path that can be encoded");
    }
  }
  const auto name = bytes.cast<std::string>();
  if (name.find('\0') == std::string::npos) return name;
  refuse(ErrorCode::Syntax, what, "expected a path, found one that holds a NUL");
}

std::string text(py::handle given, const std::string& what) {
  if (!PyUnicode_Check(given.ptr())) {
    refuse(ErrorCode::Mismatch, what, "expected a text, found " + typeName(given));
  }
  py::ssize_t size = 0;
  const char* const bytes = PyUnicode_AsUTF8AndSize(given.ptr(), &size);
  if (bytes != nullptr) return std::string(bytes, static_cast<std::size_t>(size));
  PyErr_Clear();
  refuse(ErrorCode::Syntax, what, "expected a text that UTF-8 can hold");
}

std::vector<py::object> items(py::handle given, const std::string& what) {
  if (PyUnicode_Check(given.ptr()) || PyBytes_Check(given.ptr()) ||
      !py::isinstance<py::iterable>(given)) {
    refuse(ErrorCode::Mismatch, what, "expected a list, found " + typeName(given));
  }
  std::vector<py::object> found;
  for (const py::handle item : py::iter(given)) {
    found.push_back(py::reinterpret_borrow<py::object>(item));
  }
  return found;
}

std::vector<std::string> texts(py::handle given, const std::string& what) {
  std::vector<std::string> found;
  for (const py::object& item : items(given, what)) {
    found.push_back(text(item, what + "[" + std::to_string(found.size()) + "]"));
  }
  return found;
}

UpAxis upAxis(py::handle given) {
  static constexpr std::array<std::pair<const char*, UpAxis>, 2> kAxes{
      {{"y", UpAxis::Y}, {"z", UpAxis::Z}}};
  return oneOf(given, "up", kAxes);
}

py::dict mapping(py::handle given, const std::string& what) {
  if (py::isinstance<py::dict>(given)) return py::reinterpret_borrow<py::dict>(given);
  const py::object type = py::module_::import("collections.abc").attr("Mapping");
  if (py::isinstance(given, type)) return py::dict(py::reinterpret_borrow<py::object>(given));
  refuse(ErrorCode::Mismatch, what, "expected a dict, found " + typeName(given));
}

LinkId linkOf(const Avatar& avatar, py::handle given, const std::string& what) {
  if (!PyUnicode_Check(given.ptr())) {
    return static_cast<LinkId>(integer(given, what, 0, avatar.numLinks() - 1));
  }
  const std::string name = text(given, what);
  if (const auto found = avatar.skeleton().find(name)) return *found;
  std::vector<std::string> known;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    known.push_back(avatar.skeleton().name(link));
  }
  refuseName(what, "link of the avatar", name, known);
}

py::str nameOf(const Avatar& avatar, LinkId link) {
  return py::str(avatar.skeleton().name(link));
}

void refuseName(const std::string& what, const char* kind, const std::string& name,
                const std::vector<std::string>& known) {
  const py::object near =
      py::module_::import("difflib").attr("get_close_matches")(readable(name), known);
  std::string hint;
  for (const py::handle match : near) {
    hint += (hint.empty() ? "; did you mean " : ", ") + inQuotes(match.cast<std::string>());
  }
  refuse(ErrorCode::UnknownName, what,
         inQuotes(name) + " is no " + kind + hint + (hint.empty() ? "" : "?"));
}

Lss lssFrom(py::handle given, const std::string& what) {
  const std::vector<py::object> parts = items(given, what);
  if (parts.size() != 3) {
    refuse(ErrorCode::Mismatch, what,
           "expected (a, b, radius), found " + std::to_string(parts.size()) + " items");
  }
  return {point(parts[0], what + ".a"), point(parts[1], what + ".b"),
          number(parts[2], what + ".radius")};
}

}  // namespace foretouch::python
