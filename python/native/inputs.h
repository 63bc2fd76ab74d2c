// Reads the inputs of a relief from Python: paths, bytes of files, and arrays.
#pragma once

#include <pybind11/pybind11.h>

#include "common/make_order.h"

namespace relievo::python {

// Sets the order's inputs from a list of paths, (bytes, name) tuples and models made from arrays. A thread
// that has Python's lock must destroy the last copy of the order.
void take_sources(const pybind11::list& list, app::MakeOrder& order);

void add_inputs(pybind11::module_& module);

}  // namespace relievo::python
