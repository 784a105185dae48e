// Programs that are older or newer than the library.
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <foretouch/solid.h>
#include <foretouch/world.h>
#include <limits>
#include <string>
#include <vector>

#include "tests/bindings/c_world.h"

namespace foretouch {
namespace {

/// A struct as a newer program has it: `more` bytes longer.
template <typename Struct>
struct Newer {
  Struct known;
  unsigned char more[16];
};

TEST(CVersions, AreThoseOfTheLibrary) {
  EXPECT_STREQ(ft_version(), FORETOUCH_VERSION);
  EXPECT_EQ(ft_abi_version(), static_cast<std::uint32_t>(FT_ABI_VERSION));
  EXPECT_EQ(FT_CHECK_ABI(), FT_OK);
  EXPECT_EQ(ft_check_abi(0), FT_OK);  // an older program
  test::expectRefused(ft_check_abi(FT_ABI_VERSION + 1), FT_ERROR_ABI_VERSION,
                      {"ft_check_abi", FORETOUCH_VERSION});
}

TEST(CVersions, AnOlderProgramGetsDefaultsForWhatItDoesNotKnow) {
  test::SmallWorld world;
  ft_query_options options = test::initialised(ft_query_options_init);
  options.tolerance = 0.5;
  options.work_budget = 0;  // beyond what the older program has
  options.scope = 99;       // likewise
  options.ignored_count = 12345;
  options.size = 16;  // size, fidelity, tolerance
  const auto query = test::makeQuery(world.scene, world.avatar, &options);
  ASSERT_NE(query, nullptr);
  const ft_pose up = world.up(), lowered = world.lowered();
  ASSERT_EQ(ft_query_step(query.get(), &up, &lowered), FT_OK);
  ft_contact contact{};
  contact.size = sizeof contact;
  ASSERT_EQ(ft_query_links(query.get(), &contact, 1, nullptr), FT_OK);
  EXPECT_EQ(contact.verdict, FT_VERDICT_CONTACT);  // not undecided, as by a budget of nothing
  EXPECT_LE(contact.separation, 0.5);
}

TEST(CVersions, AProgramOlderThanPassSeparatingDoesNotPass) {
  test::SmallWorld world;
  ft_query_options options = test::initialised(ft_query_options_init);
  constexpr std::size_t kOlder = offsetof(ft_query_options, pass_separating);
  options.size = kOlder;
  options.pass_separating = options.reserved_end = 77;  // beyond what the older program has
  EXPECT_NE(test::makeQuery(world.scene, world.avatar, &options), nullptr);
  ASSERT_EQ(ft_query_options_init(&options, kOlder), FT_OK);
  EXPECT_EQ(options.pass_separating, 77) << "written past the end";
}

TEST(CVersions, AnOlderProgramsStructsAreNotWrittenPastTheirEnd) {
  test::SmallWorld world;
  ft_scene_info info;
  std::memset(&info, 0x5a, sizeof info);
  info.size = 16;  // size, object_count, triangles
  ASSERT_EQ(ft_scene_get_info(world.scene.get(), &info), FT_OK);
  EXPECT_EQ(info.size, 16u);
  EXPECT_EQ(info.object_count, 1);
  EXPECT_EQ(info.triangles, 2u);
  EXPECT_EQ(info.dropped_non_finite, 0x5a5a5a5a5a5a5a5au);

  ft_query_options options;
  std::memset(&options, 0x5a, sizeof options);
  ASSERT_EQ(ft_query_options_init(&options, 16), FT_OK);
  EXPECT_EQ(options.size, 16u);
  EXPECT_EQ(options.tolerance, 1e-3);
  EXPECT_EQ(options.work_budget, 0x5a5a5a5a5a5a5a5au);
}

TEST(CVersions, ContactsLieAsTheProgramHasThem) {
  test::SmallWorld world;
  const auto query = test::makeQuery(world.scene, world.avatar);
  const ft_pose up = world.up(), lowered = world.lowered();
  ASSERT_EQ(ft_query_step(query.get(), &up, &lowered), FT_OK);
  constexpr std::size_t kOldSize = 24, kNewSize = sizeof(ft_contact) + 24;
  for (const std::size_t size : {kOldSize, sizeof(ft_contact), kNewSize}) {
    std::vector<unsigned char> bytes(2 * kNewSize, 0x5a);
    const auto said = static_cast<std::uint32_t>(size);
    std::memcpy(bytes.data(), &said, sizeof said);
    auto* const contacts = reinterpret_cast<ft_contact*>(bytes.data());
    ASSERT_EQ(ft_query_links(query.get(), contacts, 1, nullptr), FT_OK);
    EXPECT_EQ(contacts->verdict, FT_VERDICT_CONTACT);
    EXPECT_GT(contacts->toi, 0.6);
    EXPECT_EQ(bytes[size], 0x5a) << "written past the end";
    if (size == kNewSize) {
      EXPECT_EQ(bytes[size - 1], 0) << "unknown fields are zero";
    }
  }
}

TEST(CVersions, ANewerProgramIsHeardWhereItAsksForNothingNew) {
  test::SmallWorld world;
  Newer<ft_query_options> options;
  std::memset(&options, 0x5a, sizeof options);
  ASSERT_EQ(ft_query_options_init(&options.known, sizeof options), FT_OK);
  EXPECT_EQ(options.known.size, sizeof options);
  EXPECT_EQ(std::count(std::begin(options.more), std::end(options.more), 0), 16);
  EXPECT_NE(test::makeQuery(world.scene, world.avatar, &options.known), nullptr);
  options.more[15] = 1;
  ft_query* query = nullptr;
  test::expectRefused(
      ft_query_create(world.scene.get(), world.avatar.get(), &options.known, &query),
      FT_ERROR_STRUCT_SIZE, {"ft_query_options", "does not know", FORETOUCH_VERSION});
  EXPECT_EQ(query, nullptr);
}

/// Structs end where a pointer may.
constexpr std::uint32_t kHalfWord = sizeof(void*) / 2;

TEST(CVersions, SizesThatNoVersionHasAreRefused) {
  test::SmallWorld world;
  ft_query_options options = test::initialised(ft_query_options_init);
  for (const std::uint32_t size : {0u, 1u, kHalfWord, 3 * kHalfWord, 4097u, 4104u, 0xffffffffu}) {
    options.size = size;
    ft_query* query = nullptr;
    test::expectRefused(ft_query_create(world.scene.get(), world.avatar.get(), &options, &query),
                        FT_ERROR_STRUCT_SIZE, {"ft_query_options", std::to_string(size)});
    test::expectRefused(ft_query_options_init(&options, size), FT_ERROR_STRUCT_SIZE,
                        {"ft_query_options_init"});
  }
  test::expectRefused(ft_query_options_init(&options, std::numeric_limits<std::size_t>::max() - 7),
                      FT_ERROR_STRUCT_SIZE, {"ft_query_options"});
}

template <typename Struct>
void expectDefaultsOf(ft_status (*init)(Struct*, std::size_t)) {
  const Struct made = test::initialised(init);
  EXPECT_EQ(made.size, sizeof made);
  test::expectRefused(init(nullptr, sizeof made), FT_ERROR_NULL_ARGUMENT, {"NULL"});
}

TEST(CVersions, EveryStructOfInputsHasItsDefaults) {
  expectDefaultsOf(ft_scene_arrays_init);
  expectDefaultsOf(ft_import_options_init);
  expectDefaultsOf(ft_avatar_arrays_init);
  expectDefaultsOf(ft_pose_init);
  expectDefaultsOf(ft_clip_options_init);
  expectDefaultsOf(ft_query_options_init);
  expectDefaultsOf(ft_solid_options_init);
  expectDefaultsOf(ft_world_options_init);
  expectDefaultsOf(ft_body_options_init);
  EXPECT_EQ(test::initialised(ft_query_options_init).work_budget,
            std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(test::initialised(ft_query_options_init).deadline_us,
            std::numeric_limits<double>::infinity());
}

TEST(CVersions, EveryStatusHasAWordOfItsOwn) {
  std::vector<std::string> words;
  for (ft_status status = -10; status < 200; ++status) {
    const std::string word = ft_status_name(status);
    if (word != "unknown") words.push_back(word);
  }
  EXPECT_EQ(words.size(), 24u);  // 9 and 15
  std::sort(words.begin(), words.end());
  EXPECT_EQ(std::unique(words.begin(), words.end()), words.end());
  EXPECT_STREQ(ft_status_name(FT_ERROR_IMPORT_CRASHED), "import-crashed");
}

}  // namespace
}  // namespace foretouch
