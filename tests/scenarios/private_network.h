// A network of its own for some processes: multicast on its loopback reaches nothing else.
#pragma once

#include <fcntl.h>
#include <sched.h>

#include <memory>
#include <optional>
#include <string>

#include "tests/support/process.h"

namespace palace {

/// Lives as long as its holder process. Needs root or unprivileged user namespaces.
class PrivateNetwork {
 public:
  /// Empty, with the reason, where the machine does not permit one.
  static std::unique_ptr<PrivateNetwork> Create(std::string& why_not) {
    if (FindProgram("unshare").empty() || FindProgram("ip").empty()) {
      why_not = "runs with unshare (util-linux) and ip (iproute2) installed";
      return nullptr;
    }
    auto network = std::unique_ptr<PrivateNetwork>(new PrivateNetwork);
    // The holder may already be in its network while its loopback cannot be set up yet.
    for (int i = 0; i < 100 && network->holder_->Running(); ++i) {
      if (network->Entered() && network->Ip({"link", "set", "lo", "up", "multicast", "on"}) &&
          network->Ip({"route", "add", "224.0.0.0/4", "dev", "lo"})) {
        return network;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    why_not = "runs as root or where user namespaces are allowed: " + network->holder_->Err();
    return nullptr;
  }

  /// The process will run inside.
  ProcessOptions Inside(ProcessOptions options) const {
    const std::string base = "/proc/" + std::to_string(holder_->pid()) + "/ns/";
    const bool user = geteuid() != 0;
    options.prepare = [base, user] {
      return (!user || Enter(base + "user", CLONE_NEWUSER)) && Enter(base + "net", CLONE_NEWNET);
    };
    return options;
  }

 private:
  PrivateNetwork() {
    ProcessOptions options;
    options.command = {"unshare", geteuid() == 0 ? "-n" : "-rn", "sleep", "600"};
    holder_ = std::make_unique<Process>(options);
  }
  static bool Enter(const std::string& space, int kind) {
    const int file = open(space.c_str(), O_RDONLY | O_CLOEXEC);
    const bool entered = file >= 0 && setns(file, kind) == 0;
    close(file);
    return entered;
  }
  bool Entered() const {
    std::error_code error;
    const auto own = std::filesystem::read_symlink("/proc/self/ns/net", error);
    const auto held =
        std::filesystem::read_symlink("/proc/" + std::to_string(holder_->pid()) + "/ns/net", error);
    return !error && own != held;
  }
  bool Ip(std::vector<std::string> words) const {
    ProcessOptions options;
    options.command = std::move(words);
    options.command.insert(options.command.begin(), "ip");
    return RunProcess(Inside(options), 10).exit_code == 0;
  }

  std::unique_ptr<Process> holder_;
};

}  // namespace palace
