#include <zip.h>

#include <memory>

#include "relievo/io/write.h"

namespace relievo {
namespace {

using ZipSource =
    std::unique_ptr<zip_source_t, decltype([](zip_source_t* source) { zip_source_free(source); })>;
using ZipArchive = std::unique_ptr<zip_t, decltype([](zip_t* archive) { zip_discard(archive); })>;

bool add_entry(zip_t* archive, const ZipEntry& entry, unsigned level) {
  ZipSource source(zip_source_buffer(archive, entry.content.data(), entry.content.size(), 0));
  const zip_int64_t added = zip_file_add(archive, entry.name.c_str(), source.get(), ZIP_FL_ENC_UTF_8);
  if (added < 0) return false;
  (void)source.release();  // it now belongs to the archive
  const auto index = static_cast<zip_uint64_t>(added);
  const zip_uint16_t midnight = 0, first_day = 0x21;  // the first date that ZIP can store
  return zip_set_file_compression(archive, index, level == 0 ? ZIP_CM_DEFAULT : ZIP_CM_DEFLATE, level) == 0 &&
         zip_file_set_dostime(archive, index, midnight, first_day, 0) == 0;
}

std::vector<std::byte> content_of(zip_source_t* source) {
  zip_stat_t stat;
  if (zip_source_stat(source, &stat) != 0 || zip_source_open(source) != 0) return {};
  std::vector<std::byte> bytes(stat.size);
  const zip_int64_t got = zip_source_read(source, bytes.data(), bytes.size());
  zip_source_close(source);
  return got == static_cast<zip_int64_t>(bytes.size()) ? std::move(bytes) : std::vector<std::byte>{};
}

}  // namespace

std::vector<std::byte> write_zip(std::span<const ZipEntry> entries, unsigned level) {
  const ZipSource memory(zip_source_buffer_create(nullptr, 0, 0, nullptr));
  ZipArchive archive(memory ? zip_open_from_source(memory.get(), ZIP_TRUNCATE, nullptr) : nullptr);
  if (!archive) return {};
  zip_source_keep(memory.get());  // the archive frees it, too
  for (const ZipEntry& entry : entries)
    if (!add_entry(archive.get(), entry, level)) return {};
  if (zip_close(archive.get()) != 0) return {};
  (void)archive.release();
  return content_of(memory.get());
}

}  // namespace relievo
