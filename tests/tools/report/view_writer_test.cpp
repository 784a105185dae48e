#include "tools/report/view_writer.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/report/view_reading.h"
#include "tools/report/viewer_page.h"

namespace foretouch::tools {
namespace {

using nlohmann::json;
using test::numbersOf;
using test::textOf;

constexpr char kHostile[] = "</script><script>alert(1)</script><!-- \" \\ \x01 ]]>";

TEST(ViewWriter, WritesWhatAPageCannotBeBrokenOutOf) {
  ViewDocument document;
  document.title = kHostile;
  document.notes = {kHostile};
  document.settings = {{kHostile, kHostile, ""}};
  document.summary = {{kHostile, kHostile, kHostile}};
  document.scene.emplace().name = kHostile;
  document.scene->objects = {{kHostile, 0, 0}};
  const std::string text = textOf(document);
  EXPECT_EQ(text.find('<'), std::string::npos);
  const json read = json::parse(text);
  EXPECT_EQ(read["title"], kHostile);
  EXPECT_EQ(read["notes"][0], kHostile);
  EXPECT_EQ(read["summary"][0]["note"], kHostile);
  EXPECT_EQ(read["settings"][0].count("note"), 0u);
  EXPECT_EQ(read["scene"]["objects"][0]["name"], kHostile);
}

TEST(ViewWriter, ReplacesWhatIsNotUtf8) {
  ViewDocument document;
  document.title = "a\xff\xc3 b";
  const json read = json::parse(textOf(document));
  EXPECT_EQ(read["title"].get<std::string>().find("\xff"), std::string::npos);
  EXPECT_NE(read["title"].get<std::string>().find("\xef\xbf\xbd"), std::string::npos);
}

TEST(ViewWriter, WritesAnEmptyDocument) {
  const json read = json::parse(textOf({}));
  EXPECT_EQ(read["format"], "foretouch-view");
  EXPECT_EQ(read["version"], 1);
  EXPECT_EQ(read["avatars"], json::array());
  EXPECT_EQ(read.count("scene"), 0u);
  EXPECT_EQ(read.count("live"), 0u);
}

TEST(ViewWriter, WritesArraysOfAnyLengthBitForBit) {
  // 49,152 bytes are handed on at a time.
  for (const std::size_t count : {0u, 1u, 2u, 5u, 12'287u, 12'288u, 12'289u, 50'001u}) {
    ViewDocument document;
    document.scene.emplace();
    for (std::size_t i = 0; i < count; ++i) {
      document.scene->mesh.positions.push_back(0.1f * static_cast<float>(i) - 3.0f);
      document.scene->mesh.indices.push_back(static_cast<std::uint32_t>(i * 2654435761u));
    }
    const json scene = json::parse(textOf(document))["scene"];
    EXPECT_EQ(numbersOf<float>(scene["positions"], "f32"), document.scene->mesh.positions);
    EXPECT_EQ(numbersOf<std::uint32_t>(scene["indices"], "u32"), document.scene->mesh.indices);
  }
}

TEST(ViewWriter, SaysThatSimplifiedTrianglesAreNotTheScenes) {
  ViewDocument document;
  document.scene.emplace();
  EXPECT_EQ(json::parse(textOf(document))["scene"].count("triangle_ids"), 1u);
  document.scene->reduction = SceneReduction::Simplified;
  const json scene = json::parse(textOf(document))["scene"];
  EXPECT_EQ(scene["reduction"], "simplified");
  EXPECT_EQ(scene.count("triangle_ids"), 0u);
}

TEST(ViewerPage, HasOnePlaceForADocument) {
  const std::string_view page = viewerPage();
  const std::string_view marker = R"(<script type="application/json" id="foretouch-view">)";
  const std::size_t place = page.find(marker);
  ASSERT_NE(place, std::string_view::npos);
  EXPECT_EQ(page.find(marker, place + 1), std::string_view::npos);
  const PageParts parts = viewerPageParts();
  EXPECT_EQ(parts.before, page.substr(0, place + marker.size()));
  EXPECT_EQ(parts.after.substr(0, 9), "</script>");
  EXPECT_EQ(page.substr(page.size() - parts.after.size()), parts.after);
}

}  // namespace
}  // namespace foretouch::tools
