/// What changes a folder and must last: whole files that appear at once, syncs, renames.
///
/// errors    StoreError with the file and the system's words; InputError where a file is in the way
#pragma once

#include <filesystem>
#include <string>

namespace portrait::disk {

/// For tests: called before everything that changes the disk. What it gives back, unless 0, is the error (errno) that
/// the call then fails with; it may also end the process.
using Hook = int (*)(const char* call);
void set_hook(Hook hook);
/// Whether the hook lets the call pass; sets errno when it does not.
bool may(const char* call);

[[noreturn]] void failed(const std::filesystem::path& path, const char* doing);

std::filesystem::path directory_of(const std::filesystem::path& file);
void sync_file(const std::filesystem::path& path);
void sync_directory(const std::filesystem::path& path);
/// In one step, over whatever has the name.
void rename(const std::filesystem::path& from, const std::filesystem::path& to);
/// In one step; false when something has the name already.
bool rename_unless_there(const std::filesystem::path& from, const std::filesystem::path& to);
void remove(const std::filesystem::path& path);

/// A file with these bytes, synced under a temporary name (PATH.PID-HOST.tmp), read back, renamed, and its directory
/// synced: in the place of another, or only where there is none (then false says that there was one).
void write_whole_file(const std::filesystem::path& path, const std::string& bytes);
bool write_new_file(const std::filesystem::path& path, const std::string& bytes);
/// Everything in a file. Throws StoreError when it cannot be read.
std::string read_whole_file(const std::filesystem::path& path);

}  // namespace portrait::disk
