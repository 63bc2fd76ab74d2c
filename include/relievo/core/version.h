// Defines the library's version; CMakeLists.txt reads it from here.
#pragma once

namespace relievo {

inline constexpr char version[] = "1.0.0";

}  // namespace relievo
