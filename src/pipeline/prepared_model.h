// The model of a job's scene, as a value: whoever makes only one relief of it can free its parts early.
#pragma once

#include <memory>
#include <vector>

#include "relievo/job.h"
#include "relievo/relief/relief.h"

namespace relievo {

struct PreparedModel {
  ReliefModel model;
  std::vector<SampleNote> notes;  // on models of which only a part of the points is used
};

// Returns the model of the scene in its view. Errors: those of prepare() in job.h.
Result<PreparedModel> prepare_model(Job job, Progress* progress);

// Returns the result of prepare() in make_relief.h. Frees the points early, unless others own them, too.
Result<ReliefModel> prepare_owned(std::shared_ptr<const Cloud> points, const View& view,
                                  const ModelOptions& options, Progress* progress);

}  // namespace relievo
