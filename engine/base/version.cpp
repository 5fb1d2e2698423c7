#include "engine/base/version.h"

#include "version_text.h"

namespace portrait {

std::string program_version() { return "portrait " PORTRAIT_VERSION " (" PORTRAIT_COMMIT ")"; }

}  // namespace portrait
