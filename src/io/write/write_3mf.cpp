// Writes 3MF: a ZIP archive with the model as XML.
#include <zip.h>

#include <array>
#include <charconv>
#include <memory>

#include "relievo/core/parallel.h"
#include "relievo/core/text.h"
#include "relievo/io/write.h"

namespace relievo {
namespace {

constexpr std::string_view content_types =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>
)";
constexpr std::string_view relationships =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Target="/3D/3dmodel.model" Id="model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>
)";
constexpr std::size_t grain = 16384;

template <typename T>
void append_number(std::string& to, T value) {
  std::array<char, 24> digits;
  to.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
}

// Returns the texts of n elements, joined in order. Blocks of elements are converted concurrently.
template <typename Append>
std::string in_blocks(std::size_t n, Append&& append_element) {
  std::vector<std::string> parts((n + grain - 1) / grain);
  parallel_ranges(n, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) append_element(i, parts[begin / grain]);
  });
  std::string all;
  for (const std::string& part : parts) all += part;
  return all;
}

std::string vertices_of(const Solid& solid) {
  return in_blocks(solid.points.size(), [&](std::size_t i, std::string& to) {
    const Vec3f p = solid.points[i].cast<float>();
    to += "<vertex x=\"", append_number(to, p.x());
    to += "\" y=\"", append_number(to, p.y());
    to += "\" z=\"", append_number(to, p.z());
    to += "\"/>\n";
  });
}

std::string triangles_of(const Solid& solid) {
  return in_blocks(solid.triangles.size(), [&](std::size_t t, std::string& to) {
    to += "<triangle v1=\"", append_number(to, solid.triangles[t][0]);
    to += "\" v2=\"", append_number(to, solid.triangles[t][1]);
    to += "\" v3=\"", append_number(to, solid.triangles[t][2]);
    to += "\"/>\n";
  });
}

using ZipSource =
    std::unique_ptr<zip_source_t, decltype([](zip_source_t* source) { zip_source_free(source); })>;
using ZipArchive = std::unique_ptr<zip_t, decltype([](zip_t* archive) { zip_discard(archive); })>;

bool add_entry(zip_t* archive, const ZipEntry& entry, unsigned level) {
  ZipSource source(zip_source_buffer(archive, entry.content.data(), entry.content.size(), 0));
  const zip_int64_t added = zip_file_add(archive, entry.name.c_str(), source.get(), ZIP_FL_ENC_UTF_8);
  if (added < 0) return false;
  (void)source.release();  // the archive owns the source now
  const auto index = static_cast<zip_uint64_t>(added);
  const zip_uint16_t midnight = 0, first_day = 0x21;  // the earliest date that ZIP can represent
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

std::vector<std::byte> write_3mf(const Solid& solid,
                                 std::span<const std::pair<std::string, std::string>> metadata) {
  std::string model = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"" +
                      std::string(solid.unit == LengthUnit::inch ? "inch" : "millimeter") +
                      "\" xml:lang=\"en-US\" "
                      "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n";
  for (const auto& [key, value] : metadata)
    model += "<metadata name=\"" + escaped_markup(key) + "\">" + escaped_markup(value) + "</metadata>\n";
  model +=
      "<resources>\n<object id=\"1\" type=\"model\">\n<mesh>\n<vertices>\n" + vertices_of(solid) +
      "</vertices>\n<triangles>\n" + triangles_of(solid) +
      "</triangles>\n</mesh>\n</object>\n</resources>\n<build>\n<item objectid=\"1\"/>\n</build>\n</model>\n";
  const auto bytes = [](std::string_view text) { return std::as_bytes(std::span(text)); };
  const ZipEntry entries[] = {{"[Content_Types].xml", bytes(content_types)},
                              {"_rels/.rels", bytes(relationships)},
                              {"3D/3dmodel.model", bytes(model)}};
  return write_zip(entries, 6);
}

std::vector<std::byte> write_zip(std::span<const ZipEntry> entries, unsigned level) {
  const ZipSource memory(zip_source_buffer_create(nullptr, 0, 0, nullptr));
  ZipArchive archive(memory ? zip_open_from_source(memory.get(), ZIP_TRUNCATE, nullptr) : nullptr);
  if (!archive) return {};
  zip_source_keep(memory.get());  // the archive owns the memory, too
  for (const ZipEntry& entry : entries)
    if (!add_entry(archive.get(), entry, level)) return {};
  if (zip_close(archive.get()) != 0) return {};
  (void)archive.release();
  return content_of(memory.get());
}

}  // namespace relievo
