#include "tools/stream/serve_config.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"

namespace foretouch::tools {
namespace {

const std::string kSmallest =
    "[scene]\nfile = \"room.glb\"\n[[avatar]]\nfile = \"a.avatar.json\"\n";

Result<ServeConfig> parse(const std::string& text) {
  return parseServeConfig(text, "etc/serve.toml");
}

/// The smallest file with `line` in `section` (before the others); its error as people see it.
std::string errorOf(const std::string& section, const std::string& line) {
  const auto config = parse("[" + section + "]\n" + line + "\n" + kSmallest);
  return config.ok() ? "accepted" : describe(config.error());
}

std::string errorOf(const std::string& text) {
  const auto config = parse(text);
  return config.ok() ? "accepted" : describe(config.error());
}

testing::AssertionResult has(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "no \"" << part << "\" in: " << text;
}

TEST(ServeConfig, SmallestFileHasTheDefaults) {
  const auto config = parse(kSmallest);
  ASSERT_TRUE(config.ok()) << describe(config.error());
  const ServeConfig& c = config.value();
  EXPECT_EQ(c.url, "udpm://239.255.76.67:7667?ttl=0");
  EXPECT_EQ(c.service.suffix, "");
  EXPECT_EQ(c.receiver, ReceiverKind::Own);
  EXPECT_EQ(c.service.workers, 1);
  EXPECT_EQ(c.service.queue, 256u);
  EXPECT_EQ(c.world.budgetUs, 0);
  EXPECT_EQ(c.log, "");
  EXPECT_EQ(c.http, "");
  EXPECT_EQ(c.view, "");
  EXPECT_EQ(c.world.scenePath, "etc/room.glb");
  EXPECT_FALSE(c.world.sceneImport.scale.has_value());
  EXPECT_FALSE(c.world.sceneImport.up.has_value());
  EXPECT_EQ(c.world.query.tolerance, 1e-3);
  EXPECT_EQ(c.world.query.fidelity, Fidelity::Link);
  EXPECT_TRUE(c.world.ignore.empty());
  EXPECT_TRUE(c.world.policies.empty());
  EXPECT_EQ(c.stream.maxStepUs, 10'000'000);
  EXPECT_EQ(c.stream.confirmations, 3);
  EXPECT_FALSE(c.stream.unmatchedAtRest);
  ASSERT_EQ(c.avatars.size(), 1u);
  EXPECT_EQ(c.avatars[0].id, 1);
  EXPECT_EQ(c.avatars[0].path, "etc/a.avatar.json");
}

TEST(ServeConfig, EveryKeyIsRead) {
  const auto config = parse(R"(# all of it
[service]
url = "udpm://239.1.2.3:7000?ttl=1"
suffix = "_LAB"
receiver = "liblcm"
workers = 64
queue = 65536
budget_us = 2_500
log = "/var/lib/foretouch/a.lcmlog"
http = "127.0.0.1:9464"
view = "[::1]:9465"
[scene]
file = "../room.ply"
scale = 1e-2
up = "z"
[query]
tolerance = 0.002
fidelity = "exact"
ignore = ["Hand:table", "Foot*"]
[[policy]]
links = ["*Hand*"]
tolerance = 0.0001
fidelity = "exact"
[[policy]]
links = ["Foot*"]
objects = ["floor", "rug"]
ignore = true
[stream]
max_step_s = 0.25
confirmations = 5
unmatched = "rest"
[[avatar]]
id = 7
file = "seven.avatar.json"
[[avatar]]
id = 0
file = "/srv/zero.avatar.json"
)");
  ASSERT_TRUE(config.ok()) << describe(config.error());
  const ServeConfig& c = config.value();
  EXPECT_EQ(c.url, "udpm://239.1.2.3:7000?ttl=1");
  EXPECT_EQ(c.service.suffix, "_LAB");
  EXPECT_EQ(c.receiver, ReceiverKind::Liblcm);
  EXPECT_EQ(c.service.workers, 64);
  EXPECT_EQ(c.service.queue, 65536u);
  EXPECT_EQ(c.world.budgetUs, 2500);
  EXPECT_EQ(c.log, "/var/lib/foretouch/a.lcmlog");
  EXPECT_EQ(c.http, "127.0.0.1:9464");
  EXPECT_EQ(c.view, "[::1]:9465");
  EXPECT_EQ(c.world.scenePath, "etc/../room.ply");
  EXPECT_EQ(c.world.sceneImport.scale, 0.01);
  EXPECT_EQ(c.world.sceneImport.up, UpAxis::Z);
  EXPECT_EQ(c.world.query.tolerance, 0.002);
  EXPECT_EQ(c.world.query.fidelity, Fidelity::Exact);
  EXPECT_EQ(c.world.ignore, (std::vector<std::string>{"Hand:table", "Foot*"}));
  ASSERT_EQ(c.world.policies.size(), 2u);
  EXPECT_EQ(c.world.policies[0].links, std::vector<std::string>{"*Hand*"});
  EXPECT_TRUE(c.world.policies[0].objects.empty());
  EXPECT_EQ(c.world.policies[0].tolerance, 1e-4);
  EXPECT_EQ(c.world.policies[0].fidelity, Fidelity::Exact);
  EXPECT_EQ(c.world.policies[0].ignore, std::nullopt);
  EXPECT_EQ(c.world.policies[1].objects, (std::vector<std::string>{"floor", "rug"}));
  EXPECT_EQ(c.world.policies[1].tolerance, std::nullopt);
  EXPECT_EQ(c.world.policies[1].ignore, true);
  EXPECT_EQ(c.stream.maxStepUs, 250'000);
  EXPECT_EQ(c.stream.confirmations, 5);
  EXPECT_TRUE(c.stream.unmatchedAtRest);
  ASSERT_EQ(c.avatars.size(), 2u);
  EXPECT_EQ(c.avatars[0].id, 7);
  EXPECT_EQ(c.avatars[1].id, 0);
  EXPECT_EQ(c.avatars[1].path, "/srv/zero.avatar.json");
}

TEST(ServeConfig, UnknownKeysAreRefusedWithTheirLineAndTheNearestOne) {
  EXPECT_TRUE(has(errorOf("service", "worker = 2"),
                  "etc/serve.toml:2: unknown key 'worker' in [service]; did you mean 'workers'?"));
  EXPECT_TRUE(has(errorOf("[scnee]\nfile = \"x\"\n"),
                  "etc/serve.toml:1: unknown key 'scnee' in the file; did you mean 'scene'?"));
  EXPECT_TRUE(has(errorOf("\n" + kSmallest + "Id = 2\n"),
                  "etc/serve.toml:6: unknown key 'Id' in [[avatar]]; did you mean 'id'?"));
  EXPECT_TRUE(has(errorOf("\n[[policy]]\nlink = [\"a\"]\n" + kSmallest),
                  "etc/serve.toml:3: unknown key 'link' in [[policy]]; did you mean 'links'?"));
  EXPECT_TRUE(has(errorOf("stream", "zzzz = 1\naaaa = 1"), ":2: unknown key 'zzzz' in [stream]"));
  EXPECT_TRUE(has(errorOf("query", "\"a\\u001b[2Jb\" = 1"), "unknown key 'a\\x1b[2Jb'"));
}

TEST(ServeConfig, NumbersOutOfRangeAreRefusedWithTheirLine) {
  EXPECT_TRUE(has(errorOf("service", "\nworkers = 0"),
                  "etc/serve.toml:3: [service] workers: expected a whole number from 1 to 256, "
                  "found 0"));
  for (const char* const bad :
       {"workers = 257", "workers = -1", "queue = 0", "queue = 65537", "budget_us = -1",
        "budget_us = 60000001", "queue = 9223372036854775807"}) {
    EXPECT_TRUE(has(errorOf("service", bad), ":2: [service] ")) << bad;
  }
  for (const char* const bad : {"tolerance = 0", "tolerance = 0.9e-9", "tolerance = -1.0",
                                "tolerance = nan", "tolerance = inf", "tolerance = 1.1e7"}) {
    EXPECT_TRUE(has(errorOf("query", bad),
                    ":2: [query] tolerance: expected a finite number of metres from 1e-9 to 1e7"))
        << bad;
  }
  for (const char* const bad : {"max_step_s = 0", "max_step_s = 0.0000009", "max_step_s = 86400.1",
                                "max_step_s = inf", "confirmations = 0", "confirmations = 1001"}) {
    EXPECT_TRUE(has(errorOf("stream", bad), ":2: [stream] ")) << bad;
  }
  const std::string avatar = "[[avatar]]\nfile = \"a\"\nid = ";
  EXPECT_TRUE(has(errorOf(avatar + "-1"), ":3: [[avatar]] id: expected a whole number from 0 to"));
  EXPECT_TRUE(has(errorOf(avatar + "2147483648"), ":3: [[avatar]] id"));
  const auto scaled = [](const std::string& scale) {
    return errorOf("[scene]\nfile = \"a\"\nscale = " + scale + "\n[[avatar]]\nfile = \"a\"\n");
  };
  EXPECT_EQ(scaled("0.01"), "accepted");
  for (const char* const bad : {"0", "-0.0", "-1", "nan", "-inf"}) {
    EXPECT_TRUE(has(scaled(bad), ":3: [scene] scale: expected a finite number greater than 0"))
        << bad;
  }
}

TEST(ServeConfig, WrongTypesAreRefusedWithTheirLine) {
  EXPECT_TRUE(has(errorOf("service", "workers = 1.5"),
                  ":2: [service] workers: expected a whole number from 1 to 256, found a number"));
  EXPECT_TRUE(has(errorOf("service", "workers = \"2\""), "found a text"));
  EXPECT_TRUE(has(errorOf("service", "url = 3"), ":2: [service] url: expected a text"));
  EXPECT_TRUE(has(errorOf("service", "log = true"), "found true or false"));
  EXPECT_TRUE(has(errorOf("query", "tolerance = 2020-01-01"), "found a date or time"));
  EXPECT_TRUE(has(errorOf("query", "ignore = \"Hand\""), "expected an array of texts"));
  EXPECT_TRUE(
      has(errorOf("query", "ignore = [\"Hand\",\n 3]"), ":3: [query] ignore: expected a text"));
  EXPECT_TRUE(has(errorOf("query", "fidelity = 1"), "expected \"link\" or \"exact\""));
  EXPECT_TRUE(has(errorOf("service = 3\n"), ":1: service: expected a table, found a whole number"))
      << errorOf("service = 3\n");
  EXPECT_TRUE(has(errorOf("[avatar]\nfile = \"a\"\n"), ":1: avatar: expected tables"));
  EXPECT_TRUE(has(errorOf("avatar = [1]\n"), ":1: avatar: expected tables"));
}

TEST(ServeConfig, WordsThatDoNotExistAreRefused) {
  EXPECT_TRUE(has(errorOf("service", "receiver = \"lcm\""),
                  ":2: [service] receiver: expected \"own\" or \"liblcm\", found 'lcm'"));
  EXPECT_TRUE(has(errorOf("query", "fidelity = \"skinned\""), "expected \"link\" or \"exact\""));
  EXPECT_TRUE(has(errorOf("query", "fidelity = \"lnik\""), "found 'lnik'; did you mean 'link'?"));
  EXPECT_TRUE(has(errorOf("stream", "unmatched = \"\""), "expected \"undecided\" or \"rest\""));
}

TEST(ServeConfig, TextsThatCannotBeUsedAreRefused) {
  EXPECT_TRUE(has(errorOf("service", "url = \"\""), "expected a text that is not empty"));
  EXPECT_TRUE(has(errorOf("service", "log = \"a\\u0000b\""), "without control characters"));
  EXPECT_TRUE(has(errorOf("service", "log = \"" + std::string(5000, 'a') + "\""), "4096 bytes"));
  EXPECT_TRUE(
      has(errorOf("service", "suffix = \"a b\""),
          ":2: [service] suffix: expected printable ASCII without spaces, at most 45 bytes"));
  EXPECT_TRUE(has(errorOf("service", "suffix = \"\u00e9\""), ":2: [service] suffix"));
  EXPECT_EQ(errorOf("service", "suffix = \"" + std::string(45, 'A') + "\""), "accepted");
  EXPECT_TRUE(has(errorOf("service", "suffix = \"" + std::string(46, 'A') + "\""),
                  "at most 45 bytes of it"));
  for (const char* const bad : {"9464", ":9464", "127.0.0.1", "127.0.0.1:", "127.0.0.1:0",
                                "127.0.0.1:65536", "127.0.0.1:1x", "::1:9464", "[::1]", "[]:1",
                                "a b:1", "127.0.0.1:-1", "http://127.0.0.1:80"}) {
    EXPECT_TRUE(has(errorOf("service", std::string("http = \"") + bad + "\""),
                    ":2: [service] http: expected a host and a port"))
        << bad;
  }
}

TEST(ServeConfig, AViewIsForThisMachineAlone) {
  EXPECT_TRUE(has(errorOf("service", "view = \"9465\""), "[service] view: expected a host"));
  for (const char* const bad :
       {"0.0.0.0:9465", "192.168.0.1:9465", "[::]:9465", "example.org:9465"}) {
    EXPECT_TRUE(has(errorOf("service", std::string("view = \"") + bad + "\""),
                    ":2: [service] view: expected localhost or an address of this machine"))
        << bad;
  }
}

TEST(ServeConfig, HttpAddressesAreRead) {
  const auto six = parseHttpAddress("--http", "[::1]:9464");
  ASSERT_TRUE(six.ok());
  EXPECT_EQ(six.value().host, "::1");
  EXPECT_EQ(six.value().port, 9464);
  const auto name = parseHttpAddress("--http", "localhost:65535");
  ASSERT_TRUE(name.ok());
  EXPECT_EQ(name.value().host, "localhost");
  EXPECT_EQ(name.value().port, 65535);
}

TEST(ServeConfig, WhatIsMissingIsNamed) {
  EXPECT_TRUE(has(errorOf(""), "etc/serve.toml: expected at least one [[avatar]]"));
  EXPECT_TRUE(has(errorOf("avatar = []\n"), "expected at least one [[avatar]]"));
  EXPECT_TRUE(has(errorOf("[[avatar]]\nfile = \"a\"\n"), "expected a file in [scene]"));
  EXPECT_TRUE(
      has(errorOf("[scene]\nfile = \"\"\n"), ":2: [scene] file: expected a text that is not"));
  EXPECT_TRUE(has(errorOf(kSmallest + "[[avatar]]\nid = 2\n"), ":5: [[avatar]]: expected a file"));
}

TEST(ServeConfig, RepeatedIdsAreRefused) {
  EXPECT_TRUE(has(errorOf(kSmallest + "[[avatar]]\nfile = \"b\"\n"),
                  ":5: [[avatar]]: the id 1 is used twice"));
  EXPECT_EQ(errorOf(kSmallest + "[[avatar]]\nid = 2\nfile = \"a.avatar.json\"\n"), "accepted");
}

TEST(ServeConfig, BrokenTomlIsRefusedWithItsLine) {
  EXPECT_TRUE(has(errorOf("[scene]\nfile = room.glb\n"), "etc/serve.toml:2: broken TOML: "));
  EXPECT_TRUE(has(errorOf("[scene]\n[scene]\n"), "etc/serve.toml:2: broken TOML: "));
  EXPECT_TRUE(has(errorOf("[scene]\nup = \"y\"\nup = \"z\"\n"), "etc/serve.toml:3: broken TOML: "));
  EXPECT_TRUE(has(errorOf("[scene]\nfile = \"\xff\"\n"), "etc/serve.toml:2: broken TOML: "));
  for (const char* const bad : {"[!\n", "[[!", "[[\n", "[", "[[", "[[a", "[[a]", "a.!", "a = {!",
                                "a = [", "a = \u00c8", "\u049e = 1", "a \u00e9"}) {
    EXPECT_TRUE(has(errorOf(bad), "broken TOML: ")) << bad;
  }
}

TEST(ServeConfig, SizeAndNestingAreBounded) {
  EXPECT_TRUE(has(errorOf(kSmallest + std::string(kMaxServeConfigBytes, '\n')), "1 MiB"));
  EXPECT_EQ(errorOf(kSmallest + std::string(kMaxServeConfigBytes - kSmallest.size(), '\n')),
            "accepted");
  std::string dotted = "a";
  for (int i = 0; i < 500'000; ++i) dotted += ".a";
  EXPECT_TRUE(has(errorOf(dotted + " = 1\n"), ":1: expected at most 256 dots in a line"));
  EXPECT_TRUE(has(errorOf("[" + dotted + "]\n"), ":1: expected at most 256 dots in a line"));
  EXPECT_TRUE(has(errorOf("[query]\nignore = " + std::string(100'000, '[')), "broken TOML"));
  // As deep as it goes: every level a line of dots.
  const std::string most = dotted.substr(0, 2 * 256 + 1);
  std::string deepest;
  for (int i = 0; i < 100; ++i) deepest += (i == 0 ? "" : "[\n{ ") + most + " = ";
  EXPECT_TRUE(has(errorOf(deepest), "broken TOML"));
  EXPECT_TRUE(has(errorOf(most + " = 1\n"), "unknown key 'a' in the file"));
}

TEST(ServeConfig, FilesAreReadWhole) {
  const test::TempFolder folder;
  const std::string path = folder / "serve.toml";
  EXPECT_EQ(readServeConfig(path).error().code, ErrorCode::FileNotFound);
  folder.write("serve.toml", kSmallest);
  const auto config = readServeConfig(path);
  ASSERT_TRUE(config.ok()) << describe(config.error());
  EXPECT_EQ(config.value().world.scenePath, folder / "room.glb");
  folder.write("serve.toml", kSmallest + std::string(kMaxServeConfigBytes, '#'));
  EXPECT_EQ(readServeConfig(path).error().code, ErrorCode::LimitExceeded);
}

}  // namespace
}  // namespace foretouch::tools
