/// The files of reproduce/data/, compiled into the program.
#pragma once

#include <span>
#include <string_view>

namespace portrait::reproduce {

struct DataFile {
  std::string_view name, text;
};

std::span<const DataFile> data_files();

}  // namespace portrait::reproduce
