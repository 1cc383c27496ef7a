#include "gui/render/texture_set.h"

#include <utility>

namespace palace {

/// One picture on the GPU and the picture it came from.
struct TextureSet::Slot {
  Texture texture;
  std::shared_ptr<const ImageU8> source;
  TextureFilter filter = TextureFilter::kLinear;
};

TextureSet::TextureSet() : pictures_(std::make_unique<std::array<Slot, 5>>()) {}
TextureSet::~TextureSet() = default;

void TextureSet::Reset() {
  pictures_ = std::make_unique<std::array<Slot, 5>>();
  maps_ = {};
  recorded_ = {};
  difference_ = {};
  shown_.reset();
  compared_now_.reset();
  compared_recorded_.reset();
  range_uploaded_.reset();
  elevation_range_m_.reset();
  names_ = {};
}

GLuint TextureSet::Show(Slot& slot, std::shared_ptr<const ImageU8> picture, TextureFilter filter) {
  if (picture == nullptr || picture->empty()) {
    slot.source.reset();
    return 0;
  }
  if (slot.source != picture) {
    slot.texture.Upload(*picture, filter);
    slot.source = std::move(picture);
    slot.filter = filter;
  } else if (slot.filter != filter) {
    slot.texture.SetFilter(filter);
    slot.filter = filter;
  }
  return slot.texture.name();
}

void TextureSet::Update(const EngineSnapshot& snapshot, double camera_scale) {
  const TextureFilter filter = camera_scale > 2 ? TextureFilter::kNearest : TextureFilter::kLinear;
  // An alias keeps the whole frame alive as long as its picture is shown.
  std::shared_ptr<const ImageU8> left = snapshot.sensors->left_rectified;
  std::shared_ptr<const ImageU8> right = snapshot.sensors->right_rectified;
  if (left == nullptr && snapshot.sensors->frame != nullptr) {
    left = {snapshot.sensors->frame, &snapshot.sensors->frame->left};
  }
  if (right == nullptr && snapshot.sensors->frame != nullptr) {
    right = {snapshot.sensors->frame, &snapshot.sensors->frame->right};
  }
  std::array<Slot, 5>& slots = *pictures_;
  const TrackerStatus& tracker = snapshot.flight->tracker;
  names_.left_camera = Show(slots[0], std::move(left), filter);
  names_.right_camera = Show(slots[1], std::move(right), filter);
  names_.anchor_patch = Show(slots[2], tracker.anchor_patch, TextureFilter::kLinear);
  names_.current_patch = Show(slots[3], tracker.current_patch, TextureFilter::kLinear);
  names_.difference_patch = Show(slots[4], tracker.difference_patch, TextureFilter::kLinear);
  UpdateMaps(snapshot);
  UpdateComparison(snapshot);
  UpdateRange(snapshot);
}

void TextureSet::UpdateRange(const EngineSnapshot& snapshot) {
  if (!range_shown_ || snapshot.terrain->range == nullptr ||
      snapshot.terrain->range->depth_m.empty()) {
    names_.range_tint = 0;
    range_uploaded_.reset();
    return;
  }
  if (snapshot.terrain->range != range_uploaded_) {
    range_uploaded_ = snapshot.terrain->range;
    names_.range_tint_m = DepthRangeFor(snapshot.terrain->range->depth_m);
    range_.Upload(RangeTint(snapshot.terrain->range->depth_m, names_.range_tint_m),
                  TextureFilter::kLinear);
  }
  names_.range_tint = range_.name();
}

void TextureSet::UpdateMaps(const EngineSnapshot& snapshot) {
  const std::shared_ptr<const TerrainDecision>& decision =
      snapshot.terrain->preview != nullptr ? snapshot.terrain->preview : snapshot.terrain->applied;
  if (decision == shown_) {
    return;
  }
  shown_ = decision;
  names_.maps = {};
  if (decision == nullptr || decision->elevation == nullptr || decision->hazards == nullptr) {
    return;
  }
  if (!elevation_range_m_) {
    elevation_range_m_ = ElevationRangeFor(decision->elevation->Measured());
  }
  ranges_ = RangesFor(decision->settings, *elevation_range_m_);
  const HazardMaps& hazards = *decision->hazards;
  struct Layer {
    const GridF& values;
    ValueRange range;
    ColourMap colours;
  };
  const Layer layers[] = {
      {decision->elevation->Measured(), ranges_.elevation_m, ColourMap::kViridis},
      {hazards.slope_rad, ranges_.slope_rad, ColourMap::kCividis},
      {hazards.roughness_m, ranges_.roughness_m, ColourMap::kMagma},
      {hazards.cost, ranges_.cost, ColourMap::kInferno},
      {hazards.safe_distance_m, ranges_.safe_distance_m, ColourMap::kSafeDistance}};
  for (std::size_t i = 0; i < maps_.size(); ++i) {
    maps_[i].Upload(MapPicture(layers[i].values, layers[i].range, layers[i].colours),
                    TextureFilter::kNearest);
    names_.maps[i] = maps_[i].name();
  }
}

void TextureSet::UpdateComparison(const EngineSnapshot& snapshot) {
  const std::shared_ptr<const TerrainDecision>& recorded = snapshot.terrain->recorded;
  if (recorded == compared_recorded_ && shown_ == compared_now_) {
    return;
  }
  compared_recorded_ = recorded;
  compared_now_ = shown_;
  names_.recorded_safe_distance = 0;
  names_.difference = 0;
  if (recorded == nullptr || recorded->hazards == nullptr) {
    return;
  }
  const ValueRange range = RangesFor(recorded->settings, ranges_.elevation_m).safe_distance_m;
  recorded_.Upload(MapPicture(recorded->hazards->safe_distance_m, range, ColourMap::kSafeDistance),
                   TextureFilter::kNearest);
  names_.recorded_safe_distance = recorded_.name();
  if (shown_ != nullptr && shown_->hazards != nullptr) {
    difference_.Upload(DifferencePicture(*recorded->hazards, *shown_->hazards),
                       TextureFilter::kNearest);
    names_.difference = difference_.name();
  }
}

}  // namespace palace
