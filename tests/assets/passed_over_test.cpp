// What files hold and no reader of ours uses: never silent.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "assets/import/model_import.h"
#include "assets/import/scene_import.h"
#include "tests/assets/import_files.h"
#include "tests/support/temp_folder.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

class PassedOver : public testing::Test {
 protected:
  ImportedScene written(const std::string& name, const std::string& content) {
    auto scene = importScene(folder_.write(name, content), withImporter());
    EXPECT_TRUE(scene.ok()) << describe(scene.error());
    return scene.ok() ? std::move(scene).value() : ImportedScene{};
  }
  TempFolder folder_;
};

TEST_F(PassedOver, OfObjAreSurfacesThatAreNoPolygons) {
  const std::string obj(kTriangleObj);
  for (const char* word :
       {"curv", "curv2", "surf", "bsp", "bzp", "cdc", "cdp", "res", "call", "csh"}) {
    const auto scene =
        written("a.obj", obj + "  " + word + " 1 2 3 4\n" + word + " 4 3 2 1\r\n# " + word + "\n");
    ASSERT_EQ(scene.report.notes.size(), 1U) << word;
    EXPECT_EQ(scene.report.notes[0].rfind("2 times '" + std::string(word) + "': ", 0), 0U)
        << scene.report.notes[0];
    EXPECT_EQ(scene.scene.triangles.size(), 1U);
  }
  EXPECT_TRUE(written("b.obj", "mtllib a.mtl\no x\ng y\nusemtl z\ns 1\nc_interp on\n" + obj)
                  .report.notes.empty());
  EXPECT_EQ(written("c.obj", obj + "l 1 2\np 1\n").report.notes,
            (std::vector<std::string>{"2 points and lines are left out: they have no surface"}));
}

std::string plyWith(const std::string& elements, const std::string& data) {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
         "property float z\n" +
         elements + "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n" + data;
}

TEST_F(PassedOver, OfPlyAreElementsThatAreNoFaces) {
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
  const std::string edges = "element edge 1\nproperty int vertex1\nproperty int vertex2\n";
  EXPECT_TRUE(written("a.ply", plyWith(faces, "3 0 1 2\n")).report.notes.empty());
  EXPECT_EQ(written("b.ply", plyWith(faces + edges, "3 0 1 2\n0 1\n")).report.notes,
            (std::vector<std::string>{"elements 'edge' are left out"}));
  // assimp makes one triangle of a strip of two.
  const auto strips = importScene(
      folder_.write("c.ply", plyWith("element tristrips 1\nproperty list int int vertex_indices\n",
                                     "4 0 1 2 3\n")),
      withImporter());
  ASSERT_FALSE(strips.ok());
  EXPECT_NE(strips.error().message.find("line 7: expected faces one by one"), std::string::npos)
      << strips.error().message;
}

// What assimp would read as another surface, or lose.
TEST_F(PassedOver, WhatWouldMoveOrLoseSurfacesIsRefusedByItsLine) {
  const std::string head = "v 0 0 0\nv 1 0 0\n", faces = "v 1 2 0\nv 0 2 3\nf 1 2 3\n";
  const std::string behind = "property float x\nproperty float y\nproperty float z\n";
  const std::string camera = "element camera 1\nproperty float f\n";
  const std::string ply = "ply\nformat ascii 1.0\n", vertex = "element vertex 3\n" + behind;
  const std::string face = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string rows = "0 0 0\n1 0 0\n0 1 0\n";
  struct Lost {
    std::string name, text, line;
  };
  for (const Lost& lost :
       {Lost{"a.obj", head + faces + "  f 1 3 4\n", "line 6: expected 'f' where"},
        Lost{"b.obj", head + "\tv 1 2 0\nv 0 2 3\nf 1 2 3\n", "line 3: expected 'v' where"},
        Lost{"c.obj", head + "v 1 .5 0\n" + faces, "line 3: expected a digit"},
        Lost{"d.obj", head + "v 0x1 0 0\n" + faces, "line 3: expected decimal numbers"},
        Lost{"e.obj", "\xEF\xBB\xBF" + head + faces, "line 1: expected no byte order mark"},
        Lost{"a.ply", ply + camera + vertex + face + "1.5\n" + rows + "3 0 1 2\n",
             "line 3: expected the elements vertex and face first, found 'camera'"},
        Lost{"b.ply", ply + vertex + camera + face + rows + "1.5\n3 0 1 2\n",
             "line 7: expected the elements vertex and face first, found 'camera'"}}) {
    const auto scene = importScene(folder_.write(lost.name, lost.text), withImporter());
    ASSERT_FALSE(scene.ok()) << lost.text;
    EXPECT_NE(scene.error().message.find(lost.line), std::string::npos) << scene.error().message;
  }
  // These are read.
  EXPECT_EQ(written("f.obj", head + "v 1 -.5 +0.5e1\n" + faces).scene.triangles.size(), 1U);
}

TEST_F(PassedOver, OfStlIsNothingWhateverTheCaseOfItsWords) {
  const std::string stl =
      "SOLID Big Room\nFACET NORMAL 0 0 1\n OUTER LOOP\n  VERTEX -2.0E+00 0 0\n  VERTEX 1 0 0\n"
      "  VERTEX 0 1 3.5\n ENDLOOP\nENDFACET\nENDSOLID Big Room\n";
  for (const std::string& text : {stl, "Solid" + stl.substr(5)}) {
    const auto scene = written("a.stl", text);
    ASSERT_EQ(scene.scene.triangles.size(), 1U);
    EXPECT_EQ(scene.scene.triangles[0].vertices[0], Vector3d(-2, 0, 0));
    EXPECT_EQ(scene.scene.triangles[0].vertices[2], Vector3d(0, 1, 3.5));
    EXPECT_TRUE(scene.report.notes.empty());
  }
}

TEST_F(PassedOver, OfColladaIsWhatIsNoMesh) {
  const std::string dae = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1"/><up_axis>Y_UP</up_axis></asset>
<library_geometries>
<geometry id="s"><spline closed="false"></spline></geometry>
<geometry id="m"><mesh><source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 1 0</float_array>
<technique_common><accessor source="#pa" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="w"><node id="n"><instance_geometry url="#m"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#w"/></scene></COLLADA>
)";
  EXPECT_EQ(written("a.dae", dae).report.notes,
            (std::vector<std::string>{"1 times '<spline': geometry that is no mesh is left out"}));
}

}  // namespace
}  // namespace foretouch::test
