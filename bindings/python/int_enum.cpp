#include "bindings/python/int_enum.h"

#include <algorithm>
#include <cctype>

namespace foretouch::python {
namespace {

std::string upperCase(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return word;
}

}  // namespace

PyObject* addIntEnum(pybind11::module_& module, const char* name, const EnumMembers& members) {
  namespace py = pybind11;
  py::dict named;
  for (const auto& [word, value] : members) named[py::str(upperCase(word))] = value;
  const py::object type = py::module_::import("enum").attr("IntEnum")(
      name, named, py::arg("module") = "foretouch._foretouch");
  // Since Python 3.11 an IntEnum prints as its number.
  type.attr("__str__") = py::cpp_function([](const py::object& self) { return self.attr("name"); },
                                          py::name("__str__"), py::is_method(type));
  module.attr(name) = type;
  return type.ptr();
}

}  // namespace foretouch::python
