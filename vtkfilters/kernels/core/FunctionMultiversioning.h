// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_FunctionMultiversioning_h
#define novelview_FunctionMultiversioning_h

/**
 * Before a function that is to be compiled twice, for any processor and for one with wider
 * registers; the program takes what the machine has. Both do the same operations on each element,
 * so that the results are the same bits: no sums across elements in such a function, and no fused
 * multiply-add (see the compile options). Not for ThreadSanitizer, whose code would run in the choice
 * between them, which the loader makes before anything is set up.
 */
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) &&       \
  !defined(__SANITIZE_THREAD__)
#define NOVELVIEW_CLONES __attribute__((target_clones("avx2", "default")))
/** The same for two definitions of a function, where one text is not the best for both. */
#define NOVELVIEW_FOR_AVX2 __attribute__((target("avx2")))
#define NOVELVIEW_FOR_ANY __attribute__((target("default")))
#else
#define NOVELVIEW_CLONES
#define NOVELVIEW_FOR_ANY
#endif

#endif
