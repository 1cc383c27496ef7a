// Each fuzz target on its corpus and on mutations of it. libFuzzer looks deeper (./test --full);
// this keeps the targets alive and finds in seconds what breaks at once.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <ostream>
#include <set>

#include <gtest/gtest.h>

#include "engine/core/random.h"
#include "tests/fuzz/fuzz_target.h"

namespace palace {

void PrintTo(const FuzzTarget& target, std::ostream* out) { *out << target.name; }

namespace {

using Input = std::vector<std::uint8_t>;
constexpr std::size_t kLongest = 1 << 16;

std::vector<Input> CorpusOf(const FuzzTarget& target) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(
           std::filesystem::path(PALACE_SOURCE_DIR) / "tests/fuzz/corpus" / target.name)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<Input> corpus;
  for (const auto& path : files) {
    std::ifstream file(path, std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return corpus;
}

/// Bytes that counts, lengths and floating-point numbers go wrong on.
constexpr std::uint8_t kTelling[] = {0x00, 0x01, 0x7F, 0x80, 0xFF, 0xF0, '\n', '"', '[', '=', 0xC3};

void MutateOnce(Input& input, const std::vector<Input>& corpus, RandomStream& random) {
  const int length = static_cast<int>(input.size());
  const auto at = input.begin() + (length > 0 ? random.Index(length) : 0);
  const auto run = std::min<std::ptrdiff_t>(1 + random.Index(16), input.end() - at);
  switch (random.Index(6)) {
    case 0:
      if (length > 0) {
        *at ^= static_cast<std::uint8_t>(1 << random.Index(8));
      }
      return;
    case 1:
      std::fill_n(at, run, kTelling[random.Index(std::size(kTelling))]);
      return;
    case 2:
      input.erase(at, at + run);
      return;
    case 3: {
      const Input piece(at, at + run);
      input.insert(at, piece.begin(), piece.end());
      return;
    }
    case 4:
      input.insert(at, kTelling[random.Index(std::size(kTelling))]);
      return;
    default: {  // the head of this one, the tail of another
      const Input& other =
          corpus[static_cast<std::size_t>(random.Index(static_cast<int>(corpus.size())))];
      const auto from =
          std::min<std::ptrdiff_t>(at - input.begin(), static_cast<std::ptrdiff_t>(other.size()));
      input.erase(at, input.end());
      input.insert(input.end(), other.begin() + from, other.end());
    }
  }
}

class EveryTarget : public testing::TestWithParam<FuzzTarget> {};

TEST_P(EveryTarget, LivesThroughItsCorpusAndMutationsOfIt) {
  const std::vector<Input> corpus = CorpusOf(GetParam());
  ASSERT_FALSE(corpus.empty());
  for (const Input& input : corpus) {
    GetParam().run(input);
  }
  const std::uint64_t seed = 20261123;
  const bool touches_files = GetParam().run == FileTargets().front().run;
  const int runs = touches_files ? 150 : 3000;
  std::cout << GetParam().name << ": seed " << seed << ", " << runs << " mutations\n";
  RandomStream random(seed, GetParam().name);
  for (int i = 0; i < runs; ++i) {
    Input input = corpus[static_cast<std::size_t>(random.Index(static_cast<int>(corpus.size())))];
    for (int n = 1 + random.Index(8); n > 0; --n) {
      MutateOnce(input, corpus, random);
    }
    input.resize(std::min(input.size(), kLongest));
    GetParam().run(input);
  }
}

/// The definitions by name, with the text of each.
std::map<std::string, std::string> WireDefinitions() {
  std::map<std::string, std::string> definitions;
  for (const auto& entry : std::filesystem::directory_iterator(
           std::filesystem::path(PALACE_SOURCE_DIR) / "engine/wire/types")) {
    std::ifstream file(entry.path());
    definitions[entry.path().stem().string()] = {std::istreambuf_iterator<char>(file), {}};
  }
  return definitions;
}

TEST(FuzzedTypes, AreAllThatAreDefined) {
  const auto definitions = WireDefinitions();
  ASSERT_GT(definitions.size(), 20u);
  const auto is_part = [&](const std::string& name) {
    return std::any_of(definitions.begin(), definitions.end(), [&](const auto& other) {
      return other.second.find("\n  " + name + " ") != std::string::npos;
    });
  };
  std::vector<std::string> messages;
  for (const auto& [name, text] : definitions) {
    if (!is_part(name)) {
      messages.push_back(name);
    }
  }
  EXPECT_THAT(FuzzedTypes(), testing::UnorderedElementsAreArray(messages));
}

/// A file of the corpus whose first byte tells another type was mistaken for it.
TEST(FuzzedTypes, HaveASampleEach) {
  const std::vector<FuzzTarget> targets = WireTargets();
  const auto message = std::find_if(targets.begin(), targets.end(), [](const FuzzTarget& target) {
    return std::string(target.name) == "message";
  });
  ASSERT_NE(message, targets.end());
  std::set<std::string> seen;
  for (const Input& input : CorpusOf(*message)) {
    ASSERT_FALSE(input.empty());
    ASSERT_LT(input[0], FuzzedTypes().size());
    seen.insert(FuzzedTypes()[input[0]]);
  }
  EXPECT_EQ(seen.size(), FuzzedTypes().size());
}

INSTANTIATE_TEST_SUITE_P(Fuzz, EveryTarget, testing::ValuesIn(FuzzTargets()),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace
}  // namespace palace
