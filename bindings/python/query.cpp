// bindings/python/query.cpp: foretouch.Query.
#include "bindings/python/query.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "bindings/python/bindings.h"
#include "bindings/python/poses.h"
#include "bindings/python/query_options.h"
#include "middleware/query/query.h"
#include "middleware/worker_pool.h"

namespace foretouch::python {
namespace {

/// Steps between checks for Ctrl-C.
constexpr std::size_t kStepsAtOnce = 1024;

/// A scratch that goes back to its shelf.
class BorrowedScratch {
 public:
  explicit BorrowedScratch(ScratchShelf& shelf) : shelf_(shelf), scratch_(shelf.take()) {}
  BorrowedScratch(const BorrowedScratch&) = delete;
  BorrowedScratch& operator=(const BorrowedScratch&) = delete;
  ~BorrowedScratch() { shelf_.putBack(std::move(scratch_)); }
  Scratch& operator*() { return *scratch_; }

 private:
  ScratchShelf& shelf_;
  std::unique_ptr<Scratch> scratch_;
};

/// An error about an option is one about its keyword.
Result<foretouch::Query> withKeywords(Result<foretouch::Query> built) {
  if (built.ok()) return built;
  Error error = built.error();
  if (error.file == "self") error.file = "self_pairs";
  if (error.file == "passSeparating") error.file = "pass_separating";
  return error;
}

void throwIfInterrupted() {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace

std::unique_ptr<Scratch> ScratchShelf::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (free_.empty()) return std::make_unique<Scratch>();
  auto scratch = std::move(free_.back());
  free_.pop_back();
  return scratch;
}

void ScratchShelf::putBack(std::unique_ptr<Scratch> scratch) {
  const std::lock_guard<std::mutex> lock(mutex_);
  free_.push_back(std::move(scratch));
}

Query::Query(std::shared_ptr<Avatar> avatar, std::shared_ptr<Scene> scene,
             const QueryOptions& options)
    : avatar_(std::move(avatar)),
      scene_(std::move(scene)),
      question_(valueOf(withKeywords(foretouch::Query::build(*avatar_, *scene_, options)))) {}

/// The library detects a motion of another avatar only by its number of joints.
void Query::checkMotion(const Motion& motion) const {
  if (motion.avatar->identity() == avatar_->identity()) return;
  refuse(ErrorCode::Mismatch, "motion", "expected a motion of this avatar");
}

Step Query::firstContacts(std::shared_ptr<const Motion> motion) {
  checkMotion(*motion);
  const py::gil_scoped_release free;
  BorrowedScratch scratch(shelf_);
  StepContacts step;
  question_.answer(motion->chain, *scratch, step);
  Answers answers{avatar_, scene_, question_, {std::move(motion), {}, {}}};
  answers.add(std::move(step));
  return {std::make_shared<const Answers>(std::move(answers)), 0};
}

Steps Query::firstContactsMany(AnsweredMotions motions, int threads) {
  auto pool = valueOf(WorkerPool::start(threads));
  const std::size_t steps = motions.count();
  const auto answers =
      std::make_shared<Answers>(Answers{avatar_, scene_, question_, std::move(motions)});
  answers->contacts.reserve(steps * answers->links());
  answers->counters.reserve(steps);
  std::vector<StepTask> tasks;
  std::vector<StepContacts> found;
  for (std::size_t done = 0; done < steps; done += tasks.size()) {
    throwIfInterrupted();
    const py::gil_scoped_release free;
    tasks.clear();
    for (std::size_t i = done; i < std::min(steps, done + kStepsAtOnce); ++i) {
      tasks.push_back({&question_, &answers->motions.start(i), &answers->motions.end(i)});
    }
    valueOf(foretouch::Query::answerAll(tasks, pool, found));
    for (StepContacts& step : found) answers->add(std::move(step));
  }
  return {answers};
}

py::array_t<bool> Query::touchesAt(const Motion& motion, const Instants& instants) {
  checkMotion(motion);
  py::array_t<bool> touched(instants.shapeWith({avatar_->numLinks()}));
  bool* answer = touched.mutable_data();
  const py::gil_scoped_release free;
  BorrowedScratch scratch(shelf_);
  for (const double t : instants.values()) {
    for (LinkId link = 0; link < avatar_->numLinks(); ++link) {
      *answer++ = question_.touchesAt(motion.chain, link, t, *scratch);
    }
  }
  return touched;
}

namespace {

std::unique_ptr<Query> createQuery(std::shared_ptr<Avatar> avatar, std::shared_ptr<Scene> scene,
                                   Shown<shown::Number> tolerance, Shown<shown::Text> fidelity,
                                   Shown<shown::Mapping> policies, Shown<shown::Items> ignore,
                                   Shown<shown::Integer> workBudget,
                                   Shown<shown::Number> deadlineUs, Shown<shown::Text> scope,
                                   Shown<shown::Surface> surface, Shown<shown::PairRules> selfPairs,
                                   Shown<shown::Truth> passSeparating) {
  const auto options = optionsFrom({tolerance, fidelity, policies, ignore, workBudget, deadlineUs,
                                    scope, surface, selfPairs, passSeparating},
                                   *avatar, *scene);
  return std::make_unique<Query>(std::move(avatar), std::move(scene), options);
}

int threadsFrom(const py::object& given) {
  if (!given.is_none()) return static_cast<int>(integer(given, "threads", 1, kMaxPoolThreads));
  return static_cast<int>(
      std::clamp(std::thread::hardware_concurrency(), 1u, unsigned{kMaxPoolThreads}));
}

/// From each pose to the next, or from each of `poses` to the one at the same place in `ends`.
Steps many(Query& query, const Shown<shown::Poses>& poses, const Shown<shown::Poses>& ends,
           const Shown<shown::Integer>& threads) {
  const Skeleton& skeleton = query.avatar()->skeleton();
  const int count = threadsFrom(threads);
  std::vector<Pose> from = posesFrom(skeleton, poses, "poses");
  if (ends.is_none()) {
    if (from.size() < 2) {
      refuse(ErrorCode::Empty, "poses",
             "expected at least two poses, found " + std::to_string(from.size()));
    }
    return query.firstContactsMany({nullptr, std::move(from), {}}, count);
  }
  std::vector<Pose> to = posesFrom(skeleton, ends, "ends");
  if (to.size() != from.size() || from.empty()) {
    refuse(ErrorCode::Mismatch, "ends",
           "expected one per pose, and at least one; found " + std::to_string(to.size()) + " for " +
               std::to_string(from.size()) + " poses");
  }
  return query.firstContactsMany({nullptr, std::move(from), std::move(to)}, count);
}

constexpr char kOptionsText[] =
    "tolerance: metres, at most what separates a contact at its toi. fidelity: 'link' "
    "(LSS),\n"
    "or 'exact' (triangles; needs surface).\n"
    "policies: {link: {'tolerance': ..., 'fidelity': ..., 'ignore': ...}} where links\n"
    "differ, or {(link, object): ...} where objects do; later ones win.\n"
    "ignore: a list of links and of pairs (link, object), by name or index.\n"
    "work_budget: evaluations (about 10 ns each) that a step may cost; deadline_us: the "
    "same\n"
    "by the clock. What is not answered by then is undecided.\n"
    "scope: 'links', every link's own contact; 'avatar', only the earliest of all; "
    "'objects',\n"
    "also every link's own contact with every object (Step.objects), at fidelity 'link' or\n"
    "'exact' and without a budget.\n"
    "self_pairs: PairRules: also ask whether own links touch each other (Step.pairs); at\n"
    "fidelity 'link' or 'exact', and not at scope 'avatar'.\n"
    "pass_separating: a link that begins within the tolerance of the scene without touching\n"
    "it, and does not approach it, goes on until it is a quarter as near: so an avatar that\n"
    "was stopped can leave again. At fidelity 'link' or 'exact'.";

}  // namespace

void bindQuery(py::module_& module) {
  const QueryOptions usual;
  py::class_<Query>(module, "Query",
                    "A question to ask again and again: avatar, scene and options, checked\n"
                    "once, with memory that it keeps. Any number of threads may ask one at once.")
      .def(py::init(&createQuery), py::arg("avatar").none(false), py::arg("scene").none(false),
           py::kw_only(), py::arg("tolerance") = usual.tolerance, py::arg("fidelity") = "link",
           py::arg("policies") = py::none(), py::arg("ignore") = py::tuple(),
           py::arg("work_budget") = py::none(), py::arg("deadline_us") = py::none(),
           py::arg("scope") = "links", py::arg("surface") = py::none(),
           py::arg("self_pairs") = py::none(), py::arg("pass_separating") = false, kOptionsText)
      .def(
          "first_contacts",
          [](Query& query, std::shared_ptr<Motion> motion) {
            return query.firstContacts(std::move(motion));
          },
          py::arg("motion").none(false), "What every link meets first: a Step.")
      .def("first_contacts_many", &many, py::arg("poses"), py::kw_only(),
           py::arg("ends") = py::none(), py::arg("threads") = py::none(),
           "From each pose to the next (or to the one at the same place in ends): Steps. threads:\n"
           "None for as many as the processor has. The answers are the same for any number.")
      .def(
          "touches_at",
          [](Query& query, const Motion& motion, const Shown<shown::Instants>& t) {
            return query.touchesAt(motion, Instants(t));
          },
          py::arg("motion"), py::arg("t"),
          "What a discrete check sees, without any promise: booleans (n,) for a number t, (k, n)\n"
          "for k of them.")
      .def_property_readonly("avatar", &Query::avatar)
      .def_property_readonly("scene", &Query::scene);
}

}  // namespace foretouch::python
