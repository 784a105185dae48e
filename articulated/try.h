// articulated/try.h: statements that hand the error of a Result on to the caller. For sources, not
// for public headers: a user's program sees no macro of ours.
#pragma once

#include <utility>

#include "articulated/result.h"

// What to do with a Result that the caller cannot mend. Each is one statement.
//   FORETOUCH_TRY(const auto text, readWholeFile(path, limit));   text is the value
//   FORETOUCH_CHECK(file.commit());                               nothing is needed of the value
//   FORETOUCH_TRY_OR(failed, const auto text, ...);               returns failed(error) instead
#define FORETOUCH_TRY_NAME_(line) tried##line##_
#define FORETOUCH_TRY_NAME(line) FORETOUCH_TRY_NAME_(line)
#define FORETOUCH_TRY_AS_(tried, fail, declaration, ...) \
  auto tried = (__VA_ARGS__);                            \
  if (!tried.ok()) return fail(tried.error());           \
  declaration = std::move(tried).value()
#define FORETOUCH_TRY_OR(fail, declaration, ...) \
  FORETOUCH_TRY_AS_(FORETOUCH_TRY_NAME(__LINE__), fail, declaration, __VA_ARGS__)
#define FORETOUCH_TRY(declaration, ...) \
  FORETOUCH_TRY_AS_(FORETOUCH_TRY_NAME(__LINE__), , declaration, __VA_ARGS__)
#define FORETOUCH_CHECK_OR(fail, ...) \
  if (const auto checked_ = (__VA_ARGS__); !checked_.ok()) return fail(checked_.error())
#define FORETOUCH_CHECK(...) FORETOUCH_CHECK_OR(, __VA_ARGS__)
