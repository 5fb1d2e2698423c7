// HDF5 1.10 forgets some of its own memory when it gives up on a damaged file. The leak detector asks here what to
// pass over; a build without it never calls this.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5_serial\n"; }
