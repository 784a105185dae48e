#include "bindings/python/errors.h"

#include "bindings/python/bindings.h"

namespace foretouch::python {
namespace {

// Borrowed from the module, which lives as long as the interpreter.
PyObject* inputErrorType = nullptr;
PyObject* resourceErrorType = nullptr;

/// Whether the system or a file failed, rather than an argument or a file's content.
bool isOfTheSystem(ErrorCode code) {
  switch (code) {
    case ErrorCode::FileNotFound:
    case ErrorCode::FileUnreadable:
    case ErrorCode::FileUnwritable:
    case ErrorCode::ImportCrashed:
    case ErrorCode::DeviceFailed: return true;
    case ErrorCode::Syntax:
    case ErrorCode::LimitExceeded:
    case ErrorCode::NonFinite:
    case ErrorCode::OutOfRange:
    case ErrorCode::UnknownName:
    case ErrorCode::DuplicateName:
    case ErrorCode::BadHierarchy:
    case ErrorCode::Empty:
    case ErrorCode::Mismatch:
    case ErrorCode::ImportFailed: break;
  }
  return false;
}

py::object numberOrNone(std::int64_t number) {
  if (number < 0) return py::none();
  return py::int_(number);
}

void raise(const Error& error) {
  PyObject* const type = isOfTheSystem(error.code) ? resourceErrorType : inputErrorType;
  const py::object exception = py::reinterpret_borrow<py::object>(type)(readable(describe(error)));
  exception.attr("code") = toString(error.code);
  exception.attr("file") = error.file.empty() ? py::object(py::none()) : readable(error.file);
  exception.attr("line") = numberOrNone(error.line);
  exception.attr("index") = numberOrNone(error.index);
  PyErr_SetObject(type, exception.ptr());
}

py::object newException(py::module_& module, const char* name, const char* doc,
                        const py::tuple& bases, const py::dict& attributes) {
  const std::string fullName = std::string("foretouch.") + name;
  auto type = py::reinterpret_steal<py::object>(
      PyErr_NewExceptionWithDoc(fullName.c_str(), doc, bases.ptr(), attributes.ptr()));
  if (!type) throw py::error_already_set();
  module.attr(name) = type;
  return type;
}

}  // namespace

void refuse(ErrorCode code, const std::string& what, std::string message, std::int64_t index) {
  throw Failure(Error{code, what, -1, index, std::move(message)});
}

void warn(const char* words) {
  if (PyErr_WarnEx(PyExc_UserWarning, words, 1) < 0) throw py::error_already_set();
}

py::str readable(const std::string& bytes) {
  auto text = py::reinterpret_steal<py::str>(PyUnicode_DecodeUTF8(
      bytes.data(), static_cast<py::ssize_t>(bytes.size()), "backslashreplace"));
  if (!text) throw py::error_already_set();
  return text;
}

void bindErrors(py::module_& module) {
  const auto builtin = [](PyObject* type) { return py::reinterpret_borrow<py::object>(type); };
  py::dict attributes;
  for (const char* name : {"code", "file", "line", "index"}) attributes[name] = py::none();
  const py::object base =
      newException(module, "Error", "Bad input, or a file or system that failed.",
                   py::make_tuple(builtin(PyExc_Exception)), attributes);
  inputErrorType =
      newException(module, "InputError", "An argument, or what a file holds, is refused.",
                   py::make_tuple(base, builtin(PyExc_ValueError)), py::dict())
          .ptr();
  resourceErrorType = newException(module, "ResourceError",
                                   "A file cannot be read or written, or the system refused.",
                                   py::make_tuple(base, builtin(PyExc_OSError)), py::dict())
                          .ptr();
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Failure& failure) {
      raise(failure.error());
    }
  });
}

}  // namespace foretouch::python
