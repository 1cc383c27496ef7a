// Writes the corpus of the binary targets anew (tests/fuzz/corpus), from the tests' own samples.
#include <algorithm>
#include <fstream>
#include <utility>

#include "engine/camera/files/camera_files.h"
#include "engine/core/check.h"
#include "engine/core/random.h"
#include "engine/journal/log_index.h"
#include "engine/journal/log_writer.h"
#include "engine/trust/secret_key.h"
#include "tests/camera/sample_cameras.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/wire_types.h"
#include "tests/wire/wire_samples.h"

namespace palace {
namespace {

/// The number of the type whose hash the payload begins with; there must be one.
template <std::size_t... I>
std::uint8_t TypeOf(const std::vector<std::uint8_t>& payload, std::index_sequence<I...>) {
  std::uint64_t hash = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    hash = hash << 8 | payload[i];
  }
  std::size_t type = sizeof...(I);
  ((static_cast<std::uint64_t>(std::tuple_element_t<I, WireTypes>::getHash()) == hash
        ? void(type = I)
        : void()),
   ...);
  PALACE_CHECK(type < sizeof...(I), "a sample's type is not in WireTypes");
  return static_cast<std::uint8_t>(type);
}

void Write(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

std::vector<std::uint8_t> Read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void WriteMessages(const std::filesystem::path& folder, const std::vector<WireMessage>& messages) {
  const std::vector<std::string> channels = StreamChannels(ChannelNames{});
  std::vector<std::uint8_t> stream;
  for (const WireMessage& message : messages) {
    const std::uint8_t type =
        TypeOf(message.payload, std::make_index_sequence<std::tuple_size_v<WireTypes>>());
    std::vector<std::uint8_t> bytes{type};
    bytes.insert(bytes.end(), message.payload.begin() + 8, message.payload.end());
    Write(folder / "message" / message.channel, bytes);
    Write(folder / "conversion" / message.channel, bytes);
    const auto place = std::find(channels.begin(), channels.end(), message.channel);
    if (place != channels.end()) {
      const std::size_t length = bytes.size() - 1;
      stream.insert(stream.end(),
                    {static_cast<std::uint8_t>(place - channels.begin()), type,
                     static_cast<std::uint8_t>(length >> 8), static_cast<std::uint8_t>(length)});
      stream.insert(stream.end(), bytes.begin() + 1, bytes.end());
    }
  }
  Write(folder / "stream" / "bundle", stream);
}

/// Two bytes of length, the log, and for the second file its sidecar.
void WriteLogs(const std::filesystem::path& folder, const std::vector<WireMessage>& messages) {
  const std::filesystem::path log = folder / "scratch.lcm";
  std::filesystem::remove(log);
  std::filesystem::remove(SidecarPath(log));
  {
    auto writer = LogWriter::Create(log);
    for (const WireMessage& message : messages) {
      (void)writer->Write(message);
    }
    (void)writer->Close();
  }
  std::vector<std::uint8_t> bytes = Read(log);
  const std::vector<std::uint8_t> sidecar = Read(SidecarPath(log));
  const std::size_t length = bytes.size();
  bytes.insert(bytes.begin(),
               {static_cast<std::uint8_t>(length >> 8), static_cast<std::uint8_t>(length)});
  Write(folder / "log" / "alone", bytes);
  bytes.insert(bytes.end(), sidecar.begin(), sidecar.end());
  Write(folder / "log" / "with_sidecar", bytes);
  std::filesystem::remove(log);
  std::filesystem::remove(SidecarPath(log));
}

void WriteCameras(const std::filesystem::path& folder, RandomStream& random) {
  const std::pair<const char*, CameraModel> models[] = {
      {"cahvor", CameraModel{RandomCahvor(random)}},
      {"cahvore", CameraModel{RandomCahvore(random, 0.4)}},
      {"tsai", CameraModel{RandomTsai(random)}}};
  const std::pair<const char*, CameraFormat> formats[] = {{"jpl", CameraFormat::kJplText},
                                                          {"willson", CameraFormat::kWillson},
                                                          {"yaml", CameraFormat::kOpenCvYaml},
                                                          {"xml", CameraFormat::kOpenCvXml},
                                                          {"ros", CameraFormat::kRosYaml}};
  for (const auto& [model_name, model] : models) {
    for (const auto& [format_name, format] : formats) {
      if (const auto text = CameraToText(model, format)) {
        Write(folder / "camera" / (std::string(model_name) + "." + format_name),
              {text->begin(), text->end()});
      }
    }
  }
}

void WriteKey(const std::filesystem::path& folder) {
  const std::string digits = "00112233445566778899aabbccddeeff00112233445566778899aabbccddeeff";
  const std::string text = "PALACE-KEY 1\n# of the first\nmade 2026-11-23T01:20:00Z\nfingerprint " +
                           FingerprintText(SecretKey::FromHex(digits).id()) + "\nkey " + digits +
                           "\n";
  Write(folder / "key" / "whole.key", {text.begin(), text.end()});
}

void WriteCorpus(const std::filesystem::path& folder) {
  RandomStream random(7);
  const std::vector<WireMessage> messages = OneOfEach(random);
  WriteMessages(folder, messages);
  WriteLogs(folder, messages);
  WriteCameras(folder, random);
  WriteKey(folder);
}

}  // namespace
}  // namespace palace

int main() {
  palace::WriteCorpus(PALACE_SOURCE_DIR "/tests/fuzz/corpus");
  return 0;
}
