#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace stdc::app {

/// What else is said about an option; a handle, the command keeps the option itself.
class CommandOption {
 public:
  explicit CommandOption(CLI::Option& option) : option_(&option) {}

  /// The command cannot go without it.
  CommandOption& required();
  /// What stands for the value in the help, for instance "A:B".
  CommandOption& type_name(const std::string& name);
  /// The help shows the value that the variable has now.
  CommandOption& capture_default_str();
  /// Each use takes one value: what follows is no second one.
  CommandOption& one_value_each();
  /// The value, a number, may be left out: then it is `missing`.
  /// @param name  what stands for it in the help, for instance "PORT"
  CommandOption& optional_number(const std::string& name, const std::string& missing);
  /// Several values in one word, divided by this.
  CommandOption& delimiter(char divider);
  /// Any other value is refused.
  CommandOption& in_range(int min, int max);
  CommandOption& in_range(double min, double max);
  CommandOption& one_of(const std::vector<std::string>& values);
  /// Refused without that option, or together with it.
  CommandOption& needs(const CommandOption& other);
  CommandOption& excludes(const CommandOption& other);

 private:
  CLI::Option* option_;
};

/// A subcommand of the program, made with CLI11. CLI11 costs seconds to compile in every file that includes
/// it, so only command.cpp does. A handle: the Program keeps the command itself.
class Command {
 public:
  explicit Command(CLI::App& app) : app_(&app) {}

  Command add_subcommand(const std::string& name, const std::string& description);
  /// An option ("--output,-o") or a positional argument ("SEQUENCE"). `Value` is one of the types at the end
  /// of command.cpp (text, path, numbers, optional and vector of them): the linker misses others, add them
  /// there.
  /// @param value  where it goes; must live until the command has run
  template <typename Value>
  CommandOption add_option(const std::string& names, Value& value, const std::string& description);
  CommandOption add_flag(const std::string& names, bool& value, const std::string& description);
  /// Text under the options in the help: notes and examples.
  void footer(const std::string& text);
  /// The work; throws stdc::Error for whatever the user can correct, or ExitStatus.
  void callback(std::function<void()> work);
  /// One of its subcommands must be given.
  void require_subcommand();
  /// Any options and arguments are taken and ignored.
  void allow_extras();

 private:
  CLI::App* app_;
};

/// Thrown by a command that has said all there is to say, and ends with this exit code.
struct ExitStatus {
  int code;
};

/// The whole command line.
class Program {
 public:
  Program(const std::string& description, const std::string& version);
  /// A developers' tool: one command, that of root(), without subcommands.
  static Program tool(const std::string& name, const std::string& description) {
    return Program(name, description, 0);
  }
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// The commands are added to this as its subcommands.
  Command root() { return Command(*app_); }
  /// Parses the arguments and runs the command that they name.
  /// @return exit code: 0, or 2 for arguments that no command takes; then one line on stderr says why
  /// Throws what the command throws.
  int run(int argc, char** argv);

 private:
  Program(const std::string& name, const std::string& description, int subcommands);

  std::unique_ptr<CLI::App> app_;
};

}  // namespace stdc::app
