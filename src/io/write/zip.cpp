#include "io/write/zip.h"

#include <zlib.h>

#include <algorithm>
#include <cstring>

namespace relievo::io {
namespace {

constexpr std::size_t largest = 0xFFFFFFFF;

// zlib's sizes are 32 bits: both sides are handed over in pieces.
std::vector<std::byte> deflated(std::string_view content) {
  std::vector<std::byte> out(content.size() / 2 + 1024);
  z_stream stream{};
  const int level = 6, raw_window = -15, memory = 9;
  if (deflateInit2(&stream, level, Z_DEFLATED, raw_window, memory, Z_DEFAULT_STRATEGY) != Z_OK) return {};
  const std::size_t piece = std::size_t{1} << 30;
  std::size_t taken = 0, made = 0;
  int state = Z_OK;
  while (state != Z_STREAM_END) {
    if (made == out.size()) out.resize(out.size() * 2);
    const std::size_t in = std::min(piece, content.size() - taken), room = std::min(piece, out.size() - made);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data() + taken));
    stream.avail_in = static_cast<uInt>(in);
    stream.next_out = reinterpret_cast<Bytef*>(out.data() + made);
    stream.avail_out = static_cast<uInt>(room);
    state = deflate(&stream, taken + in == content.size() ? Z_FINISH : Z_NO_FLUSH);
    taken += in - stream.avail_in;
    made += room - stream.avail_out;
    if (state == Z_STREAM_ERROR) break;
  }
  deflateEnd(&stream);
  out.resize(made);
  return out;
}

}  // namespace

void ZipWriter::put(std::size_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out_.push_back(static_cast<std::byte>(value >> (8 * i) & 0xFF));
}

// The part that a file's own header and the directory have in common.
void ZipWriter::put_common(const Entry& entry) {
  const std::size_t version = 20, deflate = 8, first_day = 0x21;
  put(version, 2), put(0, 2), put(deflate, 2), put(0, 2), put(first_day, 2);
  put(entry.crc, 4), put(entry.packed_size, 4), put(entry.size, 4), put(entry.name.size(), 2), put(0, 2);
}

void ZipWriter::add(std::string_view name, std::string_view content) {
  const std::vector<std::byte> packed = deflated(content);
  unsigned long crc = crc32(0, nullptr, 0);
  for (std::size_t at = 0; at < content.size(); at += largest / 4) {
    const std::string_view piece = content.substr(at, largest / 4);
    crc = crc32(crc, reinterpret_cast<const Bytef*>(piece.data()), static_cast<uInt>(piece.size()));
  }
  const Entry entry{name, out_.size(), packed.size(), content.size(), crc};
  is_too_large_ = is_too_large_ || content.size() > largest || out_.size() + packed.size() > largest - 4096;
  entries_.push_back(entry);
  put(0x04034B50, 4);
  put_common(entry);
  for (const char c : name) out_.push_back(static_cast<std::byte>(c));
  out_.insert(out_.end(), packed.begin(), packed.end());
}

std::vector<std::byte> ZipWriter::finish() {
  if (is_too_large_) return {};
  const std::size_t directory = out_.size();
  for (const Entry& entry : entries_) {
    put(0x02014B50, 4), put(20, 2);
    put_common(entry);
    put(0, 2), put(0, 2), put(0, 2), put(0, 4), put(entry.offset, 4);
    for (const char c : entry.name) out_.push_back(static_cast<std::byte>(c));
  }
  const std::size_t size = out_.size() - directory;
  put(0x06054B50, 4), put(0, 4), put(entries_.size(), 2), put(entries_.size(), 2);
  put(size, 4), put(directory, 4), put(0, 2);
  return std::move(out_);
}

}  // namespace relievo::io
