// XServer: an X server of the test's own that draws into memory, for real windows.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <string>

#include "tests/support/process.h"

namespace palace {

/// Takes a free display number. It does not start afresh when its last client leaves: a client that
/// came at that moment would be thrown out.
class XServer {
 public:
  static bool IsInstalled() { return !FindProgram("Xvfb").empty(); }

  /// Returns when the server has said that it accepts clients, or has ended, or has kept silent for
  /// 30 s.
  XServer() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) {
      return;
    }
    const int to_us = ends[1];
    ProcessOptions options;
    options.command = {"Xvfb",      "-displayfd", std::to_string(to_us),
                       "-screen",   "0",          "1920x1080x24",
                       "-nolisten", "tcp",        "-noreset"};
    options.prepare = [to_us] { return fcntl(to_us, F_SETFD, 0) == 0; };
    server_ = std::make_unique<Process>(options);
    close(to_us);
    const std::string number = LineFrom(ends[0]);
    close(ends[0]);
    display_ = number.empty() ? "" : ":" + number;
  }

  /// ":7"; empty where no server came up.
  const std::string& display() const { return display_; }
  std::string Complaint() const { return server_ ? server_->Err() : "no pipe"; }

 private:
  /// Without its end; empty when the other side closed or was silent for too long.
  static std::string LineFrom(int file) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    std::string line;
    for (char c = 0;;) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
          end - std::chrono::steady_clock::now());
      pollfd wait{file, POLLIN, 0};
      if (left.count() <= 0 || poll(&wait, 1, static_cast<int>(left.count())) <= 0 ||
          read(file, &c, 1) != 1) {
        return {};
      }
      if (c == '\n') {
        return line;
      }
      line += c;
    }
  }

  std::unique_ptr<Process> server_;
  std::string display_;
};

}  // namespace palace
