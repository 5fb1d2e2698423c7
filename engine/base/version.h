/// Which Portrait this is.
#pragma once

#include <string>

namespace portrait {

/// "portrait 0.1.0 (1a2b3c4d5e6f)"; "-modified" behind the commit when the sources were changed since.
std::string program_version();

}  // namespace portrait
