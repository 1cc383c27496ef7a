#include "engine/slad/side_by_side.h"

#include <opencv2/core.hpp>

namespace palace {

void ForEach(int count, const std::function<void(int)>& work) {
  cv::parallel_for_(cv::Range(0, count), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) {
      work(i);
    }
  });
}

void SideBySide(std::initializer_list<std::function<void()>> jobs) {
  ForEach(static_cast<int>(jobs.size()), [&](int i) { jobs.begin()[i](); });
}

}  // namespace palace
