/// A plain file written from front to back, which appears under its name only when it is complete.
///
/// errors    InputError: it exists, or its directory does not; StoreError: the disk
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

#include "portraits/temporary_file.h"

namespace portrait {

class OutputFile {
 public:
  OutputFile(const std::filesystem::path& path, Existing existing);

  void write(std::string_view bytes);
  /// Bytes at the start once more. REQUIRES: so many were written.
  void write_again_at_start(std::string_view bytes);
  void publish();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  [[noreturn]] void failed() const;

  TemporaryFile temporary_;
  Existing existing_;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace portrait
