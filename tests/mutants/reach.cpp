// tests/mutants/reach.cpp: which test comes by which mutants: a line per test in the file that
// FORETOUCH_REACHED names. Linked into every test program of the mutants' build.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <gtest/gtest.h>

#include "switch.h"

namespace {

class ReachWriter : public testing::EmptyTestEventListener {
 public:
  explicit ReachWriter(std::FILE* file) : file_(file) {}
  /// What constants and other tests' beginnings reached counts for all.
  void OnTestStart(const testing::TestInfo&) override { begin(); }
  void OnTestEnd(const testing::TestInfo& test) override {
    std::fprintf(file_, "%s.%s\t%lld\t", test.test_suite_name(), test.name(),
                 static_cast<long long>(test.result()->elapsed_time()));
    write();
  }
  void OnTestProgramEnd(const testing::UnitTest&) override { std::fclose(file_); }

 private:
  void begin() {
    if (hasBegun_) return;
    hasBegun_ = true;
    std::fprintf(file_, "\t0\t");
    write();
  }
  void write() {
    for (int k = 0; k < foretouch_mutants::kMost; ++k) {
      if (foretouch_mutants::reached[k] != 0) std::fprintf(file_, "%d ", k);
    }
    std::fprintf(file_, "\n");
    std::memset(foretouch_mutants::reached, 0, sizeof foretouch_mutants::reached);
  }

  std::FILE* file_;
  bool hasBegun_ = false;
};

const bool isListening = [] {
  const char* const path = std::getenv("FORETOUCH_REACHED");
  std::FILE* const file = path != nullptr ? std::fopen(path, "w") : nullptr;
  if (file != nullptr) {
    testing::UnitTest::GetInstance()->listeners().Append(new ReachWriter(file));
  }
  return true;
}();

}  // namespace
