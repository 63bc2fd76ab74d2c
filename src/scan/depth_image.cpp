#include "relievo/scan/depth_image.h"

#include "relievo/core/text.h"

namespace relievo {

namespace {

constexpr int most_channels = 64;

}  // namespace

Result<void> check(const DepthOptions& options) {
  if (!(options.range >= .01 && options.range <= 10))
    return option_error("depth-range", cat("expected a number from 0.01 to 10, found ", options.range));
  if (options.channel < 0 || options.channel > most_channels)
    return option_error("channel", cat("expected a number from 0 to 64, found ", options.channel));
  if (!(options.points >= 1000 && options.points <= 1e7))
    return option_error("points", cat("expected a number from 1000 to 1e+07, found ", options.points));
  return {};
}

Result<DepthOptions> parse_depth(const DepthTexts& texts) {
  RELIEVO_TRY(const DepthValues values, parse_choice("depth-values", texts.values, depth_value_choices));
  RELIEVO_TRY(const Background background, parse_choice("background", texts.background, background_choices));
  DepthOptions options;
  options.values = values;
  if (!(texts.channel >= 0 && texts.channel <= most_channels))
    return option_error("channel", cat("expected a number from 0 to 64, found ", texts.channel));
  options.channel = static_cast<int>(texts.channel);
  if (options.channel != texts.channel)
    return option_error("channel", cat("expected a whole number, found ", texts.channel));
  options.range = texts.range;
  options.background = background;
  RELIEVO_CHECK(check(options));
  return options;
}

}  // namespace relievo
