// Which large files can be read row by row, and where the rows are.
#pragma once

#include "io/readers.h"
#include "io/records.h"

namespace relievo::io {

struct StreamRecords {
  Records records;
  std::string format;
};

// Returns the rows of a file of which `head` holds the beginning. Errors: those of the formats' headers, and
// for files that cannot be read row by row.
Result<StreamRecords> find_stream_records(const Source& head);

}  // namespace relievo::io
