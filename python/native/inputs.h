// Reads what Python makes a relief of: paths, bytes of files, arrays.
#pragma once

#include <pybind11/pybind11.h>

#include "common/make_order.h"

namespace relievo::python {

// Gives the order its inputs: those of a list of paths, (bytes, name) tuples and models from arrays. Python's objects must
// outlive it.
void take_sources(const pybind11::list& list, app::MakeOrder& order);

void add_inputs(pybind11::module_& module);

}  // namespace relievo::python
