#include "relievo/scan/depth_image.h"

#include "relievo/core/text.h"

namespace relievo {

Result<void> check(const DepthOptions& options) {
  if (!(options.range >= .01 && options.range <= 10))
    return option_error("depth-range", cat("expected a number from 0.01 to 10, found ", options.range));
  if (options.channel < 0 || options.channel > 64)
    return option_error("channel", cat("expected a number from 0 to 64, found ", options.channel));
  if (!(options.points >= 1000 && options.points <= 1e7))
    return option_error("points", cat("expected a number from 1000 to 1e+07, found ", options.points));
  return {};
}

}  // namespace relievo
