// The importer's parent where memory ends: every allocation of an import fails once, and each time
// the import is an error or goes on; no process and no descriptor is left.
#include <string>

#include <gtest/gtest.h>

#include "assets/import/model_import.h"
#include "assets/import/scene_import.h"
#include "tests/assets/import_files.h"
#include "tests/support/allocation_count.h"

namespace foretouch::test {
namespace {

/// Calls `import` with the first, the second, ... allocation failing until none is left to fail;
/// gives how many did. It returns whether it succeeded.
template <typename Import>
int failingEachAllocation(const Import& import) {
  constexpr int kMost = 20'000;
  for (int n = 0; n < kMost; ++n) {
    failAllocationAfter(n);
    const bool isDone = import();
    if (!stopFailing()) {
      EXPECT_TRUE(isDone);
      return n;
    }
    EXPECT_FALSE(hasChildren()) << n;
  }
  ADD_FAILURE() << "no end";
  return 0;
}

TEST(ImportersParent, AnswersWithAnErrorWhicheverAllocationFails) {
  if (!countsAllocations()) GTEST_SKIP() << "allocations cannot be made to fail here";
  const TempFolder folder;
  const std::string scene = folder.write("t.obj", kTriangleObj);
  const SceneImportOptions options = withImporter();
  ASSERT_TRUE(importScene(scene, options).ok());  // what is made once is there
  const std::size_t descriptors = openDescriptors();
  const int ofScene = failingEachAllocation([&] {
    const auto result = importScene(scene, options);
    EXPECT_TRUE(result.ok() || !result.error().message.empty());
    return result.ok();
  });
  EXPECT_GT(ofScene, 20);
  ModelImportOptions ofModels;
  ofModels.import = options;
  const int ofModel = failingEachAllocation([&] { return importModel(scene, ofModels).ok(); });
  EXPECT_GT(ofModel, 20);
  EXPECT_EQ(openDescriptors(), descriptors);
}

}  // namespace
}  // namespace foretouch::test
