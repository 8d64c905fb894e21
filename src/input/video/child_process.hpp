#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace stdc {

/// A program that runs beside this one and whose standard output is read here. It has no input, is in a
/// process group of its own (Ctrl-C in a terminal is for this program to handle), and is gone with this
/// object. To be used by one thread at a time.
class ChildProcess {
 public:
  /// Starts `words[0]`, which is looked for in PATH, with the others as its arguments; no shell reads them.
  /// Throws std::system_error: with no_such_file_or_directory if there is no such program.
  explicit ChildProcess(const std::vector<std::string>& words);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Fills `to` with the next bytes of the output, waiting for them. @returns how many: fewer only at the end
  std::size_t read(std::span<std::uint8_t> to);
  /// To be called when the output has ended: waits until the program has. @returns its exit status, nothing
  /// if it had to be stopped or was
  std::optional<int> finish();
  /// The first 4 KB of what it wrote to its standard error.
  const std::string& complaints() const { return complaints_; }

 private:
  /// An open file, closed with this object.
  class File {
   public:
    ~File() { close(); }
    File() = default;
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    void close();
    int number = -1;
  };
  static void make_pipe(File& from, File& to);
  void take_complaints();
  void stop();
  void start(const std::vector<std::string>& words, const File& output, const File& errors);

  File output_, errors_;
  pid_t id_ = -1;  ///< -1: it has been waited for
  std::string complaints_;
};

}  // namespace stdc
