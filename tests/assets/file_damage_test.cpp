// What is said of damaged files: where, what was expected, what was found.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <random>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "assets/import/model_import.h"
#include "assets/import/xml_damage.h"
#include "tests/assets/import_files.h"

namespace foretouch::test {
namespace {

using internal::damageOfXml;

/// The triangle of import_files.h with indices, in a GLB's own chunk of 44 bytes.
constexpr char kJson[] =
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"name":"a","children":[1]},{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],
"buffers":[{"byteLength":44}]})";

void appendWord(std::string& bytes, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(word >> shift);
}

std::string triangleBytes() {
  std::string bytes;
  constexpr std::uint32_t kOne = 0x3F800000;  // 1.0F
  for (const std::uint32_t word : {0U, 0U, 0U, kOne, 0U, 0U, 0U, kOne, 0U, 0x10000U, 2U}) {
    appendWord(bytes, word);
  }
  return bytes;
}

std::string glbOf(std::string json = kJson, const std::string& binary = triangleBytes()) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string glb = "glTF";
  const std::size_t chunk = binary.empty() ? 0 : 8 + binary.size();
  for (const std::size_t word : {std::size_t{2}, 20 + json.size() + chunk, json.size()}) {
    appendWord(glb, static_cast<std::uint32_t>(word));
  }
  glb += "JSON" + json;
  if (binary.empty()) return glb;
  appendWord(glb, static_cast<std::uint32_t>(binary.size()));
  return glb + std::string("BIN\0", 4) + binary;
}

/// The JSON with its first `from` replaced.
std::string replaced(const std::string& from, const std::string& to, std::string text = kJson) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

class FileDamage : public testing::Test {
 protected:
  /// Why the importer refuses it.
  std::string damageIn(const std::string& name, const std::string& bytes) {
    const std::string reason = reasonFor(name, bytes), refused = "the importer refused the file: ";
    return reason.rfind(refused, 0) == 0 ? reason.substr(refused.size()) : reason;
  }
  std::string reasonFor(const std::string& name, const std::string& bytes) {
    const auto result = importScene(folder_.write(name, bytes), withImporter());
    return result.ok() ? "none" : result.error().message;
  }
  TempFolder folder_;
};

TEST_F(FileDamage, IsNoneInSoundFiles) {
  EXPECT_EQ(reasonFor("a.glb", glbOf()), "none");
  EXPECT_EQ(damageIn("a.gltf", gltfWithNodes(R"([{"mesh":0,"children":[1]},{"mesh":1}])")), "none");
}

// What nobody reads may be broken: a file of textures that are not there has its triangles.
TEST_F(FileDamage, OfPartsThatAreNotReadIsNone) {
  for (const char* parts : {R"("images":[{"bufferView":9}],"materials":7,)",
                            R"("cameras":{},"textures":[{"source":-1}],)",
                            R"("skins":[{"joints":[0],"inverseBindMatrices":0}],)"}) {
    EXPECT_EQ(
        damageIn("a.glb", glbOf(replaced("{\"asset\"", std::string("{") + parts + "\"asset\""))),
        "none")
        << parts;
  }
}

TEST_F(FileDamage, OfAGlbContainerNamesTheByte) {
  const std::string sound = glbOf();
  const std::string size = std::to_string(sound.size());
  const auto with = [&](std::size_t at, const std::string& bytes) {
    std::string glb = sound;
    return glb.replace(at, bytes.size(), bytes);
  };
  EXPECT_EQ(damageIn("a.glb", with(0, "glTX")),
            "byte 0: expected 'glTF', as every GLB file begins, found 'glTX'");
  EXPECT_EQ(damageIn("a.glb", "glTF"),
            "byte 0: expected a header of 12 bytes and one of a chunk of 8 bytes, found a file of "
            "4 bytes");
  EXPECT_EQ(damageIn("a.glb", with(4, "\x07")), "byte 4: expected version 2, found 7");
  EXPECT_EQ(damageIn("a.glb", with(8, std::string("\x2A\0\0\0", 4))),
            "byte 8: expected the file's length of " + size + " bytes, found 42");
  EXPECT_EQ(damageIn("a.glb", with(16, "JSOX")),
            "byte 16: expected a chunk of type 'JSON', found 'JSOX'");
  const std::string cut = sound.substr(0, sound.size() - 10);
  const std::string binary = std::to_string(sound.size() - 52);
  EXPECT_EQ(damageIn("a.glb", cut),
            "byte 8: expected the file's length of " + std::to_string(cut.size()) +
                " bytes, found " + size + "; byte " + binary +
                ": expected a chunk of at most the 34 bytes that follow its header, found a length "
                "of 44");
  EXPECT_EQ(damageIn("a.glb", with(sound.size() - 48, "BIM")),
            "byte " + std::to_string(sound.size() - 48) +
                ": expected a chunk of type 'BIN' and a zero byte, found 'BIM\\x00'");
}

TEST_F(FileDamage, OfJsonNamesByteOrLine) {
  // The JSON begins at byte 20 of a GLB.
  const std::size_t at = std::string(kJson).find("\"count\":3");
  EXPECT_EQ(
      damageIn("a.glb", glbOf(replaced("\"count\":3", "\"count\";3"))),
      "byte " + std::to_string(20 + at + 7) +
          ": broken JSON, invalid literal; expected ':', near '5126,\"count\";3,\"type\":\"V'");
  EXPECT_EQ(damageIn("a.gltf", "{\n\"asset\": {\"version\": \"2.0\"},\n  oops}"),
            "line 3, column 3: broken JSON, invalid literal; expected string literal, near "
            "': \"2.0\"},\\x0a  oops}'");
  EXPECT_NE(damageIn("a.gltf", "{\n\"asset\":")
                .find("line 2, column 9: broken JSON, unexpected "
                      "end of input"),
            std::string::npos)
      << damageIn("a.gltf", "{\n\"asset\":");
  EXPECT_EQ(damageIn("a.gltf", "[1]"), "the JSON: expected an object, found a list of 1");
}

TEST_F(FileDamage, OfADocumentNamesTheKey) {
  const auto damage = [&](const std::string& from, const std::string& to) {
    return damageIn("a.glb", glbOf(replaced(from, to)));
  };
  EXPECT_EQ(damage(R"("bufferView":1)", R"("bufferView":7)"),
            "accessors[1].bufferView: expected the number of one of the 2 bufferViews, found 7");
  EXPECT_EQ(damage(R"("bufferView":1)", R"("bufferView":-1)"),
            "accessors[1].bufferView: expected the number of one of the 2 bufferViews, found -1");
  EXPECT_EQ(damage(R"("mesh":0)", R"("mesh":"x")"),
            "nodes[1].mesh: expected the number of one of the 1 meshes, found 'x'");
  EXPECT_EQ(damage(R"("componentType":5126,)", ""),
            "accessors[0].componentType: expected this key, found none");
  EXPECT_EQ(damage("5126", "5127"),
            "accessors[0].componentType: expected one of 5120, 5121, 5122, 5123, 5125, 5126, "
            "found 5127");
  EXPECT_EQ(damage("VEC3", "VEC9"),
            "accessors[0].type: expected one of SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3, MAT4, found "
            "'VEC9'");
  EXPECT_EQ(damage("VEC3", "VEC2"),
            "meshes[0].primitives[0].attributes.'POSITION': expected an accessor of type VEC3, "
            "found accessors[0] of type VEC2");
  EXPECT_EQ(damage("\"meshes\"", "\"mesh\u00e9s\""),
            "nodes[1].mesh: expected the number of one of the 0 meshes, found 0");
  EXPECT_EQ(damage(R"("indices":1)", R"("indices":1,"mode":9)"),
            "meshes[0].primitives[0].mode: expected a whole number from 0 to 6, found 9");
  EXPECT_EQ(damage("POSITION", "POSITIOM"),
            "meshes[0].primitives[0].attributes.POSITION: expected this key, found none");
  EXPECT_EQ(damage(R"("2.0")", R"("9.0")"), "asset.version: expected the text 2.0, found '9.0'");
  EXPECT_EQ(damage("\"asset\"", "\"assat\""), "asset: expected this key, found none");
  EXPECT_EQ(damage("[1]", "[0]"),
            "nodes[0].children[0]: expected a node that is no other's child, found 0, itself");
  EXPECT_EQ(damage(R"({"mesh":0})", R"({"mesh":0,"children":[0]})"),
            "nodes[0]: expected a tree, found its own ancestor");
}

TEST_F(FileDamage, OfExtentsNamesWhatDoesNotFit) {
  const auto damage = [&](const std::string& from, const std::string& to) {
    return damageIn("a.glb", glbOf(replaced(from, to)));
  };
  EXPECT_EQ(damage(R"("count":3)", R"("count":4)"),
            "accessors[0]: expected elements within the 36 bytes of bufferViews[0], found 4 of "
            "them, 12 bytes apart, from byte 0 on");
  EXPECT_EQ(damage(R"("count":3)", R"("count":18446744073709551615)"),
            "accessors[0]: expected elements within the 36 bytes of bufferViews[0], found "
            "18446744073709551615 of them, 12 bytes apart, from byte 0 on");
  EXPECT_EQ(damage(R"("byteOffset":36)", R"("byteOffset":40)"),
            "bufferViews[1]: expected bytes within the 44 bytes of buffers[0], found 6 bytes from "
            "byte 40 on");
  // Not where the format wants it, but it is there: 0, 256 and 512 are read, of three vertices.
  EXPECT_EQ(
      damage(R"("byteOffset":36)", R"("byteOffset":35)"),
      "expected triangles, found none (0 points and lines, 1 faces with indices out of range)");
  EXPECT_EQ(damage(R"("byteLength":44)", R"("byteLength":45)"),
            "buffers[0].byteLength: expected at most the 44 bytes of the file's binary chunk, "
            "found 45");
  EXPECT_EQ(
      damageIn("a.glb", glbOf(kJson, "")),
      "buffers[0]: expected a binary chunk in the file, as the buffer has no uri, found none");
  EXPECT_EQ(damageIn("a.gltf", kJson), "buffers[0]: expected a uri, found none");
  const std::string beside = replaced(R"("byteLength":44)", R"("byteLength":44,"uri":"a%20b.bin")");
  EXPECT_EQ(damageIn("a.gltf", beside),
            "buffers[0].uri: expected a file beside this one, found 'a b.bin': No such file or "
            "directory");
  folder_.write("a b.bin", "short");
  EXPECT_EQ(damageIn("a.gltf", beside),
            "buffers[0].byteLength: expected at most the 5 bytes of the file 'a b.bin', found 44");
  folder_.write("a b.bin", triangleBytes());
  EXPECT_EQ(damageIn("a.gltf", beside), "none");
  EXPECT_EQ(damageIn("a.gltf", replaced(R"("byteLength":44)",
                                        R"("byteLength":44,"uri":"data:a/b;base64,AAAA")")),
            "buffers[0].byteLength: expected at most the 3 bytes of its data URI, found 44");
}

TEST(XmlDamage, NamesTheLine) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"<a>\n <b/>\n <c x='1' y=\"2\">text &amp; <![CDATA[<]]></c>\n <!-- < --></a>\n", ""},
      {"\xEF\xBB\xBF<?xml version=\"1.0\"?>\n<!DOCTYPE a [<!ENTITY b \"c\">]>\n<a/>", ""},
      {"<a>\n<b>\n</a>", "line 3: expected </b>, which closes line 2, found </a>"},
      {"<a>\n<b>\n", "line 3: expected </b>, which closes line 2, found the end"},
      {"<a>\n<b", "line 2: expected an attribute, /> or > in <b>, found the end"},
      {"<a>\n<b c></b></a>", "line 2: expected = after 'c' in <b>, found '>'"},
      {"<a>\n<b c=1/></a>", "line 2: expected a value in quotes for 'c' in <b>, found '1'"},
      {"<a>\n<b c=\"1/>\n</a>",
       "line 2: expected a closing quote after the value of 'c' in <b>, found '<'"},
      {"<a>\n<b c=\"1\"d=\"2\"/></a>", "line 2: expected a blank in <b>, found 'd'"},
      {"<a>\n< b/></a>", "line 2: expected a name after <, found ' '"},
      {"<a>\n<!-- b </a>", "line 2: expected --> after this comment, found none"},
      {"<a>\n</a b>", "line 2: expected > after </a, found 'b'"},
      {"<a/>\n<b/>", "line 2: expected nothing after the first element, found <b>"},
      {"<a/>\n</b>", "line 2: expected no closing tag, as nothing is open, found </b>"},
      {"\nwords", "line 2: expected an element, found text outside of all: 'words'"},
      {"\n \n", "line 3: expected an element, found the end"},
      {std::string("<a>\n\0</a>", 9), "line 2: expected text, found a zero byte"},
      {std::string("\xFF\xFE<\0a\0/\0>\0", 10), ""},  // UTF-16 is not looked into
  };
  for (const auto& [text, expected] : cases) EXPECT_EQ(damageOfXml(text), expected) << text;
}

// Nothing of a text may be closed twice, or left out, without a line.
TEST(XmlDamage, IsFoundInEveryCutOfAnElement) {
  const std::string text = "<a>\n<b c='1'>\n<d/>text</b>\n</a>";
  EXPECT_EQ(damageOfXml(text), "");
  for (std::size_t size = 0; size < text.size(); ++size) {
    EXPECT_EQ(damageOfXml(text.substr(0, size)).rfind("line ", 0), 0u) << size;
  }
}

TEST_F(FileDamage, OfColladaNamesTheLine) {
  const std::string dae =
      "<?xml version=\"1.0\"?>\n<COLLADA version=\"1.4.1\">\n<asset>\n</COLLADA>\n";
  EXPECT_EQ(reasonFor("a.dae", dae),
            "the importer refused the file: line 4: expected </asset>, which closes line 3, found "
            "</COLLADA>");
}

/// Cuts, flipped bits, other lengths, other numbers, lost text and zeroed bytes.
std::string mutated(std::string bytes, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
  const std::size_t jsonEnd = bytes.size() - 52;
  switch (below(6)) {
    case 0: return bytes.substr(0, 1 + below(bytes.size() - 1));
    case 1:
      for (std::size_t i = below(3); i < 3; ++i) {
        bytes[below(jsonEnd + 8)] ^= static_cast<char>(1U << below(8));
      }
      return bytes;
    case 2: {
      std::string word;
      appendWord(word, static_cast<std::uint32_t>(random()));
      const std::size_t at = std::vector<std::size_t>{8, 12, jsonEnd}[below(3)];
      return bytes.replace(at, 4, word);
    }
    case 3: {
      const std::size_t digit = bytes.find_first_of("0123456789", 20 + below(jsonEnd - 40));
      return bytes.replace(digit, 1, 1, static_cast<char>('0' + below(10)));
    }
    case 4: return bytes.erase(20 + below(jsonEnd - 20), 1 + below(20));
    default: return bytes.replace(below(jsonEnd), 1 + below(30), 8, '\0');
  }
}

// Every refusal says where.
TEST_F(FileDamage, IsNamedInEveryRefusalOfADamagedGlb) {
  const std::regex named(
      R"re(the importer refused the file: (byte \d+|[A-Za-z]+(\[\d+\])?(\.[^: ]+)*): .*(expected|broken JSON).*)re");
  int refused = 0, unnamed = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    const std::string reason = reasonFor("a.glb", mutated(glbOf(), random));
    if (reason == "none" || reason.rfind("expected triangles", 0) == 0) continue;
    ++refused;
    if (std::regex_match(reason, named)) continue;
    ++unnamed;
    ADD_FAILURE() << "seed " << seed << ": " << reason;
  }
  EXPECT_GT(refused, 150);
  EXPECT_EQ(unnamed, 0);
}

}  // namespace
}  // namespace foretouch::test
