#include "articulated/result.h"

#include <cstdio>
#include <cstdlib>

namespace foretouch {

const char* toString(ErrorCode code) {
  switch (code) {
    case ErrorCode::FileNotFound: return "file-not-found";
    case ErrorCode::FileUnreadable: return "file-unreadable";
    case ErrorCode::FileUnwritable: return "file-unwritable";
    case ErrorCode::Syntax: return "syntax";
    case ErrorCode::LimitExceeded: return "limit-exceeded";
    case ErrorCode::NonFinite: return "non-finite";
    case ErrorCode::OutOfRange: return "out-of-range";
    case ErrorCode::UnknownName: return "unknown-name";
    case ErrorCode::DuplicateName: return "duplicate-name";
    case ErrorCode::BadHierarchy: return "bad-hierarchy";
    case ErrorCode::Empty: return "empty";
    case ErrorCode::Mismatch: return "mismatch";
    case ErrorCode::ImportFailed: return "import-failed";
    case ErrorCode::ImportCrashed: return "import-crashed";
    case ErrorCode::DeviceFailed: return "device-failed";
  }
  return "unknown";
}

std::string describe(const Error& error) {
  std::string text = error.file;
  if (error.line >= 0) text += ":" + std::to_string(error.line);
  if (!text.empty()) text += ": ";
  return text + error.message;
}

namespace internal {

void stopForValueOf(const Error& error) {
  std::fprintf(stderr, "foretouch: value() of a Result that failed: %s\n", describe(error).c_str());
  std::abort();
}

void stopForErrorOfSuccess() {
  std::fputs("foretouch: error() of a Result that is ok\n", stderr);
  std::abort();
}

}  // namespace internal

Error inFile(Error error, const std::string& place) {
  if (error.file.empty()) error.file = place;
  return error;
}

}  // namespace foretouch
