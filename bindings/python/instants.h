// bindings/python/instants.h: the argument `t`: one instant of a motion, or many.
#pragma once

#include <vector>

#include "bindings/python/arguments.h"

namespace foretouch::python {

class Instants {
 public:
  /// A number or a one-dimensional array, in [0,1].
  explicit Instants(py::handle given);

  [[nodiscard]] bool isOne() const { return isOne_; }
  [[nodiscard]] const std::vector<double>& values() const { return values_; }
  /// `rest` for one instant; for many, their number and then `rest`.
  [[nodiscard]] Shape shapeWith(Shape rest) const;

 private:
  bool isOne_ = false;
  std::vector<double> values_;
};

}  // namespace foretouch::python
