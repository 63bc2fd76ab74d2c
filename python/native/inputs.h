// Reads what Python makes a relief of: paths, bytes of files, arrays.
#pragma once

#include <pybind11/pybind11.h>

#include "common/make_order.h"

namespace relievo::python {

// Gives the order the inputs of a list: paths, (bytes, name) tuples and models from arrays. The last copy of the order
// must be destroyed by a thread that holds Python's lock.
void take_sources(const pybind11::list& list, app::MakeOrder& order);

void add_inputs(pybind11::module_& module);

}  // namespace relievo::python
