/// The first look at a file that should be a portrait.
#pragma once

#include <filesystem>

#include "portraits/h5.h"

namespace portrait {

/// Opens a portrait whose format this program reads. Throws InputError when it is none, or of another major
/// version.
h5::File open_portrait(const std::filesystem::path& path);

}  // namespace portrait
