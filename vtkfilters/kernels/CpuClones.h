// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_CpuClones_h
#define novelview_CpuClones_h

/**
 * Before a function that is to be compiled twice, for any processor and for one with wider
 * registers; the program takes what the machine has. Both do the same operations on each element,
 * so that the results are the same bits: no sums across elements in such a function, and no fused
 * multiply-add (see the compile options).
 */
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__)
#define NOVELVIEW_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define NOVELVIEW_CLONES
#endif

#endif
