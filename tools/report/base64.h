// tools/report/base64.h: bytes as text ([RFC4648] section 4).
#pragma once

#include <cstddef>
#include <string>

namespace foretouch::tools {

/// Appends the padded base64 text of `size` bytes. You may join the texts of pieces if every piece
/// but the last has a multiple of three bytes.
void appendBase64(const unsigned char* bytes, std::size_t size, std::string& text);

}  // namespace foretouch::tools
