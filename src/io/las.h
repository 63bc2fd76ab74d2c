// The header of a LAS file: where the numbers of a point are.
#pragma once

#include "io/readers.h"
#include "io/records.h"

namespace relievo::io {

// Returns the point records of LAS 1.0 to 1.4. `source` may hold only the beginning of the file. Errors name
// the byte.
Result<Records> read_las_header(const Source& source);

}  // namespace relievo::io
