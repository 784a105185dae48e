// tests/house/markdown.h: the lines of Markdown documents.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace foretouch::test {

/// Columns that a line of UTF-8 takes: its code points.
std::size_t columnsOf(std::string_view line);

struct WideLine {
  int number = 0;  ///< From 1.
  std::size_t columns = 0;
};

/// Lines of more than `most` columns. Exempt, because they cannot be wrapped: rows of tables, lines
/// that are one HTML tag or comment, lines that are one link, fences of program output (```text)
/// and of lines of JSON (```jsonl), and generated text between comments NAME:begin and NAME:end.
std::vector<WideLine> wideLines(std::string_view text, std::size_t most);

}  // namespace foretouch::test
