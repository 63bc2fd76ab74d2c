#include "io/stream_records.h"

#include <algorithm>

#include "io/las.h"
#include "io/pcd.h"
#include "io/ply.h"

namespace relievo::io {
namespace {

Result<StreamRecords> ply_records(const Source& head) {
  const auto header = read_ply_header(head);
  if (!header) return std::unexpected(header.error());
  const auto& elements = header->elements;
  const auto vertex = std::ranges::find(elements, std::string_view("vertex"), &PlyElement::name);
  if (vertex == elements.end())
    return head.error_in_line(header->lines, "expected an element vertex before end_header, found none");
  if (header->format == PlyFormat::ascii || std::any_of(elements.begin(), vertex + 1, has_lists))
    return head.error_in_line(vertex->line,
                              "expected binary vertices without lists, to be read piece by piece");
  auto records = ply_vertex_records(head, *header, *vertex);
  if (!records) return std::unexpected(records.error());
  records->offset = header->data_offset;
  for (auto element = elements.begin(); element != vertex; ++element) {
    const std::uint64_t size = least_row_size(*element);
    if (size > 0 && element->count > (std::uint64_t{1} << 60) / size)
      return head.error_in_line(element->line, "expected a number of rows that fits the file, found " +
                                                   std::to_string(element->count));
    records->offset += size * element->count;
  }
  return StreamRecords{*records, header->format == PlyFormat::big_endian ? "PLY binary big endian"
                                                                         : "PLY binary little endian"};
}

Result<StreamRecords> pcd_records(const Source& head) {
  const auto header = read_pcd_header(head);
  if (!header) return std::unexpected(header.error());
  if (header->data != PcdData::binary)
    return head.error({}, "expected binary points, to be read piece by piece");
  return StreamRecords{header->records, "PCD binary"};
}

}  // namespace

Result<StreamRecords> find_stream_records(const Source& head) {
  if (head.bytes.starts_with("ply")) return ply_records(head);
  if (is_pcd(head)) return pcd_records(head);
  if (!is_las(head))
    return head.error({}, "expected a binary PLY, PCD or LAS file, to be read piece by piece");
  const auto records = read_las_header(head);
  if (!records) return std::unexpected(records.error());
  return StreamRecords{*records, "LAS"};
}

}  // namespace relievo::io
