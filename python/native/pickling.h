// Pickles of reliefs, so that processes may hand them on.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>

#include "common/make_order.h"

namespace relievo::python {

namespace py = pybind11;

// Returns the state of a relief: its solids, its report and its remarks, as bytes and numbers.
py::tuple state_of(const app::FinishedRelief& relief);

// Returns the relief of such a state: its files, pictures and arrays are those of the relief that was pickled.
// Raises ValueError for a state of another version.
std::shared_ptr<app::FinishedRelief> relief_in(const py::tuple& state);

}  // namespace relievo::python
