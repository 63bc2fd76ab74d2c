// Defines the native module of the Python package, which parses arguments, calls the library and returns its
// results. The public interface is in python/relievo/.
#include <pybind11/stl.h>

#include "native/call.h"
#include "native/errors.h"
#include "native/options.h"
#include "native/relief.h"
#include "relievo/core/version.h"

PYBIND11_MODULE(_native, module) {
  module.attr("__version__") = relievo::version;
  relievo::python::add_errors();
  relievo::python::add_threads(module);
  relievo::python::add_options(module);
  relievo::python::add_inputs(module);
  relievo::python::add_relief(module);
  relievo::python::add_session(module);
  relievo::python::add_stages(module);
}
