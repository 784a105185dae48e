// bindings/python/query.h: a reusable query: avatar, scene and options, looked up and checked once,
// and scratch memory.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/skeleton.h"
#include "bindings/python/answers.h"
#include "bindings/python/instants.h"
#include "bindings/python/motion.h"
#include "middleware/query/query.h"
#include "middleware/scene/scene.h"

namespace foretouch::python {

/// Scratch memory for any number of concurrent calls.
class ScratchShelf {
 public:
  [[nodiscard]] std::unique_ptr<Scratch> take();
  void putBack(std::unique_ptr<Scratch> scratch);

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Scratch>> free_;
};

/// Any number of threads may use one Query at once: each call takes its own scratch. Callers hold
/// the GIL; the methods release it while they work.
class Query {
 public:
  /// Throws if the library refuses the options.
  Query(std::shared_ptr<Avatar> avatar, std::shared_ptr<Scene> scene, const QueryOptions& options);

  [[nodiscard]] const std::shared_ptr<Avatar>& avatar() const { return avatar_; }
  [[nodiscard]] const std::shared_ptr<Scene>& scene() const { return scene_; }

  [[nodiscard]] Step firstContacts(std::shared_ptr<const Motion> motion);

  /// By `threads` threads.
  [[nodiscard]] Steps firstContactsMany(AnsweredMotions motions, int threads);

  /// (links) of booleans at one instant, (instants, links) at many.
  [[nodiscard]] py::array_t<bool> touchesAt(const Motion& motion, const Instants& instants);

 private:
  void checkMotion(const Motion& motion) const;
  std::shared_ptr<Avatar> avatar_;
  std::shared_ptr<Scene> scene_;
  foretouch::Query question_;
  ScratchShelf shelf_;
};

}  // namespace foretouch::python
