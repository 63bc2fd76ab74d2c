// Puts the report on a relief together.
#pragma once

#include "pipeline/body.h"
#include "pipeline/formed_front.h"
#include "relievo/make_relief.h"

namespace relievo {

// All that a relief was made of and by.
struct ReliefFacts {
  const Surface& surface;
  const Relief& relief;
  const FormedFront& formed;
  const Body& body;
  const ReliefOptions& options;
};

ReliefReport report_on(const ReliefFacts& facts);

}  // namespace relievo
