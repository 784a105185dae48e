// articulated/quoted.h: words and numbers for messages. Not installed.
#pragma once

#include <string>
#include <string_view>

namespace foretouch {

/// True for well-formed UTF-8: no overlong forms, no surrogates, nothing above U+10FFFF.
[[nodiscard]] bool isUtf8(std::string_view text);

/// A word of an untrusted file for a message: in single quotes, control characters and bytes that
/// are not UTF-8 as \xNN, cut after 48 bytes. Keeps control sequences out of terminals.
[[nodiscard]] std::string inQuotes(std::string_view text);

/// A number with at most `digits` significant digits (1 to 17), as "%g" writes it, whatever the
/// locale.
[[nodiscard]] std::string inDigits(double number, int digits = 6);

}  // namespace foretouch
