// Process: another program as a test's child, with its output, its exit code and a time limit.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace palace {

struct ProcessOptions {
  std::vector<std::string> command;  ///< program (a path, or a name on PATH), then its arguments
  std::vector<std::pair<std::string, std::string>> environment;  ///< set besides the test's own
  std::vector<std::string> without;                              ///< variables taken away
  std::filesystem::path folder;                                  ///< to run in; empty: the test's
  std::function<bool()> prepare;  ///< run in the child before the program; false: exit 126
};

struct ProcessResult {
  int exit_code = -1;  ///< -1 when it did not exit by itself
  int signal = 0;      ///< that ended it
  bool timed_out = false;
  std::string out;
  std::string err;
};

/// Runs from construction on; killed with its children at destruction, and when the test dies.
class Process {
 public:
  explicit Process(const ProcessOptions& options)
      : out_(memfd_create("stdout", MFD_CLOEXEC)), err_(memfd_create("stderr", MFD_CLOEXEC)) {
    std::vector<char*> words;
    for (const std::string& word : options.command) {
      words.push_back(const_cast<char*>(word.c_str()));
    }
    words.push_back(nullptr);
    pid_ = fork();
    if (pid_ == 0) {
      Become(options, words);
    }
    setpgid(pid_, pid_);
  }
  ~Process() {
    Kill();
    close(out_);
    close(err_);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t pid() const { return pid_; }
  /// What it wrote so far.
  std::string Out() const { return Text(out_); }
  std::string Err() const { return Text(err_); }
  bool Running() { return !ended_ && !Reap(WNOHANG); }
  void Signal(int signal) const {
    if (!ended_) {
      kill(pid_, signal);
    }
  }
  /// Until it ends; killed after `timeout_s` of a machine that does nothing else. One that does is
  /// slow, and slow is no hang: it has kBusy times as long.
  ProcessResult Wait(double timeout_s) {
    const auto start = std::chrono::steady_clock::now();
    while (Running()) {
      const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - start;
      if (waited.count() > kBusy * timeout_s) {
        result_.timed_out = true;
        Kill();
        break;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    result_.out = Out();
    result_.err = Err();
    return result_;
  }

 private:
  static constexpr double kBusy = 4;

  [[noreturn]] void Become(const ProcessOptions& options, const std::vector<char*>& words) const {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const int nothing = open("/dev/null", O_RDONLY);
    dup2(nothing, STDIN_FILENO);
    dup2(out_, STDOUT_FILENO);
    dup2(err_, STDERR_FILENO);
    for (const std::string& name : options.without) {
      unsetenv(name.c_str());
    }
    for (const auto& [name, value] : options.environment) {
      setenv(name.c_str(), value.c_str(), 1);
    }
    const bool placed = options.folder.empty() || chdir(options.folder.c_str()) == 0;
    if (!placed || (options.prepare && !options.prepare())) {
      _exit(126);
    }
    execvp(words[0], words.data());
    _exit(127);
  }
  bool Reap(int how) {
    int status = 0;
    pid_t got = 0;
    do {
      got = waitpid(pid_, &status, how);
    } while (got < 0 && errno == EINTR);
    if (got == pid_) {
      ended_ = true;
      result_.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
      result_.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    }
    return ended_;
  }
  void Kill() {
    if (!ended_) {
      kill(-pid_, SIGKILL);
      Reap(0);
    }
  }
  static std::string Text(int file) {
    std::string text;
    char buffer[4096];
    for (ssize_t got = 0;
         (got = pread(file, buffer, sizeof buffer, static_cast<off_t>(text.size()))) > 0;) {
      text.append(buffer, static_cast<std::size_t>(got));
    }
    return text;
  }

  int out_;
  int err_;
  pid_t pid_ = -1;
  bool ended_ = false;
  ProcessResult result_;
};

inline ProcessResult RunProcess(const ProcessOptions& options, double timeout_s) {
  return Process(options).Wait(timeout_s);
}

/// A program on PATH, or nothing.
inline std::string FindProgram(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::string rest = path != nullptr ? path : "";
  while (!rest.empty()) {
    const std::size_t colon = rest.find(':');
    const std::string candidate = rest.substr(0, colon) + "/" + name;
    if (access(candidate.c_str(), X_OK) == 0) {
      return candidate;
    }
    rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
  }
  return {};
}

}  // namespace palace
