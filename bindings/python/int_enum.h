// bindings/python/int_enum.h: the library's enumerations as enum.IntEnum.
#pragma once

#include <cstddef>
#include <pybind11/pybind11.h>
#include <string>
#include <utility>
#include <vector>

namespace foretouch::python {

/// The members' words and numbers.
using EnumMembers = std::vector<std::pair<std::string, int>>;

/// Adds the class to the module, with members in upper case ("contact" is CONTACT); borrowed from
/// the module, which lives as long as the interpreter.
[[nodiscard]] PyObject* addIntEnum(pybind11::module_& module, const char* name,
                                   const EnumMembers& members);

/// The first `count` values of an enumeration whose words are toString()'s.
template <typename Enum>
[[nodiscard]] EnumMembers membersOf(int count) {
  EnumMembers members;
  for (int value = 0; value < count; ++value) {
    members.emplace_back(toString(static_cast<Enum>(value)), value);
  }
  return members;
}

/// The member of a class that addIntEnum() made.
template <typename Enum>
[[nodiscard]] pybind11::object memberOf(PyObject* type, Enum value) {
  return pybind11::reinterpret_borrow<pybind11::object>(type)(static_cast<int>(value));
}

}  // namespace foretouch::python
