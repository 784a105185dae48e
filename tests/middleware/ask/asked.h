// tests/middleware/ask/asked.h: one question, by a memory that has asked nothing yet.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "middleware/ask/ask.h"

namespace foretouch::test {

inline WorldAnswer ask(const World& world, const WorldQuestion& question) {
  Scratch scratch;
  WorldAnswer answer;
  const auto done = askWorld(world, question, scratch, answer);
  EXPECT_TRUE(done.ok()) << describe(done.error());
  return answer;
}

/// Empty: it was answered.
inline std::string errorOf(const World& world, const WorldQuestion& question) {
  Scratch scratch;
  WorldAnswer answer;
  const auto done = askWorld(world, question, scratch, answer);
  return done.ok() ? std::string() : describe(done.error());
}

}  // namespace foretouch::test
