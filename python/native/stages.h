// Stages of the library that can be called with arrays.
#pragma once

#include <pybind11/pybind11.h>

namespace relievo::python {

void add_stages(pybind11::module_& module);

}  // namespace relievo::python
