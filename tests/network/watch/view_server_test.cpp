#include "network/watch/view_server.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/network/http_client.h"
#include "tests/network/sent_events.h"
#include "tests/network/service/service_fakes.h"

namespace foretouch {
namespace {

using std::chrono::milliseconds;
using test::asked;
using test::Connection;
using test::eventOf;
using test::eventually;
using test::SentEvent;
using test::sentEvents;
using test::statusOf;

/// Events under a test's hand. The server owns a source that reads here.
class ServedStage {
 public:
  void say(ViewEvent event) { sayTogether({std::move(event)}); }
  /// They are collected together.
  void sayTogether(const std::vector<ViewEvent>& events) {
    const std::lock_guard lock(mutex_);
    events_.insert(events_.end(), events.begin(), events.end());
  }
  void take(std::vector<ViewEvent>& events) {
    const std::lock_guard lock(mutex_);
    for (ViewEvent& event : events_) events.push_back(std::move(event));
    events_.clear();
  }
  [[nodiscard]] bool isTaken() const {
    const std::lock_guard lock(mutex_);
    return events_.empty();
  }
  std::atomic<std::size_t> viewers{0};
  std::atomic<int> rests{0};

 private:
  mutable std::mutex mutex_;
  std::vector<ViewEvent> events_;
};

class FakeSource final : public EventSource {
 public:
  explicit FakeSource(std::shared_ptr<ServedStage> stage) : stage_(std::move(stage)) {}
  void setViewers(std::size_t count) override { stage_->viewers = count; }
  void collect(Time, std::vector<ViewEvent>& events) override { stage_->take(events); }
  void rest() override { ++stage_->rests; }

 private:
  std::shared_ptr<ServedStage> stage_;
};

constexpr char kWatch[] = "GET /events HTTP/1.1\r\nHost: localhost\r\n\r\n";

class View : public testing::Test {
 protected:
  void start(const AudienceOptions& options = {}) {
    ViewServer::Pages pages;
    pages.page = "<!doctype html><p>seen</p>";
    pages.document = "{\"format\":\"foretouch-view\"}";
    pages.events = std::make_unique<FakeSource>(stage_);
    server_.emplace(ViewServer::start("127.0.0.1", 0, std::move(pages), options).value());
  }
  [[nodiscard]] std::uint16_t port() const { return server_->port(); }

  /// Its answer's headers have come, and the line after them.
  [[nodiscard]] std::unique_ptr<Connection> viewer(int receiveBytes = 0) {
    auto connection = std::make_unique<Connection>(port(), receiveBytes);
    EXPECT_TRUE(connection->isOpen());
    connection->send(kWatch);
    EXPECT_EQ(statusOf(connection->receivedUpTo("retry: 1000\n\n")), 200);
    return connection;
  }
  [[nodiscard]] std::string request(const std::string& path, const std::string& headers,
                                    const std::string& method = "GET") const {
    return asked(port(), method + " " + path + " HTTP/1.1\r\n" + headers + "\r\n");
  }

  std::shared_ptr<ServedStage> stage_ = std::make_shared<ServedStage>();
  std::optional<ViewServer> server_;
};

TEST_F(View, IsAPageAndItsDocument) {
  start();
  const std::string page = test::get(port(), "/");
  EXPECT_EQ(statusOf(page), 200);
  EXPECT_NE(page.find("\r\n\r\n<!doctype html><p>seen</p>"), std::string::npos) << page;
  EXPECT_NE(page.find("Content-Security-Policy: "), std::string::npos);
  EXPECT_NE(page.find("X-Content-Type-Options: nosniff"), std::string::npos);
  const std::string document = test::get(port(), "/view.json");
  EXPECT_NE(document.find("Content-Type: application/json"), std::string::npos);
  EXPECT_NE(document.find("\r\n\r\n{\"format\":\"foretouch-view\"}"), std::string::npos);
  for (const std::string& response : {page, document}) {
    EXPECT_EQ(response.find("Access-Control"), std::string::npos);
  }
  for (const char* path :
       {"/index.html", "/view.json/", "/events/x", "/../etc/passwd", "/metrics"}) {
    EXPECT_EQ(statusOf(test::get(port(), path)), 404) << path;
  }
}

TEST_F(View, RunsOnlyTheScriptThatThePageNames) {
  start();  // a page that names none
  const std::string none = test::get(port(), "/");
  EXPECT_NE(none.find("Content-Security-Policy: default-src 'none'; base-uri 'none'; form-action "
                      "'none'; frame-ancestors 'none'\r\n"),
            std::string::npos)
      << none;
  ViewServer::Pages pages;
  pages.page =
      "<head><meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src "
      "'sha256-abc='\"></head>";
  pages.events = std::make_unique<FakeSource>(stage_);
  const auto server = ViewServer::start("127.0.0.1", 0, std::move(pages));
  ASSERT_TRUE(server.ok());
  for (const char* path : {"/", "/view.json", "/none"}) {
    const std::string got = test::get(server.value().port(), path);
    EXPECT_NE(got.find("Content-Security-Policy: default-src 'none'; script-src 'sha256-abc='; "
                       "frame-ancestors 'none'\r\n"),
              std::string::npos)
        << got;
    EXPECT_EQ(got.find("unsafe-inline"), std::string::npos);
  }
}

// Clients that ask for much and read nothing hold up nobody.
TEST_F(View, WaitsForNoClientThatDoesNotRead) {
  ViewServer::Pages pages;
  pages.page = "<p>seen</p>";
  pages.document = std::string(std::size_t{32} << 20, 'x');
  pages.events = std::make_unique<FakeSource>(stage_);
  const auto server = ViewServer::start("127.0.0.1", 0, std::move(pages));
  ASSERT_TRUE(server.ok());
  std::vector<Connection> deaf;
  for (int i = 0; i < 63; ++i) {
    deaf.emplace_back(server.value().port(), 4096);
    deaf.back().send("GET /view.json HTTP/1.1\r\nHost: localhost\r\n\r\n");
  }
  for (int i = 0; i < 20; ++i) EXPECT_EQ(statusOf(test::get(server.value().port(), "/")), 200);
  // And whoever reads gets all of it.
  const std::string whole = test::get(server.value().port(), "/view.json");
  EXPECT_GT(whole.size(), std::size_t{32} << 20);
}

TEST_F(View, ReadsOnly) {
  start();
  for (const char* path : {"/", "/view.json", "/events"}) {
    for (const char* method : {"POST", "PUT", "DELETE", "PATCH", "OPTIONS"}) {
      EXPECT_EQ(statusOf(request(path, "Host: localhost\r\nContent-Length: 2\r\n\r\nab", method)),
                405)
          << method;
    }
    const std::string head = request(path, "Host: localhost\r\n", "HEAD");
    EXPECT_EQ(statusOf(head), 200) << path;
    EXPECT_EQ(head.find("\r\n\r\n") + 4, head.size()) << head;
  }
  EXPECT_EQ(server_->numViewers(), 0u);
}

TEST_F(View, AnswersNoPageOfAStranger) {
  start();
  const std::string host = "Host: 127.0.0.1:" + std::to_string(port()) + "\r\n";
  const std::string own = "Origin: http://127.0.0.1:" + std::to_string(port()) + "\r\n";
  EXPECT_EQ(statusOf(request("/view.json", host + own)), 200);
  EXPECT_EQ(statusOf(request("/view.json", host + "Sec-Fetch-Site: same-origin\r\n")), 200);
  EXPECT_EQ(statusOf(request("/", host + "Sec-Fetch-Site: cross-site\r\n")), 200);  // a link
  for (const std::string& headers :
       {std::string(), std::string("Host: example.org\r\n"), host + "Host: localhost\r\n",
        std::string("Host: 192.168.0.1:9465\r\n"), host + "Origin: http://example.org\r\n",
        host + "Origin: null\r\n", host + own + own,
        host + "Origin: http://localhost:" + std::to_string(port()) + "\r\n",
        host + "Sec-Fetch-Site: cross-site\r\n", host + "Sec-Fetch-Site: same-site\r\n"}) {
    for (const char* path : {"/view.json", "/events"}) {
      const std::string response = request(path, headers);
      EXPECT_EQ(statusOf(response), 403) << headers;
      EXPECT_EQ(response.find("foretouch"), std::string::npos);
    }
  }
  EXPECT_EQ(server_->numViewers(), 0u);
}

TEST_F(View, IsForThisMachineAlone) {
  for (const char* host : {"0.0.0.0", "192.168.0.1", "::", "example.org", ""}) {
    const auto refused = ViewServer::start(host, 0, {});
    ASSERT_FALSE(refused.ok()) << host;
    EXPECT_NE(refused.error().message.find("this machine alone"), std::string::npos);
  }
  start();
  const auto second =
      ViewServer::start("127.0.0.1", port(), {"", "", std::make_unique<FakeSource>(stage_)});
  ASSERT_FALSE(second.ok());
  EXPECT_NE(second.error().message.find("cannot serve the view on 127.0.0.1:"), std::string::npos);
}

TEST_F(View, ShowsNewcomersTheLastOfEveryTopicAndThenWhatComes) {
  start();
  const auto first = viewer();
  stage_->sayTogether({eventOf(1, 1, {11}), eventOf(0, 1), eventOf(1, 2, {12})});
  std::string seen = first->receivedUpTo("\"sequence\":2,\"contacts\":[11,12]");
  const auto second = viewer();
  const std::string shown =
      second->receivedUpTo("\"sequence\":2,\"contacts\":[12],\"skipped\":0}\n\n");
  const std::vector<SentEvent> events = sentEvents(shown);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].avatar, 0);  // topics in their order
  EXPECT_EQ(events[1].avatar, 1);
  stage_->say(eventOf(0, 5, {51}));
  for (const auto& one : {first.get(), second.get()}) {
    EXPECT_NE(one->receivedUpTo("[51],\"skipped\":0}\n\n").find("\"sequence\":5"),
              std::string::npos);
  }
}

TEST_F(View, TellsTheSourceWhetherAnybodyWatches) {
  AudienceOptions options;
  options.restEvery = milliseconds(20);
  start(options);
  EXPECT_TRUE(eventually([&] { return stage_->rests > 2; }));
  {
    const auto one = viewer();
    EXPECT_EQ(stage_->viewers, 1u);
    const auto two = viewer();
    EXPECT_EQ(stage_->viewers, 2u);
  }
  EXPECT_TRUE(eventually([&] { return stage_->viewers == 0; }));
  const int before = stage_->rests;
  EXPECT_TRUE(eventually([&] { return stage_->rests > before + 2; }));
}

TEST_F(View, SendsHeartbeatsWhenNothingHappens) {
  AudienceOptions options;
  options.heartbeatAfter = milliseconds(20);
  start(options);
  const auto watching = viewer();
  EXPECT_NE(watching->receivedUpTo(":\n\n:\n\n").find(":\n\n:\n\n"), std::string::npos);
}

TEST_F(View, HasABoundedNumberOfViewers) {
  start();
  std::vector<std::unique_ptr<Connection>> viewers;
  for (std::size_t i = 0; i < kMaxViewers; ++i) viewers.push_back(viewer());
  EXPECT_EQ(server_->numViewers(), kMaxViewers);
  const std::string refused = asked(port(), kWatch);
  EXPECT_EQ(statusOf(refused), 503);
  EXPECT_NE(refused.find("Retry-After"), std::string::npos);
  EXPECT_EQ(statusOf(test::get(port(), "/")), 200);
  viewers.pop_back();
  EXPECT_TRUE(eventually([&] { return server_->numViewers() == kMaxViewers - 1; }));
  const auto again = viewer();
  stage_->say(eventOf(0, 1, {7}));
  for (const auto& each : viewers) {
    EXPECT_NE(each->receivedUpTo("[7],\"skipped\":0}\n\n").find("[7]"), std::string::npos);
  }
}

/// Large steps, so that buffers fill; `contacts` in order.
void sayMany(ServedStage& stage, int from, int steps, std::vector<int>& contacts) {
  for (int i = from; i < from + steps; ++i) {
    contacts.push_back(i);
    stage.say(eventOf(0, i, {i}, 8000));
    // One a collection, mostly: the source merges nothing by itself.
    if (i % 16 != 0) continue;
    EXPECT_TRUE(eventually([&] { return stage.isTaken() || stage.viewers == 0; }));
  }
}

TEST_F(View, LetsSlowViewersSkipStepsAndNoContact) {
  start();
  const auto slow = viewer(4096);
  const auto quick = viewer();
  std::string seenQuickly;
  std::atomic<bool> isOver{false};
  constexpr int kSteps = 2000;  // 16 MB: more than the system keeps
  std::thread reading(
      [&] { seenQuickly = quick->receivedUpTo("\"sequence\":" + std::to_string(kSteps) + ","); });
  std::vector<int> said;
  sayMany(*stage_, 1, kSteps, said);
  reading.join();
  std::string seenSlowly = slow->receivedUpTo("\"sequence\":" + std::to_string(kSteps) + ",");
  seenSlowly += slow->receivedUpTo("\n\n");
  std::vector<int> contacts;
  std::int64_t steps = 0;
  const std::vector<SentEvent> events = sentEvents(seenSlowly);
  for (const SentEvent& event : events) {
    contacts.insert(contacts.end(), event.contacts.begin(), event.contacts.end());
    steps += 1 + event.skipped;
  }
  EXPECT_EQ(contacts, said);
  EXPECT_EQ(steps, kSteps);
  EXPECT_LT(events.size(), static_cast<std::size_t>(kSteps) / 2);
  EXPECT_GT(sentEvents(seenQuickly).size(), events.size());
}

TEST_F(View, LetsStalledViewersGo) {
  AudienceOptions options;
  options.stalledAfter = milliseconds(200);
  start(options);
  const auto stalled = viewer(4096);
  std::vector<int> said;
  sayMany(*stage_, 1, 1000, said);
  EXPECT_TRUE(eventually([&] { return server_->numViewers() == 0; }));
  EXPECT_EQ(statusOf(test::get(port(), "/")), 200);
}

TEST_F(View, OutlivesViewersThatLeaveInTheMiddleOfAnEvent) {
  start();
  std::mt19937 random(5);
  std::vector<int> said;
  int step = 1;
  const auto faithful = viewer();
  std::string last;
  std::thread reading([&] { last = faithful->receivedUpTo("\"sequence\":400,"); });
  for (int round = 0; round < 20; ++round) {
    const auto leaving = viewer(4096);
    sayMany(*stage_, step, 20, said);
    step += 20;
    for (std::uint32_t reads = random() % 4; reads > 0; --reads) leaving->receivedNext();
  }
  reading.join();
  EXPECT_NE(last.find("\"sequence\":400,"), std::string::npos);
  EXPECT_TRUE(eventually([&] { return server_->numViewers() == 1; }));
}

TEST_F(View, LetsGoWhoeverTalks) {
  start();
  const auto talking = viewer();
  talking->send("GET /view.json HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_TRUE(eventually([&] { return server_->numViewers() == 0; }));
}

TEST_F(View, SurvivesGarbage) {
  start();
  std::mt19937 random(11);
  for (int i = 0; i < 300; ++i) {
    std::string bytes(random() % 3000, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random());
    if (i % 3 == 0) bytes = "GET /events HTTP/1.1\r\nHost: localhost\r\n" + bytes + "\r\n\r\n";
    if (i % 3 == 1)
      bytes = "GET /events" + bytes.substr(0, 20) + " HTTP/1.1\r\nHost: localhost\r\n\r\n";
    Connection connection(port());
    ASSERT_TRUE(connection.isOpen());
    connection.send(bytes);
    connection.sendNoMore();
    connection.received();
  }
  Connection big(port());
  big.send("GET / HTTP/1.1\r\nHost: localhost\r\n");
  for (int i = 0;
       i < 1000 && big.send("X-" + std::to_string(i) + ": " + std::string(200, 'x') + "\r\n");
       ++i) {
  }
  EXPECT_NE(statusOf(big.received()), 200);
  EXPECT_TRUE(eventually([&] { return server_->numViewers() == 0; }));
  EXPECT_EQ(statusOf(test::get(port(), "/")), 200);
}

// A part of the document in many pieces, or pressed: more work than the document is.
TEST_F(View, GivesTheDocumentAsItIs) {
  start();
  std::string ranges = "Range: bytes=0-";
  for (int i = 0; i < 500; ++i) ranges += ",0-";
  const std::string response =
      request("/view.json", "Host: localhost\r\nAccept-Encoding: br, gzip\r\n" + ranges + "\r\n");
  if (statusOf(response) == 200) {
    EXPECT_NE(response.find("\r\n\r\n{\"format\":\"foretouch-view\"}"), std::string::npos);
  } else {
    EXPECT_EQ(statusOf(response), 416);
  }
  EXPECT_LT(response.size(), 2000u);
}

TEST_F(View, EndsWithViewersOpen) {
  start();
  std::vector<std::unique_ptr<Connection>> viewers;
  for (int i = 0; i < 8; ++i) viewers.push_back(viewer(4096));
  std::vector<int> said;
  sayMany(*stage_, 1, 100, said);
  Connection silent(port());
  Connection halfway(port());
  halfway.send("GET /events HTTP/1.1\r\n");
  server_.reset();
  EXPECT_EQ(stage_->viewers, 0u);
  for (const auto& each : viewers) each->received();  // to the end, which comes
}

}  // namespace
}  // namespace foretouch
