// examples/circle.h: the constant of the circle.
#pragma once

namespace foretouch::examples {

inline constexpr double kPi = 3.14159265358979323846;

}  // namespace foretouch::examples
