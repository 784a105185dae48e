// foretouch-import: reads a model file and writes its content to standard output: its triangles
// (assets/import/protocol.h), or with --model its nodes, meshes, bones and animations
// (assets/import/model_stream.h). A helper of the library, run as a child under limits that its
// parent sets; the only program that links assimp, Draco, urdfdom and libmujoco.
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unistd.h>

#include "assets/import/cage.h"
#include "assets/import/failure.h"
#include "assets/import/gltf_file.h"
#include "assets/import/memory_budget.h"
#include "assets/import/mjcf_text.h"
#include "assets/import/model.h"
#include "assets/import/model_stream.h"
#include "assets/import/scene.h"
#include "assets/import/text.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

bool writeAll(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = write(fd, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes.remove_prefix(countOf(count));
  }
  return true;
}

Model read(const ModelQuestion& question) {
  if (lowerExtensionOf(question.path) == ".urdf") return readUrdf(question);
  if (lowerExtensionOf(question.path) == ".mvnx") return readMvnx(question);
  if (isGltf(question.path)) return readGltf(question);
  if (!isMjcf(question.path)) return readModel(question);
#ifdef FORETOUCH_HAS_MUJOCO
  return readMjcf(question);
#else
  refuse(
      "it is a MuJoCo model (MJCF), and this foretouch-import is built without libmujoco "
      "(FORETOUCH_MUJOCO)");
#endif
}

bool sendModel(const ModelQuestion& question, ModelWriter& writer) {
  const Model model = read(question);
  writer.fileFrame(model.frame);
  return writer.write(model);
}

/// The exit status.
template <typename Writer, typename Send>
int answer(Send send) {
  // Reserves standard output for the stream; the libraries' output goes to stderr.
  const int output = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (output < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) {
    std::perror("foretouch-import: standard output");
    return 2;
  }
  Writer writer([output](std::string_view bytes) { return writeAll(output, bytes); });
  try {
    return send(writer) ? 0 : 1;
  } catch (const Failure& failure) {
    writer.fail(failure.kind, failure.text);
  } catch (const std::bad_alloc&) {
    writer.fail(ImportFailure::OutOfMemory, std::to_string(grantedMemory()));
  } catch (const std::exception& error) {
    writer.fail(ImportFailure::Refused, error.what());
  }
  return 1;
}

/// Nothing if the arguments do not ask for a model.
std::optional<ModelQuestion> modelQuestion(int argc, char** argv) {
  if (argc < 3 || std::string_view(argv[1]) != "--model") return std::nullopt;
  ModelQuestion question;
  question.path = argv[2];
  for (int i = 3; i < argc; ++i) {
    const std::string_view option = argv[i];
    if (option == "--visual") {
      question.visual = true;
    } else if (option == "--robot") {
      question.isRobot = true;
    } else if (option == "--meshes") {
      question.needsMeshes = true;
    } else if (option == "--package" && i + 1 < argc) {
      question.packagePaths.emplace_back(argv[++i]);
    } else {
      return std::nullopt;
    }
  }
  return question;
}

int run(int argc, char** argv) {
  closeCageBehindUs();
  grantMemoryFor(0);
  const auto question = modelQuestion(argc, argv);
  if (question.has_value()) {
    return answer<ModelWriter>([&](ModelWriter& writer) { return sendModel(*question, writer); });
  }
  const std::string path = argv[1];
  return answer<ImportWriter>([&](ImportWriter& writer) { return sendScene(path, writer); });
}

}  // namespace
}  // namespace foretouch::internal

int main(int argc, char** argv) {
  const bool isQuestion = argc == 2 || foretouch::internal::modelQuestion(argc, argv).has_value();
  if (!isQuestion || std::string_view(argv[1]) == "--help" || isatty(STDOUT_FILENO) != 0) {
    std::fputs(
        "usage: foretouch-import FILE\n"
        "       foretouch-import --model FILE [--visual] [--robot] [--package DIR]...\n"
        "Writes the triangles, or the rigged model, of a file to standard output, in a binary\n"
        "form that the foretouch library reads. Not meant to be run by hand.\n",
        stderr);
    return 2;
  }
  _exit(foretouch::internal::run(argc, argv));
}
