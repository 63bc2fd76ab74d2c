// The noise of a scan: measuring it, and removing it while creases stay. Tested by tests/scan/noise_test.cpp.
#pragma once

#include "relievo/core/progress.h"
#include "relievo/scan/cloud.h"
#include "relievo/scan/spacing.h"

namespace relievo {

// Returns the standard deviation of the points along their normals, in sampling distances. It is the scatter about
// local quadratic surfaces that a quarter of the points stays below, so that details in parts of a model do not count,
// and it is lower if the normals scatter less than such points make them. Scatter below 0.1 is taken for detail: then
// the result is 0, and so it is for clouds of fewer than 100 points or without normals.
double measure_noise(const Cloud& cloud, const Spacing& spacing);

// Turns the normals and moves the points to the surface that robust regression finds around each of them; does nothing
// without normals. `noise`, > 0, is the standard deviation to remove, in sampling distances: more of it averages over
// wider neighbourhoods and rounds sharper creases. Normals are fitted linearly in the tangent plane, with less weight
// for neighbours that deviate from the last fit, which are those beyond a crease (Oeztireli, Guennebaud and Gross,
// "Feature preserving point set surfaces based on non-linear kernel regression", 2009; there the fit is constant,
// which flattens curved parts). Leaves the cloud as it was if the progress is cancelled.
void remove_noise(Cloud& cloud, const Spacing& spacing, double noise, const Progress* progress = nullptr);

}  // namespace relievo
