// Every document has one width, so that it reads alike in an editor, in a diff and in a terminal.
#include "tests/house/markdown.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/house/documents.h"
#include "tests/house/source_files.h"

namespace foretouch::test {
namespace {

constexpr std::size_t kColumns = 100;
const std::string kLong(kColumns + 1, 'x');

std::size_t wideIn(const std::string& text) {
  return wideLines(text, kColumns).size();
}

TEST(Markdown, LinesHaveAtMostAHundredColumns) {
  int documents = 0;
  for (const auto& document : house::documentsBelow(FORETOUCH_SOURCE_DIR)) {
    ++documents;
    const std::string text = house::contentOf(document);
    for (const WideLine& line : wideLines(text, kColumns)) {
      ADD_FAILURE() << document.string() << ":" << line.number << ": " << line.columns
                    << " columns; expected at most " << kColumns;
    }
  }
  EXPECT_GT(documents, 30);
}

TEST(Markdown, WideLinesAreFound) {
  EXPECT_EQ(wideIn(kLong), 1u);
  EXPECT_EQ(wideIn("short\n- " + kLong + "\n# " + kLong + "\n"), 2u);
  EXPECT_EQ(wideIn("```cpp\n" + kLong + "\n```\n" + kLong), 2u);
  EXPECT_EQ(wideIn("```\n" + kLong + "\n```\n"), 1u);
  EXPECT_EQ(wideIn("    " + kLong), 1u);
  EXPECT_EQ(wideIn("see [" + kLong + "](page.md)"), 1u);
  EXPECT_EQ(wideIn("<b>" + kLong + "</b> and more"), 1u);
  EXPECT_EQ(wideIn("<!-- x:begin -->\n<!-- x:end -->\n" + kLong), 1u);
  EXPECT_EQ(wideLines("short\n" + kLong, kColumns).front().number, 2);
}

TEST(Markdown, WhatCannotBeWrappedMayBeWide) {
  EXPECT_EQ(wideIn("| " + kLong + " |"), 0u);
  EXPECT_EQ(wideIn("- [" + kLong + "](page.md)."), 0u);
  EXPECT_EQ(wideIn("<img alt=\"" + kLong + "\">"), 0u);
  EXPECT_EQ(wideIn("```text\n" + kLong + "\n```\n"), 0u);
  EXPECT_EQ(wideIn("```jsonl\n" + kLong + "\n```\n"), 0u);
  EXPECT_EQ(wideIn("<!-- x:begin -->\n" + kLong + "\n<!-- x:end -->\n"), 0u);
}

TEST(Markdown, ColumnsAreCodePoints) {
  EXPECT_EQ(columnsOf("0.9 \xc2\xb5s"), 6u);
}

}  // namespace
}  // namespace foretouch::test
