/// What can go wrong outside our own code, by who can mend it.
///
///     InputError      the user's text or arguments: says where and what to write instead       exit code 2
///     StoreError      disk or HDF5: file, object, the library's own words                      exit code 1
///     IntegrityError  a stored portrait is not what was written                                exit code 4
///
/// The library throws; only tools/ prints and exits.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace portrait {

/// A place in a text, counted from 1; 0 means unknown.
struct Place {
  std::string source;  ///< file name, or what else the text is: "--where"
  std::size_t line = 0;
  std::size_t column = 0;
};

/// "grid.toml:12:9"; leaves out what is unknown.
std::string to_string(const Place& place);

class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  /// "grid.toml:12:9: unknown key "kapa" (did you mean "kappa"?)"
  InputError(const Place& place, const std::string& message)
      : std::runtime_error(to_string(place) + ": " + message) {}
};

class StoreError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class IntegrityError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace portrait
