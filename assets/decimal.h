// assets/decimal.h: a double from decimal text, whatever the locale. Not installed.
#pragma once

#include <charconv>

namespace foretouch::internal {

/// std::from_chars(), which not every standard library has for doubles.
std::from_chars_result readDecimal(const char* first, const char* last, double& value);

/// The same by strtod(), which such a library has: of the same texts, the same doubles. Needs the
/// locale "C", as any program has that asks for no other, where strtod() heeds locales at all.
std::from_chars_result readDecimalByStrtod(const char* first, const char* last, double& value);

}  // namespace foretouch::internal
