#include "assets/decimal.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>

namespace foretouch::internal {
namespace {

const char* pastDigits(const char* at, const char* last) {
  return std::find_if(at, last, [](char c) { return c < '0' || c > '9'; });
}

/// The end of digits with at most one point among or beside them; `first` if there is no digit.
const char* pastMantissa(const char* first, const char* last) {
  const char* at = pastDigits(first, last);
  const bool hasWhole = at != first;
  if (at == last || *at != '.') return at;
  const char* const end = pastDigits(at + 1, last);
  return hasWhole || end != at + 1 ? end : first;
}

/// An exponent without digits is not part of the number.
const char* pastExponent(const char* first, const char* last) {
  if (first == last || (*first != 'e' && *first != 'E')) return first;
  const char* digits = first + 1;
  if (digits != last && (*digits == '+' || *digits == '-')) ++digits;
  const char* const end = pastDigits(digits, last);
  return end == digits ? first : end;
}

/// "infinity", "inf" or "nan", in any case, with or without "(word)"; `first` if it is none.
const char* pastWord(const char* first, const char* last, double& value) {
  const auto begins = [&](std::string_view word) {
    return last - first >= static_cast<std::ptrdiff_t>(word.size()) &&
           std::equal(word.begin(), word.end(), first, [](char expected, char found) {
             return expected == std::tolower(static_cast<unsigned char>(found));
           });
  };
  for (const std::string_view word : {std::string_view("infinity"), std::string_view("inf")}) {
    if (!begins(word)) continue;
    value = HUGE_VAL;
    return first + word.size();
  }
  if (!begins("nan")) return first;
  value = std::nan("");
  const char* const end = first + 3;
  if (end == last || *end != '(') return end;
  const char* const close = std::find_if_not(end + 1, last, [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
  });
  return close != last && *close == ')' ? close + 1 : end;
}

}  // namespace

std::from_chars_result readDecimalByStrtod(const char* first, const char* last, double& value) {
  const bool isNegative = first != last && *first == '-';
  const char* const begin = first + (isNegative ? 1 : 0);
  const char* const mantissaEnd = pastMantissa(begin, last);
  if (mantissaEnd == begin) {
    double word = 0.0;
    const char* const end = pastWord(begin, last, word);
    if (end == begin) return {first, std::errc::invalid_argument};
    value = isNegative ? -word : word;
    return {end, std::errc{}};
  }
  const char* const end = pastExponent(mantissaEnd, last);
  const double read = std::strtod(std::string(first, end).c_str(), nullptr);
  const bool hasDigit =
      std::any_of(begin, mantissaEnd, [](char c) { return c >= '1' && c <= '9'; });
  if (std::isinf(read) || (read == 0.0 && hasDigit)) return {end, std::errc::result_out_of_range};
  value = read;
  return {end, std::errc{}};
}

std::from_chars_result readDecimal(const char* first, const char* last, double& value) {
#if defined(__cpp_lib_to_chars)
  return std::from_chars(first, last, value);
#else
  return readDecimalByStrtod(first, last, value);
#endif
}

}  // namespace foretouch::internal
