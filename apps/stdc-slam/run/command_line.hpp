#pragma once

#include <string>
#include <vector>

namespace stdc::app {

/// The words that this process was started with, the program's name first.
std::vector<std::string> process_arguments();

/// A command as it can be pasted into a shell (bash, zsh): words with odd characters are quoted, bytes that
/// are no printable text are written as escapes.
std::string shell_command(const std::vector<std::string>& words);

/// The processor and how many of its cores this process may use: "AMD EPYC 9B14, 2 cores".
std::string machine_name();

}  // namespace stdc::app
