#include "portraits/output_file.h"

#include "portraits/disk.h"

namespace portrait {

OutputFile::OutputFile(const std::filesystem::path& path, Existing existing) : temporary_(path), existing_(existing) {
  check_target(path, existing);
  file_.reset(std::fopen(temporary_.path().c_str(), "wbx"));
  if (!file_) disk::failed(temporary_.path(), "create it");
}

void OutputFile::failed() const { disk::failed(temporary_.target(), "write to it"); }

void OutputFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) failed();
}

void OutputFile::write_again_at_start(std::string_view bytes) {
  if (std::fseek(file_.get(), 0, SEEK_SET) != 0) failed();
  write(bytes);
}

void OutputFile::publish() {
  if (std::fflush(file_.get()) != 0) failed();
  file_.reset();
  temporary_.publish(existing_);
}

}  // namespace portrait
