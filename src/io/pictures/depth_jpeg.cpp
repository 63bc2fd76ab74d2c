// Reads JPEG files with libjpeg.
#include <setjmp.h>

#include <cstddef>
#include <cstdio>
#include <vector>

// jpeglib.h needs FILE and std::size_t; jerror.h needs the macros of jpeglib.h.
#include <jpeglib.h>

#include <jerror.h>

#include "io/pictures/pictures.h"
#include "io/text.h"

namespace relievo::io {
namespace {

// A scan is a pass over the picture in a progressive JPEG. Cameras and programs write at most some tens of
// scans. Broken files may have thousands, and each scan takes as much time as decoding the whole picture.
constexpr int most_scans = 100;

// libjpeg requires that its error handler does not return. So leave() jumps back into decode(), where no
// object has a destructor.
struct Decoder {
  // Must be the first member, so that libjpeg's pointers to it are pointers to the Decoder.
  jpeg_decompress_struct jpeg;
  jpeg_error_mgr errors;
  jpeg_progress_mgr progress;
  jmp_buf begin;
  char message[JMSG_LENGTH_MAX];
  std::size_t bytes_left;
};

Decoder& decoder_of(j_common_ptr jpeg) {
  return *reinterpret_cast<Decoder*>(jpeg);
}

[[noreturn]] void leave(Decoder& decoder) {
  decoder.bytes_left = decoder.jpeg.src ? decoder.jpeg.src->bytes_in_buffer : 0;
  longjmp(decoder.begin, 1);
}

[[noreturn]] void fail(j_common_ptr jpeg) {
  Decoder& decoder = decoder_of(jpeg);
  decoder.errors.format_message(jpeg, decoder.message);
  leave(decoder);
}

// Missing or wrong pixels are warnings in libjpeg (level -1), but errors here.
void take_message(j_common_ptr jpeg, int level) {
  const int code = jpeg->err->msg_code;
  const bool is_harmless =
      level >= 0 || code == JWRN_EXTRANEOUS_DATA || code == JWRN_ADOBE_XFORM || code == JWRN_BOGUS_ICC;
  if (!is_harmless) fail(jpeg);
}

void check_scans(j_common_ptr jpeg) {
  Decoder& decoder = decoder_of(jpeg);
  if (decoder.jpeg.input_scan_number <= most_scans) return;
  std::snprintf(decoder.message, sizeof decoder.message, "more than %d scans", most_scans);
  leave(decoder);
}

// Fills `pixels`, which has the size for the header's width, height and channels. Returns whether that
// succeeded; if not, `decoder` has the reason.
bool decode(std::string_view bytes, const JpegHeader& header, std::uint8_t* pixels, Decoder& decoder) {
  jpeg_decompress_struct& jpeg = decoder.jpeg;
  jpeg.err = jpeg_std_error(&decoder.errors);
  decoder.errors.error_exit = fail;
  decoder.errors.emit_message = take_message;
  decoder.progress.progress_monitor = check_scans;
  if (setjmp(decoder.begin) != 0) {
    jpeg_destroy_decompress(&jpeg);
    return false;
  }
  jpeg_create_decompress(&jpeg);
  jpeg.progress = &decoder.progress;
  jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(bytes.data()),
               static_cast<unsigned long>(bytes.size()));
  jpeg_read_header(&jpeg, TRUE);
  jpeg.out_color_space = header.channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg.do_block_smoothing = FALSE;
  jpeg_start_decompress(&jpeg);
  if (jpeg.output_width != header.width || jpeg.output_height != header.height)
    ERREXIT(&jpeg, JERR_BAD_LENGTH);
  while (jpeg.output_scanline < jpeg.output_height) {
    JSAMPROW row = pixels + header.channels * header.width * jpeg.output_scanline;
    jpeg_read_scanlines(&jpeg, &row, 1);
  }
  jpeg_destroy_decompress(&jpeg);
  return true;
}

Result<void> check_header(const Source& source, const JpegHeader& header) {
  const std::uint64_t pixels = header.width * header.height;
  if (pixels == 0) return source.error({}, "expected the size of a JPEG picture, found none; save it as PNG");
  if (header.channels != 1 && header.channels != 3)
    return source.error(
        {}, cat("expected a JPEG picture of grey or of red, green and blue, found ", header.channels,
                header.channels == 4 ? " channels, as CMYK of prints has" : " channels", "; save it as PNG"));
  RELIEVO_CHECK(check_room(source, {header.width, header.height, 0, 0}));
  return check_packing(source, pixels, pixels);
}

}  // namespace

bool is_jpeg(const Source& source) {
  return source.bytes.starts_with("\xFF\xD8\xFF");
}

Result<DepthImage> read_depth_jpeg(const Source& source, const PictureChannels& wanted) {
  const JpegHeader header = find_jpeg_header(source.bytes);
  RELIEVO_CHECK(check_header(source, header));
  const std::size_t channels = header.channels;
  std::vector<std::uint8_t> pixels(channels * header.width * header.height);
  Decoder decoder{};
  if (!decode(source.bytes, header, pixels.data(), decoder))
    return source.error_at_byte(source.bytes.size() - decoder.bytes_left,
                                cat("expected the data of a JPEG picture, found: ", decoder.message));
  DepthImage image{{}, 1, "JPEG, 8 bits"};
  image.values.resize(static_cast<int>(header.width), static_cast<int>(header.height));
  RELIEVO_CHECK(fill_values(source, wanted, channels, image.values, [&](std::size_t i) {
    const auto at = [&](std::size_t c) { return static_cast<float>(pixels[channels * i + c]); };
    return channels == 1 ? PixelColour{at(0)} : PixelColour{at(0), at(1), at(2)};
  }));
  turn_upright(image, header.orientation);
  return image;
}

}  // namespace relievo::io
