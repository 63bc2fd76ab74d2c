// Writes E57 files independently of the library's reader. Tests can choose the columns and damage the contents.
#pragma once

#include <bit>

#include "relievo/core/text.h"
#include "support/format_samples.h"

namespace relievo {

// A column of a scan: its element in the prototype, and its numbers. Of each number, `bits` bits are stored.
struct E57Column {
  std::string name, attributes;
  unsigned bits = 64;
  std::vector<std::uint64_t> numbers;
};

struct E57TestScan {
  std::vector<E57Column> columns;
  std::string xml = {};  // other children of the scan's element
};

inline E57Column e57_doubles(const std::string& name, const std::vector<double>& values) {
  E57Column column{name, R"(type="Float")", 64, {}};
  for (const double value : values) column.numbers.push_back(std::bit_cast<std::uint64_t>(value));
  return column;
}

inline E57Column e57_integers(const std::string& name, std::int64_t minimum, std::int64_t maximum,
                              const std::vector<std::int64_t>& values) {
  const auto range = static_cast<std::uint64_t>(maximum) - static_cast<std::uint64_t>(minimum);
  E57Column column{name,
                   cat(R"(type="Integer" minimum=")", minimum, R"(" maximum=")", maximum, '"'),
                   static_cast<unsigned>(std::bit_width(range)),
                   {}};
  for (const std::int64_t value : values)
    column.numbers.push_back(static_cast<std::uint64_t>(value) - static_cast<std::uint64_t>(minimum));
  return column;
}

inline std::string packed_bits(const E57Column& column) {
  std::string bytes((column.numbers.size() * column.bits + 7) / 8, '\0');
  std::size_t at = 0;
  for (const std::uint64_t number : column.numbers)
    for (unsigned bit = 0; bit < column.bits; ++bit, ++at)
      if ((number >> bit & 1) != 0) bytes[at / 8] = static_cast<char>(bytes[at / 8] | 1 << at % 8);
  return bytes;
}

// Returns the packets of a section. Each packet has at most `most` bytes of every column. The first two
// packets are an index packet and an empty packet, which readers must skip.
inline std::string e57_packets(const std::vector<E57Column>& columns, std::size_t most) {
  std::string all =
      std::string("\x00\x00\x0F\x00", 4) + std::string(12, '\0') + std::string("\x02\x00\x03\x00", 4);
  for (std::size_t from = 0;; from += most) {
    std::string sizes, bytes;
    for (const E57Column& column : columns) {
      const std::string packed = packed_bits(column);
      const std::string piece = from < packed.size() ? packed.substr(from, most) : "";
      sizes += raw(static_cast<std::uint16_t>(piece.size()));
      bytes += piece;
    }
    if (bytes.empty()) return all;
    std::string body = raw(static_cast<std::uint16_t>(columns.size())) + sizes + bytes;
    body.resize((body.size() + 3) / 4 * 4);
    all += std::string("\x01\x00", 2) + raw(static_cast<std::uint16_t>(body.size() + 3)) + body;
  }
}

inline std::uint32_t bitwise_crc32c(std::string_view bytes) {
  std::uint32_t crc = ~std::uint32_t{0};
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? crc >> 1 ^ 0x82F63B78 : crc >> 1;
  }
  return ~crc;
}

// Divides the contents into pages of 1,024 bytes with checksums. Writes the new length to the header.
inline std::string e57_pages(std::string contents) {
  contents.resize((contents.size() + 1019) / 1020 * 1020, ' ');
  contents = patched(contents, 16, static_cast<std::uint64_t>(contents.size() / 1020 * 1024));
  std::string file;
  for (std::size_t at = 0; at < contents.size(); at += 1020) {
    const std::string page = contents.substr(at, 1020);
    file += page + raw(std::byteswap(bitwise_crc32c(page)));
  }
  return file;
}

inline std::uint64_t e57_physical(std::uint64_t logical) {
  return logical / 1020 * 1024 + logical % 1020;
}

// Returns the contents of all pages: the header, one section per scan, and the XML.
inline std::string e57_contents(const std::vector<E57TestScan>& scans, std::size_t most_in_packet = 7) {
  std::string contents(48, '\0'), xml;
  for (const E57TestScan& scan : scans) {
    const std::size_t at = contents.size();
    const std::string packets = e57_packets(scan.columns, most_in_packet);
    contents += raw(std::uint64_t{1}) + raw(std::uint64_t{32 + packets.size()}) + raw(e57_physical(at + 32)) +
                raw(std::uint64_t{0}) + packets;
    xml += cat("<vectorChild type='Structure'>", scan.xml, "<points type=\"CompressedVector\" fileOffset=\"",
               e57_physical(at), "\" recordCount=\"", scan.columns[0].numbers.size(), "\"><prototype>\n");
    for (const E57Column& column : scan.columns) xml += cat("<", column.name, " ", column.attributes, "/>\n");
    xml += "</prototype><codecs type=\"Vector\"/></points></vectorChild>\n";
  }
  xml =
      "<?xml version=\"1.0\"?>\n<!-- > -->\n<e57Root type=\"Structure\"><name><![CDATA[<a>]]></name>\n"
      "<data3D type=\"Vector\">" +
      xml + "</data3D></e57Root>\n";
  contents.replace(0, 8, "ASTM-E57");
  contents = patched(contents, 8, std::uint32_t{1});
  contents = patched(contents, 24, e57_physical(contents.size()));
  contents = patched(contents, 32, std::uint64_t{xml.size()});
  contents = patched(contents, 40, std::uint64_t{1024});
  return contents + xml;
}

inline std::string e57(const std::vector<E57TestScan>& scans, std::size_t most_in_packet = 7) {
  return e57_pages(e57_contents(scans, most_in_packet));
}

// Returns a file of three coloured points in cartesian coordinates. The second point is invalid.
inline std::string e57_sample() {
  return e57({{{e57_doubles("cartesianX", {1, 4, 7}), e57_integers("cartesianY", -2, 9, {2, 5, 8}),
                e57_doubles("cartesianZ", {3, 6, 9}), e57_integers("cartesianInvalidState", 0, 2, {0, 1, 0}),
                e57_integers("colorRed", 0, 255, {255, 0, 7}), e57_integers("colorGreen", 0, 255, {0, 1, 2}),
                e57_integers("colorBlue", 0, 255, {9, 8, 7})}}});
}

}  // namespace relievo
