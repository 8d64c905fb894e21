#include "input/video/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string_view>
#include <system_error>

namespace stdc {
namespace {

constexpr std::size_t kMaxComplaints = 4096;

void check_spawn(int code, const char* what) {
  if (code != 0) throw std::system_error(code, std::generic_category(), what);
}

/// Whether posix_spawnp will find a program, which need not be able to say that it did not: an emulator such
/// as qemu-user starts children by fork(), and then only the child knows.
bool is_there(const std::string& program) {
  if (program.find('/') != std::string::npos) return access(program.c_str(), X_OK) == 0;
  const char* path = std::getenv("PATH");
  std::string_view rest = path != nullptr ? path : "/bin:/usr/bin";
  while (true) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    const std::string folder(end > 0 ? rest.substr(0, end) : ".");
    if (access((folder + "/" + program).c_str(), X_OK) == 0) return true;
    if (end == rest.size()) return false;
    rest.remove_prefix(end + 1);
  }
}

/// What the child does before it becomes the program.
class SpawnActions {
 public:
  SpawnActions(int output, int errors) {
    check_spawn(posix_spawn_file_actions_init(&actions_), "posix_spawn_file_actions_init");
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, errors, STDERR_FILENO);
#if defined(__GLIBC__) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 34)
    // Streams of C++ leave their files open in children: the network's sockets and a file half written among
    // them.
    posix_spawn_file_actions_addclosefrom_np(&actions_, STDERR_FILENO + 1);
#endif
  }
  ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

/// A group of its own, and no signals blocked or ignored that this program blocks or ignores.
class SpawnAttributes {
 public:
  SpawnAttributes() {
    check_spawn(posix_spawnattr_init(&attributes_), "posix_spawnattr_init");
    sigset_t none{}, usual{};
    sigemptyset(&none);
    sigemptyset(&usual);
    for (const int signal : {SIGINT, SIGTERM, SIGPIPE}) sigaddset(&usual, signal);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setsigdefault(&attributes_, &usual);
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(&attributes_,
                             POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  ~SpawnAttributes() { posix_spawnattr_destroy(&attributes_); }
  SpawnAttributes(const SpawnAttributes&) = delete;
  SpawnAttributes& operator=(const SpawnAttributes&) = delete;
  const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_{};
};

/// read(2) that goes on after signals.
ssize_t read_some(int file, void* to, std::size_t size) {
  ssize_t got = 0;
  do {
    got = ::read(file, to, size);
  } while (got < 0 && errno == EINTR);
  return got;
}

/// waitpid(2) that goes on after signals; false if somebody else has waited for the child.
bool reap(pid_t id, int& status) {
  pid_t got = 0;
  do {
    got = waitpid(id, &status, 0);
  } while (got < 0 && errno == EINTR);
  return got == id;
}

}  // namespace

void ChildProcess::File::close() {
  if (number >= 0) ::close(number);
  number = -1;
}

void ChildProcess::make_pipe(File& from, File& to) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe2");
  from.number = ends[0], to.number = ends[1];
}

ChildProcess::ChildProcess(const std::vector<std::string>& words) {
  File output, errors;  // the child's ends
  make_pipe(output_, output);
  make_pipe(errors_, errors);
  constexpr int kPipeBytes = 1 << 20;  // fewer changes between the two processes; smaller will do
  fcntl(output_.number, F_SETPIPE_SZ, kPipeBytes);
  start(words, output, errors);
}

void ChildProcess::start(const std::vector<std::string>& words, const File& output, const File& errors) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (const std::string& word : words)
    arguments.push_back(const_cast<char*>(word.c_str()));  // not written to
  arguments.push_back(nullptr);
  if (!is_there(words.front())) check_spawn(ENOENT, words.front().c_str());
  const SpawnActions actions(output.number, errors.number);
  const SpawnAttributes attributes;
  check_spawn(
      posix_spawnp(&id_, words.front().c_str(), actions.get(), attributes.get(), arguments.data(), environ),
      words.front().c_str());
}

ChildProcess::~ChildProcess() { stop(); }

void ChildProcess::stop() {
  if (id_ < 0) return;
  kill(-id_, SIGKILL);  // and what it has started: some install a script that starts the program
  kill(id_, SIGKILL);   // in an emulator it need not have come to have its group yet
  int status = 0;
  reap(id_, status);
  id_ = -1;
}

std::size_t ChildProcess::read(std::span<std::uint8_t> to) {
  std::size_t filled = 0;
  while (filled < to.size() && output_.number >= 0) {
    // Both at once: a child that waits for its complaints to be read writes no output.
    std::array<pollfd, 2> files{pollfd{output_.number, POLLIN, 0}, pollfd{errors_.number, POLLIN, 0}};
    if (poll(files.data(), files.size(), -1) < 0 && errno != EINTR) break;
    if (files[1].revents != 0) take_complaints();
    if (files[0].revents == 0) continue;
    const ssize_t got = read_some(output_.number, to.data() + filled, to.size() - filled);
    if (got <= 0) {
      output_.close();
      break;
    }
    filled += static_cast<std::size_t>(got);
  }
  return filled;
}

void ChildProcess::take_complaints() {
  std::array<char, 1024> text{};
  const ssize_t got = read_some(errors_.number, text.data(), text.size());
  if (got <= 0) return errors_.close();
  complaints_.append(text.data(),
                     std::min(static_cast<std::size_t>(got), kMaxComplaints - complaints_.size()));
}

std::optional<int> ChildProcess::finish() {
  constexpr int kPatience = 2000;  // [ms] without a word from a child whose output has ended
  output_.close();
  while (errors_.number >= 0) {
    pollfd file{errors_.number, POLLIN, 0};
    const int ready = poll(&file, 1, kPatience);
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) {
      stop();
      return std::nullopt;
    }
    take_complaints();
  }
  if (id_ < 0) return std::nullopt;
  int status = 0;
  const bool known = reap(id_, status);
  id_ = -1;
  if (!known || !WIFEXITED(status)) return std::nullopt;
  return WEXITSTATUS(status);
}

}  // namespace stdc
