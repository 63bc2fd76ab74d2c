// Pickles reliefs, so that processes can pass them to each other.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>

#include "common/make_order.h"

namespace relievo::python {

namespace py = pybind11;

// Returns the state of a relief as bytes and numbers: its solids, its report and its remarks.
py::tuple state_of(const app::FinishedRelief& relief);

// Returns the relief with that state. Its files, pictures and arrays are those of the pickled relief. Raises
// ValueError for a state from another version.
std::shared_ptr<app::FinishedRelief> relief_in(const py::tuple& state);

}  // namespace relievo::python
