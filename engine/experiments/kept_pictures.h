// Pictures of drawn fields kept on disk: drawing them is most of an experiment on ground,
// and a changed SLAD sees the same ones.
//
//   DIR/FAMILY-SEED-HEIGHTm/NN.png    NN counts a field's pictures, left before right
//
// What is kept is believed: who changes worlds, renderer or view plans empties the folder.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "engine/core/result.h"
#include "engine/model/image.h"

namespace palace {

class KeptPictures {
 public:
  /// Keeps nothing.
  KeptPictures() = default;
  /// Of one field; `field` names its folder.
  KeptPictures(const std::filesystem::path& dir, const std::string& field) : dir_(dir / field) {}

  /// The next picture: as kept, else as drawn now and kept. A file that is no picture of that size
  /// or cannot be written is an error that names it.
  Result<ImageU8> Next(int width, int height, const std::function<ImageU8()>& draw);

 private:
  std::filesystem::path dir_;
  int next_ = 0;
};

}  // namespace palace
