#include "network/wire/loopback.h"

#include <gtest/gtest.h>

namespace foretouch {
namespace {

TEST(IsLoopbackHost, IsThisMachineByItsOwnNames) {
  for (const char* host : {"localhost", "localhost:9465", "127.0.0.1", "127.0.0.1:9465",
                           "127.3.2.1:1", "[::1]", "[::1]:65535"}) {
    EXPECT_TRUE(isLoopbackHost(host)) << host;
  }
}

TEST(IsLoopbackHost, IsNoNameOfAnotherAndNoTrick) {
  for (const char* host : {"",
                           ":",
                           "example.org",
                           "example.org:9465",
                           "localhost.example.org",
                           "127.0.0.1.example.org",
                           "localhost:",
                           "localhost:94a5",
                           "localhost:999999",
                           "localhost:1:2",
                           "::1",
                           "[::1",
                           "[::1]x",
                           "[localhost]",
                           "[127.0.0.1]",
                           "0.0.0.0",
                           "192.168.1.2:9465",
                           "127.1",
                           "0x7f.0.0.1",
                           "2130706433",
                           "localhost ",
                           " localhost",
                           "user@localhost",
                           "localhost/",
                           "[::2]:9465",
                           "[::ffff:127.0.0.1]:1"}) {
    EXPECT_FALSE(isLoopbackHost(host)) << host;
  }
}

TEST(IsOwnOrigin, IsThePageOfTheSameHostAndPort) {
  EXPECT_TRUE(isOwnOrigin("http://127.0.0.1:9465", "127.0.0.1:9465"));
  for (const char* origin :
       {"", "null", "http://127.0.0.1", "http://127.0.0.1:9466", "https://127.0.0.1:9465",
        "http://localhost:9465", "http://127.0.0.1:9465/", "http://127.0.0.1:9465.example.org"}) {
    EXPECT_FALSE(isOwnOrigin(origin, "127.0.0.1:9465")) << origin;
  }
}

}  // namespace
}  // namespace foretouch
