#include "relief/baselines/scaled.h"
#include "relievo/relief/baselines.h"
#include "relievo/scan/surface.h"

namespace relievo {

Relief linear_relief(const Surface& surface, double height) {
  return scaled_relief(depths(surface), surface, height);
}

Relief linear_relief(const ReliefModel& model, double height) {
  return linear_relief(model.surface(), height);
}

}  // namespace relievo
