// Makes the solid of a front, with at most the requested number of triangles. Tested by
// tests/pipeline/triangle_limit_test.cpp.
#pragma once

#include "pipeline/body.h"
#include "pipeline/formed_front.h"

namespace relievo {

struct FormedBody {
  FormedFront formed;
  Body body;
};

// Returns the body with that front, which is simplified as the options ask. Errors: those of
// simplified_front() and make_body(); kind option for fewer triangles than the solid needs for its outline
// and its walls.
Result<FormedBody> make_formed_body(FormedFront full, const ReliefOptions& options, Progress* progress);

}  // namespace relievo
