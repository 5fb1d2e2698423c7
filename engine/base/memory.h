/// How the program's allocator treats memory that is freed.
#pragma once

namespace portrait {

/// Keeps up to 64 MB of freed memory with the process. A sweep's tiles come and go, a megabyte each: the GNU allocator would
/// give them back to the system every time, which then has to clear new pages for the next one. For programs, in main.
/// cost      nothing while a program runs; bench/store_rate.cpp prints what storing costs, stage by stage
void keep_freed_memory();

}  // namespace portrait
