// bindings/python/errors.h: how bad input reaches Python: foretouch.Error, with the library's text
// (file, place, expectation) and its parts as attributes.
#pragma once

#include <cstdint>
#include <exception>
#include <pybind11/pybind11.h>
#include <string>
#include <utility>

#include "articulated/result.h"

namespace foretouch::python {

namespace py = pybind11;

/// An Error on its way to Python. Thrown with or without the GIL held.
class Failure : public std::exception {
 public:
  explicit Failure(Error error) : error_(std::move(error)) {}
  [[nodiscard]] const Error& error() const { return error_; }
  [[nodiscard]] const char* what() const noexcept override { return error_.message.c_str(); }

 private:
  Error error_;
};

/// `what`: the refused argument; `message`: what was expected and found.
[[noreturn]] void refuse(ErrorCode code, const std::string& what, std::string message,
                         std::int64_t index = -1);

/// The value, or a Failure.
template <typename T>
T valueOf(Result<T> result) {
  if (!result.ok()) throw Failure(result.error());
  return std::move(result).value();
}

/// The same; an error without a file names `what` instead.
template <typename T>
T valueOf(Result<T> result, const std::string& what) {
  return valueOf(inFile(std::move(result), what));
}

/// A UserWarning of one line. Throws if the caller wants warnings as exceptions.
void warn(const char* words);

/// Untrusted bytes as a Python text; bytes that are not UTF-8 become \xNN.
[[nodiscard]] py::str readable(const std::string& bytes);

}  // namespace foretouch::python
