// Converts Python arguments to options and inputs.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <string_view>

#include "common/make_order.h"
#include "relievo/option_table.h"

namespace relievo::python {

// Returns the keyword of an option: its name with underscores and, for lengths and angles, with the unit, as
// in rim_height_mm and draft_deg. Returns other texts unchanged.
std::string keyword_of(std::string_view name);

// Returns the options in a dict of keywords and values. None means the default. Raises TypeError for a value
// of another type.
OptionValues values_of(const pybind11::dict& given);

// Returns the names of the options whose value is None.
std::vector<std::string> unset_options(const pybind11::dict& given);

// Returns the options for reading depth images, and the file size above which files are read in blocks.
// Raises the errors of values_of(), and relievo.Error.
app::InputArguments input_arguments(const pybind11::dict& given);

// Sets the order's inputs from a list of paths, (bytes, name) tuples and models made from arrays. A thread
// that has Python's lock must destroy the last copy of the order.
void take_sources(const pybind11::list& list, app::MakeOrder& order);

void add_options(pybind11::module_& module);
void add_inputs(pybind11::module_& module);

}  // namespace relievo::python
