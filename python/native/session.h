// One model, prepared once, whose reliefs are made many times.
#pragma once

#include <pybind11/pybind11.h>

namespace relievo::python {

void add_session(pybind11::module_& module);

}  // namespace relievo::python
