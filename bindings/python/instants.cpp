#include "bindings/python/instants.h"

namespace foretouch::python {

Instants::Instants(py::handle given)
    : isOne_(PyNumber_Check(given.ptr()) && !py::isinstance<py::array>(given)) {
  const Numbers found = numbers(given, "t", isOne_ ? Shape{} : Shape{kAny});
  values_.assign(found.data(), found.data() + found.size());
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (values_[i] >= 0.0 && values_[i] <= 1.0) continue;
    refuse(ErrorCode::OutOfRange, isOne_ ? "t" : "t[" + std::to_string(i) + "]",
           "expected 0 to 1, found " + std::to_string(values_[i]));
  }
}

Shape Instants::shapeWith(Shape rest) const {
  if (!isOne_) rest.insert(rest.begin(), static_cast<py::ssize_t>(values_.size()));
  return rest;
}

}  // namespace foretouch::python
