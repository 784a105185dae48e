// A robot's motion as arrays of numpy: what is read, and what is refused, of files that the test
// writes byte by byte.
#include "tools/inputs/npz_motion.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/tools/inputs/npz_bytes.h"
#include "tools/inputs/npz_arrays.h"

namespace foretouch::tools {
namespace {

using test::npyOf;
using test::npyOfTexts;
using test::npzOf;
using Contents = std::vector<std::pair<std::string, std::string>>;

/// Two rows of two joints, at 50 Hz.
Contents motion() {
  return {{"fps", npyOf<std::int64_t>("<i8", "()", {50})},
          {"root_pos", npyOf<double>("<f8", "(2, 3)", {1, 2, 3, 4, 5, 6})},
          {"root_rot_wxyz", npyOf<float>("<f4", "(2, 4)", {1, 0, 0, 0, 0, 0.6F, 0, 0.8F})},
          {"dof_pos", npyOf<double>("<f8", "(2, 2)", {0.1, 0.2, 0.3, 0.4})},
          {"joint_names", npyOfTexts({"knee", "hip"}, 5)}};
}

Contents with(const std::string& name, const std::string& content) {
  Contents all = motion();
  for (auto& [known, bytes] : all) {
    if (known == name) bytes = content;
  }
  return all;
}

Contents without(const std::string& name) {
  Contents all;
  for (const auto& entry : motion()) {
    if (entry.first != name) all.push_back(entry);
  }
  return all;
}

TEST(NpzMotion, ReadsRootJointsNamesAndRate) {
  for (const bool isDeflated : {false, true}) {
    const auto table = tableFromNpz(npzOf(motion(), isDeflated), {});
    ASSERT_TRUE(table.ok()) << describe(table.error());
    EXPECT_EQ(table.value().joints, (std::vector<std::string>{"knee", "hip"}));
    EXPECT_EQ(table.value().rows[1], (std::vector<double>{0.3, 0.4}));
    EXPECT_EQ(table.value().frameTimeS, 0.02);
    EXPECT_EQ(table.value().roots[1].translation, Eigen::Vector3d(4, 5, 6));
    EXPECT_NEAR(table.value().roots[1].rotation.z(), 0.8, 1e-7);
    EXPECT_NEAR(table.value().roots[1].rotation.w(), 0.0, 1e-7);
  }
}

TEST(NpzMotion, ReadsColumnsThatFortranWrote) {
  const std::string header = "{'descr': '<f8', 'fortran_order': True, 'shape': (2, 2), }";
  const std::string rows = npyOf<double>("<f8", "(2, 2)", {0.1, 0.3, 0.2, 0.4});
  const auto table =
      tableFromNpz(npzOf(with("dof_pos", npyOf(header, rows.substr(rows.size() - 32))), false), {});
  ASSERT_TRUE(table.ok()) << describe(table.error());
  EXPECT_EQ(table.value().rows[1], (std::vector<double>{0.3, 0.4}));
}

TEST(NpzMotion, TakesFromTheOptionsWhatTheFileDoesNotSay) {
  Contents bare = without("joint_names");
  bare.erase(bare.begin());
  bare[1] = {"root_rot", npyOf<double>("<f8", "(2, 4)", {0, 0, 0, 1, 0.6, 0, 0.8, 0})};
  JointTableOptions options;
  options.columns = {"knee", "hip"};
  options.rateHz = 100.0;
  const std::string bytes = npzOf(bare, false);
  const auto asked = tableFromNpz(bytes, options);
  ASSERT_FALSE(asked.ok());
  EXPECT_NE(describe(asked.error()).find("expected --quaternion to say"), std::string::npos);
  options.quaternion = QuaternionOrder::Xyzw;
  const auto twice = tableFromNpz(npzOf(motion(), false), options);
  ASSERT_FALSE(twice.ok());
  EXPECT_NE(describe(twice.error()).find("expected no --columns beside it"), std::string::npos);
  const auto table = tableFromNpz(bytes, options);
  ASSERT_TRUE(table.ok()) << describe(table.error());
  EXPECT_EQ(table.value().roots[1].rotation.x(), 0.6);
  EXPECT_EQ(table.value().frameTimeS, 0.01);
}

struct NpzRefusal {
  Contents contents;
  std::string says;
};

TEST(NpzMotion, RefusesByName) {
  const std::string wide = "{'descr': '<f8', 'fortran_order': False, 'shape': ";
  JointTableOptions rate;
  for (const NpzRefusal& refusal : std::vector<NpzRefusal>{
           {without("dof_pos"), "an array 'joint_pos'"},
           {without("joint_names"), "an array 'joint_names'"},
           {without("fps"), "how many rows a second"},
           {without("root_pos"), "both where the root is"},
           {with("fps", npyOf<double>("<f8", "()", {0.0})), "rows per second above 0"},
           {with("dof_pos", npyOf<double>("<f8", "(4,)", {1, 2, 3, 4})), "shape (rows, 2)"},
           {with("dof_pos", npyOf<double>("<f8", "(2, 2)", {1, 2, 3})), "24 bytes where"},
           {with("dof_pos", npyOf<double>(">f8", "(2, 2)", {1, 2, 3, 4})), "other machines"},
           {with("dof_pos", npyOf<double>("|O", "(2, 2)", {1, 2, 3, 4})), "Python's objects"},
           {with("dof_pos", npyOf<double>("<f8", "(2, 2)", {1, 2, std::nan(""), 4})), "value 2"},
           {with("dof_pos", npyOf(wide + "(99999999999, 99999999999), }", "")), "at most 16777216"},
           {with("dof_pos", npyOf(wide + "(2, ", "")), "header is not as numpy"},
           {with("dof_pos", "junk"), "header is not as numpy"},
           {with("root_rot_wxyz", npyOf<double>("<f8", "(2, 4)", {1, 0, 0, 0, 1, 1, 0, 0})),
            "the norm 1 within 0.001"},
       }) {
    const auto table = tableFromNpz(npzOf(refusal.contents, true), {});
    ASSERT_FALSE(table.ok()) << refusal.says;
    EXPECT_NE(describe(table.error()).find(refusal.says), std::string::npos)
        << describe(table.error()) << ", expected " << refusal.says;
  }
}

TEST(NpzMotion, DamageIsAnErrorOrFiniteNumbers) {
  int refused = 0, tried = 0;
  for (const bool isDeflated : {false, true}) {
    const std::string whole = npzOf(motion(), isDeflated);
    const auto judge = [&](const std::string& bytes) {
      ++tried;
      const auto table = tableFromNpz(bytes, {});
      if (!table.ok()) {
        ++refused;
        EXPECT_FALSE(table.error().message.empty());
        return;
      }
      for (const auto& row : table.value().rows) {
        for (const double number : row) EXPECT_TRUE(std::isfinite(number));
      }
    };
    for (std::size_t cut = 0; cut < whole.size(); cut += 3) judge(whole.substr(0, cut));
    for (std::size_t at = 0; at < whole.size(); ++at) {
      for (const char bits : {'\x01', '\x80', '\xff'}) {
        std::string bytes = whole;
        bytes[at] = static_cast<char>(bytes[at] ^ bits);
        judge(bytes);
      }
    }
  }
  EXPECT_GT(refused, tried / 2);  // most of a file is under a check sum
  EXPECT_LT(refused, tried);      // dates are not
}

}  // namespace
}  // namespace foretouch::tools
