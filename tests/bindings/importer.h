// tests/bindings/importer.h: the program that reads models and scenes, for tests that ask for it.
#pragma once

#include <gtest/gtest.h>

/// Its path; empty where the library was built without it.
#ifndef FORETOUCH_TEST_IMPORTER
#define FORETOUCH_TEST_IMPORTER ""
#endif

/// Skips the test, by name, where there is no importer.
#define FORETOUCH_REQUIRE_IMPORTER() \
  if (FORETOUCH_TEST_IMPORTER[0] == '\0') GTEST_SKIP() << "built without the importer"
