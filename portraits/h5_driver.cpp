#include "portraits/h5_driver.h"

#include <cerrno>
#include <cstring>
#include <map>
#include <mutex>
#include <string>
#include <utility>

#include "portraits/disk.h"
#include "portraits/h5_call.h"

namespace portrait::h5 {
namespace {

/// By the place where HDF5 keeps the file's descriptor, which both sides can ask for.
class Faults {
 public:
  std::shared_ptr<WriteFault> at(const void* file) {
    const std::lock_guard lock(mutex_);
    auto& fault = faults_[file];
    if (!fault) fault = std::make_shared<WriteFault>();
    return fault;
  }
  void forget(const void* file) {
    const std::lock_guard lock(mutex_);
    faults_.erase(file);
  }

 private:
  std::mutex mutex_;
  std::map<const void*, std::shared_ptr<WriteFault>> faults_;
};

Faults& faults() {
  static Faults all;
  return all;
}

thread_local const Behind* behind = nullptr;
thread_local Placement* placement = nullptr;
thread_local ReadLocator* locator = nullptr;

/// The functions of HDF5's driver for plain files. It gives them away only with an open file.
const H5FD_class_t& plain_driver() {
  static const H5FD_class_t driver = [] {
    H5FD_t* file = H5FDopen("/dev/null", H5F_ACC_RDONLY, H5P_DEFAULT, HADDR_UNDEF);
    if (file == nullptr) throw CallFailed{};
    const H5FD_class_t found = *file->cls;
    called(H5FDclose(file));
    return found;
  }();
  return driver;
}

const void* key_of(H5FD_t* file) {
  void* descriptor = nullptr;
  plain_driver().get_handle(file, H5P_DEFAULT, &descriptor);
  return descriptor;
}

/// What HDF5 is told after something it asked for was tried: that it succeeded.
herr_t remembered(WriteFault& fault, std::string words) {
  fault.dropping = true;
  fault.words = std::move(words);
  return 0;
}

herr_t remembered(WriteFault& fault, herr_t result) {
  if (result >= 0) return 0;
  remembered(fault, words_on(H5E_DEFAULT));
  H5Eclear2(H5E_DEFAULT);
  return 0;
}

/// What is in the file stays: HDF5 would empty it.
H5FD_t* open_as_it_is(const char* name, unsigned, hid_t list, haddr_t largest) {
  return plain_driver().open(name, H5F_ACC_RDWR, list, largest);
}

/// HDF5 makes a file only of an empty one.
haddr_t end_as_told(const H5FD_t* file, H5FD_mem_t type) {
  return behind != nullptr ? 0 : plain_driver().get_eof(file, type);
}

/// Space at the end of the file, behind the bytes that HDF5 is not to touch.
haddr_t space_for(H5FD_t* file, H5FD_mem_t type, hid_t, hsize_t size) {
  if (placement != nullptr && type == H5FD_MEM_DRAW && placement->is_of(size)) {
    placement->take();
    return placement->address();
  }
  const haddr_t end = plain_driver().get_eoa(file, type);
  const haddr_t at = type != H5FD_MEM_SUPER && behind != nullptr && end < behind->end() ? behind->end() : end;
  plain_driver().set_eoa(file, type, at + size);
  return at;
}

/// HDF5 asks for every piece of space by itself, from `space_for`, instead of cutting it from larger ones.
herr_t abilities(const H5FD_t* file, unsigned long* flags) {
  const herr_t result = plain_driver().query(file, flags);
  if (flags != nullptr) *flags &= ~static_cast<unsigned long>(H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_AGGREGATE_SMALLDATA);
  return result;
}

herr_t write(H5FD_t* file, H5FD_mem_t type, hid_t list, haddr_t at, std::size_t size, const void* from) {
  if (placement != nullptr && type == H5FD_MEM_DRAW && at == placement->address() && placement->is_of(size)) {
    placement->take();
    return 0;
  }
  const std::shared_ptr<WriteFault> fault = faults().at(key_of(file));
  if (fault->dropping) return 0;
  if (!disk::may("write")) return remembered(*fault, std::strerror(errno));
  return remembered(*fault, plain_driver().write(file, type, list, at, size, from));
}

herr_t truncate(H5FD_t* file, hid_t list, hbool_t closing) {
  const std::shared_ptr<WriteFault> fault = faults().at(key_of(file));
  return fault->dropping ? 0 : remembered(*fault, plain_driver().truncate(file, list, closing));
}

herr_t close(H5FD_t* file) {
  const void* key = key_of(file);
  const std::shared_ptr<WriteFault> fault = faults().at(key);
  faults().forget(key);
  return remembered(*fault, plain_driver().close(file));
}

herr_t read(H5FD_t* file, H5FD_mem_t type, hid_t list, haddr_t at, std::size_t size, void* into) {
  if (type != H5FD_MEM_DRAW || locator == nullptr) return plain_driver().read(file, type, list, at, size, into);
  locator->note(at, size);
  return 0;
}

/// A file that was only read loses nothing when closing fails; HDF5 would not survive it.
herr_t close_read(H5FD_t* file) {
  if (plain_driver().close(file) < 0) H5Eclear2(H5E_DEFAULT);
  return 0;
}

hid_t registered_to_read() {
  H5FD_class_t driver = plain_driver();
  driver.name = "portrait_reading";
  driver.terminate = nullptr;
  driver.read = read;
  driver.close = close_read;
  return called(H5FDregister(&driver));
}

hid_t registered() {
  H5FD_class_t driver = plain_driver();
  driver.name = "portrait";
  driver.terminate = nullptr;
  driver.open = open_as_it_is;
  driver.query = abilities;
  driver.alloc = space_for;
  driver.get_eof = end_as_told;
  driver.write = write;
  driver.truncate = truncate;
  driver.close = close;
  return called(H5FDregister(&driver));
}

}  // namespace

void remember_failed_writes(const H5::FileAccPropList& list) {
  static const hid_t driver = registered();
  called(H5Pset_driver(list.getId(), driver, nullptr));
}

void locate_reads(const H5::FileAccPropList& list) {
  static const hid_t driver = registered_to_read();
  called(H5Pset_driver(list.getId(), driver, nullptr));
}

Behind::Behind(std::uint64_t end) : end_(end) { behind = this; }

Behind::~Behind() { behind = nullptr; }

Placement::Placement(std::uint64_t address, std::uint64_t length) : address_(address), length_(length) {
  placement = this;
}

Placement::~Placement() { placement = nullptr; }

ReadLocator::ReadLocator() { locator = this; }

ReadLocator::~ReadLocator() { locator = nullptr; }

int& descriptor_of(const H5::H5File& file) {
  void* descriptor = nullptr;
  called(H5Fget_vfd_handle(file.getId(), H5P_DEFAULT, &descriptor));
  return *static_cast<int*>(descriptor);
}

std::shared_ptr<WriteFault> fault_of(const H5::H5File& file) { return faults().at(&descriptor_of(file)); }

}  // namespace portrait::h5
