// Baked scenes: the same scene bit for bit, whatever is done to the file, refused by name, and no
// stranger's numbers lead a query out of it.
#define XXH_INLINE_ALL
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>
#include <xxhash.h>

#include <gtest/gtest.h>

#include "assets/import/scene_import.h"
#include "middleware/scene/scene_parts.h"
#include "tests/assets/import_files.h"
#include "tests/support/holds.h"

namespace foretouch::test {
namespace {

namespace fs = std::filesystem;
using internal::BvhLeaf;
using internal::BvhNode;
using internal::SceneParts;

/// A file as docs/formats.md has it, to plant lies in.
class BakedBytes {
 public:
  explicit BakedBytes(std::string bytes) : bytes_(std::move(bytes)) {
    const auto after = [](std::size_t place, std::size_t size) {
      return (place + size + 63) / 64 * 64;
    };
    triangles = after(kHeader, number(72));
    nodes = after(triangles, numTriangles() * 72);
    leaves = after(nodes, number(40) * sizeof(BvhNode));
    clusters = after(leaves, number(48) * sizeof(BvhLeaf));
    objects = after(clusters, number(48) * 16);
    orders = after(after(objects, numTriangles() * 4), numTriangles() * 2);
  }
  static constexpr std::size_t kHeader = 320;
  [[nodiscard]] std::size_t numTriangles() const { return number(32); }
  [[nodiscard]] std::uint64_t number(std::size_t at) const { return get<std::uint64_t>(at); }
  template <typename T>
  [[nodiscard]] T get(std::size_t at) const {
    T value;
    std::memcpy(&value, bytes_.data() + at, sizeof value);
    return value;
  }
  template <typename T>
  BakedBytes& set(std::size_t at, const T& value) {
    std::memcpy(bytes_.data() + at, &value, sizeof value);
    return *this;
  }
  template <typename T>
  BakedBytes& change(std::size_t at, const std::function<void(T&)>& how) {
    T value = get<T>(at);
    how(value);
    return set(at, value);
  }
  /// With a check sum that says that it is whole.
  [[nodiscard]] std::string signedAnew() {
    set(16, std::uint64_t{XXH3_64bits(bytes_.data() + 24, bytes_.size() - 24)});
    return bytes_;
  }

  std::size_t triangles, nodes, leaves, clusters, objects, orders;

 private:
  std::string bytes_;
};

class BakedScene : public testing::Test {
 protected:
  void SetUp() override {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> at(-3.0, 3.0), by(-0.2, 0.2);
    std::string obj = "mtllib none.mtl\n";
    for (int i = 0; i < 700; ++i) {
      const double x = at(random), y = at(random), z = at(random);
      if (i % 100 == 0) obj += "o part" + std::to_string(i) + "\n";
      for (int k = 0; k < 3; ++k) {
        obj += "v " + std::to_string(x + by(random)) + " " + std::to_string(y + by(random)) + " " +
               std::to_string(z + by(random)) + "\n";
      }
      obj += "f -3 -2 -1\n";
    }
    source_ = folder_.write("room.obj", obj + "v -0.0 0 0\nv 0 -0.0 0\nv 0 0 1\nf -1 -2 -3\n");
    options_ = withImporter();
    options_.scale = 0.5;
    options_.up = UpAxis::Z;
    const auto baked = bakeScene(source_, options_, baked_);
    ASSERT_TRUE(baked.ok()) << describe(baked.error());
    bytes_ = contentOf(baked_);
  }

  [[nodiscard]] LoadedScene read(const std::string& path) const {
    auto loaded = readScene(path, options_);
    EXPECT_TRUE(loaded.ok()) << describe(loaded.error());
    return std::move(loaded).value();
  }
  /// Empty where it was read.
  [[nodiscard]] std::string refusalOf(const std::string& bytes) const {
    const auto loaded = readScene(folder_.write("changed.ftscene", bytes));
    if (loaded.ok()) return "";
    EXPECT_TRUE(holds(loaded.error().message, "expected a baked scene") ||
                holds(loaded.error().message, "expected the parts of a scene"))
        << loaded.error().message;
    EXPECT_TRUE(holds(loaded.error().file, "changed.ftscene"));
    return loaded.error().message;
  }
  [[nodiscard]] BakedBytes planted() const { return BakedBytes(bytes_); }

  TempFolder folder_;
  SceneImportOptions options_;
  std::string source_, baked_ = folder_ / "room.ftscene", bytes_;
};

template <typename Array>
bool areSame(const Array& one, const Array& other) {
  return one.size() == other.size() &&
         std::memcmp(one.data(), other.data(), one.size() * sizeof(*one.data())) == 0;
}

TEST_F(BakedScene, IsTheSceneOfItsSourceBitForBit) {
  const LoadedScene fresh = read(source_), baked = read(baked_);
  const SceneParts &one = fresh.scene.parts(), &other = baked.scene.parts();
  EXPECT_TRUE(areSame(one.triangles, other.triangles));
  EXPECT_TRUE(areSame(one.objectOf, other.objectOf));
  EXPECT_TRUE(areSame(one.bvh.arrays().nodes, other.bvh.arrays().nodes));
  EXPECT_TRUE(areSame(one.bvh.arrays().leaves, other.bvh.arrays().leaves));
  EXPECT_TRUE(areSame(one.bvh.arrays().clusters, other.bvh.arrays().clusters));
  EXPECT_TRUE(areSame(one.flatEdges().bits(), other.flatEdges().bits()));
  EXPECT_EQ(one.bvh.vertexRounding(), other.bvh.vertexRounding());
  EXPECT_EQ(one.bvh.origin(), other.bvh.origin());
  EXPECT_EQ(one.objectNames, other.objectNames);
  EXPECT_EQ(one.audit.triangles, other.audit.triangles);
  EXPECT_EQ(one.audit.boxMax, other.audit.boxMax);
  EXPECT_EQ(one.audit.shortestEdge, other.audit.shortestEdge);
  EXPECT_EQ(fresh.report.nodes, baked.report.nodes);
  EXPECT_EQ(fresh.report.notes, baked.report.notes);
  EXPECT_EQ(baked.frame.metresPerUnit, 0.5);
  EXPECT_EQ(baked.frame.up, UpAxis::Z);
  EXPECT_TRUE(baked.frame.isUnitAsked);
  EXPECT_EQ(describe(fresh.frame), describe(baked.frame));
  EXPECT_TRUE(checkScene(baked.scene).ok());
}

TEST_F(BakedScene, GivesTheTrianglesAsTheyCame) {
  const auto fresh = importScene(source_, options_), baked = importScene(baked_);
  ASSERT_TRUE(fresh.ok() && baked.ok());
  EXPECT_TRUE(areSame(fresh.value().scene.triangles, baked.value().scene.triangles));
  EXPECT_EQ(fresh.value().scene.objectOf, baked.value().scene.objectOf);
  EXPECT_EQ(fresh.value().scene.objectNames, baked.value().scene.objectNames);
}

/// Triangles that are not finite have no place in the tree, and keep their numbers.
TEST_F(BakedScene, KeepsWhatHasNoPlace) {
  const std::string source =
      folder_.write("odd.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nf 4 1 2\nf 1 2 3\nf 1 2 4\n");
  const auto baked = bakeScene(source, withImporter(), folder_ / "odd.ftscene");
  ASSERT_TRUE(baked.ok()) << describe(baked.error());
  const auto loaded = readScene(folder_ / "odd.ftscene");
  ASSERT_TRUE(loaded.ok()) << describe(loaded.error());
  const auto kept = baked.value().scene.audit().droppedNonFinite;
  EXPECT_EQ(loaded.value().scene.audit().droppedNonFinite, kept);
  EXPECT_EQ(loaded.value().scene.numTriangles(), baked.value().scene.numTriangles());
  EXPECT_TRUE(checkScene(loaded.value().scene).ok());
}

TEST_F(BakedScene, IsReadAsACopyWhereOthersMayWriteIt) {
  fs::permissions(baked_, fs::perms::others_write, fs::perm_options::add);
  EXPECT_TRUE(areSame(read(source_).scene.parts().triangles, read(baked_).scene.parts().triangles));
}

TEST_F(BakedScene, RefusesEveryDamage) {
  for (std::size_t i = 8; i < bytes_.size(); i += i < 400 ? 1 : 997) {
    std::string damaged = bytes_;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    EXPECT_NE(refusalOf(damaged), "") << i;
  }
  for (const std::size_t size : {bytes_.size() - 1, bytes_.size() / 2, std::size_t{320},
                                 std::size_t{319}, std::size_t{9}, std::size_t{8}}) {
    EXPECT_NE(refusalOf(bytes_.substr(0, size)), "") << size;
  }
  EXPECT_NE(refusalOf(bytes_ + "x"), "");
}

TEST_F(BakedScene, RefusesOtherLayoutsByName) {
  EXPECT_TRUE(holds(refusalOf(planted().set(12, std::uint32_t{2}).signedAnew()), "version"));
  EXPECT_TRUE(
      holds(refusalOf(planted().set(8, std::uint32_t{0x04030201}).signedAnew()), "machine"));
}

/// Whoever wrote the check sum anew could write anything else.
TEST_F(BakedScene, RefusesWhatWouldLeadAQueryOutOfIt) {
  ASSERT_EQ(refusalOf(planted().signedAnew()), "");
  constexpr auto kHuge = std::numeric_limits<std::uint64_t>::max();
  for (const std::size_t count : {32, 40, 48, 56, 64, 72}) {
    for (const std::uint64_t value :
         {std::uint64_t{0}, kHuge, kHuge / 72, std::uint64_t{1} << 40}) {
      if (value == planted().number(count)) continue;
      EXPECT_NE(refusalOf(planted().set(count, value).signedAnew()), "") << count << ' ' << value;
    }
  }
  const BakedBytes whole = planted();
  const auto root = whole.get<BvhNode>(whole.nodes);
  ASSERT_EQ(root.child[1] & BvhNode::kLeafFlag, 0U) << "of a tree of two levels or more";
  const auto withChild = [&](std::uint32_t child) {
    return refusalOf(planted()
                         .change<BvhNode>(whole.nodes, [&](BvhNode& n) { n.child[1] = child; })
                         .signedAnew());
  };
  EXPECT_NE(withChild(0), "") << "no child, and yet a box";
  EXPECT_NE(withChild(root.child[0]), "") << "two ways to a node, and none to another";
  EXPECT_NE(withChild(0x00ffffff), "");
  EXPECT_NE(withChild(BvhNode::kLeafFlag | BvhNode::kLeafMask), "");
  for (const float number : {std::nanf(""), HUGE_VALF, 1e30F}) {
    EXPECT_NE(
        refusalOf(planted()
                      .change<BvhNode>(whole.nodes, [&](BvhNode& n) { n.lower[0][0] = number; })
                      .signedAnew()),
        "");
    EXPECT_NE(refusalOf(planted()
                            .change<BvhLeaf>(whole.leaves,
                                             [&](BvhLeaf& leaf) { leaf.vertex[0][0][0] = number; })
                            .signedAnew()),
              "");
    EXPECT_NE(refusalOf(planted().set(whole.clusters + 12, number).signedAnew()), "");
    EXPECT_NE(refusalOf(planted().set(80, double{number}).signedAnew()), "") << "origin";
    EXPECT_NE(refusalOf(planted().set(104, double{number}).signedAnew()), "") << "rounding";
  }
  for (const TriangleId id : {-2, 701, 1 << 30, whole.get<BvhLeaf>(whole.leaves).id[1]}) {
    EXPECT_NE(refusalOf(planted().set(whole.leaves + 288, id).signedAnew()), "") << id;
  }
  for (const ObjectId object : {-1, 1000}) {
    EXPECT_NE(refusalOf(planted().set(whole.objects, object).signedAnew()), "");
  }
  for (const double number : {1e8, std::nan("")}) {
    EXPECT_NE(refusalOf(planted().set(whole.triangles + 8, number).signedAnew()), "") << number;
  }
  EXPECT_NE(refusalOf(planted().set(BakedBytes::kHeader, std::uint32_t{1 << 30}).signedAnew()), "");
}

/// Of triangles that its tree hides, checkScene() knows.
TEST_F(BakedScene, IsCheckedForTrianglesThatItsTreeHides) {
  const BakedBytes whole = planted();
  const auto isHiding = [&](BakedBytes bytes) {
    const auto loaded = readScene(folder_.write("lies.ftscene", bytes.signedAnew()));
    EXPECT_TRUE(loaded.ok()) << describe(loaded.error());
    return loaded.ok() && !checkScene(loaded.value().scene).ok();
  };
  EXPECT_FALSE(isHiding(planted()));
  EXPECT_TRUE(isHiding(planted().change<BvhNode>(whole.nodes, [](BvhNode& node) {
    node.upper[0][0] = std::nextafter(node.lower[0][0], 9.F);
  })));
  EXPECT_TRUE(isHiding(planted().change<BvhLeaf>(
      whole.leaves, [](BvhLeaf& leaf) { leaf.vertex[1][1][0] += 0.01F; })));
  EXPECT_TRUE(isHiding(planted().set(whole.clusters + 12, 0.0F)));
  EXPECT_TRUE(isHiding(planted().set(104, 0.0)));
  EXPECT_TRUE(isHiding(
      planted().change<std::array<double, 9>>(whole.triangles, [](std::array<double, 9>& t) {
        std::swap_ranges(t.begin(), t.begin() + 3, t.begin() + 6);
      })));
}

TEST_F(BakedScene, StandsForItsSourceAsItWas) {
  const auto then = fs::last_write_time(baked_);
  const std::string text = contentOf(source_);
  fs::last_write_time(source_, then + std::chrono::seconds(5));
  EXPECT_TRUE(readScene(baked_).ok()) << "written anew, and the same";
  std::string changed = text;
  changed[text.find("v ") + 2] = '1';
  folder_.write("room.obj", changed);
  fs::last_write_time(source_, then + std::chrono::seconds(5));
  auto loaded = readScene(baked_);
  ASSERT_FALSE(loaded.ok());
  EXPECT_TRUE(holds(loaded.error().message, "was baked from 'room.obj', which has changed since"));
  EXPECT_EQ(loaded.error().code, ErrorCode::Mismatch);
  folder_.write("room.obj", text + "\n");
  fs::last_write_time(source_, then - std::chrono::seconds(5));
  EXPECT_FALSE(readScene(baked_).ok()) << "of another size";
  EXPECT_FALSE(importScene(baked_).ok());
  fs::remove(source_);
  EXPECT_TRUE(readScene(baked_).ok()) << "it is gone";
}

TEST_F(BakedScene, IsReadAsItWasBakedAndNoOtherWay) {
  SceneImportOptions options;
  EXPECT_TRUE(readScene(baked_, options).ok());
  options.scale = 1.0;
  auto loaded = readScene(baked_, options);
  ASSERT_FALSE(loaded.ok());
  EXPECT_TRUE(holds(loaded.error().message,
                    "was baked with 0.5 m per unit and z up; expected the same, found 1 m"));
  options.scale = 0.5;
  options.up = UpAxis::Y;
  loaded = readScene(baked_, options);
  ASSERT_FALSE(loaded.ok());
  EXPECT_TRUE(holds(loaded.error().message, "found y"));
}

TEST_F(BakedScene, IsNoModelToBake) {
  const auto again = bakeScene(baked_, {}, folder_ / "again.ftscene");
  ASSERT_FALSE(again.ok());
  EXPECT_TRUE(holds(again.error().message, "expected the file of a model"));
  EXPECT_FALSE(bakeScene(source_, withImporter(), folder_ / "no/such/folder").ok());
}

}  // namespace
}  // namespace foretouch::test
