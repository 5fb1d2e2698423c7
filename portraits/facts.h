/// Where a portrait comes from: who computed it, with what, when and how long.
#pragma once

#include <cstdint>
#include <string>

#include "portraits/h5.h"

namespace portrait {

/// Known when a sweep begins.
struct Provenance {
  std::string command_line;  ///< "portrait sweep grid.toml -o file.h5"
  std::string method;        ///< engine and instruction set that compute it
  std::string date = {};     ///< when it began; empty: now
};

/// Known when it ends.
struct RunFacts {
  double wall_seconds = 0;
  int threads = 1;
};

/// What a file says of its own origin.
struct Facts {
  std::string schema_version, program, history, date_created, method, compiler, hdf5_version, state;
  double wall_seconds = 0;
  std::int64_t threads = 0;
};

/// "2025-01-31T09:30:00Z": now, or the time in SOURCE_DATE_EPOCH (seconds since 1970), by which builds that
/// must repeat byte for byte fix their dates. Throws InputError when that is no such number.
std::string date_text();

void write_provenance(const h5::File& file, const Provenance& provenance);
void write_run_facts(const h5::File& file, const RunFacts& facts);
Facts read_facts(const h5::File& file);

}  // namespace portrait
