#include "io/pictures/tiff_bytes.h"

#include <tiff.h>
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>

namespace relievo::io {
namespace {

std::uint64_t little_endian(const unsigned char* first, unsigned bits) {
  std::uint64_t value = 0;
  std::memcpy(&value, first, bits / 8);
  return value;
}

std::uint64_t packed(const unsigned char* row, std::size_t first_bit, unsigned bits) {
  std::uint64_t value = 0;
  for (std::size_t bit = first_bit; bit < first_bit + bits; ++bit)
    value = value << 1 | (row[bit / 8] >> (7 - bit % 8) & 1U);
  return value;
}

}  // namespace

TiffBytes::TiffBytes(std::string_view bytes) : bytes_(bytes) {
  open("rm");
}

TiffBytes::TiffBytes(std::vector<std::byte>& out) : out_(&out) {
  open("wlm");
}

void TiffBytes::open(const char* mode) {
  TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
  if (!options) return;
  TIFFOpenOptionsSetErrorHandlerExtR(options, keep_message, this);
  TIFFOpenOptionsSetWarningHandlerExtR(
      options, [](TIFF*, void*, const char*, const char*, va_list) { return 1; }, nullptr);
  const tmsize_t most_memory = tmsize_t{1} << 31;
  TIFFOpenOptionsSetMaxSingleMemAlloc(options, most_memory);
  tiff_ = TIFFClientOpenExt(
      "picture", mode, this, read, write, seek, [](thandle_t) { return 0; }, size,
      [](thandle_t, void**, toff_t*) { return 0; }, [](thandle_t, void*, toff_t) {}, options);
  TIFFOpenOptionsFree(options);
}

void TiffBytes::close() {
  if (tiff_) TIFFClose(tiff_);
  tiff_ = nullptr;
}

int TiffBytes::keep_message(TIFF*, void* self, const char*, const char* format, va_list arguments) {
  auto& message = static_cast<TiffBytes*>(self)->message_;
  if (!message.empty()) return 1;
  char text[160];
  std::vsnprintf(text, sizeof text, format, arguments);
  // libtiff begins some messages with the name that open() gives to the file.
  const std::string_view line(text), name = "picture: ";
  message = line.substr(line.starts_with(name) ? name.size() : 0);
  return 1;
}

tmsize_t TiffBytes::read(thandle_t self, void* to, tmsize_t wanted) {
  auto& it = *static_cast<TiffBytes*>(self);
  const std::size_t left = it.bytes_.size() - std::min(it.bytes_.size(), it.at_);
  const std::size_t got = std::min(left, static_cast<std::size_t>(wanted));
  std::memcpy(to, it.bytes_.data() + it.bytes_.size() - left, got);
  it.at_ += got;
  return static_cast<tmsize_t>(got);
}

tmsize_t TiffBytes::write(thandle_t self, void* from, tmsize_t wanted) {
  auto& it = *static_cast<TiffBytes*>(self);
  if (!it.out_ || !from) return 0;  // libtiff passes null if it had no memory for a copy of a text
  const std::size_t end = it.at_ + static_cast<std::size_t>(wanted);
  if (end > it.out_->size()) it.out_->resize(end);
  std::memcpy(it.out_->data() + it.at_, from, static_cast<std::size_t>(wanted));
  it.at_ = end;
  return wanted;
}

toff_t TiffBytes::seek(thandle_t self, toff_t offset, int from) {
  auto& it = *static_cast<TiffBytes*>(self);
  if (from == SEEK_SET) it.at_ = offset;
  if (from == SEEK_CUR) it.at_ += offset;
  if (from == SEEK_END) it.at_ = size(self) + offset;
  return it.at_;
}

toff_t TiffBytes::size(thandle_t self) {
  const auto& it = *static_cast<TiffBytes*>(self);
  return it.out_ ? it.out_->size() : it.bytes_.size();
}

std::optional<SampleFormat> find_sample_format(unsigned sample_format, unsigned bits) {
  const auto is_one_of = [&](auto... sizes) { return ((bits == sizes) || ...); };
  if (sample_format == SAMPLEFORMAT_UINT || sample_format == SAMPLEFORMAT_VOID) {
    if ((bits >= 1 && bits <= 32) || bits == 64) return SampleFormat{SampleKind::whole, bits};
  } else if (sample_format == SAMPLEFORMAT_INT) {
    if (is_one_of(8U, 16U, 32U, 64U)) return SampleFormat{SampleKind::signed_whole, bits};
  } else if (sample_format == SAMPLEFORMAT_IEEEFP) {
    if (is_one_of(16U, 32U, 64U)) return SampleFormat{SampleKind::fraction, bits};
  }
  return std::nullopt;
}

std::string describe_samples(unsigned sample_format, unsigned bits) {
  constexpr std::array names = {"numbers", "whole numbers", "signed numbers", "fractions",
                                "undefined numbers"};
  const std::size_t known = sample_format < names.size() ? sample_format : 0;
  return std::to_string(bits) + "-bit " + (sample_format > 4 ? "complex numbers" : names[known]);
}

void decode_samples(const SampleFormat& format, const SampleRow& row, std::size_t n, float* to) {
  const unsigned bits = format.bits;
  const bool is_packed = bits % 8 != 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t sample = row.first + i * row.step;
    const std::uint64_t value = is_packed ? packed(row.bytes, sample * bits, bits)
                                          : little_endian(row.bytes + sample * (bits / 8), bits);
    to[i] = decode_sample(format, value);
  }
}

}  // namespace relievo::io
