// Prepares the model of a job's scene and returns it as a value. A caller who makes only one relief of the
// model can then free parts of it early.
#pragma once

#include <memory>
#include <vector>

#include "relievo/job.h"
#include "relievo/relief/relief.h"

namespace relievo {

struct SampledModel {
  ReliefModel model;
  std::vector<SampleNote> notes;  // notes on how the points of the scene were sampled
};

// Returns the model of the scene in its view. Errors: those of prepare() in job.h.
Result<SampledModel> prepare_sampled(Job job, Progress* progress);

// Prepares a model as prepare() in make_relief.h does, but frees the points early, unless they have other
// owners.
Result<ReliefModel> prepare_owned(std::shared_ptr<const Cloud> points, const View& view,
                                  const ModelOptions& options, Progress* progress);

}  // namespace relievo
