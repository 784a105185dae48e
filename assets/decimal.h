// assets/decimal.h: a double from decimal text, whatever the locale. Not installed.
#pragma once

#include <charconv>

namespace foretouch::internal {

/// std::from_chars(), which not every standard library has for doubles.
std::from_chars_result readDecimal(const char* first, const char* last, double& value);

/// The same by strtod(), which such a library has: from the same texts, the same doubles. Where
/// strtod() heeds locales, needs the locale "C", which a program has unless it asks for another.
std::from_chars_result readDecimalByStrtod(const char* first, const char* last, double& value);

}  // namespace foretouch::internal
