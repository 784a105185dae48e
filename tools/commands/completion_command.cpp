#include "tools/commands/completion_command.h"

#include <memory>
#include <string>
#include <utility>

#include "tools/commands/completion.h"

namespace foretouch::tools {

Command completionCommand(std::function<std::vector<Command>()> all) {
  const auto shell = std::make_shared<std::string>();
  Settings settings;
  Setting& setting =
      settings.text("shell", "bash|zsh|fish", *shell, "The shell that is to complete");
  setting.words = {"bash", "zsh", "fish"};
  setting.only(setting.words).required("a shell: bash, zsh or fish");
  Command command{"completion",
                  "Print a script that completes commands, options and files in a shell",
                  "Examples:\n"
                  "  source <(foretouch completion bash)\n"
                  "  source <(foretouch completion zsh)\n"
                  "  foretouch completion fish | source",
                  std::move(settings)};
  command.run = [shell, all = std::move(all)](const Settings&) {
    const Shell asked = *shell == "bash" ? Shell::Bash : *shell == "zsh" ? Shell::Zsh : Shell::Fish;
    printOut(completionScript(asked, completableCommands(all())));
    return ExitCode::Done;
  };
  return command;
}

}  // namespace foretouch::tools
