#include "commands/command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>

namespace stdc::app {
namespace {

constexpr char kOptionalMark = '[';  ///< begins the type's name of an option whose value may be left out

bool is_number(const std::string& word) {
  return !word.empty() && word.find_first_not_of("0123456789") == std::string::npos;
}

/// CLI11 would take the next word for a value that was left out, whatever it is: the value that is meant is
/// written out.
std::vector<std::string> with_missing_numbers(const CLI::App& app, std::vector<std::string> words) {
  if (words.empty()) return words;
  const auto subcommands =
      app.get_subcommands([&](const CLI::App* one) { return one->get_name() == words[0]; });
  if (subcommands.empty()) return words;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const CLI::Option* option = subcommands[0]->get_option_no_throw(words[i]);
    if (option == nullptr || !option->get_type_name().starts_with(kOptionalMark)) continue;
    const bool is_given = i + 1 < words.size() && is_number(words[i + 1]);
    if (!is_given) words[i] += "=" + option->get_default_str();
  }
  return words;
}

}  // namespace

CommandOption& CommandOption::required() {
  option_->required();
  return *this;
}

CommandOption& CommandOption::type_name(const std::string& name) {
  option_->type_name(name);
  return *this;
}

CommandOption& CommandOption::capture_default_str() {
  option_->capture_default_str();
  return *this;
}

CommandOption& CommandOption::one_value_each() {
  option_->allow_extra_args(false);
  return *this;
}

CommandOption& CommandOption::optional_number(const std::string& name, const std::string& missing) {
  option_->type_name(kOptionalMark + name + "]")->default_str(missing);
  return *this;
}

CommandOption& CommandOption::delimiter(char divider) {
  option_->delimiter(divider);
  return *this;
}

CommandOption& CommandOption::in_range(int min, int max) {
  option_->check(CLI::Range(min, max));
  return *this;
}

CommandOption& CommandOption::in_range(double min, double max) {
  option_->check(CLI::Range(min, max));
  return *this;
}

CommandOption& CommandOption::one_of(const std::vector<std::string>& values) {
  option_->check(CLI::IsMember(values));
  return *this;
}

CommandOption& CommandOption::needs(const CommandOption& other) {
  option_->needs(other.option_);
  return *this;
}

CommandOption& CommandOption::excludes(const CommandOption& other) {
  option_->excludes(other.option_);
  return *this;
}

Command Command::add_subcommand(const std::string& name, const std::string& description) {
  return Command(*app_->add_subcommand(name, description));
}

template <typename Value>
CommandOption Command::add_option(const std::string& names, Value& value, const std::string& description) {
  return CommandOption(*app_->add_option(names, value, description));
}

CommandOption Command::add_flag(const std::string& names, bool& value, const std::string& description) {
  return CommandOption(*app_->add_flag(names, value, description));
}

void Command::footer(const std::string& text) { app_->footer(text); }

void Command::callback(std::function<void()> work) { app_->callback(std::move(work)); }

void Command::require_subcommand() { app_->require_subcommand(1); }

void Command::allow_extras() { app_->allow_extras(); }

Program::Program(const std::string& name, const std::string& description, int subcommands)
    : app_(std::make_unique<CLI::App>(description)) {
  app_->require_subcommand(subcommands);
  app_->failure_message([name](const CLI::App*, const CLI::Error& error) {
    return name + ": " + error.what() + "; run with --help to see the options\n";
  });
}

Program::Program(const std::string& description, const std::string& version)
    : Program("stdc-slam", description, 1) {
  app_->set_version_flag("--version", version);
}

Program::~Program() = default;

int Program::run(int argc, char** argv) {
  try {
    app_->name(argc > 0 ? argv[0] : "stdc-slam");
    std::vector<std::string> words = with_missing_numbers(*app_, {argv + std::min(argc, 1), argv + argc});
    std::reverse(words.begin(), words.end());  // as CLI11 has it
    app_->parse(std::move(words));
    return 0;
  } catch (const CLI::ParseError& error) {
    constexpr int kBadInput = 2;
    return app_->exit(error) == 0 ? 0 : kBadInput;  // --help and --version come here too
  }
}

// clang-format off
template CommandOption Command::add_option(const std::string&, int&, const std::string&);
template CommandOption Command::add_option(const std::string&, double&, const std::string&);
template CommandOption Command::add_option(const std::string&, std::uint64_t&, const std::string&);
template CommandOption Command::add_option(const std::string&, std::string&, const std::string&);
template CommandOption Command::add_option(const std::string&, std::filesystem::path&, const std::string&);
template CommandOption Command::add_option(const std::string&, std::optional<double>&, const std::string&);
template CommandOption Command::add_option(const std::string&, std::optional<int>&, const std::string&);
template CommandOption Command::add_option(const std::string&, std::optional<std::string>&, const std::string&);
template CommandOption Command::add_option(const std::string&, std::optional<std::filesystem::path>&, const std::string&);
template CommandOption Command::add_option(const std::string&, std::vector<int>&, const std::string&);
template CommandOption Command::add_option(const std::string&, std::vector<std::string>&, const std::string&);
template CommandOption Command::add_option(const std::string&, std::vector<std::filesystem::path>&, const std::string&);
// clang-format on

}  // namespace stdc::app
