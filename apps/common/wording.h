// Sentences for people, made of the facts that the library returns: for the command line and the studio alike.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "relievo/make_relief.h"

namespace relievo::app {

// Returns a line for each fact that a user should know, without capital and full stop. `outliers` were left out before.
std::vector<std::string> remarks_on(const ScanReport& scan, std::size_t outliers = 0);
std::vector<std::string> remarks_on(const ReliefReport& report);

// Returns the line with a capital and a full stop.
std::string as_sentence(std::string line);

}  // namespace relievo::app
