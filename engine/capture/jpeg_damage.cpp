#include "engine/capture/jpeg_damage.h"

// jpeglib.h asks for FILE and leaves it to others.
// clang-format off
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <jpeglib.h>
#include <jerror.h>
// clang-format on

namespace palace {
namespace {

/// OpenCV reads no larger picture, so nobody has to wait here for a small file that claims one.
constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 30;

/// What libjpeg reports to. `base` comes first: it hands back a pointer to it.
struct Reports {
  jpeg_error_mgr base{};
  std::jmp_buf stop{};
  char damage[JMSG_LENGTH_MAX] = "";
};

Reports& ReportsOf(j_common_ptr decoder) { return *reinterpret_cast<Reports*>(decoder->err); }

/// Only warnings (level -1), and of them the first that is damage.
void Hear(j_common_ptr decoder, int level) {
  Reports& reports = ReportsOf(decoder);
  if (level == -1 && reports.base.msg_code != JWRN_EXTRANEOUS_DATA && reports.damage[0] == '\0') {
    reports.base.format_message(decoder, reports.damage);
  }
}

/// libjpeg is C and may not go on: back to where it was called.
[[noreturn]] void Stop(j_common_ptr decoder) {
  Reports& reports = ReportsOf(decoder);
  reports.base.format_message(decoder, reports.damage);
  std::longjmp(reports.stop, 1);
}

}  // namespace

std::string DamageInJpeg(std::string_view bytes) {
  Reports reports;
  jpeg_decompress_struct decoder{};
  decoder.err = jpeg_std_error(&reports.base);
  reports.base.emit_message = Hear;
  reports.base.error_exit = Stop;
  if (setjmp(reports.stop) == 0) {
    jpeg_create_decompress(&decoder);
    jpeg_mem_src(&decoder, reinterpret_cast<const unsigned char*>(bytes.data()),
                 static_cast<unsigned long>(bytes.size()));
    jpeg_read_header(&decoder, TRUE);
    if (std::uint64_t{decoder.image_width} * decoder.image_height > kMostPixels) {
      jpeg_destroy_decompress(&decoder);
      return {};
    }
    decoder.dct_method = JDCT_FASTEST;  // the samples are not looked at
    decoder.do_fancy_upsampling = FALSE;
    jpeg_start_decompress(&decoder);
    // Libjpeg's own memory: no object of ours begins or changes between setjmp and longjmp.
    const JSAMPARRAY row = decoder.mem->alloc_sarray(
        reinterpret_cast<j_common_ptr>(&decoder), JPOOL_IMAGE,
        decoder.output_width * static_cast<JDIMENSION>(decoder.output_components), 1);
    while (decoder.output_scanline < decoder.output_height) {
      jpeg_read_scanlines(&decoder, row, 1);
    }
    jpeg_finish_decompress(&decoder);
  }
  jpeg_destroy_decompress(&decoder);
  return reports.damage;
}

}  // namespace palace
