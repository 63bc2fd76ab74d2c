// Makes the report on a relief.
#pragma once

#include "pipeline/body.h"
#include "pipeline/formed_front.h"
#include "relievo/make_relief.h"

namespace relievo {

// The results of all stages of a relief, and its options.
struct ReliefFacts {
  const Surface& surface;
  const Relief& relief;
  const FormedFront& formed;
  const Body& body;
  const ReliefOptions& options;
};

ReliefReport report_on(const ReliefFacts& facts);

}  // namespace relievo
