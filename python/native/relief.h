// Makes reliefs as `relievo make` does, and returns them to Python.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "common/make_order.h"

namespace relievo::python {

// Reads the arguments: the inputs of a relief, and a dict of keywords. Raises TypeError or relievo.Error for
// values of a wrong type.
app::MakeOrder order_of(const pybind11::list& sources, const pybind11::dict& keywords);

using SharedRelief = std::shared_ptr<app::FinishedRelief>;

// Returns the state of a relief as bytes and numbers, for pickling: its solids, its report and its remarks.
pybind11::tuple state_of(const app::FinishedRelief& relief);

// Returns the relief with that state. Its files, pictures and arrays are those of the pickled relief. Raises
// ValueError for a state from another version.
SharedRelief relief_in(const pybind11::tuple& state);

// Add the types and functions of relief.cpp, session.cpp and stages.cpp to the module.
void add_relief(pybind11::module_& module);
void add_session(pybind11::module_& module);
void add_stages(pybind11::module_& module);

}  // namespace relievo::python
