#include "engine/tools/trust_command.h"

#include <cstdio>
#include <iostream>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "engine/trust/key_file.h"

namespace palace {
namespace {

struct TrustOptions {
  std::string name;
  std::string keys;

  std::filesystem::path folder() const {
    return keys.empty() ? DefaultKeyFolder() : std::filesystem::path(keys);
  }
};

int Fail(const Error& error) {
  std::cerr << "palacectl trust: " << error.message << "\n";
  return error.code == ErrorCode::kUsage ? 2 : 1;
}

void Print(const NamedKey& key) {
  std::printf("%s  %s  %s\n", FingerprintText(key.key.id()).c_str(), key.name.c_str(),
              key.file.string().c_str());
}

int Make(const TrustOptions& options) {
  const Result<NamedKey> key = MakeKeyFile(options.name, options.folder());
  if (!key) {
    return Fail(key.error());
  }
  Print(*key);
  std::printf("Copy this file to the vehicle by a way that nobody else reads.\n");
  return 0;
}

int Show(const TrustOptions& options) {
  const Result<NamedKey> key = FindKey(options.name, options.folder());
  if (!key) {
    return Fail(key.error());
  }
  Print(*key);
  return 0;
}

int List(const TrustOptions& options) {
  int exit_code = 0;
  const auto files = KeyFilesIn(options.folder());
  for (const auto& file : files) {
    const Result<NamedKey> key = LoadKeyFile(file);
    if (key) {
      Print(*key);
    } else {
      exit_code = Fail(key.error());
    }
  }
  if (files.empty()) {
    std::printf("no keys in %s; make one with palacectl trust make NAME\n",
                options.folder().string().c_str());
  }
  return exit_code;
}

int Remove(const TrustOptions& options) {
  const Status removed = RemoveKeyFile(options.name, options.folder());
  if (!removed) {
    return Fail(removed.error());
  }
  std::printf("removed; the vehicle obeys its copy until that is removed too\n");
  return 0;
}

}  // namespace

void AddTrustCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "trust", "Keys of pairs of station and vehicle: who holds one may ask to command");
  command->require_subcommand(1);
  const auto options = std::make_shared<TrustOptions>();
  const auto add = [&](const char* verb, const char* what, bool named,
                       int (*run)(const TrustOptions&)) {
    CLI::App* sub = command->add_subcommand(verb, what);
    if (named) {
      sub->add_option("NAME", options->name, "Of the pair, e.g. heli-1")->required();
    }
    sub->add_option("--keys", options->keys,
                    "Folder of keys; without it $XDG_CONFIG_HOME/palace/keys");
    sub->callback([options, run, &exit_code] { exit_code = run(*options); });
  };
  add("make", "Make a random key, mode 0600", true, Make);
  add("show", "Fingerprint and file of a key, never the key", true, Show);
  add("list", "All keys", false, List);
  add("remove", "Remove a key", true, Remove);
}

}  // namespace palace
