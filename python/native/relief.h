// Makes reliefs, as `relievo make` does, and keeps them.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <vector>

#include "common/make_order.h"
#include "native/inputs.h"

namespace relievo::python {

// Holds what to make, from Python's objects: the sources and a dict of keywords.
struct PythonOrder : app::MakeOrder {
  std::vector<Source> sources;
};

// Reads the arguments. Raises TypeError or relievo.Error for those of a wrong type.
PythonOrder order_of(const pybind11::list& sources, const pybind11::dict& keywords);

// Reads the sources of an order. Errors: those of options_of() and read_sources().
Result<app::LoadedOrder> load(const PythonOrder& order, Progress& progress);

using SharedRelief = std::shared_ptr<app::FinishedRelief>;

void add_relief(pybind11::module_& module);

}  // namespace relievo::python
