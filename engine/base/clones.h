/// Loops over many numbers, made once for each width of vectors; which one runs is found out when the program starts.
///
/// result    the same bits of each: for loops whose numbers do not meet, or meet in a way that no width changes
///           (whole numbers, minima)
/// For code beside the engine: the kernel chooses its instruction set itself (engine/isa).
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define PORTRAIT_CLONES [[gnu::target_clones("avx512f", "avx2", "default"), gnu::noinline]]
#else
#define PORTRAIT_CLONES
#endif
